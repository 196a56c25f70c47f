"""A panel read by a process of its own: the loop gets what the driver gives, and goes on where its bus hangs."""

import os
import socket
from collections import Counter
from pathlib import Path

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from controller.clocks import VirtualClock
from controller.device.bank.reader import Bank
from controller.device.board.devices import Temperature
from controller.device.board.worker import Worker, WorkerEnded
from controller.device.loop.context import LoopContext, Watch
from controller.device.loop.wiring import assemble
from controller.device.scene.scene import load_scene
from controller.device.service.drivers import open_session, tracked
from controller.device.touch.drivers import panel_process as messages
from controller.device.touch.drivers.awaited_reader import LOST, NO_DEVICE
from controller.device.touch.drivers.contact_events import describe
from controller.device.touch.drivers.panel_process import HANG_S, PanelProcess, serve_panel
from controller.device.touch.live_source import LiveSource
from controller.device.touch.panels.gt911 import Gt911Touch
from controller.errors import TouchError
from controller.workshop.gateware.simulated_link import open_simulated

PROGRAM = Path(__file__).parent / "peers" / "gt911_process.py"
CLICK = '[[regions]]\nname = "all"\nshape = "plate"\neffects = ["click"]\n'

events = st.lists(st.tuples(st.integers(0, 65535), st.integers(0, 65535), st.integers(-(2**31), 2**31 - 1), st.floats(0, 1e9)))


@given(events)
def test_events_arrive_as_they_were_given(given_events):
    message = messages.events_message(given_events)
    assert message[0] == messages.EVENTS
    assert messages.events_of(memoryview(message)[1:]) == given_events


class Scripted:
    """A reader that goes through what it was given; one entry a read."""

    def __init__(self, *script):
        self.warnings = Counter()
        self.present = True
        self.description = describe("panel", 1, 2100, 1480, sized=True)
        self.script = list(script)
        self.closed = False

    def fileno(self):
        return None

    def next_time_s(self):
        return 0.0 if self.script else None

    def read(self, _now_s):
        return self.script.pop(0)(self) if self.script else ()

    def close(self):
        self.closed = True


class Ends:
    """Both ends in this process."""

    def __init__(self):
        self.ours, self.theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        self.ours.setblocking(False)

    def fileno(self):
        return self.ours.fileno()

    def receive(self):
        try:
            data = self.ours.recv(1 << 14)
        except BlockingIOError:
            return None
        if not data:
            raise WorkerEnded
        return memoryview(data)

    def close(self):
        self.ours.close()
        self.theirs.close()


@pytest.fixture
def ends():
    ends = Ends()
    yield ends
    ends.close()


def test_what_the_driver_says_of_itself_is_what_the_loop_sees(ends):
    def lost(reader):
        reader.present = False
        reader.warnings["panel_lost"] += 1
        return [(3, 57, -1, 2.0)]

    def back(reader):
        reader.present = True
        reader.description = describe("another", 2, 800, 480, sized=True)
        return ()

    def last(_reader):
        ends.ours.shutdown(socket.SHUT_WR)  # the loop goes
        return [(0, 0, 0, 3.0)]

    panel = PanelProcess(ends)
    assert (panel.present, panel.cause, panel.description, panel.next_time_s()) == (False, "", NO_DEVICE, None)
    reader = Scripted(lambda _: [(3, 53, 100, 1.0), (0, 0, 0, 1.0)], lost, back, last)
    serve_panel(lambda: reader, ends.theirs)
    assert reader.closed
    ends.theirs.shutdown(socket.SHUT_WR)
    seen = []

    def read_all():
        while True:
            given_events = list(panel.read(0.0))
            seen.append((given_events, panel.present, panel.cause, panel.description.name, panel.warnings["panel_lost"]))

    with pytest.raises(WorkerEnded):
        read_all()
    assert [entry for entry in seen if entry[0]] == [
        ([(3, 53, 100, 1.0), (0, 0, 0, 1.0)], False, "", "panel", 0),  # that it is there comes behind
        ([(3, 57, -1, 2.0)], True, "", "panel", 0),
        ([(0, 0, 0, 3.0)], True, "", "another", 1),
    ]
    assert ([], False, LOST, "panel", 0) in seen


def test_a_panel_that_cannot_be_opened_is_reported_and_tried_again(ends):
    panel = PanelProcess(ends)
    tries = []

    def opens():
        tries.append(1)
        if len(tries) == 1:
            raise TouchError("there is no I2C bus")
        ends.ours.shutdown(socket.SHUT_WR)
        return Scripted()

    serve_panel(opens, ends.theirs)
    panel.read(0.0)
    assert (panel.present, panel.cause) == (False, "there is no I2C bus")
    panel.read(0.0)
    panel.read(0.0)
    assert (panel.present, panel.cause) == (True, "")


def test_a_bus_that_hangs_from_the_start_on_is_reported(ends):
    panel = PanelProcess(ends)
    for now_s in (1000.0, 1000.0 + HANG_S - 0.1):
        panel.read(now_s)
        assert panel.cause == ""
    panel.read(1000.0 + HANG_S)
    assert "its bus hangs" in panel.cause
    ends.theirs.send(messages.presence_message(None))
    panel.read(2000.0)
    assert (panel.present, panel.cause) == (True, "")


class Paced(VirtualClock):
    """Time goes on where nothing comes within a while, so that another process may say something."""

    def wait(self, selector, until_s):
        if not selector.select(1e-3):
            super().wait(selector, until_s)


def test_a_bus_that_hangs_costs_touches_and_no_heartbeat(board, bank_file, tmp_path):
    fifo = tmp_path / "control"
    os.mkfifo(fifo)
    (tmp_path / "control.bus").touch()
    (tmp_path / "s.toml").write_text(CLICK)
    worker = Worker([str(PROGRAM), str(fifo)])
    axes_mm = {"x_mm_from_axes": (210.0, 0.0, 0.0), "y_mm_from_axes": (0.0, 148.0, 0.0)}
    touch = Gt911Touch(bus="-", interrupt_chip="-", interrupt_line="-", ghost_ms=0.0, **axes_mm)
    board = msgspec.structs.replace(board, touch=touch)
    clock = Paced()
    link = open_simulated(board, clock.now_s)
    session = open_session(link, board, clock.now_s)
    panel = PanelProcess(worker)
    source = tracked(LiveSource(panel, board), board)
    heartbeats = []

    def steps():
        """What is said to the far end, each when what came before has been felt."""
        while not panel.present:
            yield
        control.write(b"touch 1000 700\n")
        while made.counters.emissions < 1:
            yield
        control.write(b"hang\ntouch 1200 700\n")
        first = made.counters.heartbeats
        while made.counters.heartbeats < first + 60:  # of 33 ms: two seconds
            assert made.loop.outputs.on
            yield
        assert made.counters.emissions == 1
        heartbeats.append(made.counters.heartbeats - first)
        control.write(b"go\nlift\n")
        while made.counters.emissions < 1 or source.predict(0, clock.now_s()) is not None:
            yield
        control.write(b"touch 500 300\n")
        while made.counters.emissions < 2:
            yield
        made.loop.stop()
        while True:
            yield

    script = steps()
    with open(fifo, "wb", buffering=0) as control, Bank.open(bank_file, board) as bank:  # noqa: PTH123
        scene = load_scene(tmp_path / "s.toml", board)
        made = assemble(LoopContext(board, clock, session, source), scene, bank, watch=Watch(lambda _: next(script)))
        made.loop.run()
    panel.close()
    link.close()
    assert heartbeats == [60]
    assert (made.counters.host_silent, made.counters.outages) == (0, 0)


def test_a_process_that_ends_by_itself_ends_the_service():
    worker = Worker(["-c", ""])
    panel = PanelProcess(worker)

    def read_on():
        while True:
            panel.read(0.0)

    with pytest.raises(WorkerEnded) as ended:
        read_on()
    assert ended.value.exit_code == 1
    panel.close()


def test_code_from_the_working_directory_is_not_run(tmp_path, monkeypatch):
    (tmp_path / "smbus2.py").write_text("raise SystemExit('not ours')")
    (tmp_path / "controller.py").write_text("raise SystemExit('not ours')")
    monkeypatch.chdir(tmp_path)
    settings = msgspec.json.encode(Temperature(kind="hwmon", device="/nowhere", coefficient_per_k=0.0)).decode()
    worker = Worker(["-m", "controller.device.service.beside_loop", "thermometer", "0", settings])
    worker.send(b"?")
    answer = None
    while answer is None:
        answer = worker.receive()
    assert b"No such file" in bytes(answer)
    worker.close()
