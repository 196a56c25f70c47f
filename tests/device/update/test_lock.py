"""Locks: one process at a time, and no other user of the machine can take or hold them."""

import fcntl
import os
import subprocess
import tempfile
from pathlib import Path

import pytest
from tables import each_row
from tiny_release import NOW, TinyRepository

from controller.device.update.lock import alone
from controller.errors import UpdateError
from controller.workshop.gateware.rtl_build import _one_at_a_time
from controller.workshop.publish.publications import draft_renewal
from controller.workshop.publish.publisher import Repository
from controller.workshop.workers.kept_file import KeptFile

NOBODY = 65534


@pytest.fixture
def readable():
    """A folder that every user may look into."""
    with tempfile.TemporaryDirectory() as folder:
        Path(folder).chmod(0o755)
        yield Path(folder)


def test_one_process_at_a_time(tmp_path):
    lock = tmp_path / "lock"
    with alone(lock):
        assert lock.stat().st_mode & 0o777 == 0o600
        with pytest.raises(UpdateError, match=f"{lock}: another update is at work"), alone(lock):
            pass
        with pytest.raises(UpdateError, match=f"{lock}: wait"), alone(lock, "wait"):
            pass
    with alone(lock):
        pass


def test_a_lock_that_an_earlier_release_has_left_open_to_others_is_closed_to_them(tmp_path):
    lock = tmp_path / "lock"
    lock.touch()
    lock.chmod(0o644)
    with alone(lock):
        assert lock.stat().st_mode & 0o777 == 0o600
    lock.chmod(0o644)
    with lock.open("rb") as held:  # and somebody has it already: it is not ignored
        fcntl.flock(held, fcntl.LOCK_SH)
        with pytest.raises(UpdateError, match="another update is at work"), alone(lock):
            pass


@each_row("kind", ["link", "pipe", "folder"])
def test_what_is_no_file_is_no_lock(tmp_path, kind):
    lock, other = tmp_path / "lock", tmp_path / "other"
    other.touch(0o644)
    {"link": lambda: lock.symlink_to(other), "pipe": lambda: os.mkfifo(lock), "folder": lock.mkdir}[kind]()
    with pytest.raises(OSError, match=r"symbolic link|not a regular file|Is a directory"), alone(lock):
        pass
    assert other.stat().st_mode & 0o777 == 0o644


@pytest.mark.skipif(os.geteuid() != 0, reason="opens files as another user")
def test_no_other_user_can_open_a_lock(readable):
    with alone(readable / "lock"), _one_at_a_time(readable / "x"), KeptFile.open(readable / "kept"):
        names = ["lock", ".x.lock", "kept"]
        assert sorted(path.name for path in readable.iterdir()) == sorted(names)
        for name in names:
            done = subprocess.run(["flock", "-sn", name, "true"], cwd=readable, user=NOBODY, group=NOBODY, extra_groups=[],
                                  capture_output=True, text=True, check=False)  # fmt: skip
            assert done.returncode != 0
            assert "Permission denied" in done.stderr


def test_a_folder_that_others_lock_holds_nobody_up(tmp_path):
    repository = TinyRepository(tmp_path / "repository", tmp_path / "keys")
    held = [os.open(folder, os.O_RDONLY) for folder in (tmp_path, repository.folder)]
    try:
        for folder in held:
            fcntl.flock(folder, fcntl.LOCK_EX)
        with Repository.opened(repository.folder) as opened:
            draft_renewal(opened, NOW)
            with pytest.raises(UpdateError, match="another process works on this repository"), Repository.opened(repository.folder):
                pass
        with _one_at_a_time(tmp_path / "gateware"):
            pass
    finally:
        for folder in held:
            os.close(folder)


def test_a_lock_of_the_repository_that_cannot_be_opened_is_not_ignored(tmp_path):
    repository = TinyRepository(tmp_path / "repository", tmp_path / "keys")
    (repository.folder / ".lock").unlink()
    (repository.folder / ".lock").mkdir()
    said = r"lock: cannot be opened .Is a directory.: let the user who owns it"
    with pytest.raises(UpdateError, match=said), Repository.opened(repository.folder):
        pass


@pytest.mark.skipif(os.geteuid() == 0, reason="root may write everywhere")
def test_a_repository_that_cannot_be_changed_can_be_looked_at(tmp_path):
    repository = TinyRepository(tmp_path / "repository", tmp_path / "keys")
    (repository.folder / ".lock").unlink()
    repository.folder.chmod(0o555)
    try:
        with Repository.opened(repository.folder) as opened:
            assert opened.published("timestamp").signed.version == 1
    finally:
        repository.folder.chmod(0o755)
