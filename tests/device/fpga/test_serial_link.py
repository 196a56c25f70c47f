"""The serial link, with the gateware model behind a pseudo-terminal and lines that lose, damage and add bytes."""

import contextlib
import itertools
import re
import threading
import time
from types import SimpleNamespace

import numpy as np
import pytest
import serial
from cobs import cobs
from hypothesis import given, settings
from hypothesis import strategies as st
from tables import each_row

from controller.clocks import VirtualClock
from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.device.fpga import frames
from controller.device.fpga.build_parameters import BuildParameters
from controller.device.fpga.frames import FRAME_BYTES, Play
from controller.device.fpga.links import serial_link
from controller.device.fpga.links.serial_link import ANSWER_BYTES, GUARD, SerialLink, on_wire
from controller.device.fpga.registers import FrameType, Register, Result, State
from controller.device.fpga.session import Session
from controller.device.fpga.status import parse_status
from controller.errors import LinkError
from controller.workshop.gateware.model.model import GatewareModel
from controller.workshop.gateware.serial_peer import PseudoTerminal, UartPanel, decoded

BUILD = 0x1234ABCD
BOARD = load_board(find_board("simulated"))
BAUD = 1_000_000
PATIENT_S = 30.0  # for answers that do come: a busy machine is no error
BRIEF_S = 0.02  # for those that never do
LATENCIES_S = (BRIEF_S, 10 * BRIEF_S, 100 * BRIEF_S, PATIENT_S)  # the first will do unless the machine is very busy
WORDS = memoryview(np.random.default_rng(7).integers(0, 1 << 32, 1000, dtype=np.uint32).view(np.uint8)).cast("B")


class Line:
    """The line between a panel and its terminal; `to_panel` and `to_host` change the bytes that pass."""

    def __init__(self, panel):
        self.panel = panel
        self.to_panel = self.to_host = lambda data: data
        self.heard = bytearray()  # by the panel
        self.taken_bytes = 0

    def answer(self, data):
        size = len(data)
        data = self.to_panel(data)
        self.heard += data
        answer = self.to_host(self.panel.receive(data))
        self.taken_bytes += size
        return answer

    def frames(self):
        """Frames that the panel has received so far."""
        return [cobs.decode(bytes(line)) for line in bytes(self.heard).split(b"\0") if line]


def at(number, change):
    """Damages the `number`th byte from now on: `change` maps it to the bytes that replace it."""
    counter = itertools.count()

    def damage(data):
        return b"".join(change(byte) if next(counter) == number else bytes([byte]) for byte in data)

    return damage


def lost(_byte):
    return b""


def flipped(byte):
    return bytes([byte ^ 0x10])


class TimeToAnswer:
    """A clock for the link that stands still until its peer, a thread of this process, has run."""

    perf_counter_ns = staticmethod(time.perf_counter_ns)

    def __init__(self, line):
        self._line = line
        self._now_s, self._last_s = 0.0, time.monotonic()
        self._waited = True  # for the link, not for the peer
        self.links = []

    def monotonic(self):
        last_s, self._last_s = self._last_s, time.monotonic()
        waited, self._waited = self._waited, self._line.taken_bytes >= sum(link.written_bytes for link in self.links)
        if waited and self._waited:
            self._now_s += self._last_s - last_s
        return self._now_s


class CountingLink(SerialLink):
    """A port that counts what it wrote to the terminal."""

    def _opened(self):
        port = super()._opened()
        self.written_bytes = 0
        write = port.write

        def counted(data):
            self.written_bytes += len(data)
            return write(data)

        port.write = counted
        return port


def model(board):
    return GatewareModel(BuildParameters.of(board, BUILD))


@pytest.fixture
def clock():
    return VirtualClock()


@pytest.fixture
def line(board, clock):
    return Line(UartPanel(model(board), board.link.clock_hz, BAUD, clock.now_s))


@pytest.fixture
def open_link(clock, line, monkeypatch):
    """Opens the link of a test, at the terminal at which the line ends."""
    link_time = TimeToAnswer(line)
    monkeypatch.setattr(serial_link, "time", link_time)
    with PseudoTerminal(line.answer) as terminal:
        opened = link_time.links

        def to_terminal(latency_s=PATIENT_S):
            opened.append(CountingLink(terminal.device, BAUD, clock.now_s, latency_s))
            opened[-1]._unsure = False  # a terminal just made holds nothing: no need to wait until it is quiet
            line.panel.receive(b"\0")
            return opened[-1]

        yield to_terminal
        for link in opened:
            link.close()


def wait_at_most(link, latency_s):
    link._latency_s = link._port.timeout = latency_s


def nops(link, count, sequence=10):
    """Send NOPs in one message; returns the statuses received."""
    sent = bytearray(count * FRAME_BYTES)
    for number in range(count):
        frames.pack_nop(sent, number * FRAME_BYTES, sequence + number)
    received = memoryview(bytearray(b"\xee" * len(sent)))
    link.exchange(memoryview(sent), [FRAME_BYTES] * count, received)
    return [parse_status(received, number * FRAME_BYTES) for number in range(count)]


def recovered(link):
    """After an error the next message succeeds, once pending answers have been discarded."""
    for latency_s in LATENCIES_S:
        wait_at_most(link, latency_s)
        with contextlib.suppress(LinkError):
            if [status.sequence for status in nops(link, 3, 77)[1:]] == [77, 78]:
                return
    pytest.fail("the link did not recover")


def test_a_session_goes_over_a_terminal_as_over_spi(board, clock, line, open_link):
    link = open_link()
    session = Session(link, board, BUILD, clock.now_s)
    clock._now_s = session.arm()
    session.require_armed()
    session.upload_and_play(Play(2), WORDS, stop=False)
    assert State.PENDING in session.heartbeat().state
    clock._now_s = session.disarm()
    assert session.heartbeat().state & (State.ARMED | State.HV_ENABLE) == 0
    words = line.panel.gateware.take_capture().words
    assert board.idle_word in words
    assert words[-1] == 0


def test_the_trigger_is_a_frame_whose_answer_comes_with_the_next_message(clock, line, open_link):
    link = open_link()
    nops(link, 2)
    clock._now_s = 5.0
    when = link.trigger()
    link.trigger()
    assert when == pytest.approx(5.0 + (FRAME_BYTES + 4) * 10 / BAUD)
    assert link.wire_free_s() > when
    first, second = nops(link, 2)
    assert first.sequence != 11, "about the trigger, no answer of which is left over"
    assert second.sequence == 10
    wanted = bytearray(FRAME_BYTES)
    heard = line.frames()
    assert len(heard) == 2 + 2 + 2
    for frame in heard[2:4]:
        frames.pack_short(wanted, 0, FrameType.WRITE, frame[3], Register.CONTROL, 6)
        assert frame == wanted
        assert frame[3] not in range(10, 20), "no number that a message near it may use"


def test_the_trigger_plays(board, clock, line, open_link):
    link = open_link()
    session = Session(link, board, BUILD, clock.now_s)
    clock._now_s = session.arm()
    session.upload_and_play(Play(2), WORDS, stop=False)
    link.trigger()
    session.heartbeat()
    clock._now_s = link.wire_free_s() + 3e-3
    assert session.heartbeat().emissions == 1


def test_a_load_is_answered_at_its_place_with_zeros_behind(open_link):
    link = open_link()
    sent = bytearray(2 * frames.LOAD_FRAME_BYTES + FRAME_BYTES)
    end = frames.pack_load(sent, 0, 5, 0, WORDS[:500])
    end = frames.pack_load(sent, end, 6, 1, WORDS[500:1000])
    frames.pack_nop(sent, end, 7)
    lengths = [frames.LOAD_FRAME_BYTES] * 2 + [FRAME_BYTES]
    received = memoryview(bytearray(b"\xee" * len(sent)))
    link.exchange(memoryview(sent), lengths, received)
    for start, sequence in ((frames.LOAD_FRAME_BYTES, 5), (2 * frames.LOAD_FRAME_BYTES, 6)):
        status = parse_status(received, start)
        assert (status.result, status.sequence) == (Result.OK, sequence)
    assert not any(received[FRAME_BYTES : frames.LOAD_FRAME_BYTES])
    assert link.bytes_sent == len(sent)
    wire_bytes = len(sent) + 3 * len(GUARD) + 3 + sum(len(cobs.encode(sent[:504])) - 504 for _ in range(2)) + 1
    assert link.wire_ns == pytest.approx(wire_bytes * 1e10 / BAUD, rel=3e-3)
    assert link.blocked_ns > 0


def test_a_message_longer_than_a_batch_is_answered_frame_by_frame(open_link):
    statuses = nops(open_link(), 3 * serial_link.BATCH_FRAMES + 5)
    assert [status.sequence for status in statuses[1:]] == list(range(10, 10 + len(statuses) - 1))


@each_row("damage", [lost, flipped], ids=["lost", "flipped"])
@each_row("number", [0, 1, 3, 20, ANSWER_BYTES - 1, ANSWER_BYTES, 2 * ANSWER_BYTES + 9], afresh=[clock, line, open_link])
def test_a_damaged_answer_is_an_error_that_names_the_device(line, open_link, damage, number):
    link = open_link(BRIEF_S)
    for latency_s in LATENCIES_S:
        wait_at_most(link, latency_s)
        line.to_host = at(number, damage)
        with pytest.raises(LinkError) as error:
            nops(link, 3)
        recovered(link)
        if "does not answer" not in str(error.value):
            break
    assert re.search(r"/dev/.*(damaged|came back whole).*check the cable", str(error.value))


def on_wire_byte(number):
    """Byte of the second of three NOPs as `nops` sends them."""
    return FRAME_BYTES + 4 + number


@each_row("number", [2, 3, 5, 6, 20, 33], afresh=[clock, line, open_link])
def test_a_bit_flipped_on_the_way_there_is_refused_and_reported(line, open_link, number):
    link = open_link(BRIEF_S)
    line.to_panel = at(on_wire_byte(number), flipped)
    try:
        third = nops(link, 3)[2]
    except LinkError:  # the bit made, or was, a zero: there are more frames than answers wanted, or fewer
        pass
    else:
        assert third.result in (Result.BAD_SYNC, Result.BAD_LENGTH, Result.BAD_CRC)
        assert third.sequence == 10, "of the last frame that was accepted"
        assert link._unsure, "it makes sure before the next message"
    recovered(link)


def test_a_lost_delimiter_costs_an_answer_only_without_the_guard(line, open_link):
    link = open_link()
    line.to_panel = at(FRAME_BYTES + 3, lost)
    assert [status.sequence for status in nops(link, 3)[1:]] == [10, 11], "the next frame's zeros end this one"


def test_a_frame_swallowed_whole_is_one_answer_too_few(line, open_link):
    link = open_link(BRIEF_S)
    swallowed = iter([True])
    line.to_panel = lambda data: data[FRAME_BYTES + 4 :] if next(swallowed, False) else data
    with pytest.raises(LinkError, match="2 of 3 answers came back whole"):
        nops(link, 3)
    recovered(link)


def test_garbage_before_the_first_message_is_discarded(clock, line):
    noise = bytes(range(1, 200)) + b"\0" + b"\xff" * 50
    pending = [noise]
    line.to_host = lambda data: (pending.pop() if pending else b"") + data
    with PseudoTerminal(line.answer) as terminal:
        link = SerialLink(terminal.device, BAUD, clock.now_s, 0.2)
        link._port.write(noise)  # what a modem probe or a terminal program leaves in the panel
        assert [status.sequence for status in nops(link, 3)[1:]] == [10, 11]
        link.close()


def test_unrequested_answers_are_discarded_before_the_next_message(line, open_link):
    link = open_link()
    nops(link, 1)
    seen = threading.Event()
    line.to_panel = lambda data: (seen.set(), data)[1]
    link._port.write(on_wire(bytes(FRAME_BYTES)))
    assert seen.wait(PATIENT_S)
    while not link._port.in_waiting:  # the terminal hands it on when it likes
        pass
    link._port.timeout = BRIEF_S
    assert [status.sequence for status in nops(link, 3, 40)[1:]] == [40, 41]


def test_a_device_that_sends_without_end_is_an_error(line, open_link):
    link = open_link(BRIEF_S)
    link._unsure = True
    link._port = SimpleNamespace(write=len, read=lambda _: b"U" * 4096, in_waiting=0, is_open=True, close=lambda: None)
    with pytest.raises(LinkError, match="sends without being asked: is it the panel's port"):
        nops(link, 1)


def test_silence_is_an_error_that_says_what_to_look_at(line, open_link):
    link = open_link(BRIEF_S)
    line.to_host = lambda _data: b""
    with pytest.raises(LinkError, match="does not answer: is it the panel's port, and is gateware loaded"):
        nops(link, 2)
    line.to_host = lambda data: data
    recovered(link)


def test_a_session_survives_a_lost_byte(board, clock, line, open_link):
    link = open_link()
    session = Session(link, board, BUILD, clock.now_s)
    for direction in ("to_panel", "to_host"):
        wait_at_most(link, 0.3)
        setattr(line, direction, at(30, lost))
        assert session.heartbeat().result is Result.OK
        setattr(line, direction, lambda data: data)


def test_a_board_unplugged_in_the_middle_is_an_error_each_time_until_it_is_back(clock, line, tmp_path):
    port = tmp_path / "ttyPANEL"
    with PseudoTerminal(line.answer) as terminal:
        port.symlink_to(terminal.device)
        link = SerialLink(str(port), BAUD, clock.now_s, BRIEF_S)
        nops(link, 1)
    port.unlink()
    for attempt, said in (
        (lambda: nops(link, 1), "still plugged in"),
        (link.trigger, "still plugged in"),
        (lambda: nops(link, 1), "there is no serial port"),
    ):
        with pytest.raises(LinkError, match=said):
            attempt()
    with PseudoTerminal(line.answer) as terminal:
        port.symlink_to(terminal.device)
        nops(link, 1)
        link.close()
        link.close()


@each_row(
    ("number", "said"),
    [(2, "is the board plugged in"), (13, "dialout"), (16, "in use by another program"), (None, "could not be opened at")],
    afresh=[clock],
)
def test_a_port_that_cannot_be_opened_says_what_to_do(clock, monkeypatch, number, said):
    def refuse(*_args, **_kwargs):
        raise ValueError("bad rate") if number is None else serial.SerialException(number, "no")

    monkeypatch.setattr(serial, "Serial", refuse)
    with pytest.raises(LinkError, match=said):
        SerialLink("/dev/ttyPANEL", BAUD, clock.now_s)


def test_a_device_that_is_not_there_or_no_terminal_is_refused(clock, tmp_path):
    with pytest.raises(LinkError, match="there is no serial port /dev/ttyNONE"):
        SerialLink("/dev/ttyNONE", BAUD, clock.now_s)
    file = tmp_path / "file"
    file.touch()
    with pytest.raises(LinkError, match="could not be opened"):
        SerialLink(str(file), BAUD, clock.now_s)


def test_a_second_link_to_the_same_panel_is_refused(clock, open_link):
    device = open_link()._device
    with pytest.raises(LinkError, match="in use by another program"):
        SerialLink(device, BAUD, clock.now_s)


@given(st.binary(max_size=600))
@settings(deadline=None)
def test_any_payload_survives_encoding_and_decoding(payload):
    wire = on_wire(payload)
    assert wire.startswith(GUARD)
    assert wire.endswith(b"\0")
    assert 0 not in wire[len(GUARD) : -1]
    assert len(wire) <= len(payload) + len(GUARD) + 2 + len(payload) // 254
    assert decoded(wire[len(GUARD) : -1]) == (payload or b"\0")


EDITS = st.lists(
    st.tuples(st.sampled_from(["flip", "lose", "add", "set"]), st.integers(0, 599), st.integers(1, 255)), min_size=1, max_size=4
)


def edited(wire, edits):
    wire = bytearray(wire)
    for kind, place, value in edits:
        at_byte = place % len(wire)
        if kind == "flip":
            wire[at_byte] ^= value
        elif kind == "lose":
            del wire[at_byte : at_byte + value % 8 + 1]
        elif kind == "add":
            wire[at_byte:at_byte] = bytes([value])
        else:
            wire[at_byte] = value - 1
        if not wire:
            break
    return bytes(wire)


@given(st.integers(0, 0xFFFFFFFF), EDITS)
@settings(deadline=None, max_examples=300)
def test_a_damaged_frame_is_never_accepted_and_the_next_one_is_whole(value, edits):
    """A register is written over a damaged line, then read over a good one: it holds what it did or what was sent."""
    panel = UartPanel(model(BOARD), 80_000_000, BAUD, lambda: 0.0)
    frame = bytearray(FRAME_BYTES)

    def send(damage, pack, *arguments):
        pack(frame, 0, *arguments)
        return panel.receive(damage(on_wire(frame)))

    panel.receive(b"\0")
    send(bytes, frames.pack_write, 1, Register.IDLE_WORD, 0x5555AAAA)
    send(lambda wire: edited(wire, edits), frames.pack_write, 2, Register.IDLE_WORD, value)
    panel.receive(bytes(ANSWER_BYTES))  # an answer to a piece of the damaged frame goes out
    send(bytes, frames.pack_read, 3, Register.IDLE_WORD)
    line = send(bytes, frames.pack_nop, 4)
    status = parse_status(cobs.decode(line[:-1]))
    assert (status.result, status.sequence) == (Result.OK, 3)
    assert status.data in (0x5555AAAA, value)
    send(bytes, frames.pack_read, 5, Register.CHANNEL_MASK)
    assert parse_status(cobs.decode(send(bytes, frames.pack_nop, 6)[:-1])).data == 0xFFFFFFFF


@each_row("cut", [1, 2, 3, 4, 5, 10, 27, FRAME_BYTES - 1, FRAME_BYTES])
def test_a_frame_cut_off_is_refused_for_its_length_even_where_filling_would_make_it_whole(cut):
    """Its CRC ends with the very byte that the simulated panel puts behind a frame cut off, and only its code comes at last."""
    frame = bytearray(FRAME_BYTES)
    for value in range(1 << 16):
        frames.pack_write(frame, 0, 9, Register.IDLE_WORD, value)
        if frame[-1] == 0xFF:
            break
    panel = UartPanel(model(BOARD), 80_000_000, BAUD, lambda: 0.0)
    panel.receive(on_wire(frame)[: -1 - cut] + b"\0")
    frames.pack_nop(frame, 0, 1)
    status = parse_status(cobs.decode(panel.receive(bytes(ANSWER_BYTES) + on_wire(frame))[-ANSWER_BYTES:-1]))
    wanted = Result.BAD_LENGTH if cut < FRAME_BYTES else Result.BAD_SYNC
    assert (status.result, status.sequence) == (wanted, 0)


def test_the_panel_gives_no_answer_while_one_is_on_its_way():
    """As `uart_peripheral.v`: without the guard, and from a host that sends less than a whole frame."""
    panel = UartPanel(model(BOARD), 80_000_000, BAUD, lambda: 0.0)
    frame = bytearray(FRAME_BYTES)
    frames.pack_nop(frame, 0, 1)
    panel.receive(b"\0")
    short = cobs.encode(bytes(frame[:20])) + b"\0"
    assert panel.receive(short * 4).count(b"\0") == 2
    panel.receive(bytes(ANSWER_BYTES))
    assert panel.receive(on_wire(frame) * 4).count(b"\0") == 4


@each_row("late_s", [0.0, 0.1])
def test_an_answer_that_is_there_reports_no_time_to_come_although_the_terminal_delivers_late(late_s):
    """Else the host, whose wire has long been free, takes the next heartbeat's smaller advance for a reset."""
    now_s = 0.0
    panel = UartPanel(model(BOARD), BOARD.link.clock_hz, BAUD, lambda: now_s)
    frame = bytearray(FRAME_BYTES)
    frames.pack_nop(frame, 0, 1)
    panel.receive(b"\0")
    message = 40 * on_wire(frame)
    line_s = len(message) * serial_link.BITS_PER_BYTE / BAUD
    now_s = line_s + late_s
    statuses = [parse_status(cobs.decode(answer)) for answer in panel.receive(message).split(b"\0")[:-1]]
    ticks = [status.timestamp_ticks for status in statuses]
    assert len(ticks) == 40
    assert ticks[-1] <= now_s * BOARD.link.clock_hz
    frame_ticks = len(on_wire(frame)) * serial_link.BITS_PER_BYTE * BOARD.link.clock_hz / BAUD
    assert np.allclose(np.diff(ticks), frame_ticks, atol=1)


def test_the_panel_takes_nothing_before_the_first_zero():
    panel = UartPanel(model(BOARD), 80_000_000, BAUD, lambda: 0.0)
    frame = bytearray(FRAME_BYTES)
    frames.pack_nop(frame, 0, 1)
    assert panel.receive(on_wire(frame)[len(GUARD) :]) == b""
    assert len(panel.receive(on_wire(frame))) == ANSWER_BYTES
