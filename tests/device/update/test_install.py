"""A release built from the store: whole, or nothing of it."""

import ensurepip
import hashlib
import json
import os
import signal
import subprocess
import sysconfig
import zipfile
from pathlib import Path

import msgspec
import pytest
from tables import each_row

from controller.cli import main
from controller.device.update.install import install, prune
from controller.device.update.installed import update_state
from controller.device.update.layout import Layout
from controller.device.update.manifest import Manifest, ReleaseFile, this_platform
from controller.device.update.settings import UpdateSettings
from controller.errors import UpdateError

CONTROLLER = {"controller/__init__.py": "", "controller/__main__.py": "print('haptic-panel tiny')\n"}
# Debian's Python has its wheels in a folder of its own.
WHEELS = Path(sysconfig.get_config_var("WHEEL_PKG_DIR") or Path(ensurepip.__file__).parent / "_bundled")
PIP = max(WHEELS.glob("pip-*.whl"))


def wheel(files):
    """Bytes of a wheel with these modules."""
    import io

    about = "haptic_panel-9.dist-info"
    files = files | {f"{about}/METADATA": "Metadata-Version: 2.1\nName: haptic-panel\nVersion: 9\n"}
    files |= {f"{about}/WHEEL": "Wheel-Version: 1.0\nGenerator: test\nRoot-Is-Purelib: true\nTag: py3-none-any\n"}
    record = "".join(f"{name},,\n" for name in [*files, f"{about}/RECORD"])
    made = io.BytesIO()
    with zipfile.ZipFile(made, "w") as archive:
        for name, text in (files | {f"{about}/RECORD": record}).items():
            archive.writestr(zipfile.ZipInfo(name), text)  # with the same date each time
    return made.getvalue()


@pytest.fixture
def device(tmp_path):
    layout = Layout(tmp_path / "root")
    for folder in (layout.releases, layout.store, layout.download, layout.state, layout.requests):
        folder.mkdir(parents=True)
    return layout


def release(layout, version="9", counter=1, controller=CONTROLLER, **more):
    """A manifest whose files are in the store."""
    contents = {
        f"wheels/{PIP.name}": PIP.read_bytes(),
        "wheels/haptic_panel-9-py3-none-any.whl": wheel(controller),
        "banks/panel.bank": b"bank" * 1000,
        "boards/panel/board.toml": b"name = 'panel'\n",
    }
    files = []
    for path, data in contents.items():
        digest = hashlib.sha256(data).hexdigest()
        stored = layout.store / digest
        if not stored.exists():
            stored.write_bytes(data)
            stored.chmod(0o444)
        files.append(ReleaseFile(path=path, sha256=digest, size_bytes=len(data)))
    architecture, python = this_platform().split("-cp3")
    known = {"protocol": 2, "gateware_hash": "0" * 8, "bank_format": 4, "settings_format": 1}
    return Manifest(version=version, counter=counter, python=f"3.{python}", architecture=architecture, files=files, **known | more)


def files_of(folder):
    return {str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file()}


def test_a_release_is_built_from_the_store_alone_and_starts(device, monkeypatch):
    monkeypatch.setenv("PIP_TARGET", str(device.root / "elsewhere"))  # a setting of this computer's
    synced = device.root / "synced"
    (device.root / "bin").mkdir()
    notes = f'#!/bin/sh\n[ -e "$2/.complete" ]\necho $1 $2 $? >> {synced}\nPATH=${{PATH#*:}} exec sync "$@"\n'
    (device.root / "bin/sync").write_text(notes)
    (device.root / "bin/sync").chmod(0o755)
    monkeypatch.setenv("PATH", f"{device.root / 'bin'}:{os.environ['PATH']}")
    (device.release("9") / "venv/lib").mkdir(parents=True)
    (device.release("9") / "venv/lib/part").write_text("of an installation that was interrupted")
    manifest = release(device)
    steps = []
    install(device, manifest, lambda done, _: steps.append(done))
    folder = device.release("9")
    assert device.is_complete("9")
    on_disk = [f"-f {device.releases} 1", f"-f {folder} 1", f"-f {folder} 0"]  # nothing of it; all but that it is complete; that
    assert synced.read_text().splitlines() == on_disk
    assert steps == [1, 2, 3, 4, 5]
    assert (folder / "release.json").read_bytes() == manifest.to_json()
    assert (folder / "banks/panel.bank").stat().st_nlink == 2, "shared with the store"
    assert not (folder / "wheels").exists()
    assert "venv/lib/part" not in files_of(folder)
    said = subprocess.run([folder / "venv/bin/python", "-I", "-m", "controller"], capture_output=True, text=True, check=True).stdout
    assert said == "haptic-panel tiny\n"
    assert any(name.endswith(".pyc") and "controller" in name for name in files_of(folder / "venv"))
    before = files_of(folder)
    install(device, manifest)
    assert files_of(folder) == before
    with pytest.raises(UpdateError, match="another release 9 is installed: what differs needs another version"):
        install(device, msgspec.structs.replace(manifest, counter=2))
    assert device.is_complete("9")


def damaged(device, manifest):
    stored = device.store / manifest.files[2].sha256
    stored.chmod(0o644)
    stored.write_bytes(b"knab" * 1000)
    return manifest


def absent(device, manifest):
    (device.store / manifest.files[1].sha256).unlink()
    return manifest


def without_pip(_, manifest):
    return msgspec.structs.replace(manifest, files=manifest.files[1:])


@pytest.mark.parametrize(
    ("spoil", "options", "said"),
    [
        (damaged, {}, "banks/panel.bank is damaged: haptic-panel update download"),
        (absent, {}, "haptic_panel-9-py3-none-any.whl is not there: haptic-panel update download"),
        (without_pip, {}, "release 9 has 0 wheels of pip"),
        (None, {"fall_back": 99}, "needs a newer Debian package"),
        (
            None,
            {"controller": {"controller/__init__.py": "", "controller/__main__.py": "import nothing"}},
            "No module named 'nothing'",
        ),
        pytest.param(None, {"controller": {"controller/__init__.py": "1 +"}}, "compileall failed", marks=pytest.mark.slow),
    ],
)
def test_what_cannot_be_built_leaves_nothing(device, spoil, options, said):
    manifest = release(device, **options)
    if spoil:
        manifest = spoil(device, manifest)
    with pytest.raises(UpdateError, match=said) as refused:
        install(device, manifest)
    assert "\n" not in str(refused.value)
    assert not list(device.releases.iterdir())


def test_another_platform_is_refused(device):
    with pytest.raises(UpdateError, match=r"is for s390x-cp311, and this is .*: fetch the one for this platform"):
        install(device, msgspec.structs.replace(release(device), architecture="s390x", python="3.11"))


def test_what_nothing_leads_to_is_removed(device, monkeypatch):
    shared = {file.sha256 for file in release(device).files}
    for number in range(1, 6):
        folder = device.release(str(number))
        folder.mkdir()
        old = device.store / hashlib.sha256(f"{number}".encode()).hexdigest()
        old.write_text(f"{number}")
        manifest = release(device, version=str(number))
        own = ReleaseFile(path="banks/own.bank", sha256=old.name, size_bytes=1)
        (folder / "release.json").write_bytes(msgspec.structs.replace(manifest, files=[*manifest.files, own]).to_json())
        (folder / ".complete").touch()
    for name, version in (("current", "3"), ("previous", "2"), ("trial", "4")):
        (device.state / name).write_text(f"{version}\n")
    device.current.symlink_to("releases/4")
    monkeypatch.setattr("controller.device.update.install.running_release", lambda: device.release("5"))
    assert prune(device, release(device, version="6")) == ["1"], "the release that does this is kept, too"
    monkeypatch.setattr("controller.device.update.install.running_release", lambda: None)
    assert prune(device, release(device, version="6")) == ["5"]
    assert {folder.name for folder in device.releases.iterdir()} == {"2", "3", "4"}
    kept = {hashlib.sha256(f"{number}".encode()).hexdigest() for number in (2, 3, 4)}
    assert {file.name for file in device.store.iterdir()} == kept | shared


def test_releases_of_others_are_left_and_do_not_end_an_update(device, monkeypatch):
    """Such as root's, installed from a checkout before the package."""
    for number in (1, 2):
        device.release(str(number)).mkdir()
    monkeypatch.setattr("controller.device.update.install.os.geteuid", lambda: 12345)
    assert prune(device, release(device, version="6")) == []
    assert len(list(device.releases.iterdir())) == 2


BROKEN = {"controller/__init__.py": "", "controller/__main__.py": "import nothing"}


@pytest.fixture
def offered(device, monkeypatch):
    """What is offered to a device whose commands are run here: a function that sets it."""
    monkeypatch.setenv("HAPTIC_PANEL_ROOT", str(device.root))
    monkeypatch.setattr("controller.commands.update.check.load_settings", lambda: UpdateSettings(source="somewhere"))
    return lambda manifest: monkeypatch.setattr("controller.device.update.download.fetch.fetch", lambda *_, **__: manifest)


def test_an_installation_that_fails_is_remembered_shown_and_tried_again_ever_more_rarely(device, offered, monkeypatch, capsys):
    tries = []
    monkeypatch.setattr(
        "controller.device.update.install._build", lambda *_: tries.append(1) or (_ for _ in ()).throw(UpdateError("no\nway"))
    )
    offered(manifest := release(device))
    looks = [main(["update", "install", "--automatic"]) for _ in range(1 + 1 + 2 + 4 + 8)]
    assert [look for look, code in enumerate(looks) if code] == [0, 1, 3, 7, 15]
    assert len(tries) == 5
    assert update_state(device).not_installed == "release 9 could not be installed, 5 times: no way"
    capsys.readouterr()
    main(["update", "status"])
    assert (
        "release 9 could not be installed, 5 times: no way: haptic-panel update install tries it again" in capsys.readouterr().out
    )
    assert main(["update", "install"]) == 1, "by hand, at once"
    assert len(tries) == 6
    offered(msgspec.structs.replace(manifest, counter=2))
    assert main(["update", "install", "--automatic"]) == 1, "another release is tried"
    assert update_state(device).not_installed == "release 9 could not be installed, once: no way"


def test_an_installation_that_goes_well_is_not_called_failed(device, offered):
    offered(release(device, controller=BROKEN))
    assert main(["update", "install"]) == 1
    assert "No module named 'nothing'" in update_state(device).not_installed
    offered(release(device))
    assert main(["update", "install"]) == 0
    assert update_state(device).not_installed == ""
    assert (device.requests / "trial").read_text() == "9\n"


@each_row("damaged", [b"", b"{", b'{"version": 1}', b"\xff", b"[" * 100_000], afresh=[device])
def test_what_is_remembered_may_be_damaged(device, damaged):
    (device.download / "install_failed.json").write_bytes(damaged)
    assert update_state(device).not_installed == ""


def test_an_installation_that_hangs_ends_and_leaves_nothing(device, offered, monkeypatch, capsys):
    monkeypatch.setattr("controller.commands.update.install.INSTALL_S", 0.2)
    offered(release(device, controller={"controller/__init__.py": "", "controller/__main__.py": "import time; time.sleep(1e6)"}))
    assert main(["update", "install"]) == 1
    assert "release 9: not installed within 0.2 s; nothing of it is left" in capsys.readouterr().err
    assert not list(device.releases.iterdir())
    assert "not installed within 0.2 s" in update_state(device).not_installed
    assert signal.getitimer(signal.ITIMER_REAL) == (0.0, 0.0)


def test_the_state_is_reported_whatever_it_is(device, monkeypatch, capsys):
    monkeypatch.setenv("HAPTIC_PANEL_ROOT", str(device.root))
    assert main(["update", "status"]) == 1
    assert "no release is in use" in capsys.readouterr().out
    assert main(["update", "rollback"]) == 1
    assert "there is no release before this one to go back to" in capsys.readouterr().err
    for version in ("1", "2"):
        device.release(version).mkdir()
        (device.release(version) / "release.json").write_bytes(release(device, version, int(version)).to_json())
        (device.release(version) / ".complete").touch()
    device.current.symlink_to("releases/2")
    for name, word in (("current", "2"), ("previous", "1"), ("failed", "3\n../x")):
        (device.state / name).write_text(f"{word}\n")
    assert main(["update", "status", "--json"]) == 0
    reported = json.loads(capsys.readouterr().out)
    assert (reported["in_use"], reported["previous"], reported["failed"], reported["problems"]) == ("2", "1", ["3"], [])
    assert [one["version"] for one in reported["releases"]] == ["2", "1"]
    assert reported["releases"][0]["size_bytes"] == sum(file.size_bytes for file in release(device).files)
    assert main(["update", "rollback"]) == 0
    assert (device.requests / "rollback").read_text() == "2\n"
    assert update_state(device).requested == ("rollback",)
    (device.state / "trial").write_bytes(b"\0\xff")
    (device.release("1") / "release.json").write_text("{")
    assert main(["update", "status"]) == 1
    said = capsys.readouterr().out
    assert f"WRONG {device.state / 'trial'}: is damaged" in said
    assert f"WRONG {device.release('1') / 'release.json'}: cannot be read" in said


def test_the_timer_does_what_the_settings_say_and_waits_for_a_trial(device, monkeypatch, capsys):
    monkeypatch.setenv("HAPTIC_PANEL_ROOT", str(device.root))

    def automatic(**settings):
        monkeypatch.setattr("controller.commands.update.check.load_settings", lambda: UpdateSettings(**settings))
        code = main(["update", "install", "--automatic"])
        return code, *capsys.readouterr()

    assert automatic() == (0, "update.toml names no source: nothing to do\n", "")
    absent = str(device.root / "stick")
    for what in ("check", "download", "install"):
        code, _, why = automatic(source=absent, automatic=what)
        assert (code, why.count("\n")) == (1, 1)
        assert "is the stick plugged in and mounted?" in why
    (device.state / "trial").write_text("2\n")
    assert automatic(source=absent) == (0, "2 is on trial: nothing to do\n", "")
    assert main(["update", "install", "--from", absent]) == 1
    assert "release 2 is on trial: wait until it is decided" in capsys.readouterr().err
