"""Runs in the container, as root, under a systemd of its own: the unit as it is installed, with the simulated board."""

import os
import re
import shutil
import signal
import subprocess
from pathlib import Path

import panel_board
from service_under_test import (
    CHECKOUT,
    UNIT,
    fresh_start,
    install,
    journal,
    main_pid,
    restarted,
    run,
    said,
    shown,
    status_of,
    wait_for,
)

HOST, PANEL = os.openpty()  # a touch panel at a serial port


def test_it_is_installed_as_the_readme_says():
    install("udevadm")  # a container has no devices of its own
    panel_board.write(f'kind = "serial_panel"\ndevice = "{os.ttyname(PANEL)}"')
    shutil.chown(os.ttyname(PANEL), group="dialout")
    Path(os.ttyname(PANEL)).chmod(0o660)
    assert run("systemd-analyze", "verify", "--man=no", f"/etc/systemd/system/{UNIT}.service") == ""
    groups = set(run("id", "-nG", UNIT).split())
    assert groups == {UNIT, "spi", "i2c", "gpio", "input", "dialout"}


def test_its_sandbox_leaves_little_exposed():
    for unit in sorted((CHECKOUT / "systemd").glob("*.service")):
        run("systemd-analyze", "security", "--no-pager", "--offline=true", "--threshold=11", str(unit))


def test_it_starts_and_says_that_it_is_ready():
    pid = fresh_start()
    assert shown("ActiveState") == "active"
    assert shown("StatusText") == "playing on board 'simulated'"
    assert shown("NRestarts") == "0"
    assert Path(f"/run/{UNIT}").stat().st_mode & 0o777 == 0o755
    assert main_pid() == pid


def test_it_is_a_user_without_rights_but_those_of_the_loop():
    pid = main_pid()
    user = run("id", "-u", UNIT).strip()
    assert set(status_of(pid, "Uid").split()) == {user} != {"0"}
    assert {int(status_of(pid, f"Cap{kind}"), 16) for kind in ("Inh", "Prm", "Eff", "Bnd", "Amb")} == {0}
    assert status_of(pid, "NoNewPrivs") == "1"
    assert status_of(pid, "Seccomp") == "2"
    permitted = re.search(r"^Max realtime priority +50 ", Path(f"/proc/{pid}/limits").read_text(), re.MULTILINE)
    if permitted:  # else this machine gives its containers no such limits, and it is told of in one line
        assert os.sched_getscheduler(pid) & ~os.SCHED_RESET_ON_FORK == os.SCHED_FIFO
        assert int(status_of(pid, "VmLck").split()[0]) > 0
    assert said().count("not in real time") == (0 if permitted else 1)


def test_killed_it_is_started_again():
    pid = fresh_start()
    os.kill(pid, signal.SIGKILL)
    wait_for("the restart", lambda: restarted(pid))
    assert shown("NRestarts") == "1"


def test_hanging_it_is_ended_by_the_watchdog_and_started_again():
    pid = fresh_start()
    os.kill(pid, signal.SIGSTOP)
    wait_for("the restart", lambda: restarted(pid))
    assert "Watchdog timeout (limit 3s)!" in journal()
    assert "code=killed, status=6/ABRT" in journal()


def test_stopped_it_ends_as_a_success():
    fresh_start()
    run("systemctl", "stop", UNIT)
    assert (shown("ActiveState"), shown("Result"), shown("ExecMainStatus")) == ("inactive", "success", "0")


def test_a_wrong_board_is_said_in_one_line_and_not_tried_again():
    good = panel_board.BOARD.read_text()
    panel_board.BOARD.write_text(good.replace("[plate]", "[plate]\nwood = true"))
    try:
        subprocess.run(["systemctl", "start", UNIT], check=False, capture_output=True)
        assert (shown("ActiveState"), shown("ExecMainStatus"), shown("NRestarts")) == ("failed", "78", "0")
        (line,) = [line for line in journal().splitlines() if line.startswith("haptic-panel: ")][-1:]
        assert "board.toml" in line
        assert "wood" in line
    finally:
        panel_board.BOARD.write_text(good)


def test_ten_starts_in_five_minutes_that_failed_are_the_last():
    pid = fresh_start()
    for _ in range(10):
        os.kill(pid, signal.SIGKILL)
        old = pid
        pid = wait_for("a restart or the end", lambda old=old: shown("ActiveState") == "failed" or (restarted(old) and main_pid()))
        if pid is True:
            break
    assert shown("Result") == "start-limit-hit" or re.search(r"Start request repeated too quickly", journal())
    subprocess.run(["systemctl", "reset-failed", UNIT], check=True)
