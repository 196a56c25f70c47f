"""`doctor` on releases and updates: one finding for each thing that may be wrong, and none where there are no releases."""

import json
import os
from datetime import UTC, datetime
from types import SimpleNamespace

import pytest
from tables import each_row

from controller.device.doctor import update_examination
from controller.device.doctor.update_examination import look_at_updates
from controller.device.update.failed_install import remember
from controller.device.update.installed import manifest_of
from controller.device.update.layout import Layout
from controller.device.update.manifest import Manifest
from controller.device.update.trust import validity

NOW = datetime(2026, 11, 22, 12, tzinfo=UTC)


class Device:
    """A device with release 1.0 in use, whose folders belong to this user."""

    def __init__(self, root):
        self.layout = Layout(root / "opt", root / "root.json")
        self.settings = root / "update.toml"
        self.now = NOW
        for name, mode in {"state": 0o755, "releases": 0o755, "store": 0o755, "requests": 0o775, "download": 0o755}.items():
            (root / "opt" / name).mkdir(parents=True)
            (root / "opt" / name).chmod(mode)
        release = self.layout.release("1.0")
        release.mkdir()
        manifest = Manifest(
            version="1.0", counter=1, python="3.11", architecture="x86_64", protocol=2, gateware_hash="0" * 8, bank_format=4,
            settings_format=1, built_s=1_700_000_000, files=[],
        )  # fmt: skip
        (release / "release.json").write_bytes(manifest.to_json())
        (release / ".complete").touch()
        self.layout.current.symlink_to("releases/1.0")
        self.state("current", "1.0")
        self.expires("2031-01-01T00:00:00Z")
        self.settings.write_text('source = "https://updates.example"\n')

    def state(self, name, word):
        (self.layout.state / name).write_text(f"{word}\n")

    def expires(self, moment):
        self.layout.trusted_root.write_text(json.dumps({"signed": {"expires": moment}}))

    def found(self):
        """What is said of each, and whether it is good, warned of or wrong."""
        findings = look_at_updates(self.layout, self.settings)
        return {each.about: ("warns" if each.warns else "good" if each.good else "wrong", each.said) for each in findings}


@pytest.fixture
def device(tmp_path, monkeypatch):
    monkeypatch.setattr(update_examination, "BOOTED", tmp_path / "no systemd")
    device = Device(tmp_path)

    class Clock(datetime):
        @classmethod
        def now(cls, tz=None):
            assert tz is UTC
            return device.now

    monkeypatch.setattr(validity, "datetime", Clock)
    me = device.layout.root.owner()
    monkeypatch.setattr(update_examination, "OWNERS", {name: (me, mode) for name, (_, mode) in update_examination.OWNERS.items()})
    return device


def test_all_is_well(device):
    found = device.found()
    assert {about: how for about, (how, _) in found.items() if how != "good"} == {}
    assert found["release"][1] == "1.0 is in use"
    assert "install from https://updates.example, channel stable" in found["update settings"][1]
    assert found["trusted root"][1].endswith("expires on 2031-01-01")


def test_a_computer_without_releases_is_not_asked(tmp_path):
    assert look_at_updates(Layout(tmp_path, tmp_path / "root.json")) == []


def test_an_environment_that_was_made_by_hand_is_said_to_take_no_updates(device):
    (device.layout.release("1.0") / "release.json").unlink()
    (found,) = device.found().items()
    assert found == ("release", ("warns", "1.0 was installed by hand, without release.json: updates are not looked at"))


def test_a_release_of_a_checkout_beside_that_of_the_package_is_nothing_wrong(device):
    """As the package leaves what was installed by hand before it."""
    (device.layout.release("checkout") / "venv").mkdir(parents=True)
    (device.layout.release("checkout") / ".complete").touch()
    assert {about: how for about, (how, _) in device.found().items() if how != "good"} == {}
    (device.layout.release("checkout") / "release.json").write_text("{")
    assert device.found()["release"][0] == "wrong", "one that is damaged is"


def test_an_installation_that_failed_is_warned_of(device):
    manifest = manifest_of(device.layout.release("1.0"))
    remember(device.layout, manifest, "no space")
    assert device.found()["installations"] == (
        "warns", "release 1.0 could not be installed, once: no space: haptic-panel update install tries it again",
    )  # fmt: skip


def wrong(device, change, about, how, *words):
    change(device)
    is_how, said = device.found()[about]
    assert is_how == how, said
    assert "\n" not in said
    for word in words:
        assert word in said


CASES = [
    (lambda d: d.state("trial", "2.0"), "release", "warns", "2.0 is on trial", "1.0 is used again"),
    (lambda d: d.layout.current.unlink(), "release", "wrong", "no release is in use"),
    (lambda d: (d.layout.release("1.0") / ".complete").unlink(), "release", "wrong", "no complete release"),
    (lambda d: d.state("failed", "3.0"), "failed releases", "warns", "3.0"),
    (lambda d: (d.layout.requests / "trial").write_text("2.0"), "update requests", "warns", "trial: not done yet"),
    (lambda d: d.layout.store.chmod(0o777), "update folders", "wrong", "mode 777", "systemd-tmpfiles"),
    (lambda d: d.layout.store.rmdir(), "update folders", "wrong", "store"),
    (lambda d: d.settings.write_text("sauce = 1\n"), "update settings", "wrong", "sauce"),
    (lambda d: d.settings.unlink(), "update settings", "warns", "no source"),
    (lambda d: d.expires("2026-11-01T00:00:00Z"), "trusted root", "wrong", "no update is taken"),
    (lambda d: d.expires("2026-12-24T00:00:00Z"), "trusted root", "warns", "expires on 2026-12-24"),
    (lambda d: d.layout.trusted_root.write_text("<html>"), "trusted root", "wrong", "is no root.json"),
    (lambda d: d.layout.trusted_root.unlink(), "trusted root", "warns", "takes no updates"),
    (lambda d: setattr(d, "now", datetime(1970, 1, 1, tzinfo=UTC)), "clock", "warns", "2023-11-14", "at least"),
]


@each_row("case", CASES, ids=[f"{about}-{words[0] if words else how}" for _, about, how, *words in CASES], afresh=[device])
def test_what_is_wrong_is_said_in_one_line(device, case):
    wrong(device, *case)


def test_a_folder_of_a_user_that_is_gone_is_said(device, monkeypatch):
    def nobody(*_):
        raise KeyError

    monkeypatch.setattr("pwd.getpwuid", nobody)
    assert device.found()["update folders"][0] == "wrong"


def test_little_space_is_said(device, monkeypatch):
    monkeypatch.setattr(update_examination.shutil, "disk_usage", lambda _: SimpleNamespace(free=1_000_000))
    assert device.found()["free space"][0] == "warns"


def test_units_that_are_off_are_said_with_what_switches_them_on(device, monkeypatch, tmp_path):
    monkeypatch.setattr(update_examination, "BOOTED", tmp_path)
    program = tmp_path / "systemctl"
    program.write_text("#!/bin/sh\necho inactive\necho active\n")
    program.chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path}:{os.environ['PATH']}")
    how, said = device.found()["update units"]
    assert how == "warns"
    assert said.endswith("systemctl enable --now haptic-panel-update.timer")
