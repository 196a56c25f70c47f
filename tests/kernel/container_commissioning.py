"""Runs in the container, as root: a panel of one's own put into service, by the lines of boards/README.md and systemd/README.md.

The board is written by `haptic-panel setup`, of a plate of its own with fewer actuators and a serial touch panel, whose axes lie
otherwise. Its FPGA is the model at a serial port, and empty until a bitstream is loaded; it is then what that bitstream's
parameters say. Lines are taken from the documents; `editor` is a program that makes our changes, `openFPGALoader` one that has the
FPGA read the file.
"""

import contextlib
import grp
import itertools
import math
import os
import re
import shutil
import signal
import subprocess
from functools import cache
from pathlib import Path

import panel_board
from far_end_serial import FarEnd
from serial_finger import LARGEST, SerialPanel
from terminal import at_terminal
from the_service import CHECKOUT, UNIT, fresh_start, journal, main_pid, run, shown, wait_for

from controller.device.application_socket.client import PanelClient
from controller.device.board.board import load_board

LENGTH_MM, WIDTH_MM = 165.0, 100.0
PANEL = SerialPanel()
BOARD = Path("/etc/haptic-panel/boards/panel/board.toml")
BITSTREAM = BOARD.with_name("panel.bit")
FPGA, JTAG = Path("/run/fpga"), Path("/run/jtag")
LINK = f"""kind = "serial"
device = "{FPGA}"
baud = 1_000_000
clock_hz = 62_500_000
sck_hz = 25_000_000
slots = 16
"""
LOADER = f"""#!/opt/haptic-panel/current/venv/bin/python -I
import socket, sys

which, board, option, file = sys.argv[1:]
assert (which, board) == ("--board", "ulx3s")
with socket.socket(socket.AF_UNIX) as jtag:
    jtag.connect("{JTAG}")
    jtag.sendall(f"{{option}}\\n{{file}}".encode())
    sys.exit(jtag.recv(16) != b"done")
"""
BANK = Path("/var/lib/haptic-panel/banks/panel.v9.bank")
TOOLS = Path("/run/tools")
SOCKET = "/tmp/panel.sock"
ENVIRONMENT = {
    "PATH": f"{TOOLS}:/usr/sbin:/usr/bin",
    "HOME": "/root",
    "PIP_NO_INDEX": "1",
    "PIP_FIND_LINKS": "/opt/wheels",
    "PIP_DISABLE_PIP_VERSION_CHECK": "1",
    "PIP_ROOT_USER_ACTION": "ignore",
    "OPENBLAS_NUM_THREADS": "1",
}


def blocks(document, heading):
    """Lines of each block of commands of a section."""
    text = (CHECKOUT / document).read_text()
    section = re.search(rf"^## {heading}\n(.*?)(?=^## |\Z)", text, re.MULTILINE | re.DOTALL)[1]
    found = re.findall(r"^```(?:sh)?\n(.*?)^```", section, re.MULTILINE | re.DOTALL)
    return [block.splitlines() for block in found]


PACKAGE, SYSTEM, ADOPT = blocks("systemd/README.md", "Install from a checkout")
DEB, LOOK = blocks("systemd/README.md", "Install")
SERVICE = [*DEB[1:], *LOOK]  # the first installs the package: container_package.py
STEPS = blocks("boards/README.md", "A panel of your own")[0]
HOME = Path("/root")


def started(line, user="root", folder=HOME):
    """A line of a document in a shell, begun; in a session of its own, so that Ctrl-C reaches it and not us."""
    shell = ["sh", "-c", f"exec {line}" if line.startswith("haptic-panel") else line]  # what ends it is then the command's own end
    rights = [] if user == "root" else ["setpriv", f"--reuid={user}", f"--regid={user}", "--init-groups"]
    home = "/root" if user == "root" else str(folder)
    command = ["env", f"HOME={home}", *rights, *shell]
    return subprocess.Popen(
        command, cwd=folder, env=ENVIRONMENT, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
        start_new_session=True,
    )  # fmt: skip


def done(line, user="root", folder=HOME, code=0):
    """What a line of a document prints; it ends with this exit code and without a traceback."""
    with started(line, user, folder) as process:
        out = process.stdout.read()
    assert process.returncode == code, f"{line}: exit code {process.returncode}\n{out}"
    assert "Traceback" not in out, f"{line}\n{out}"
    return out


def reported(process, wanted):
    """Lines up to the one that contains this."""
    lines = []
    for line in process.stdout:
        lines.append(line)
        if wanted in line:
            return lines
    raise AssertionError(f"{wanted!r} was not said:\n{''.join(lines)}")


def ctrl_c(process):
    """The rest of what is said, with Ctrl-C pressed."""
    os.killpg(process.pid, signal.SIGINT)
    out = process.stdout.read()
    assert process.wait() == 0, out
    return out


def finger(places_mm):
    """A finger on a panel whose x axis lies along the plate's width, backwards, and its y axis along the length."""
    return PANEL.finger((round(LARGEST * (1 - y_mm / WIDTH_MM)), round(LARGEST * x_mm / LENGTH_MM)) for x_mm, y_mm in places_mm)


def to_and_fro():
    return ((80 + 40 * math.sin(number / 20), 50.0) for number in itertools.count())


ANSWERS = [
    ("Extent of the glass along x", LENGTH_MM),
    ("Extent of the glass along y", WIDTH_MM),
    ("Thickness of the glass", 0.7),
    ("Kind of glass", "borosilicate"),
    ("How the glass is held", "simply_supported"),
    ("active area", ""),
    ("The same along y", ""),
    ("Piezo disc", ""),
    ("Number of discs", 7),
    ("rim of a disc", ""),
    ("Power rating", ""),
    ("Drive words", ""),
    ("FPGA board", "ulx3s"),
    ("Kind of touch panel", "serial_panel"),
    ("touch.device", PANEL.device),
]


def at_a_serial_port(text):
    """The board that setup wrote, as somebody with another link and a slow machine changes it."""
    for key, value in {"pitch_mm": 4.5, "heartbeat_timeout_ms": 250.0}.items():
        text, count = re.subn(rf"^{key} = \S+", f"{key} = {value}", text, flags=re.MULTILINE)
        assert count == 1, key
    text = panel_board.table(text, "link", LINK)
    return panel_board.table(text, "application_socket", f'path = "{SOCKET}"\n')


def step(wanted):
    """The one line of boards/README.md that has this in it."""
    (line,) = [line for line in STEPS if wanted in line]
    return line


def test_the_package_the_user_and_the_unit_are_installed_as_written():
    Path("/opt/haptic-panel/current").unlink()
    shutil.rmtree("/opt/haptic-panel/state")
    shutil.rmtree("/etc/haptic-panel")
    shutil.rmtree("/var/lib/haptic-panel")
    for line in PACKAGE:
        done(line, folder=CHECKOUT)
    for line in SYSTEM:
        if "udevadm" not in line and " /usr/" not in line:  # a container has no devices of its own, and its /usr is this machine's
            done(line, folder=CHECKOUT)
    for line in ADOPT:
        done(line)
    PANEL.belongs_to("dialout")


def test_a_board_is_written_by_its_builders_answers_and_made_ones_own():
    said = at_terminal(["sh", "-c", f"exec {step('haptic-panel setup')}"], ANSWERS, ENVIRONMENT)
    assert "[ ] the bitstream has this board's limits" in " ".join(said.split())
    done(step("cp -r"))
    TOOLS.mkdir()
    (TOOLS / "changed.toml").write_text(at_a_serial_port(BOARD.read_text()))
    for name, text in (("editor", f'#!/bin/sh\nexec cp {TOOLS}/changed.toml "$1"\n'), ("openFPGALoader", LOADER)):
        (TOOLS / name).write_text(text)
        (TOOLS / name).chmod(0o755)
    done(step("editor "))
    assert f"length_mm = {LENGTH_MM:g}" in BOARD.read_text()


def test_the_changed_board_is_checked_without_any_device():
    assert "panel/board.toml" in done(step("board check"))


@cache
def fpga():
    """As it was delivered: nothing is in its flash."""
    return FarEnd(load_board(BOARD.parent), None, FPGA, grp.getgrnam("dialout").gr_gid, JTAG)


def test_an_fpga_that_was_never_loaded_is_reported_and_there_is_nothing_to_load_yet():
    fpga()
    assert re.search(
        r"^NOT OK +link +.* does not answer: is it the panel's port, and is gateware loaded",
        done(step("doctor --link"), code=1),
        re.MULTILINE,
    )
    assert f"{BITSTREAM}: there is no such bitstream: haptic-panel gateware build --board panel" in done(
        step("gateware load"), code=78
    )


def test_its_bitstream_is_built_and_loaded_and_there_after_a_loss_of_supply():
    assert "/var/lib/haptic-panel/panel.bit: " in done(step("gateware build"))
    done(step("install -m 644"))
    assert f"{BITSTREAM}: loaded" in done(step("gateware load"))
    fpga().lose_supply()
    assert re.search(r"^ok +identity", done(step("doctor --link"), code=1), re.MULTILINE), "all but the bank is there"


def test_the_bank_is_where_run_looks_for_it_and_belongs_to_the_service():
    assert f"bank: {BANK}\n" in done(step("bank build"))
    for place, mode in ((BANK.parent.parent, 0o750), (BANK.parent, 0o750), (BANK, 0o644)):
        assert (place.owner(), place.group(), place.stat().st_mode & 0o777) == (UNIT, UNIT, mode), place
    assert f"{BANK}, " in done("haptic-panel bank verify --board panel")


def test_the_doctor_looks_with_the_services_eyes():
    said = done(step("doctor --board"))
    assert f"looked at as {UNIT}, as which the service runs" in said
    assert "NOT OK" not in said
    BANK.chmod(0)
    try:
        assert re.search(r"NOT OK +bank +.*Permission denied", done(step("doctor --board"), code=1)), "root itself could read it"
    finally:
        BANK.chmod(0o644)
    assert re.search(r"^ok +bits +0 errors in", done(step("doctor --link")), re.MULTILINE)


def calibrated(line):
    """What is said, with each mark touched when it is asked for."""
    said = []
    with started(line) as process:
        hand = contextlib.ExitStack()
        for text in process.stdout:
            said.append(text)
            if asked := re.search(r"at x = (\S+) mm, y = (\S+) mm", text):
                hand.close()
                hand.enter_context(finger(itertools.repeat((float(asked[1]), float(asked[2])))))
        hand.close()
    assert process.returncode == 0, "".join(said)
    return "".join(said)


def test_five_touches_put_the_axes_into_the_board():
    said = calibrated(step("calibrate-touch --board panel |"))
    assert "written to /etc/haptic-panel/boards/panel/board.toml" in said
    rows = [[float(value) for value in row.split(",")] for row in re.findall(r"_mm_from_axes = \[(.*)\]", said)]
    for row, expected in zip(rows, ([0.0, LENGTH_MM, 0.0], [-WIDTH_MM, 0.0, WIDTH_MM]), strict=True):
        assert max(abs(a - b) for a, b in zip(row, expected, strict=True)) < 0.1, said


def test_a_panel_that_hears_nothing_of_the_fpga_gets_no_dead_time():
    """Two minutes, as the page says."""
    said = done(step("--ghosts"))
    assert re.search(r"^ghost_ms = 0(\.0)?$", said, re.MULTILINE), said
    assert re.search(r"^no ghost in \d{3} emissions: ", said, re.MULTILINE), said
    assert "ghost_ms = 0" in BOARD.read_text()


def test_a_finger_says_where_a_channel_buzzes_until_ctrl_c():
    first = load_board(BOARD.parent).actuators[0]
    with started(step("calibrate channels")) as process:
        reported(process, "channel 0 buzzes")
        with finger(itertools.repeat((first.x_mm, first.y_mm))):
            reported(process, "channel 1 buzzes")
        os.killpg(process.pid, signal.SIGINT)
        assert "Traceback" not in process.stdout.read()
    assert process.returncode == 130


def recorded(line, user, folder):
    """A recording made until Ctrl-C; what is said of it."""
    file = Path(line.split("--out ")[1].split()[0])
    file.unlink(missing_ok=True)
    with started(line, user, folder) as process:
        reported(process, "recording ")
        with finger(to_and_fro()):
            wait_for("events", lambda: file.exists() and file.read_text().count("E: ") > 20)
        return ctrl_c(process)


def played(line, user="root"):
    """What the panel prints at the end, after a finger has been felt."""
    with started(line, user) as process:
        wait_for("the socket", Path(SOCKET).exists)
        with finger(to_and_fro()):
            wait_for("five emissions", lambda: figures(SOCKET)["emissions"] >= 5)
        return ctrl_c(process)


def figures(path):
    with PanelClient(path) as panel:
        return panel.figures()


def test_what_the_panel_sends_is_recorded_and_it_plays():
    assert "events" in recorded(step(" record "), "root", HOME)
    said = played(step(" run --board panel "))
    assert re.search(r"^board \S+: (\d+) pulses played; ", said, re.MULTILINE), said
    again = done("haptic-panel run --board panel --replay /tmp/mine.evemu --link model --speed max --json")
    assert '"max_fingers": 1' in again
    assert f'"bank": "{BANK}"' in again


def test_every_step_that_needs_no_root_works_as_the_services_user():
    folder = Path("/tmp/as the user")
    folder.mkdir()
    shutil.chown(folder, UNIT)
    done(step("bank build"), UNIT, folder)
    assert BANK.owner() == UNIT
    assert f"looked at as {UNIT}" in done(step("doctor --board"), UNIT, folder)
    done(step("doctor --link"), UNIT, folder)
    said = done("haptic-panel calibrate-touch --board panel --write", UNIT, folder, code=78)
    assert "board.toml: cannot be written (Permission denied)" in said, "and before five marks were touched for nothing"
    assert said.count("\n") == 1
    recorded(step(" record "), UNIT, folder)
    played(step(" run --board panel "), UNIT)


def test_the_service_plays_what_was_commissioned():
    for line in SERVICE:
        done(line)
    assert shown("UnitFileState") == "enabled"
    assert f"cells of {BANK}" in journal()
    socket = f"/proc/{main_pid()}/root{SOCKET}"
    with finger(to_and_fro()):
        wait_for("five emissions", lambda: figures(socket)["emissions"] >= 5)


def test_a_pitch_changed_in_the_board_is_said_by_the_service_with_what_to_do():
    good = BOARD.read_text()
    BOARD.write_text(good.replace("pitch_mm = 4.5", "pitch_mm = 4.0"))
    try:
        run("systemctl", "stop", UNIT)
        subprocess.run(["systemctl", "start", UNIT], check=False, capture_output=True)
        wait_for("the end", lambda: shown("ActiveState") == "failed")
        assert shown("ExecMainStatus") == "78"
        line = [line for line in journal().splitlines() if "bank.pitch_mm" in line][-1]
        advice = line.partition("rebuild it: ")[2]
        assert advice == "haptic-panel bank build --board panel"
        done(advice)
        assert fresh_start()
    finally:
        BOARD.write_text(good)
