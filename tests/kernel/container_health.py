"""Runs in the container, as root, under a systemd of its own: what the service reports, and how a trial is evaluated by it."""

import grp
import json
import os
import shutil
import signal
import subprocess
import sys
from functools import cache
from pathlib import Path

import panel_board
from far_end_serial import FarEnd
from serial_finger import SerialPanel
from the_service import CHECKOUT, UNIT, fresh_start, install, main_pid, restarted, run, wait_for

from controller.device.application_socket.client import PanelClient
from controller.device.board.board import load_board
from controller.device.board.panel_status import FOLDER, NAME, boot_id, read_status
from controller.device.service.drivers import gateware_hash
from controller.device.update.layout import Layout

sys.path.append(str(CHECKOUT / "tests/device/update"))
from repository_fixture import Publisher

FILE = FOLDER / NAME
TOUCH, FPGA = Path("/run/touch"), Path("/run/fpga")
LINK = f"""kind = "serial"
device = "{FPGA}"
baud = 3_000_000
clock_hz = 80_000_000
sck_hz = 25_000_000
slots = 16
"""
JUDGE = "haptic-panel-trial"
LAYOUT = Layout()
HEALTHY_S = 5.0


class Bench:
    """What stands round the service, from the first test on."""

    def __init__(self):
        install("udevadm")  # a container has no devices of its own
        panel_board.write(f'kind = "serial_panel"\ndevice = "{TOUCH}"', LINK)
        Path("/etc/haptic-panel/update.toml").write_text(f"healthy_s = {HEALTHY_S}\n")
        self.panel = SerialPanel()
        TOUCH.symlink_to(self.panel.device)
        self.panel.belongs_to("dialout")
        self.fpga = FarEnd(load_board(panel_board.BOARD), gateware_hash(), FPGA, grp.getgrnam("dialout").gr_gid)
        root = Path("/etc/haptic-panel/root.json")
        root.write_bytes(Publisher(Path("/tmp/owner")).root)
        drop_in = Path(f"/run/systemd/system/{JUDGE}.service.d/root.conf")
        drop_in.parent.mkdir(parents=True)
        drop_in.write_text(f"[Service]\nEnvironment=HAPTIC_PANEL_TRUSTED_ROOT={root}\n")
        run("systemctl", "daemon-reload")
        run("systemctl", "start", "haptic-panel-requests.path")
        self.first = LAYOUT.current.readlink().name


@cache
def bench():
    """The one bench."""
    return Bench()


def asked():
    """Exit code of `haptic-panel status` for a user without rights, what it says, and its error."""
    become = ["setpriv", "--reuid=65534", "--regid=65534", "--clear-groups", "--"]
    command = [*become, LAYOUT.current / "venv/bin/python", "-I", "-m", "controller", "status", "--json"]
    done = subprocess.run(command, cwd="/", check=False, capture_output=True, text=True)
    return done.returncode, json.loads(done.stdout or "{}"), done.stderr


def state():
    """The state in the file; none without a file."""
    status = read_status(FILE)
    return status and status.state.value


def test_everybody_may_read_how_the_panel_fares():
    bench()
    pid = fresh_start()
    wait_for("the outputs", lambda: state() == "playing")
    code, said, _ = asked()
    assert (code, said["serves"], said["state"], said["pid"]) == (0, True, "playing", pid)
    assert said["boot"] == boot_id(), "the unit has reported it: its sandbox hides it"
    assert said["release"] == bench().first
    assert FILE.stat().st_mode & 0o777 == 0o644
    assert FILE.owner() == UNIT


def test_the_file_follows_the_state():
    fresh_start()
    wait_for("the outputs", lambda: state() == "playing")
    with PanelClient() as panel:
        panel.disarm()
        wait_for("disarmed", lambda: state() == "disarmed")
        assert asked()[0] == 0, "as it was commanded to"
        panel.arm()
        wait_for("the outputs", lambda: state() == "playing")
    bench().fpga.permit(False)
    wait_for("no permit", lambda: state() == "no permit")
    code, said, _ = asked()
    assert (code, said["outputs_on"], said["outage_causes"]) == (1, False, {"NO_PERMIT": 1})
    bench().fpga.permit(True)
    wait_for("the outputs", lambda: state() == "playing")


def test_a_service_that_hangs_or_is_gone_is_distinguished_from_one_that_serves():
    pid = fresh_start()
    wait_for("the outputs", lambda: state() == "playing")
    os.kill(pid, signal.SIGKILL)
    wait_for("the restart", lambda: restarted(pid))
    wait_for("its status", lambda: read_status(FILE).pid == main_pid())
    wait_for("the outputs", lambda: state() == "playing")
    assert read_status(FILE).heartbeats < 10_000, "counted again"
    run("systemctl", "stop", UNIT)
    code, said, why = asked()
    assert (code, said) == (69, {})
    assert why.count("\n") == 1
    assert "systemctl start haptic-panel" in why


def evaluated():
    """What the judge has said since it was started last."""
    subprocess.run(["journalctl", "--sync"], check=False)
    invocation = run("systemctl", "show", "--value", "-p", "InvocationID", JUDGE).strip()
    return run("journalctl", "--no-pager", "-o", "cat", f"_SYSTEMD_INVOCATION_ID={invocation}") if invocation else ""


def of_the_judge(name):
    """A property of its unit."""
    return run("systemctl", "show", "--value", "-p", name, JUDGE).strip()


def begin_trial(version, spoil=""):
    """Put a copy of the release on trial, one module of it spoilt, and start the service."""
    folder = LAYOUT.release(version)
    shutil.copytree(LAYOUT.release(bench().first), folder, symlinks=True)
    for module in folder.glob(f"venv/lib/*/site-packages/{spoil}") if spoil else ():
        module.write_text("raise ImportError('spoilt')\n")
    run("systemctl", "stop", UNIT)
    (LAYOUT.state / "tries").write_text("0\n")
    (LAYOUT.state / "trial").write_text(f"{version}\n")
    fresh_start()
    assert LAYOUT.current.readlink().name == version
    return version


def test_a_trial_that_serves_is_good():
    version = begin_trial("0.1.1")
    words = f"release {version} is good: it served for {HEALTHY_S:g} s"
    wait_for("the verdict", lambda: words in evaluated())
    wait_for("its end", lambda: of_the_judge("ActiveState") == "inactive")
    assert of_the_judge("Result") == "success"
    wait_for("the end of the trial", lambda: LAYOUT.word("trial") == "")  # after the promotion
    assert LAYOUT.word("current") == version
    assert state() == "playing", "without a restart"


def test_without_a_trial_no_judge_runs():
    fresh_start()
    assert of_the_judge("ActiveState") == "inactive"
    assert of_the_judge("ConditionResult") == "no"


def test_each_start_of_a_trial_has_a_judge_also_one_by_itself():
    begin_trial("0.1.2")
    bench().fpga.permit(False)
    wait_for("the judge", lambda: "on trial: no permit" in evaluated())
    run("systemctl", "stop", JUDGE)
    assert (of_the_judge("Result"), of_the_judge("ExecMainStatus")) == ("success", str(signal.SIGTERM.value)), "it ends at once"
    pid = main_pid()
    os.kill(pid, signal.SIGKILL)
    wait_for("the restart", lambda: restarted(pid))
    wait_for("the judge", lambda: of_the_judge("ActiveState") == "active")
    first = of_the_judge("InvocationID")
    run("systemctl", "restart", UNIT)
    wait_for("another judge", lambda: of_the_judge("InvocationID") not in ("", first) and of_the_judge("ActiveState") == "active")


def test_without_a_permit_it_is_not_evaluated_and_its_starts_do_not_count():
    wait_for("no try counted", lambda: (LAYOUT.state / "tries").read_text() == "0\n")
    assert LAYOUT.word("trial") == "0.1.2"
    assert of_the_judge("ActiveState") == "active"
    assert of_the_judge("StatusText").startswith("release 0.1.2 is on trial: no permit")
    bench().fpga.permit(True)
    wait_for("the promotion", lambda: LAYOUT.word("current") == "0.1.2")


def back_at(version, failed):
    """Whether a release is in use again, and another one remembered."""
    return (
        LAYOUT.current.readlink().name == version
        and failed in (LAYOUT.state / "failed").read_text().split()
        and LAYOUT.word("trial") == ""
    )


def test_a_trial_that_finds_no_fpga_is_bad():
    hidden = FPGA.rename("/run/hidden")
    try:
        begin_trial("0.1.3")
        wait_for("the way back", lambda: back_at("0.1.2", "0.1.3"))
    finally:
        hidden.rename(FPGA)
    subprocess.run(["journalctl", "--sync"], check=False)
    assert "release 0.1.3 is bad: waiting for FPGA" in run("journalctl", "--no-pager", "-o", "cat", "-u", JUDGE)
    wait_for("the outputs", lambda: state() == "playing")


def test_a_judge_that_hangs_is_no_verdict():
    begin_trial("0.1.4")
    bench().fpga.permit(False)
    wait_for("the judge", lambda: "on trial: no permit" in evaluated())
    os.kill(int(of_the_judge("MainPID")), signal.SIGSTOP)
    wait_for("the way back", lambda: back_at("0.1.2", "0.1.4"))
    bench().fpga.permit(True)
    wait_for("the outputs", lambda: state() == "playing")


def test_a_release_that_could_not_update_again_is_bad():
    begin_trial("0.1.5", spoil="controller/device/update/download/fetch.py")
    wait_for("the way back", lambda: back_at("0.1.2", "0.1.5"))
    subprocess.run(["journalctl", "--sync"], check=False)
    assert "release 0.1.5 is bad: it could not update again" in run("journalctl", "--no-pager", "-o", "cat", "-u", JUDGE)
