"""A user of whom the system knows nothing but a number, as containers give: no passwd entry, no HOME."""

import os
import subprocess
import sys

import pytest
from tables import each_row

from controller.commands.update import make_release as update_make_release
from controller.errors import UpdateError

NUMBER = 54321
AS_NOBODY = ["unshare", "--user", f"--map-user={NUMBER}"]


def run(*arguments, folder, **environment):
    known = {name: value for name, value in os.environ.items() if name not in {"HOME", "XDG_CACHE_HOME", "STATE_DIRECTORY", "USER"}}
    done = subprocess.run(
        [*AS_NOBODY, sys.executable, "-m", "controller", *arguments],
        cwd=folder, env=known | environment, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert "Traceback" not in done.stderr, done.stderr
    return done


@pytest.fixture(autouse=True)
def namespaces():
    if subprocess.run([*AS_NOBODY, "true"], capture_output=True, check=False).returncode:
        pytest.skip("this kernel lets nobody make user namespaces")


@each_row("command", [("bank", "build", "--pitch-mm", "20"), ("run", "--speed", "max"), ("bank", "choices")])
def test_what_is_to_be_kept_has_no_place_and_that_is_said(tmp_path, command):
    done = run(*command, folder=tmp_path)
    assert done.returncode == 78
    assert done.stderr == (
        f"haptic-panel: user {NUMBER} has no home folder for what is kept: set HOME, XDG_CACHE_HOME or STATE_DIRECTORY\n"
    )
    assert list(tmp_path.iterdir()) == [], "and no folder of the name ~"


def test_what_keeps_nothing_needs_no_place(tmp_path):
    assert run("board", "check", "simulated", folder=tmp_path).returncode == 0
    assert run("--version", folder=tmp_path).returncode == 0


def test_a_place_that_is_given_is_taken(tmp_path):
    for name in ("XDG_CACHE_HOME", "STATE_DIRECTORY", "HOME"):
        place = tmp_path / name
        place.mkdir()
        done = run("bank", "build", "--pitch-mm", "4", "--scene", "slider", folder=tmp_path, **{name: str(place)})
        assert done.returncode == 0, done.stderr
        assert list(place.rglob("*.bank"))


def test_without_git_a_release_says_what_gives_it_its_time(tmp_path, monkeypatch):
    monkeypatch.delenv("SOURCE_DATE_EPOCH", raising=False)
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(UpdateError, match=r"git is not installed: apt-get install git\): set SOURCE_DATE_EPOCH"):
        update_make_release._time_s(tmp_path)
