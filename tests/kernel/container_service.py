"""Runs in the container, as root, under a systemd of its own: the unit as it is installed, with the simulated board."""

import contextlib
import grp
import itertools
import json
import os
import re
import signal
import subprocess
import urllib.request
from pathlib import Path

import panel_board
from serial_finger import SerialPanel
from the_service import (
    BANK,
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

from controller.device.application_socket.client import PanelClient
from controller.errors import LinkError

SYSTEMD_README = CHECKOUT / "systemd" / "README.md"
PANEL = SerialPanel()


def test_it_is_installed_as_the_readme_says():
    install("udevadm")  # a container has no devices of its own
    panel_board.write(f'kind = "serial_panel"\ndevice = "{PANEL.device}"')
    PANEL.belongs_to("dialout")
    assert run("systemd-analyze", "verify", "--man=no", f"/etc/systemd/system/{UNIT}.service") == ""
    groups = set(run("id", "-nG", UNIT).split())
    assert groups == {UNIT, "spi", "i2c", "gpio", "input", "dialout", "haptic-play"}


def test_its_sandbox_leaves_little_exposed():
    for unit in sorted((CHECKOUT / "systemd").glob("*.service")):
        run("systemd-analyze", "security", "--no-pager", "--offline=true", "--threshold=11", str(unit))


def test_it_starts_and_says_that_it_is_ready():
    pid = fresh_start()
    assert shown("ActiveState") == "active"
    wait_for("the beacon of the scene", lambda: shown("StatusText") == "playing on board 'simulated'")
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
    if permitted:  # else this machine gives its containers no such limits, and it is reported in one line
        assert os.sched_getscheduler(pid) & ~os.SCHED_RESET_ON_FORK == os.SCHED_FIFO
        assert int(status_of(pid, "VmLck").split()[0]) > 0
    assert said().count("not in real time") == (0 if permitted else 1)


def test_all_its_processes_run_from_the_releases_own_folder():
    """Not through the link, which may lead elsewhere by the time they import something."""
    release = Path("/opt/haptic-panel/current").resolve()
    processes = Path(f"/sys/fs/cgroup/system.slice/{UNIT}.service/cgroup.procs").read_text().split()
    assert len(processes) > 1, "the loop, and what prepares scenes"
    for pid in processes:
        program = Path(f"/proc/{pid}/cmdline").read_text().split("\0")[0]
        assert program == f"{release}/venv/bin/python", program


def test_a_bank_of_before_releases_is_taken_over_and_stays():
    run("systemctl", "stop", UNIT)
    before = BANK.with_name("panel.bank")
    BANK.rename(before)
    fresh_start()
    assert f"{BANK}: taken over from {before}" in said()
    assert f"cells of {BANK}" in said()
    assert BANK.samefile(before)
    before.unlink()


def to_and_fro():
    """Places of a finger, on the panel's axes."""
    return ((x, 2000) for x in itertools.cycle([*range(1000, 3000, 100), *range(3000, 1000, -100)]))


def figure(name):
    """One of the service's counters; asked for over its socket."""
    with PanelClient() as panel:
        return panel.figures()[name]


def test_a_finger_on_its_panel_is_felt_and_a_user_interface_is_informed():
    fresh_start()
    path = Path("/run/haptic-panel/panel.sock")
    assert (path.group(), path.stat().st_mode & 0o777) == (UNIT, 0o660)
    before = figure("emissions")
    with PANEL.finger(to_and_fro()):
        wait_for("emissions", lambda: figure("emissions") >= before + 5)
        with PanelClient() as panel:
            assert "click" in panel.hello().effects
            reported = next(panel.touches())
    assert abs(reported.y_mm - 148 * 2000 / 4095) < 0.1


def test_a_changed_scene_is_taken_over_and_a_wrong_one_is_not():
    pid = fresh_start()
    scene = panel_board.BOARD.parent / "scene.toml"
    good = scene.read_text()
    try:
        scene.write_text(good.replace('name = "arrow"', 'name = "spear"'))
        run("systemctl", "reload", UNIT)
        wait_for("the scene", lambda: figure("scenes_loaded") == 1)
        assert shown("ActiveState") == "active"
        scene.write_text(good.replace('name = "arrow"', "name = 7"))
        refused = subprocess.run(["systemctl", "reload", UNIT], check=False, capture_output=True, text=True)
        assert refused.returncode == 1
        assert f"Job for {UNIT}.service failed" in refused.stderr
        wait_for("the refusal", lambda: figure("scenes_refused") == 1)  # figures are made at most once a second
        assert shown("ActiveState") == "active"
        assert "the scene stays as it was: " in said()
        assert "scene.toml" in shown("StatusText")
        assert figure("scenes_loaded") == 1
        assert main_pid() == pid
        warnings = journal("-p", "warning").splitlines()
        assert [line for line in warnings if "the scene stays as it was: " in line and "scene.toml" in line]
        assert not [line for line in warnings if "the outputs are on" in line]
        scene.write_text(good)
        run("systemctl", "reload", UNIT)
        wait_for("the scene", lambda: figure("scenes_loaded") == 2)
    finally:
        scene.write_text(good)


def as_user(name, *command):
    """The client of the package, as somebody who has just logged in."""
    client = ["/usr/bin/haptic-panel", "client", *command]
    become = ["setpriv", f"--reuid={name}", f"--regid={name}", "--init-groups", "--"]
    return subprocess.run([*become, *client], cwd="/", check=False, capture_output=True, text=True)


def outcome_for(name):
    """What becomes of a user's command to play."""
    done = as_user(name, "play", "click", "--at", "100", "70")
    assert done.stdout, done.stderr
    return json.loads(done.stdout)


def test_of_two_groups_one_may_play_and_the_other_switch_the_panel_off_for_good():
    (settings,) = re.findall(r"^```toml\n(\[application_socket\]\n.*?)^```", SYSTEMD_README.read_text(), re.MULTILINE | re.DOTALL)
    good = panel_board.BOARD.read_text()
    panel_board.BOARD.write_text(good.replace("[application_socket]\n", settings))
    for name, groups in (("stranger", ""), ("kiosk", "haptic-play"), ("anna", "haptic-play,haptic-operate")):
        run("useradd", "-M", "-U", "-G", groups, name)
    try:
        fresh_start()
        wait_for("the outputs", lambda: figure("outputs") == "on")
        assert outcome_for("kiosk")["outcome"] in {"played", "skipped"}, "the bank may have nothing there"
        refused = as_user("kiosk", "disarm")
        assert refused.returncode == 1
        assert "does not have the right to operate: group 'haptic-operate' gives it" in refused.stderr
        kept_out = as_user("stranger", "hello")
        assert kept_out.returncode == 1
        assert "user 'stranger' may not connect, group 'haptic-play' may" in kept_out.stderr
        assert as_user("anna", "disarm").returncode == 0
        wait_for("the state", lambda: shown("StatusText").startswith("disarmed"))
        assert re.search(r"user 'anna' \(uid \d+, pid \d+\) disarms the panel", said())
        pid = main_pid()
        os.kill(pid, signal.SIGKILL)
        wait_for("the restart", lambda: restarted(pid))
        assert shown("StatusText").startswith("disarmed")
        assert "the panel is disarmed" in outcome_for("kiosk")["reason"]
        assert as_user("anna", "arm").returncode == 0
        wait_for("the outputs", lambda: figure("outputs") == "on")
    finally:
        panel_board.BOARD.write_text(good)


def scraped():
    """Figures as Prometheus gets them, by name; none yet where nobody listens."""
    try:
        with urllib.request.urlopen("http://127.0.0.1:9750/metrics") as answer:
            lines = answer.read().decode().splitlines()
    except OSError:
        return {}
    return dict(line.rsplit(" ", 1) for line in lines if not line.startswith("#"))


def test_prometheus_is_answered_by_a_user_who_may_only_look_by_one_connection():
    fresh_start()
    lines = figure("application_socket")["clients_accepted"]
    run("systemctl", "start", "haptic-panel-metrics")
    try:
        wait_for("an answer", lambda: scraped().get("haptic_panel_up") == "1.0")
        (pid,) = run("systemctl", "show", "--value", "-p", "MainPID", "haptic-panel-metrics").split()
        groups = {grp.getgrgid(int(number)).gr_name for number in status_of(pid, "Groups").split()}
        assert Path(f"/proc/{pid}").owner() == "haptic-metrics"
        assert groups - {"haptic-metrics"} == {"haptic-look", "haptic-play", UNIT}
        seen = [scraped() for _ in range(200)]
        assert all(answer["haptic_panel_up"] == "1.0" for answer in seen)
        assert figure("application_socket")["clients_accepted"] - lines <= 3, "its own connection, and those of this test"
        become = [
            "setpriv",
            "--reuid=haptic-metrics",
            "--regid=haptic-metrics",
            "--groups=haptic-look,haptic-play,haptic-panel",
            "--",
        ]
        client = ["/opt/haptic-panel/current/venv/bin/python", "-m", "controller.device.application_socket.client"]
        for command, code in ((("hello",), 0), (("play", "click", "--at", "100", "70"), 1), (("disarm",), 1)):
            done = subprocess.run([*become, *client, *command], cwd="/", check=False, capture_output=True, text=True)
            assert (done.returncode, "does not have the right to" in done.stdout + done.stderr) == (code, bool(code)), done
    finally:
        run("systemctl", "stop", "haptic-panel-metrics")


def test_a_panel_that_is_pulled_out_before_the_start_is_waited_for():
    run("systemctl", "stop", UNIT)
    good = panel_board.BOARD.read_text()
    panel_board.BOARD.write_text(good.replace(PANEL.device, "/run/touch"))
    try:
        pid = fresh_start()
        assert shown("ActiveState") == "active"
        assert shown("StatusText").startswith("waiting for panel: there is no serial port /run/touch")
        assert figure("outputs") == "on"
        Path("/run/touch").symlink_to(PANEL.device)
        wait_for("the panel", lambda: shown("StatusText") == "playing on board 'simulated'")
        assert main_pid() == pid
    finally:
        panel_board.BOARD.write_text(good)
        Path("/run/touch").unlink(missing_ok=True)


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
    assert "Fatal Python error: Aborted" in journal()


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


def test_a_bank_cut_short_under_it_ends_it_and_is_refused():
    """A bank that it was given; one of its own it would build again."""
    (bank,) = Path("/var/lib/haptic-panel/banks").glob("*.bank")
    settings = Path(f"/run/systemd/system/{UNIT}.service.d/bank.conf")
    settings.parent.mkdir(parents=True)
    settings.write_text(f"[Service]\nExecStart=\nExecStart=/usr/bin/haptic-panel run --board panel --bank {bank}\n")
    run("systemctl", "daemon-reload")
    pid = fresh_start()
    whole = bank.read_bytes()
    try:
        os.truncate(bank, 4096)
        with PanelClient() as panel, contextlib.suppress(LinkError):
            for x_mm in range(20, 200, 10):
                panel.start_play("click", at_mm=(x_mm, 33))
            panel.figures()
        wait_for("the end", lambda: main_pid() != pid)
        wait_for("the refusal", lambda: shown("ActiveState") == "failed")
        assert (shown("ExecMainStatus"), shown("NRestarts")) == ("78", "1")
        assert "code=killed, status=7/BUS" in journal()
    finally:
        bank.write_bytes(whole)
        settings.unlink()
        run("systemctl", "daemon-reload")


def test_a_panel_whose_process_dies_again_and_again_is_never_left_off():
    pid = fresh_start()
    for _ in range(12):  # ten in five minutes were the last, once
        os.kill(pid, signal.SIGKILL)
        pid = wait_for("another process", lambda old=pid: main_pid() not in (0, old) and main_pid())
    wait_for("outputs on", lambda: shown("ActiveState") == "active")
    assert shown("Result") == "success"
