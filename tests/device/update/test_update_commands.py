"""`haptic-panel update check` and `download`: figures, one line for each refusal, exit codes, and an end in time."""

import json
import signal
import socket
import subprocess
import sys
from pathlib import Path

import pytest
from repository_fixture import Device, Publisher, key

from controller.cli import main
from controller.commands.update import check as update_check
from controller.device.update.settings import UpdateSettings


@pytest.fixture
def repository(tmp_path, monkeypatch):
    """A repository signed now, and the device that this computer is taken for."""
    publisher = Publisher(tmp_path / "repository", now=None)
    device = publisher.device = Device(tmp_path, publisher.root)
    monkeypatch.setenv("HAPTIC_PANEL_ROOT", str(device.layout.root))
    monkeypatch.setenv("HAPTIC_PANEL_TRUSTED_ROOT", str(device.layout.trusted_root))
    return publisher


def test_from_check_to_download(repository, capsys, monkeypatch):
    """From a folder: without a network, which nothing may ask for."""

    def no_network(*_):
        raise AssertionError("a socket was asked for")

    monkeypatch.setattr(socket, "socket", no_network)
    monkeypatch.setattr(socket, "getaddrinfo", no_network)
    repository.release("1.0", 1, {"wheels/a.whl": b"wheel"})
    source = ["--from", str(repository.folder)]
    assert main(["update", "check", *source]) == 0
    said = capsys.readouterr().out
    assert "offers 1.0 (counter 1); in use: no release" in said
    assert "at most 5 of 5 bytes to fetch" in said
    assert main(["update", "check", "--json", *source]) == 0
    figures = json.loads(capsys.readouterr().out)
    assert (figures["offered"], figures["new"], figures["missing_bytes"], figures["refused"]) == ("1.0", True, 5, "")
    assert main(["update", "download", "--json", *source]) == 0
    figures = json.loads(capsys.readouterr().out)
    assert (figures["version"], figures["release_bytes"], figures["kept_bytes"]) == ("1.0", 5, 0)
    assert main(["update", "download", *source]) == 0
    assert "5 were here" in capsys.readouterr().out


def test_a_refusal_is_one_line_and_exit_code_1(repository, capsys):
    repository.release("1.0", 1, {"wheels/a.whl": b"wheel"}, fall_back=9)
    source = ["--from", str(repository.folder)]
    assert main(["update", "check", *source]) == 1
    assert capsys.readouterr().out.startswith("REFUSED ")
    assert main(["update", "download", *source]) == 1
    said = capsys.readouterr()
    assert (said.out, said.err.count("\n")) == ("", 1)
    assert "release 1.0 needs a newer Debian package" in said.err


def test_without_a_source_it_says_so(repository, capsys):
    assert main(["update", "check"]) == 1
    assert "no repository is set" in capsys.readouterr().err


def test_a_release_in_use_is_nothing_to_do(repository, capsys):
    repository.device.install(repository.release("1.0", 1, {"wheels/a.whl": b"wheel"}))
    reported = {"check": "1.0 is what channel stable offers: nothing to do", "download": "1.0 is in use: nothing to fetch"}
    for command, said in reported.items():
        assert main(["update", command, "--from", str(repository.folder)]) == 0
        assert capsys.readouterr().out == f"{said}\n"


def test_whatever_hangs_ends(monkeypatch, capsys):
    """Such as a server that sends a header for ever, which no limit between two bytes of a body sees."""
    monkeypatch.setattr(update_check, "load_settings", lambda: UpdateSettings(total_s=0.01))
    monkeypatch.setattr(update_check, "ALARM_AFTER_S", 0.01)
    monkeypatch.setattr(update_check, "refuse_root", lambda _: None)
    monkeypatch.setattr("controller.device.update.download.fetch.check", lambda *_: signal.pause())
    assert main(["update", "check"]) == 1
    assert "not done within 0.01 s (total_s of update.toml)" in capsys.readouterr().err
    assert signal.getitimer(signal.ITIMER_REAL) == (0.0, 0.0)


BARE = """
import sys
for name in ("cryptography", "scipy", "matplotlib", "tqdm", "cyclonedx", "cyclonedx_py"):
    sys.modules[name] = None
from controller.cli import main
sys.exit(main(["update", "download", "--json", "--from", sys.argv[1]]))
"""


def test_a_device_needs_no_cryptography(repository):
    """Of python-tuf's and the publisher's packages a device has only the former: signatures are verified in Python."""

    def download():
        checkout, command = Path(__file__).parents[3], [sys.executable, "-c", BARE, repository.folder]
        return subprocess.run(command, capture_output=True, text=True, check=False, cwd=checkout)

    repository.release("1.0", 1, {"wheels/a.whl": b"wheel"})
    done = download()
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout)["version"] == "1.0"
    repository.signers["timestamp"] = [key("stranger")]
    repository.stamp()
    done = download()
    assert (done.returncode, done.stderr.count("\n")) == (1, 1)
    assert "is not signed by this device's owner" in done.stderr
