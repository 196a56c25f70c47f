"""Runs in a Debian container, as root, under a systemd of its own: releases in the field, while a panel and an FPGA play.

Both outlive the service, and the FPGA notes each emission: how long nothing could be felt is measured there, and printed. Releases
are those of the package with other lines (release_changes.py); nothing is known of the network but 127.0.0.1.
"""

import contextlib
import grp
import itertools
import os
import re
import shutil
import time
from functools import cache
from pathlib import Path

import panel_board
from derived_release import derived_release
from device.update.repository_fixture import Publisher, copied, key
from device.update.scripted_server import ScriptedServer
from documented_session import blocks, follow
from far_end_serial import FarEnd
from release_changes import FAILS, GOOD
from serial_finger import SerialPanel
from slow_form import slow
from the_package import ENVIRONMENT, done, install
from the_service import CHECKOUT, UNIT, journal, main_pid, shown, wait_for

from controller.device.board.board import load_board
from controller.device.service.drivers import gateware_hash
from controller.device.update.layout import Layout

LAYOUT = Layout()
SETTINGS = Path("/etc/haptic-panel/update.toml")
FIRST = Path("/usr/lib/haptic-panel/first-release")
WORK = Path("/root/publisher")
TOUCH, FPGA = Path("/run/touch"), Path("/run/fpga")
LINK = f"""kind = "serial"
device = "{FPGA}"
baud = 3_000_000
clock_hz = 80_000_000
sck_hz = 25_000_000
slots = 16
"""
FALL_BACK_S = 60.0  # from the begin of a trial


class Bench:
    """What stands round the service, from the first test on."""

    def __init__(self):
        shutil.copytree(LAYOUT.current / "boards/panel", panel_board.BOARD.parent)
        panel_board.write(f'kind = "serial_panel"\ndevice = "{TOUCH}"', LINK)
        self.panel = SerialPanel()
        TOUCH.symlink_to(self.panel.device)
        self.panel.belongs_to("dialout")
        self.fpga = FarEnd(load_board(panel_board.BOARD), gateware_hash(), FPGA, grp.getgrnam("dialout").gr_gid)

    def finger(self):
        """A finger to and fro on the plate."""
        return self.panel.finger((x, 2000) for x in itertools.cycle([*range(1000, 3000, 100), *range(3000, 1000, -100)]))


@cache
def bench():
    """The one bench."""
    return Bench()


class Owner:
    """Who signs, and where it is served."""

    def __init__(self):
        self.repository = Publisher(WORK / "repository", now=None)
        self.server = ScriptedServer(self.repository.folder)
        self._counter = 1

    def offers(self, version, changes):
        """Sign a release."""
        folder = WORK / version
        self._counter += 1
        derived_release(FIRST, folder, version, self._counter, changes)
        files = {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}
        del files["release.json"]
        self.repository.release(version, self._counter, files, cut=4096)
        shutil.rmtree(folder)


@cache
def owner():
    """The one owner."""
    return Owner()


class Silence:
    """The longest time between two emissions, from before something is done to after it, as `longest_s`."""

    def __enter__(self):
        self._times_s = []
        self._wait_for_one()
        self._times_s = self._times_s[-1:]
        return self

    def __exit__(self, kind, *_):
        if kind is None:
            self._wait_for_one()
            self.longest_s = max(after - before for before, after in itertools.pairwise(self._times_s))

    def _wait_for_one(self):
        """The emissions up to one from now on."""
        now_s = time.monotonic()

        def emitted():
            self._times_s += bench().fpga.focus_times_s()
            return bool(self._times_s) and self._times_s[-1] > now_s

        wait_for("an emission", emitted)


def settings(**values):
    """/etc/haptic-panel/update.toml."""
    SETTINGS.write_text("".join(f"{key} = {value!r}\n" for key, value in values.items()))


def documented(number):
    """What a block of commands of the page says, done here."""
    for _, command, lines in blocks(CHECKOUT / "systemd/README.md", "Updates")[number]:
        follow(command, lines, env=ENVIRONMENT, cwd="/")


def update(code=0):
    """What `update install` says."""
    return done("haptic-panel", "update", "install", code=code)


def by_the_timer():
    """What haptic-panel-update.timer starts."""
    done("systemctl", "start", "haptic-panel-update")


def word(name):
    """A word of the fall-back script's state."""
    return LAYOUT.word(name)


def tried(version, what, install=update):
    """Install what the owner offers, and see its trial through; seconds without haptics are printed."""
    with bench().finger(), Silence() as silence:
        install()
        begun_s = time.monotonic()
        wait_for("the trial", lambda: word("trial") == version or was_tried(version))
        wait_for("the end of the trial", lambda: not word("trial"), seconds=FALL_BACK_S)
        wait_for("the panel", lambda: plays() and runs(word("current")))  # not the trial, which may have played to its end
        decided_s = time.monotonic() - begun_s
    print(f"{silence.longest_s:5.1f} s without haptics, decided after {decided_s:5.1f} s: {what}")


def was_tried(version):
    return version in failed() or word("current") == version


def failed():
    """Versions that are not tried again."""
    file = LAYOUT.state / "failed"
    return file.read_text().split() if file.exists() else []


def plays():
    """Whether the service that runs plays."""
    return shown("ActiveState") == "active" and shown("StatusText").startswith("playing")


def runs(version):
    """Whether the service runs from a release."""
    python = os.fsencode(LAYOUT.release(version) / "venv/bin/python")
    with contextlib.suppress(FileNotFoundError):
        return Path(f"/proc/{main_pid()}/cmdline").read_bytes().startswith(python + b"\0")
    return False


def goes_well(version, what, install=update):
    tried(version, what, install)
    assert (word("current"), version in failed()) == (version, False)
    assert runs(version)


def falls_back(kind):
    """A release that fails in this way is rolled back, remembered, and not tried again, while panel and FPGA are what they were."""
    version = f"3.{list(FAILS).index(kind)}.0"
    before = word("current")
    owner().offers(version, FAILS[kind])
    tried(version, f"a release that {kind}")
    assert (word("current"), failed()[-1]) == (before, version)
    assert runs(before)
    pid = main_pid()
    assert f"release {version} has failed on this device" in update(code=1)
    done("systemctl", "restart", "haptic-panel-requests.service")
    assert main_pid() == pid, "it played on"


def test_the_package_brings_the_first_release():
    LAYOUT.root.mkdir(parents=True)
    done("mount", "-t", "tmpfs", "-o", "size=1500m,mode=755", "tmpfs", str(LAYOUT.root))  # a disk of its own, to be filled
    install("1.0")
    LAYOUT.trusted_root.parent.mkdir(exist_ok=True)
    LAYOUT.trusted_root.write_bytes(owner().repository.root)  # what build.sh does, given it
    bench()
    done("systemctl", "enable", "--now", UNIT)
    wait_for("the panel", plays)
    assert runs("1.0")


def test_a_restart_is_what_an_update_costs():
    with bench().finger(), Silence() as silence:
        done("systemctl", "restart", UNIT)
    print(f"{silence.longest_s:5.1f} s without haptics: a restart")


def test_release_2_comes_over_http():
    settings(source=owner().server.address)
    owner().offers("2.0.0", GOOD)
    goes_well("2.0.0", "an update over HTTP", lambda: documented(0))
    documented(1)
    size = sum(file.stat().st_size for file in FIRST.rglob("*"))
    print(f"{owner().server.sent_bytes:,} bytes fetched of a release of {size:,}")


def test_and_another_from_a_stick():
    owner().offers("2.1.0", GOOD)
    copied(owner().repository.folder, Path("/media/stick/panel"))
    goes_well("2.1.0", "an update from a folder", lambda: documented(2))
    settings(source=owner().server.address, healthy_s=3.0)


def test_a_release_that_exits_with_78():
    falls_back("exits with 78")
    documented(3)


@slow
def test_a_release_that_crashes_once_it_is_ready():
    falls_back("crashes")


@slow
def test_a_release_that_hangs():
    falls_back("hangs")


@slow
def test_a_release_that_is_never_ready():
    falls_back("is never ready")


@slow
def test_a_release_that_is_ready_and_finds_no_fpga():
    falls_back("finds no FPGA")


def test_a_release_that_plays_with_outages():
    falls_back("lets the FPGA wait")


def test_a_release_for_other_gateware():
    falls_back("wants other gateware")


def test_a_release_for_banks_of_another_format():
    falls_back("reads other banks")


def test_a_release_whose_judge_crashes():
    falls_back("cannot be evaluated")


@slow
def test_a_release_whose_judge_hangs():
    falls_back("is evaluated for ever")


@slow
def test_a_release_that_could_not_update_again():
    falls_back("cannot update again")


def test_release_4_mends_it_and_is_signed_with_other_keys():
    repository = owner().repository
    old = repository.signers["root"]
    repository.signers = {role: [key(f"the next owner {role}")] for role in repository.signers}
    repository.sign_root(old + repository.signers["root"])
    owner().offers("4.0.0", GOOD)
    goes_well("4.0.0", "an update after those that failed, by the timer", by_the_timer)


def test_without_permit_a_trial_is_not_evaluated_however_often_it_is_started():
    owner().offers("5.0.0", GOOD)
    bench().fpga.permit(False)
    update()
    wait_for("the trial", lambda: word("trial") == "5.0.0" and runs("5.0.0"))
    for _ in range(5):
        wait_for("the judge, who says that it stands", lambda: word("tries") == "0")
        done("systemctl", "restart", UNIT)
        assert runs("5.0.0")
    assert word("trial") == "5.0.0"
    assert "5.0.0" not in failed()
    bench().fpga.permit(True)
    wait_for("the end of the trial", lambda: word("current") == "5.0.0")


def test_a_technician_goes_back_and_stays_back():
    documented(4)
    wait_for("the release before", lambda: word("current") == "4.0.0" and plays() and runs("4.0.0"))
    assert "release 5.0.0 has failed on this device" in update(code=1)
    assert runs("4.0.0")


def test_on_a_full_disk_nothing_begins():
    owner().offers("6.0.0", GOOD)
    pid, before = main_pid(), sorted(LAYOUT.store.iterdir())
    ballast = LAYOUT.root / "ballast"
    with filled(ballast, 50_000_000):
        line = update(code=1)
        assert re.fullmatch(
            r"haptic-panel: /opt/haptic-panel: release 6.0.0 needs [\d,]+ bytes, [\d,]+ are free: make room\n", line
        )
    assert (main_pid(), sorted(LAYOUT.store.iterdir())) == (pid, before)


def test_a_disk_that_fills_up_behind_the_installation_starts_no_trial():
    done("systemctl", "stop", "haptic-panel-requests.path")
    update()
    with filled(LAYOUT.root / "ballast", 0):
        done("systemctl", "start", "haptic-panel-requests.path")
        wait_for("the refusal", lambda: "is the disk full, or read-only?" in journal())
    assert word("current") == "4.0.0"
    assert runs("4.0.0")


def test_read_only_it_plays_and_says_why_it_does_not_update():
    done("mount", "-o", "remount,ro", str(LAYOUT.root))
    try:
        line = update(code=1)
        assert "Read-only file system" in line
        assert line.count("\n") == 1
        done("systemctl", "restart", UNIT)
        wait_for("the panel", plays)
        assert runs("4.0.0")
    finally:
        done("mount", "-o", "remount,rw", str(LAYOUT.root))
    goes_well("6.0.0", "an update after a full disk and a read-only one")


@contextlib.contextmanager
def filled(ballast, free_bytes):
    """The disk with so much left."""
    disk = os.statvfs(LAYOUT.root)
    size = disk.f_bavail * disk.f_frsize - free_bytes
    with ballast.open("wb") as file:
        os.posix_fallocate(file.fileno(), 0, size)
    yield
    ballast.unlink()
