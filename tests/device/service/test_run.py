"""The service on bad days: a process of its own with a panel on a pseudo-terminal, the gateware's model and a socket.

What is waited for is what the process says, on its log or its socket, never time.
"""

import compileall
import contextlib
import json
import os
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import tty
from pathlib import Path

import pytest
from patience import communicate, wait_for

import controller
from controller.cli import main
from controller.device.application_socket.client import PanelClient
from controller.device.board.board import load_board
from controller.device.board.lookup import fpga_files
from controller.device.board.panel_state import PanelState
from controller.device.board.panel_status import read_now, read_status
from controller.device.fpga.build_parameters import BuildParameters
from controller.device.service.drivers import gateware_hash
from controller.errors import ControllerError
from controller.workshop.bank_builder.build import build_bank
from controller.workshop.bank_builder.request import BankRequest
from controller.workshop.gateware.model.model import GatewareModel
from controller.workshop.gateware.serial_peer import PseudoTerminal, UartPanel

CLICK = '[[regions]]\nname = "all"\nshape = "plate"\neffects = ["click"]\n'
TEXTURE = '[[regions]]\nname = "all"\nshape = "plate"\neffects = [{ effect = "texture", spacing_mm = 5.0 }]\n'


class Panel:
    """An Elo SmartSet panel at the end of a pseudo-terminal, which may be unplugged."""

    def __init__(self, path):
        self.path = path
        self.plug()

    def plug(self):
        self._fd, self._far = os.openpty()
        tty.setraw(self._far)
        with contextlib.suppress(FileNotFoundError):
            self.path.unlink()
        self.path.symlink_to(os.ttyname(self._far))

    def unplug(self):
        os.close(self._far)
        os.close(self._fd)

    def send(self, data):
        os.write(self._fd, data)

    def touch(self, x, y, down=True):
        """One packet: 'U', 'T', status, x, y, z, checksum (Elo SmartSet manual)."""
        body = bytes([0x55, ord("T"), 0x01 if down else 0x04, x & 0xFF, x >> 8, y & 0xFF, y >> 8, 0xFF, 0x00])
        self.send(body + bytes([(0xAA + sum(body)) & 0xFF]))


BEGUN = []  # services of a test


@pytest.fixture(autouse=True)
def none_goes_on():
    """A test that fails leaves no service: it would open the next terminal that has its panel's number."""
    yield
    while BEGUN:
        process = BEGUN.pop()
        if process.poll() is None:
            process.kill()
        process.communicate()


class Service:
    """`haptic-panel run` on a board of its own."""

    def __init__(self, folder, bank, *more, environment=None, before=""):
        command = [sys.executable, "-m", "controller.cli", "run", "--board", str(folder), "--bank", str(bank), "--json", *more]
        program = f"{before}import sys; from controller.cli import main; sys.exit(main(sys.argv[1:]))"
        command[1:3] = ["-c", program]
        self.process = subprocess.Popen(
            command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=os.environ | (environment or {})
        )
        BEGUN.append(self.process)
        self.log_end = self.process.stderr.fileno()
        self.log = []
        self.socket = folder / "panel.sock"

    def says(self, words):
        """Read the log up to a line with these words."""
        for line in self.process.stderr:
            self.log.append(line)
            if words in line:
                return line
        pytest.fail(f"ended without saying {words!r}: {self.log}, exit {self.process.wait()}")

    def client(self):
        return PanelClient(str(self.socket), timeout_s=20.0)

    def end(self, number=signal.SIGTERM):
        """Figures and exit code."""
        self.process.send_signal(number)
        out, err = communicate(self.process)
        self.log.append(err)
        return json.loads(out) if out else None, self.process.returncode


@pytest.fixture
def folder(board, tmp_path):
    """A board with a serial panel and a socket."""
    text = (board.folder / "board.toml").read_text()
    head, tail = text.split("[touch]\n")
    _, link = tail.split("[link]\n")
    touch = f"""[touch]
kind = "serial_panel"
device = "{tmp_path / "tty"}"
x_mm_from_axes = [210.0, 0.0, 0.0]
y_mm_from_axes = [0.0, 148.0, 0.0]

[application_socket]
path = "{tmp_path / "panel.sock"}"

[realtime]
priority = 0
lock_memory = false

"""
    patient = link.replace("heartbeat_timeout_ms = 100.0", "heartbeat_timeout_ms = 250.0")  # for a busy machine
    assert patient != link
    (tmp_path / "board.toml").write_text(head + touch + "[link]\n" + patient)
    (tmp_path / "scene.toml").write_text(CLICK)
    (tmp_path / "texture.toml").write_text(TEXTURE)
    return tmp_path


class Manager:
    """systemd, as far as it listens."""

    def __init__(self, path):
        self.environment = {"NOTIFY_SOCKET": str(path)}
        self._socket = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        self._socket.bind(str(path))
        self._socket.settimeout(60)

    def hears(self, name, value):
        """The next message that gives a variable a value that begins so, as all its variables."""
        while True:
            said = dict(line.partition("=")[::2] for line in self._socket.recv(4096).decode().splitlines())
            if said.get(name, "\0").startswith(value):
                return said

    def heard(self):
        """The variables of everything that waits to be read."""
        self._socket.settimeout(0)
        with contextlib.suppress(BlockingIOError):
            while True:
                yield from self._socket.recv(4096).decode().splitlines()

    def close(self):
        self._socket.close()


@pytest.fixture
def manager():
    with tempfile.TemporaryDirectory(prefix="hp") as short:  # a socket's path has at most 107 bytes
        manager = Manager(Path(short) / "notify")
        yield manager
        manager.close()


# Its far end is a thread on a busy machine.
PATIENT_LINK = "from controller.device.fpga.links import serial_link; serial_link.LATENCY_S = 0.5; "


def at_a_serial_port(folder):
    """The board's FPGA is at a serial port that is not there yet."""
    file = folder / "board.toml"
    text = file.read_text()
    before = text
    text = text.replace('kind = "simulated"', f'kind = "serial"\ndevice = "{folder / "fpga"}"\nbaud = 12_000_000')
    assert text != before
    file.write_text(text)
    return load_board(file)


@contextlib.contextmanager
def an_fpga(board, path, build=None):
    """The gateware's model at that port, while the context lasts; a function that sets its run permit, given at first."""
    link = board.link
    model = GatewareModel(BuildParameters.of(board, gateware_hash() if build is None else build))
    panel = UartPanel(model, link.clock_hz, link.baud, time.monotonic)
    levels = []

    def answer(data):
        nonlocal model, panel
        while levels:
            model.permit(model.now + 1, level=levels.pop(0))
        with contextlib.suppress(FileNotFoundError):  # which a loader leaves
            loaded = path.with_name("loaded")
            model = GatewareModel(BuildParameters.of(board, int(loaded.read_text())))
            panel = UartPanel(model, link.clock_hz, link.baud, time.monotonic)
            loaded.unlink()
        return panel.receive(data)

    with PseudoTerminal(answer) as terminal:
        path.symlink_to(terminal.device)
        try:
            yield levels.append
        finally:
            path.unlink()


@pytest.fixture
def panel(folder):
    panel = Panel(folder / "tty")
    yield panel
    with contextlib.suppress(OSError):
        panel.unplug()


@pytest.fixture
def bank(bank_file, tmp_path):
    return shutil.copy(bank_file, tmp_path / "own.bank")


@pytest.fixture
def service(folder, panel, bank):
    service = Service(folder, bank)
    service.says("the outputs are on")
    yield service
    with contextlib.suppress(ProcessLookupError):
        service.process.kill()
    service.process.communicate()


def until_played(client):
    """A command, again until it is played: on a busy machine the outputs may be off for a moment."""
    while client.play("click", at_mm=(50, 50)).outcome != "played":
        pass


def until_state(client, state):
    """Listen until the panel is said to be so."""
    next(said for said in client.states() if said.state == state)


def felt(client, panel, x, y):
    """Touch and let go; wait until the loop has reported both, so that it has played what there was to play."""
    touches = client.touches()
    panel.touch(x, y)
    next(touch for touch in touches if touch.contact)
    panel.touch(x, y, down=False)
    next(touch for touch in touches if not touch.contact)


def test_touches_are_played_until_it_is_asked_to_stop(service, panel):
    with service.client() as client:
        touches = client.touches()
        panel.touch(2048, 2048)
        touch = next(touches)
        assert (touch.x_mm, touch.y_mm) == (pytest.approx(105, abs=0.1), pytest.approx(74, abs=0.1))
        panel.touch(2048, 2048, down=False)
        assert not next(touch for touch in touches if not touch.contact).contact
    figures, code = service.end()
    assert code == 0
    assert figures["emissions"] == 1
    assert (figures["outages"], figures["host_silent"]) == (0, 0)


def virtual_bytes(pid):
    """All that is mapped."""
    with open(f"/proc/{pid}/status") as status:  # noqa: PTH123 - the kernel's
        return next(int(line.split()[1]) * 1024 for line in status if line.startswith("VmSize:"))


def test_the_memory_for_composing_is_taken_before_the_outputs_are_on(service):
    before = virtual_bytes(service.process.pid)
    with service.client() as client:
        numbers = [client.start_play("click", at_mm=place) for place in ((40, 50), (90, 60), (150, 90))]
        assert [client.wait(number).outcome for number in numbers] == ["played"] * 3
    assert virtual_bytes(service.process.pid) - before < 16 << 20, "the linear algebra alone takes 32 MB at its first sum"
    assert service.end()[0]["emissions"] < 3, "some were composed"


def resident_kib(pid, file=""):
    """Resident, and of it locked, in KiB: in all, or of the mappings of a file."""
    resident = locked = 0
    counts = not file
    with open(f"/proc/{pid}/smaps") as mappings:  # noqa: PTH123 - the kernel's
        for line in mappings:
            name, *values = line.split()
            if "-" in name and not name.endswith(":"):
                counts = not file or line.rstrip().endswith(file)
            elif counts and name in ("Rss:", "Locked:"):
                resident += int(values[0]) * (name == "Rss:")
                locked += int(values[0]) * (name == "Locked:")
    return resident, locked


def test_after_the_start_next_to_nothing_of_the_bank_is_in_memory(folder, panel, board, tmp_path):
    """Of the board's own bank, 193 MB, the responses that `prepare` composed from; the rest is checked, and in the page cache.

    In all 64 MiB, so that a computer of 512 MB has room for a user interface: 13 are NumPy, 12 Python, 12 the modules, 5 tuples
    kept for the loop, 3 room to compose; 19 are left for waveforms, which come as they are played.
    """
    file = folder / "board.toml"
    file.write_text(file.read_text().replace("lock_memory = false", "lock_memory = true"))  # if this user may
    bank = tmp_path / "whole.bank"
    build_bank(BankRequest(board, bank))
    with an_fpga(at_a_serial_port(folder), folder / "fpga"):  # its model is in another process, as the FPGA is
        service = Service(folder, bank, before=PATIENT_LINK)
        service.says("the outputs are on")
        in_all, locked = resident_kib(service.process.pid)
        of_bank, _ = resident_kib(service.process.pid, "whole.bank")
        service.end()
    assert of_bank < 1024
    assert locked <= in_all <= 64 * 1024


@pytest.fixture
def bytecode():
    """That of the package, as an installed one has: a service that compiles its modules itself takes more memory."""
    compileall.compile_dir(Path(controller.__file__).parent, quiet=2)


@pytest.mark.usefixtures("bytecode")
def test_a_bank_takes_no_memory_before_the_first_touch(service, bank):
    """Its waveforms are checked then, but read, not mapped: of what is played the pages are kept, and locked."""

    def bank_kb():
        kb, of_bank = 0, False
        for line in Path(f"/proc/{service.process.pid}/smaps").read_text().splitlines():
            name, *values = line.split()
            if "-" in name:  # a mapping begins: its addresses, and at the end its file
                of_bank = values[-1] == str(bank)
            elif name == "Rss:" and of_bank:
                kb += int(values[0])
        return kb

    status = Path(f"/proc/{service.process.pid}/status").read_text()
    assert int(status.partition("VmRSS:")[2].split()[0]) < 64e6 / 1024
    before_kb = bank_kb()
    assert before_kb < 300, "the response of the cell with which composing is tried out"
    with service.client() as client:
        until_played(client)
    assert before_kb < bank_kb()


COUNTED = """
import atexit, sys, time
from controller.device.application_socket.connections.clients import Clients
from controller.device.loop.watched_files import WatchedFiles
from controller.device.touch.panels.serial_panel import SerialPanel
silent, counts = {}, dict.fromkeys(("touch", "commands", "touch needlessly", "commands needlessly"), 0)
def noted(files, name, whole=WatchedFiles.silent):
    silent[name] = whole(files, name)
    counts[name] += silent[name]
    return silent[name]
def counted(kind, method, name):
    whole = getattr(kind, method)
    def call(*given):
        due = getattr(given[0], "next_s", sys.maxsize) <= time.monotonic()  # such as a client that is commanded to go
        counts[name + " needlessly"] += silent.get(name, False) and not due
        return whole(*given)
    setattr(kind, method, call)
WatchedFiles.silent = noted
counted(SerialPanel, "_fill", "touch")
counted(Clients, "receive", "commands")
atexit.register(lambda: print("counts", *counts.values(), file=sys.stderr))
"""


def test_panel_and_socket_are_read_only_when_the_selector_says_so(folder, panel, bank, manager):
    service = Service(folder, bank, environment=manager.environment | {"WATCHDOG_USEC": "500000"}, before=COUNTED)
    service.says("the outputs are on")
    with service.client() as client:
        felt(client, panel, 2048, 2048)
    for _ in range(8):  # meanwhile it does nothing but beat
        manager.hears("WATCHDOG", "1")
    service.end()
    counts = next(line for line in "".join(service.log).splitlines() if line.startswith("counts")).split()
    no_touch, no_command, touch_needlessly, commands_needlessly = map(int, counts[1:])
    assert min(no_touch, no_command) > 10
    assert (touch_needlessly, commands_needlessly) == (0, 0)


ASKED_EARLY = (
    "import os, signal; from controller.device.service import run; enter = run.enter_realtime; "
    "run.enter_realtime = lambda *how: (os.kill(os.getpid(), signal.SIGUSR1), enter(*how))[1]; "
)


def test_a_trace_that_is_asked_for_before_the_loop_runs_ends_nothing(folder, panel, bank):
    service = Service(folder, bank, before=ASKED_EARLY)
    service.says("the outputs are on")
    assert service.end()[1] == 0


def test_a_command_is_played_and_answered(service):
    with service.client() as client:
        assert client.play("click", at_mm=(100, 70)).outcome == "played"
        refused = client.play("boom", at_mm=(100, 70))
        assert refused.outcome == "refused"
        assert "no effect 'boom'" in refused.reason
    figures, code = service.end(signal.SIGINT)
    assert (figures["emissions"], code) == (1, 0)


def test_two_fpgas_play_for_a_finger_as_one_panel(folder, panel):
    file = folder / "board.toml"
    text, halved = re.subn(r"channel = (1[6-9]|2\d|3[01])", lambda found: f"channel = {int(found[1]) + 16}", file.read_text())
    assert halved == 16
    file.write_text(text + "\n[[link.fpga]]\n\n[[link.fpga]]\n")
    board, bank = load_board(file), folder / "halves.bank"
    for one, path in zip(board.fpga_boards, fpga_files(bank, 2), strict=True):
        build_bank(BankRequest(one, path, 30e-3))
    service = Service(folder, bank)
    service.says("the outputs are on")
    with service.client() as client:
        until_played(client)
        felt(client, panel, 2048, 2048)
    figures, code = service.end()
    assert code == 0
    assert figures["emissions"] >= 2


def test_a_panel_that_is_unplugged_is_taken_again_when_it_is_back(service, panel):
    with service.client() as client:
        touches = client.touches()
        panel.touch(2048, 2048)
        first = next(touches)
        panel.unplug()
        gone = next(touch for touch in touches if not touch.contact)
        assert gone.finger == first.finger, "the finger on it is released"
        assert client.play("click", at_mm=(100, 70)).outcome == "played", "commands go on"
        service.says("the touch panel is lost")
        panel.plug()
        service.says("the touch panel is back")
        panel.touch(1024, 1024)
        assert next(touch for touch in touches if touch.contact).finger != first.finger
    figures, code = service.end()
    assert code == 0
    assert figures["emissions"] == 3
    assert any("panel" in warning for warning in figures["warnings"])


def test_a_panel_that_talks_nonsense_or_floods_does_not_stop_the_loop(service, panel):
    with service.client() as client:
        touches = client.touches()
        panel.touch(995, 2000)
        assert next(touches).contact, "reported once the shadow of the ramp is over"
        panel.send(bytes(range(256)) * 8)
        for k in range(300):  # as fast as the port takes them
            panel.touch(1000 + 5 * k, 2000)
        seen = [touch for touch, _ in zip(touches, range(50), strict=False)]
        assert all(touch.contact for touch in seen)
        panel.touch(2500, 2000, down=False)
        assert not next(touch for touch in touches if not touch.contact).contact
        assert client.play("click", at_mm=(30, 30)).outcome == "played"
    figures, code = service.end()
    assert (code, figures["outages"]) == (0, 0)


def test_sighup_reads_the_scene_again(service, folder, panel):
    (folder / "scene.toml").write_text(CLICK + '[effects.knock]\nwhen = "command"\n')
    service.process.send_signal(signal.SIGHUP)
    service.says("another scene is played")
    with service.client() as client:
        assert "knock" in client.hello().effects
        answer = client.play("knock", at_mm=(50, 50))
        assert answer.outcome == "played", (answer, service.log)
    figures, _ = service.end()
    assert (figures["scenes_loaded"], figures["scenes_refused"]) == (1, 0)


def test_what_prepares_scenes_may_die_and_the_panel_plays_on(service, folder, panel):
    helpers = Path(f"/proc/{service.process.pid}/task/{service.process.pid}/children").read_text().split()
    assert len(helpers) == 2, "one for scenes, one for clients' regions"
    for helper in helpers:
        os.kill(int(helper), signal.SIGKILL)
    with service.client() as client:
        client.load_scene("texture")
        region = {"name": "a", "shape": "circle", "x_mm": 50, "y_mm": 50, "radius_mm": 9, "effects": ["click"]}
        assert client.put_regions([region]).regions == 1
        client.move_regions(x_mm=5)
        assert client.describe().scene == "texture"
    figures, code = service.end()
    assert (code, figures["scenes_loaded"], figures["outages"]) == (0, 1, 0)


def test_a_disarmed_panel_stays_off_whoever_comes_and_whatever_happens_until_it_is_armed(service):
    with service.client() as client:
        client.disarm()
        assert f"(uid {os.getuid()}, pid {os.getpid()}) disarms the panel" in service.says("disarms")
        cause = next(state for state in client.states() if state.state == "disarmed").cause
        assert re.fullmatch(rf"switched off by .*uid {os.getuid()}\b.*pid {os.getpid()}\)", cause)
    service.process.send_signal(signal.SIGSTOP)
    os.waitid(os.P_PID, service.process.pid, os.WSTOPPED | os.WNOWAIT)
    signal.sigtimedwait([], 0.5)  # two heartbeat timeouts
    service.process.send_signal(signal.SIGCONT)
    with service.client() as client:
        assert client.state().outputs_on is False
        assert "is disarmed" in client.play("click", at_mm=(50, 50)).reason
        states = client.states()
        client.arm()
        assert next(state for state in states if state.outputs_on).state in {"ramping", "armed"}
        next(state for state in states if state.state == "armed")
        states.close()
        assert client.play("click", at_mm=(50, 50)).outcome == "played"
    figures, code = service.end()
    assert (code, figures["emissions"]) == (0, 1)


def test_a_disarmed_panel_stays_off_when_the_service_dies_and_is_started_again(service, folder, bank):
    with service.client() as client:
        client.disarm()
    service.process.kill()
    service.process.communicate()
    again = Service(folder, bank)
    assert f"pid {os.getpid()})" in again.says("outputs off: disarmed"), "who it was is remembered"
    with again.client() as client:
        assert "is disarmed" in client.play("click", at_mm=(50, 50)).reason
        client.arm()
        again.says("the outputs are on")
        assert client.play("click", at_mm=(50, 50)).outcome == "played"
    figures, code = again.end()
    assert (code, figures["emissions"]) == (0, 1)


def test_a_bad_scene_leaves_the_old_one(service, folder, panel):
    (folder / "scene.toml").write_text("[[regions]]\nname = 1\n")
    service.process.send_signal(signal.SIGHUP)
    assert "scene.toml" in service.says("the scene stays as it was")
    with service.client() as client:
        assert client.play("click", at_mm=(50, 50)).outcome == "played"
    figures, code = service.end()
    assert (code, figures["scenes_loaded"], figures["scenes_refused"], figures["outages"]) == (0, 0, 1, 0)


def test_who_asked_for_a_reload_is_informed_what_became_of_it(folder, panel, bank, tmp_path):
    (tmp_path / "run").mkdir()
    environment = {"RUNTIME_DIRECTORY": str(tmp_path / "run")}
    service = Service(folder, bank, environment=environment)
    service.says("the outputs are on")

    def reload(before=""):
        program = f"import sys; {before}from controller.cli import main; sys.exit(main(['reload']))"
        environ = os.environ | environment | {"MAINPID": str(service.process.pid)}
        asked = subprocess.Popen([sys.executable, "-c", program], stderr=subprocess.PIPE, text=True, env=environ)
        return communicate(asked)[1], asked.returncode

    assert reload() == ("", 0)
    (folder / "scene.toml").write_text("[[regions]]\nname = 1\n")
    said, code = reload()
    assert (code, said.count("\n")) == (78, 1)
    assert said.startswith("haptic-panel: the scene stays as it was: ")
    assert "scene.toml" in said
    (folder / "scene.toml").write_text(CLICK)
    assert reload() == ("", 0)
    said, code = reload("sys.prefix = '/opt/haptic-panel/releases/2.0/venv'; ")
    assert (code, said.count("\n")) == (78, 1)
    assert f"the service runs from {sys.prefix}, and this is /opt/haptic-panel/releases/2.0/venv: restart" in said
    figures, code = service.end()
    assert (code, figures["scenes_loaded"], figures["scenes_refused"]) == (0, 2, 1)
    said, code = reload()
    assert code == 1
    assert "No such process" in said


def test_a_client_may_load_a_scene_by_its_name_and_is_informed_why_not(service, panel):
    with service.client() as client:
        client.load_scene("texture")
        with pytest.raises(ControllerError, match="nowhere"):
            client.load_scene("nowhere")
        felt(client, panel, 2048, 2048)
    figures, _ = service.end()
    assert (figures["scenes_loaded"], figures["scenes_refused"]) == (1, 1)
    assert figures["emissions"] == 0, "a texture is not felt by a touch at rest"


def test_a_saved_scene_is_loaded_by_its_name_also_after_a_restart(folder, panel, bank, tmp_path):
    mine = TEXTURE.replace('"all"', '"mine"')
    assert mine != TEXTURE
    state = {"STATE_DIRECTORY": str(tmp_path / "state")}
    service = Service(folder, bank, environment=state)
    service.says("the outputs are on")
    with service.client() as client:
        client.save_scene("mine", mine)
        assert client.describe().scene == "scene", "it is not in force"
        with pytest.raises(ControllerError, match=r"mine.toml: regions\[0\]"):
            client.save_scene("mine", "[[regions]]\nname = 1\n")
        with pytest.raises(ControllerError, match=r"'texture' is taken by the board's own texture.toml"):
            client.save_scene("texture", mine)
    figures, code = service.end()
    assert (code, figures["scenes_loaded"], figures["scenes_refused"]) == (0, 0, 0)
    assert "saves the scene 'mine'" in "".join(service.log)
    service = Service(folder, bank, environment=state)
    service.says("the outputs are on")
    with service.client() as client:
        client.load_scene("mine")
        assert (client.describe().scene, client.describe().regions[0].name) == ("mine", "mine")
    assert service.end()[1] == 0


def test_a_bank_that_is_replaced_is_played_from_the_next_reload_on(service, bank_file, bank, folder):
    with service.client() as client:
        damaged = bytearray(bank_file.read_bytes())
        damaged[len(damaged) // 2] ^= 1
        (folder / "new.bank").write_bytes(damaged)
        (folder / "new.bank").replace(bank)
        assert client.play("click", at_mm=(50, 50)).outcome == "played", "the old mapping is whole"
        service.process.send_signal(signal.SIGHUP)
        assert "damaged" in service.says("the scene stays as it was")
        shutil.copy(bank_file, folder / "newer.bank")
        (folder / "newer.bank").replace(bank)
        service.process.send_signal(signal.SIGHUP)
        service.says("another scene is played")
        assert client.play("click", at_mm=(90, 50)).outcome == "played"
    assert service.end()[1] == 0


def test_a_bank_truncated_under_the_service_ends_it_and_is_refused_by_the_next(service, bank, folder, panel):
    os.truncate(bank, 4096)
    with contextlib.suppress(ControllerError), service.client() as client:
        client.play("click", at_mm=(50, 50))
    communicate(service.process)
    assert service.process.returncode == -signal.SIGBUS
    again = Service(folder, bank)
    _, err = communicate(again.process)
    assert again.process.returncode == 78
    assert err.count("\n") == 1
    assert "truncated" in err or "size" in err or "short" in err, err


def test_what_the_loop_did_is_written_when_asked_for_and_after_a_fault(folder, panel, bank, tmp_path, capsys):
    runtime = tmp_path / "run"
    runtime.mkdir()
    service = Service(folder, bank, environment={"RUNTIME_DIRECTORY": str(runtime)})
    service.says("the outputs are on")
    with service.client() as client:
        until_played(client)
        service.process.send_signal(signal.SIGUSR1)
        assert "it was asked for (SIGUSR1): what the loop did" in service.says("haptic-panel trace")
        until_played(client)
        service.process.send_signal(signal.SIGSTOP)
        os.waitid(os.P_PID, service.process.pid, os.WSTOPPED | os.WNOWAIT)
        signal.sigtimedwait([], 0.5)  # two heartbeat timeouts
        service.process.send_signal(signal.SIGCONT)
        service.says("the outputs are on")
    _, code = service.end()
    assert code == 0
    assert main(["trace", str(runtime / "trace-1.json")]) == 0
    assert "written because: it was asked for (SIGUSR1)" in capsys.readouterr().out


def test_a_process_stopped_for_a_while_finds_its_outputs_off_and_comes_back(service):
    with service.client() as client:
        assert client.play("click", at_mm=(50, 50)).outcome == "played"
        service.process.send_signal(signal.SIGSTOP)
        os.waitid(os.P_PID, service.process.pid, os.WSTOPPED | os.WNOWAIT)
        signal.sigtimedwait([], 0.5)  # two heartbeat timeouts
        service.process.send_signal(signal.SIGCONT)
        assert "sent no valid frame" in service.says("outputs off")
        service.says("the outputs are on")
        assert client.play("click", at_mm=(60, 50)).outcome == "played"
    figures, code = service.end()
    assert (figures["host_silent"], code) == (1, 0)


def test_a_panel_that_is_absent_at_the_start_is_waited_for_while_commands_play(folder, bank, manager):
    service = Service(folder, bank, environment=manager.environment)
    assert "there is no serial port" in service.says("waiting for panel")
    assert manager.hears("READY", "1")["STATUS"].startswith("waiting for panel: there is no serial port")
    with service.client() as client:
        until_played(client)
        until_state(client, "waiting for panel")
        panel = Panel(folder / "tty")
        service.says("the touch panel is back")
        felt(client, panel, 2048, 2048)
        assert manager.hears("STATUS", "playing")
    figures, code = service.end()
    panel.unplug()
    assert code == 0
    assert figures["emissions"] >= 2


def test_an_fpga_that_is_absent_at_the_start_is_waited_for_lost_and_taken_again(folder, panel, bank, manager, tmp_path):
    board = at_a_serial_port(folder)
    service = Service(folder, bank, environment=manager.environment | {"RUNTIME_DIRECTORY": str(tmp_path)}, before=PATIENT_LINK)

    def written(like):
        """The status file, once it is like this."""
        file = tmp_path / "status.json"
        wait_for("the status", lambda: (status := read_status(file)) is not None and like(status))
        return read_status(file)

    assert "there is no serial port" in service.says("outputs off: waiting for FPGA")
    assert manager.hears("READY", "1")["STATUS"].startswith("waiting for FPGA")
    assert "there is no serial port" in written(lambda status: status.state is PanelState.WAITING_FOR_FPGA).cause
    with service.client() as client:
        assert client.figures()["state"] == "waiting for FPGA"
        assert client.play("click", at_mm=(50, 50)).outcome == "refused"
    for number in (1, 2):  # the second time the port has gone under the running service
        with an_fpga(board, folder / "fpga"):
            service.says("the outputs are on")
            with service.client() as client:
                until_played(client)
            playing = written(lambda status, number=number: status.emissions >= number)
            assert (playing.pid, playing.outputs_on) == (service.process.pid, True)
            assert playing.upload.count + playing.resident.count == playing.emissions
        with service.client() as client:
            until_state(client, "waiting for FPGA")
        lost = written(lambda status: status.state is PanelState.WAITING_FOR_FPGA and not status.outputs_on)
        assert (lost.outages, lost.outage_causes, lost.outputs_on) == (number, {"LINK": number}, False)
    figures, code = service.end()
    assert (code, figures["state"]) == (0, "waiting for FPGA")
    assert figures["emissions"] >= 2
    status, old = read_now(tmp_path / "status.json")
    assert (status.ended, status.outages, old) == (True, 2, "the service has ended")


def test_without_a_permit_it_says_so_and_serves(folder, panel, bank, manager):
    board = at_a_serial_port(folder)
    with an_fpga(board, folder / "fpga") as permit:
        permit(False)
        service = Service(folder, bank, environment=manager.environment, before=PATIENT_LINK)
        assert "run permit is not given" in service.says("outputs off: no permit")
        assert manager.hears("READY", "1")["STATUS"].startswith("no permit")
        permit(True)
        service.says("the outputs are on")
        _, code = service.end()
    assert code == 0


def test_another_gateware_is_refused_at_once(folder, panel, bank, manager):
    board = at_a_serial_port(folder)
    with an_fpga(board, folder / "fpga", build=7):
        service = Service(folder, bank, environment=manager.environment, before=PATIENT_LINK)
        _, err = communicate(service.process)
    assert service.process.returncode == 78
    assert "BUILD_HASH is 0x00000007" in err
    assert err.splitlines()[-1].startswith("haptic-panel: ")
    assert "Traceback" not in err
    assert "READY=1" not in manager.heard()


def test_another_gateware_is_loaded_beside_the_loop_and_it_serves(folder, panel, bank, manager):
    (folder / "panel.bit").write_text(str(gateware_hash()))
    with (folder / "board.toml").open("a") as file:
        load = f"cp $0 {folder}/new && mv {folder}/new {folder}/loaded"
        file.write(f'\n[gateware]\nload = ["sh", "-c", "{load}", "{{bitstream}}"]\nbitstream = "panel.bit"\n')
    board = at_a_serial_port(folder)
    with an_fpga(board, folder / "fpga", build=7):
        service = Service(folder, bank, environment=manager.environment, before=PATIENT_LINK)
        said = service.says("waiting for FPGA: the FPGA's BUILD_HASH is 0x00000007")
        assert re.search("its gateware is being loaded|it has just been loaded", said), (
            said
        )  # the loader may have been the faster one
        service.says("the outputs are on")
        _, code = service.end()
    assert code == 0


def test_a_temperature_sensor_that_hangs_for_ever_holds_up_nobody(folder, panel, bank):
    os.mkfifo(folder / "sensor")  # to open it lasts until somebody writes
    with (folder / "board.toml").open("a") as board:
        board.write(f'\n[temperature]\nkind = "hwmon"\ndevice = "{folder / "sensor"}"\ncoefficient_per_k = -1e-4\nperiod_s = 0.1\n')
    service = Service(folder, bank)
    service.says("the outputs are on")
    with service.client() as client:
        for _ in range(5):
            until_played(client)
    assert "does not answer, or its bus hangs" in service.says("temperature sensor")
    figures, code = service.end()
    assert code == 0
    assert figures["emissions"] >= 5


def test_a_log_that_nobody_reads_does_not_hold_up_the_loop(folder, panel, bank):
    service = Service(folder, bank)
    service.says("the outputs are on")
    log = os.open(f"/proc/self/fd/{service.log_end}", os.O_WRONLY | os.O_NONBLOCK)
    for filler in (b"x" * 4096, b"x"):  # the last of its pages is not always empty
        with contextlib.suppress(BlockingIOError):
            while True:
                os.write(log, filler)
    os.close(log)
    panel.unplug()
    with service.client() as client:
        until_state(client, "waiting for panel")
        until_played(client)
    panel.plug()
    figures, code = service.end()
    assert code == 0
    assert figures["log_lines_lost"] >= 1


def test_a_full_disk_at_the_end_is_one_line_and_the_outputs_are_off(folder, panel, bank):
    with open("/dev/full", "w") as full:  # noqa: PTH123 - a device
        command = [sys.executable, "-c", "import sys; from controller.cli import main; sys.exit(main(sys.argv[1:]))"]
        arguments = ["run", "--board", str(folder), "--bank", str(bank), "--json"]
        process = subprocess.Popen([*command, *arguments], stdout=full, stderr=subprocess.PIPE, text=True)
        for line in process.stderr:
            if "the outputs are on" in line:
                break
        process.send_signal(signal.SIGTERM)
        _, err = communicate(process)
    assert process.returncode == 1
    assert "No space left" in err
    assert "Traceback" not in err
