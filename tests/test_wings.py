"""What a device's wheel has without the workshop, and what works in an installation that lacks a room."""

import json
import os
import shutil
import signal
import subprocess
import sys
import sysconfig
import time
import zipfile
from pathlib import Path

import pytest
from compiled_copy import ROOT, build_wheel
from patience import communicate
from scripted_evemu import evemu
from tables import each_row

from controller.cli import COMMANDS
from controller.device.application_socket.client import PanelClient
from controller.device.board.board import load_board
from controller.device.board.panel_state import Condition, PanelState
from controller.device.board.panel_status import NAME
from controller.device.fpga.bitstreams.bitstream import Identity, sealed
from controller.device.fpga.build_parameters import BuildParameters, top_parameters
from controller.device.service.drivers import gateware_hash
from controller.device.service.status_file import StatusFile
from controller.workshop.gateware.model.model import GatewareModel
from controller.workshop.gateware.serial_peer import PseudoTerminal, UartPanel

NO_WORKSHOP = "this needs the workshop, which this installation does not have"
EACH = """
import contextlib, io, json, sys, traceback
from controller.cli import main

ended = []
for arguments in json.load(sys.stdin):
    with contextlib.redirect_stdout(io.StringIO()) as out, contextlib.redirect_stderr(io.StringIO()) as err:
        try:
            code = main(arguments)
        except SystemExit as end:
            code = end.code
        except BaseException:
            code = traceback.format_exc()
    ended.append((code, out.getvalue(), err.getvalue()))
json.dump(ended, sys.stdout)
"""


class Installation:
    """A Python that has the package as it is installed somewhere, and what this one has of other packages."""

    def __init__(self, python, package):
        self.python, self.package = python, package
        nowhere = {name: str(package / "none") for name in ("HAPTIC_PANEL_ROOT", "HAPTIC_PANEL_TRUSTED_ROOT", "XDG_CACHE_HOME")}
        self.environment = os.environ | nowhere | {"PYTHONPATH": str(package)}

    def each(self, folder, *commands):
        """Exit code, standard output and standard error of each command line, one after the other in one process."""
        asked = json.dumps([list(map(str, command)) for command in commands])
        done = subprocess.run(
            [self.python, "-c", EACH], cwd=folder, input=asked, env=self.environment, capture_output=True, text=True, check=False
        )
        assert done.returncode == 0, done.stderr
        return json.loads(done.stdout)

    def started(self, folder, *arguments):
        """The command line in a process of its own, patient with an FPGA that is a thread on a busy machine."""
        program = (
            "import sys; from controller.device.fpga.links import serial_link; serial_link.LATENCY_S = 0.5\n"
            "from controller.cli import main; sys.exit(main(sys.argv[1:]))"
        )
        command = [self.python, "-c", program, *map(str, arguments)]
        return subprocess.Popen(
            command, cwd=folder, env=self.environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
        )


@pytest.fixture(scope="module")
def device(tmp_path_factory):
    """An environment with a device's wheel, as pip unpacks it."""
    folder = tmp_path_factory.mktemp("device")
    done, wheel = build_wheel(folder, HAPTIC_PANEL_WING="device")
    assert wheel, done.stderr
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", folder / "venv"], check=True)
    packages = folder / "venv/lib" / f"python3.{sys.version_info[1]}" / "site-packages"
    with zipfile.ZipFile(wheel) as files:
        files.extractall(packages)
    (data,) = packages.glob("haptic_panel-*.data/data/share")
    data.rename(folder / "venv/share")
    (packages / "others.pth").write_text(sysconfig.get_path("platlib") + "\n")
    return Installation(folder / "venv/bin/python", packages)


@pytest.fixture
def serial_board(board, tmp_path):
    """The simulated board's plate, with an FPGA and a touch panel at serial ports that are not there, and a socket."""
    folder = tmp_path / "panel"
    shutil.copytree(board.folder, folder)
    head, tail = (folder / "board.toml").read_text().split("[touch]\n")
    link = tail.partition("[link]\n")[2].replace(
        'kind = "simulated"', f'kind = "serial"\ndevice = "{tmp_path / "fpga"}"\nbaud = 12_000_000'
    )
    touch = (
        f'[touch]\nkind = "serial_panel"\ndevice = "{tmp_path / "tty"}"\nx_mm_from_axes = [210.0, 0.0, 0.0]\n'
        f'y_mm_from_axes = [0.0, 148.0, 0.0]\n\n[application_socket]\npath = "{tmp_path / "panel.sock"}"\n\n'
        "[realtime]\npriority = 0\nlock_memory = false\n\n"
    )
    (folder / "board.toml").write_text(f"{head}{touch}[link]\n{link}")
    return folder


def bitstream(board, file):
    """A file that says that it is the board's bitstream."""
    parameters = top_parameters(board, gateware_hash())
    identity = Identity(board="panel", top="t", device="d", seed=1, parameters=parameters, sources="0", tools={})
    file.write_bytes(sealed(b"\xff\x00" + identity.comment().encode() + b"\0\xff" + bytes(100)))
    return file


def status(folder):
    """The last status of a panel: what is said of it does not depend on its age."""
    file = StatusFile(folder, "panel")
    file.changed(Condition(PanelState.ARMED, outputs_on=True))
    file.close()
    return folder / NAME


@pytest.mark.kernel
def test_a_devices_wheel_runs_every_command_of_a_device(device, serial_board, bank_file, tmp_path):
    panel = ("--board", serial_board)
    gateware = bitstream(load_board(serial_board), tmp_path / "panel.bit")
    (repository := tmp_path / "repository").joinpath("metadata").mkdir(parents=True)
    expected = {  # exit code, and what is printed, or said where it fails
        ("--version",): (0, "haptic-panel "),
        ("--help",): (0, "calibrate-touch"),
        **{(name, "--help"): (0, "usage: ") for name in COMMANDS if name != "design"},
        ("status", "--file", status(tmp_path)): (69, "armed"),
        ("status", "--file", tmp_path / "none"): (69, "no service runs"),
        ("client", "--socket", tmp_path / "panel.sock", "state"): (69, "panel.sock"),
        ("doctor", *panel): (1, "there is no serial port"),
        ("doctor", *panel, "--link"): (1, "there is no serial port"),
        ("board", "check", serial_board): (0, "PASS"),
        ("board", "reference"): (0, "board.toml"),
        ("board", "schema"): (0, "properties"),
        ("bank", "info", bank_file): (0, "responses"),
        ("bank", "verify", bank_file): (0, "PASS"),
        ("record", *panel, "--out", tmp_path / "mine.evemu"): (69, f"no serial port {tmp_path / 'tty'}"),
        ("calibrate-touch", *panel): (69, f"no serial port {tmp_path / 'tty'}"),
        ("gateware", "info", gateware, *panel): (0, "limits of board panel"),
        ("gateware", "load", gateware, *panel): (78, "give it a table [gateware]"),
        ("gateware", "check", *panel): (69, f"no serial port {tmp_path / 'fpga'}"),
        ("update", "check", "--from", repository): (1, "none: cannot be read"),
        ("update", "download", "--from", repository): (1, "none: cannot be read"),
        ("update", "install", "--from", repository): (1, "none: cannot be read"),
        ("update", "status"): (0, "no release is in use"),
        ("update", "rollback"): (1, "no release before this one"),
        ("update", "judge"): (0, ""),
        ("metrics",): (0, "haptic_panel_up 0"),
        ("reload",): (78, "$MAINPID"),
        ("completion", "bash"): (0, "complete"),
    }
    ended = device.each(tmp_path, *expected)
    for (command, (code, words)), (was, out, err) in zip(expected.items(), ended, strict=True):
        assert was == code, (command, was, out, err)
        assert words in out + err, command
        assert "workshop" not in err, command


def test_what_needs_the_workshop_says_so_in_one_line(device, serial_board, tmp_path):
    assert not (device.package / "controller/workshop").exists()
    commands = (
        ("focus", "--at", "100", "70"),
        ("design",),
        ("benchmark",),
        ("calibrate", "plan", "--out", "points.csv"),
        ("run", "--speed", "max"),
        ("run", "--board", serial_board),  # whose bank is not there
        ("serve", tmp_path / "panel.sock"),
        ("bank", "build"),
        ("gateware", "build", "--board", "ulx3s"),
        ("update", "make-release", "release", "--version", "1.0", "--counter", "1"),
    )
    for command, (code, _, err) in zip(commands, device.each(tmp_path, *commands), strict=True):
        assert code == 78, (command, code, err)
        assert NO_WORKSHOP in err, (command, err)
        assert err.count("\n") == 1, (command, err)


@pytest.mark.kernel
def test_a_devices_wheel_plays_and_waits_for_what_is_not_connected(device, serial_board, bank_file, tmp_path):
    board = load_board(serial_board)
    model = GatewareModel(BuildParameters.of(board, gateware_hash()))
    far_end = UartPanel(model, board.link.clock_hz, board.link.baud, time.monotonic)
    with device.started(tmp_path, "run", "--board", serial_board, "--bank", bank_file, "--json") as service:
        until_said(service, "waiting for FPGA")
        with PseudoTerminal(far_end.receive) as terminal:
            (tmp_path / "fpga").symlink_to(terminal.device)
            until_said(service, "the outputs are on")
            with PanelClient(str(tmp_path / "panel.sock"), timeout_s=20.0) as client:
                while client.play("click", at_mm=(50, 50)).outcome != "played":
                    pass
            service.send_signal(signal.SIGTERM)
            out, err = communicate(service)
    assert service.returncode == 0, err
    assert json.loads(out)["emissions"] >= 1


def until_said(process, words):
    """Read its messages up to these words."""
    said = []
    for line in process.stderr:
        said.append(line)
        if words in line:
            return
    pytest.fail(f"ended without saying {words!r}: {said}")


def without_room(folder, room):
    """This checkout as it is without a folder of the package."""
    for name in ("boards", "fpga_rtl", "pyproject.toml"):
        (folder / name).symlink_to(ROOT / name)
    place = Path("controller")
    for part in (*room.split("/"), None):
        (folder / place).mkdir()
        for path in (ROOT / place).iterdir():
            if path.name not in (part, "__pycache__"):
                (folder / place / path.name).symlink_to(path)
        place = place / part if part else place
        if place == Path("controller", room):
            break
    return Installation(sys.executable, folder)


@pytest.mark.kernel
@each_row("room", ["device/update", "device/application_socket", "workshop/benchmark", "workshop/calibration"])
def test_without_a_room_a_panel_runs_and_shows_its_state(room, bank_file, tmp_path):
    (tmp_path / "checkout").mkdir()
    installation = without_room(tmp_path / "checkout", room)
    touched = tmp_path / "touched.evemu"
    touched.write_text(evemu((0.0, {0: (109, 73)}), (0.3, {0: None})))
    needs = {
        "device/update": ("update", "status"),
        "device/application_socket": ("client", "state"),
        "workshop/benchmark": ("focus", "--at", "100", "70"),
        "workshop/calibration": ("calibrate", "plan", "--out", "points.csv"),
    }
    replay = ("run", "--speed", "max", "--bank", bank_file, "--replay", touched, "--json")
    played, shown, doctor, lacking = installation.each(
        tmp_path, replay, ("status", "--file", status(tmp_path)), ("doctor", "--board", "simulated", "--json"), needs[room]
    )
    assert played[0] == 0, played
    assert json.loads(played[1])["emissions"] > 0
    assert shown[0] == 69, shown
    assert "\narmed\n" in shown[1]
    assert json.loads(doctor[1])["findings"], doctor
    assert lacking[0] == 78, lacking
    assert lacking[2] == (
        f"haptic-panel: this needs controller/{room}, which this installation does not have: install all of it again\n"
    )


def test_without_the_application_socket_the_service_says_so_and_goes_on(serial_board, bank_file, tmp_path):
    (tmp_path / "checkout").mkdir()
    installation = without_room(tmp_path / "checkout", "device/application_socket")
    with installation.started(tmp_path, "run", "--board", serial_board, "--bank", bank_file, "--json") as service:
        until_said(service, "[application_socket] is not served")
        until_said(service, "waiting for FPGA")
        service.send_signal(signal.SIGTERM)
        communicate(service)
    assert service.returncode == 0


def test_help_of_every_command_needs_no_offline_tools():
    """Nor does completion: both ask what every command takes."""
    program = """
import sys
class Absent:
    def find_spec(self, name, path=None, target=None):
        if name.split(".")[0] in ("scipy", "matplotlib", "tqdm", "pyuff", "dask", "distributed"):
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)
sys.meta_path.insert(0, Absent())
from controller.cli import COMMANDS, parser
assert len(parser(COMMANDS).format_help()) > 1000
"""
    subprocess.run([sys.executable, "-c", program], check=True)
