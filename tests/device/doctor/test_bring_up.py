"""Bring-up reports no complaint of a good FPGA, and the right one for each fault of a board."""

import dataclasses
import json

import numpy as np
import pytest
from patience import SpareTime
from tables import each_row

from controller.cli import main
from controller.clocks import VirtualClock
from controller.commands.common.fpga_link import announced_chirps
from controller.device.board.lookup import data_folder
from controller.device.doctor import bring_up
from controller.device.fpga import frames
from controller.device.fpga.bitstreams.build_hash import build_hash
from controller.device.fpga.build_parameters import BuildParameters
from controller.device.fpga.clock_estimate import ClockEstimate
from controller.device.fpga.exchange import Refused
from controller.device.fpga.frames import FRAME_BYTES, Play
from controller.device.fpga.links import serial_link
from controller.device.fpga.registers import PLAY_LANDING, Register, Start
from controller.device.fpga.session import Session
from controller.errors import LinkError
from controller.workshop.gateware.gateware import Permit
from controller.workshop.gateware.model.model import GatewareModel
from controller.workshop.gateware.serial_peer import PseudoTerminal, UartPanel
from controller.workshop.gateware.simulated_link import SimulatedLink

BUILD = build_hash(data_folder("fpga_rtl"))
BITS = 3e4


class Wired:
    """Gateware with damage on its wires: `pins`, `bits` and `answer` change outputs, MOSI and MISO."""

    def __init__(self, gateware, pins=lambda words: words, bits=lambda mosi: mosi, answer=lambda _: None):
        self._gateware, self._pins, self._bits, self._answer = gateware, pins, bits, answer

    def __getattr__(self, name):
        return getattr(self._gateware, name)

    def exchange(self, select_tick, release_tick, mosi, miso):
        self._gateware.exchange(select_tick, release_tick, self._bits(bytes(mosi)), miso)
        self._answer(miso)

    def take_capture(self):
        capture = self._gateware.take_capture()
        return dataclasses.replace(capture, words=self._pins(capture.words))


def opened(board, **wires):
    clock = VirtualClock()
    model = GatewareModel(BuildParameters.of(board, BUILD))
    link = SimulatedLink(board.link, clock.now_s, Wired(model, **wires))
    return clock, link, Session(link, board, BUILD, clock.now_s)


def checked(board, **wires):
    clock, link, session = opened(board, **wires)
    return bring_up.check(session, board, clock, BITS, bring_up.Chirps(range(32)), take_capture=link.take_capture)


def test_a_good_board_has_no_complaints(board):
    done = checked(board)
    assert done.complaints == []
    assert done.bit_errors.wrong_bits == done.bit_errors.frames_refused == done.bit_errors.answers_damaged == 0
    assert done.bit_errors.bits >= 0.9 * BITS
    assert done.channels_moved == [[channel] for channel in range(32)]
    assert done.registers["clock_hz"] == board.link.clock_hz
    assert "control" not in done.registers


def swapped(words):
    one = np.uint32(1)
    return words & ~np.uint32(3) | (words & one) << one | words >> one & one


@each_row(
    ("pins", "wrong"),
    [
        (lambda words: words & ~np.uint32(1 << 7), [7]),  # dead
        (swapped, [0, 1]),
        (lambda words: words | (words & np.uint32(1 << 1)) << np.uint32(8), [1]),  # shorted to channel 9; both idle low
    ],
)
def test_dead_swapped_and_shorted_channels_are_named(board, pins, wrong):
    assert f"channels {wrong} moved other pins than their own" in checked(board, pins=pins).complaints[0]


def test_bit_errors_in_answers_are_counted(board):
    def turn_a_bit(miso):
        if len(miso) > 100:
            miso[100] ^= 4

    done = checked(board, answer=turn_a_bit)
    frames = done.bit_errors.frames
    assert done.bit_errors.wrong_bits == frames
    assert done.bit_errors.frames_refused == 0
    assert "damages bits" in done.complaints[0]


def test_bit_errors_in_commands_are_counted_and_the_frames_refused(board):
    def turn_a_bit(mosi):
        return mosi[:200] + bytes([mosi[200] ^ 128]) + mosi[201:] if len(mosi) > 200 and mosi[2] == 6 else mosi

    done = checked(board, bits=turn_a_bit)
    assert done.bit_errors.frames_refused == done.bit_errors.frames == done.bit_errors.wrong_bits


def test_a_slot_that_loses_its_words_is_reported(board):
    _, _, session = opened(board)
    rng = np.random.default_rng(3)
    assert bring_up.memory_errors(session, board, rng) == 0
    words = rng.bytes(4000)
    session.upload(2, memoryview(words))
    assert bring_up.read_slot(session, 2, 1000) == words
    assert session.exchange.read_slot_crc(2) == bring_up.zlib.crc32(words)
    with pytest.raises(Refused, match="beyond the waveform"):
        session.exchange.read_address(bring_up.READ_MEMORY + 1024 * 2 + 1000)


def test_a_listener_is_told_which_channel_chirps_and_where_before_it_does(board, capsys):
    clock, link, session = opened(board)
    chirps = announced_chirps(board, [7, 30], 0.1)
    moved = []

    def announce(channel):
        moved.append(bring_up.channels_moved(link.take_capture()))
        chirps.announce(channel)

    done = bring_up.check(session, board, clock, BITS, chirps._replace(announce=announce), take_capture=link.take_capture)
    assert (done.channels, moved[0]) == ([7, 30], [])
    assert 30 not in moved[1]
    lines = capsys.readouterr().err.splitlines()
    assert "each channel purrs for 0.4 s at its patch" in lines[0]
    assert lines[1].endswith("channel 7 chirps: patch at x = 95.5, y = 17.5 mm, disc of channels 4, 5, 6 and 7")
    assert lines[2].endswith("channel 30 chirps: patch at x = 12.5, y = 81.5 mm, disc of channels 28, 29, 30 and 31")


def test_an_fpga_without_its_permit_does_not_chirp(board):
    clock, link, session = opened(board)
    link.gateware.permit(link.gateware.now + 100, level=False, which=Permit.TEMPERATURE)
    with pytest.raises(LinkError, match="run permit is not given"):
        list(bring_up.channel_self_test(session, board, clock, bring_up.Chirps(range(32))))


def armed(session, board, clock):
    words = memoryview(np.arange(1000, dtype="<u4").tobytes())
    session.upload(0, words)
    rest(session, clock, session.arm())
    session.require_armed()
    return words


def rest(session, clock, until_s):
    selector = bring_up.selectors.DefaultSelector()
    while clock.now_s() < until_s:
        session.heartbeat()
        clock.wait(selector, min(until_s, clock.now_s() + 0.01))
    selector.close()


def test_the_gateware_plays_a_waveform_while_it_arrives(board):
    """An ability that the loop does not use: the first word is on the pins one chunk and one frame after the upload began."""
    clock, link, session = opened(board)
    exchange, words = session.exchange, armed(session, board, clock)
    sequence = exchange.sequence
    end = frames.pack_load(exchange.sent, 0, sequence, 0, words[:500])
    end = frames.pack_play(exchange.sent, end, sequence + 1, Play(PLAY_LANDING, length=1000, start=Start.NOW))
    for chunk in range(1, 8):
        end = frames.pack_load(exchange.sent, end, sequence + 1 + chunk, chunk, words[500 * chunk : 500 * (chunk + 1)])
    frames.pack_nop(exchange.sent, end, sequence + 9)
    began_s = link.wire_free_s()
    exchange.send([frames.LOAD_FRAME_BYTES, FRAME_BYTES, *[frames.LOAD_FRAME_BYTES] * 7, FRAME_BYTES])
    rest(session, clock, clock.now_s() + 0.01)
    assert exchange.read(Register.EMISSIONS) == 1
    first_s = link.time_s(exchange.read(Register.EMISSION_TIME_LOW)) - began_s
    assert first_s < 0.2e-3  # after a whole upload it would be 1.3 ms


def test_a_play_is_scheduled_at_a_time_of_the_host(board):
    clock, link, session = opened(board)
    armed(session, board, clock)
    estimate = ClockEstimate(board.link.clock_hz)
    for _ in range(10):
        before_s = clock.now_s()
        status = session.heartbeat()
        estimate.add(before_s, link.wire_free_s(), status.timestamp_ticks)
        rest(session, clock, clock.now_s() + 0.05)
    at_s = clock.now_s() + 0.02
    session.play(
        Play(
            0,
            emissions=3,
            start=Start.TIME,
            period_ticks=session.timing.period_ticks(5e-3),
            when_ticks=estimate.ticks(estimate.fpga_s(at_s)),
        ),
        stop=False,
    )
    rest(session, clock, clock.now_s() + 0.05)
    capture = link.take_capture()
    starts = capture.focus_ticks.astype(np.int64) - 1000 * board.bit_ticks
    assert np.diff(starts).tolist() == [400_000, 400_000]
    assert abs(link.time_s(int(starts[0])) - at_s) <= estimate.error_s + 1 / board.link.clock_hz


def test_check_is_a_command_for_simulated_and_serial_gateware(board, capsys, monkeypatch):
    assert main(["gateware", "check", "--bits", "1e4", "--json"]) == 0
    figures = json.loads(capsys.readouterr().out)
    assert figures["complaints"] == []
    assert figures["channels_moved"][31] == [31]
    model = GatewareModel(BuildParameters.of(board, BUILD))
    clock = VirtualClock()
    monkeypatch.setattr("controller.commands.gateware.MonotonicClock", lambda: clock)
    monkeypatch.setattr(serial_link, "time", SpareTime)
    panel = UartPanel(model, board.link.clock_hz, 1_000_000, clock.now_s)
    with PseudoTerminal(panel.receive) as terminal:
        assert main(["gateware", "check", "--device", terminal.device, "--channel", "3", "--bits", "1e4", "--json"]) == 0
    figures = json.loads(capsys.readouterr().out)
    assert figures["channels"] == [3]
    assert figures["channels_moved"] is None
    assert figures["bit_errors"]["bits"] == 0


def test_a_device_that_is_not_there_is_one_line(capsys):
    assert main(["gateware", "check", "--device", "/dev/ttyNONE"]) == 69
    assert "there is no serial port /dev/ttyNONE" in capsys.readouterr().err


def test_a_channel_there_is_not_is_one_line(capsys):
    assert main(["gateware", "check", "--channel", "32"]) == 78
    assert "--channel: board 'simulated' has no channel 32" in capsys.readouterr().err
