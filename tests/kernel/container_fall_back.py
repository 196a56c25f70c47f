"""Runs in the container, as root, under a systemd of its own: trials that fail in every way, and how soon the old release is back.

The trials are programs of a few lines in a release's place: what is tested is the script, the units and systemd.
"""

import os
import time
from functools import cache
from pathlib import Path

from the_service import UNIT, install, journal, run, shown, wait_for

from controller.device.update.layout import Layout
from controller.device.update.requests import ask

LAYOUT = Layout()
REPORTED = Path("/run/reported")  # by the release before, when it is ready
NOTIFY = """import os, socket, sys, time, signal
notify = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
address = os.environ["NOTIFY_SOCKET"]
def tell(text):
    notify.sendto(text.encode(), "\\0" + address[1:] if address.startswith("@") else address)
def serve():
    tell("READY=1")
    while True:
        tell("WATCHDOG=1")
        time.sleep(0.3)
if "judge" in sys.argv:  # of its own trial, and for ever: it is the service that matters here
    serve()
"""
WAYS = {
    "exits 78": "sys.exit(78)",
    "exits 69": "sys.exit(69)",
    "crashes at the start": "os.kill(os.getpid(), signal.SIGSEGV)",
    "crashes after READY": "tell('READY=1'); time.sleep(2); os.kill(os.getpid(), signal.SIGSEGV)",
    "crashes 19 s after READY": "tell('READY=1'); [(time.sleep(1), tell('WATCHDOG=1')) for _ in range(19)]; os.abort()",
    "hangs after READY": "tell('READY=1'); time.sleep(3600)",
    "is never ready": "time.sleep(3600)",
    "ends with 0 at once": "sys.exit(0)",
}


def release(version, program):
    """A complete release whose controller is these lines."""
    python = LAYOUT.release(version) / "venv/bin/python"
    python.parent.mkdir(parents=True)
    interpreter = os.path.realpath("/proc/self/exe")
    python.write_text(f"#!{interpreter}\n{NOTIFY}{program}\n")
    python.chmod(0o755)
    (LAYOUT.release(version) / ".complete").touch()


@cache
def ready():
    """A release that serves, and the units."""
    install("udevadm")
    Path("/etc/systemd/system/haptic-panel.service.d").mkdir()
    REPORTED.write_text("")
    REPORTED.chmod(0o666)
    release("good", serving())
    run("/usr/lib/haptic-panel/fall-back", "adopt", "good")
    run("systemctl", "start", "haptic-panel-requests.path")
    run("systemctl", "start", UNIT)


def serving(more=""):
    """The lines of a controller that serves."""
    return f"{more}open('{REPORTED}', 'a').write(str(time.monotonic()) + chr(10)); serve()"


def lines():
    return REPORTED.read_text().splitlines()


def test_every_unit_is_well_formed():
    ready()
    units = sorted(path.name for path in Path("/etc/systemd/system").glob("haptic-panel*.*") if path.suffix != ".d")
    assert len(units) >= 10, units
    assert run("systemd-analyze", "verify", "--man=no", *(f"/etc/systemd/system/{unit}" for unit in units)) == ""


def failing(way):
    """Ask for a trial that fails so; wait until the release before is ready again."""
    ready()
    version = f"bad-{way.replace(' ', '-')}"
    release(version, WAYS[way])
    before = len(lines())
    start_s = time.monotonic()
    ask(LAYOUT, "trial", version)
    wait_for(f"the end of a trial that {way}", lambda: len(lines()) > before and LAYOUT.word("trial") == "")
    back_s = float(lines()[-1]) - start_s
    print(f"a trial that {way}: back after {back_s:.1f} s")  # goal: 10 s where it ends by itself, 60 s in all
    assert LAYOUT.current.readlink().name == "good"
    assert version in (LAYOUT.state / "failed").read_text().split()
    assert shown("ActiveState") == "active"
    assert f"release {version} is on trial, start 1 of 3" in journal()


def test_a_trial_that_exits_78_is_given_up():
    failing("exits 78")


def test_a_trial_that_exits_69_is_given_up():
    failing("exits 69")


def test_a_trial_that_crashes_at_the_start_is_given_up():
    failing("crashes at the start")


def test_a_trial_that_crashes_after_ready_is_given_up():
    failing("crashes after READY")


def test_a_trial_that_crashes_again_and_again_before_it_is_evaluated_is_given_up():
    failing("crashes 19 s after READY")


def test_a_trial_that_hangs_is_given_up():
    failing("hangs after READY")


def test_a_trial_that_is_never_ready_is_given_up():
    failing("is never ready")


def test_a_trial_that_ends_as_if_all_were_well_is_given_up():
    failing("ends with 0 at once")


def test_what_has_failed_is_not_tried_again():
    ready()
    ask(LAYOUT, "trial", "bad-exits-78")
    wait_for("the refusal", lambda: "release bad-exits-78 is not tried: it has failed before" in journal())
    assert LAYOUT.word("trial") == ""


def test_a_trial_that_is_called_good_stays_and_the_way_back_is_open():
    ready()
    release("better", serving())
    before = len(lines())
    ask(LAYOUT, "trial", "better")
    wait_for("the trial", lambda: len(lines()) > before)
    ask(LAYOUT, "good", "better")
    wait_for("the end of the trial", lambda: LAYOUT.word("trial") == "")
    assert (LAYOUT.word("current"), LAYOUT.word("previous")) == ("better", "good")
    ask(LAYOUT, "rollback", "better")
    wait_for("the release before", lambda: LAYOUT.current.readlink().name == "good" and shown("ActiveState") == "active")
    assert "back to release good, by hand" in journal()


def test_a_release_that_cannot_be_stopped_is_not_the_failure_of_the_next():
    """It is killed in the end, and with that has failed; OnFailure= comes when the next one is on trial already."""
    ready()

    def trial_of(version, more=""):
        release(version, serving(more))
        before = len(lines())
        ask(LAYOUT, "trial", version)
        wait_for("the trial", lambda: len(lines()) > before)

    def ended():
        return run("systemctl", "show", "--value", "-p", "ExecMainExitTimestampMonotonic", "haptic-panel-failed.service").strip()

    trial_of("stubborn", "signal.signal(signal.SIGTERM, signal.SIG_IGN); ")
    ask(LAYOUT, "good", "stubborn")
    wait_for("the end of the trial", lambda: LAYOUT.word("trial") == "")
    before = ended()
    trial_of("next")
    wait_for("the unit that goes back", lambda: ended() not in (before, "0"))
    assert "State 'stop-sigterm' timed out" in journal()
    assert LAYOUT.word("trial") == "next"
    assert LAYOUT.current.readlink().name == "next"
    ask(LAYOUT, "good", "next")
    wait_for("the end of the trial", lambda: LAYOUT.word("current") == "next")
