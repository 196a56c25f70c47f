"""Each FPGA board as it is: its top with the bitstream's parameters, at its pins SpiLink with board.toml unchanged."""

import re
import sys
import zlib
from pathlib import Path

import msgspec
import numpy as np
import pytest
from compiled_top import BOARDS, CHANNELS, PS, SIGNALS, UART, CompiledTop, channel_pins, channels_of, files, names_in, signal_pins
from tables import each_row

from controller.device.board.lookup import data_folder
from controller.device.fpga.bitstreams.build_hash import build_hash
from controller.device.fpga.build_parameters import BuildParameters
from controller.device.fpga.capture import Capture
from controller.device.fpga.exchange import FpgaReset, Refused
from controller.device.fpga.frames import (
    FRAME_BYTES,
    LOAD_FRAME_BYTES,
    Play,
    pack_control,
    pack_load,
    pack_nop,
    pack_play,
    pack_store,
    pack_unlock,
)
from controller.device.fpga.links.spi_link import SpiLink
from controller.device.fpga.registers import IDENTITY_MAGIC, TRIGGER_LATENCY_TICKS, Control, Fault, Register, Result, Start, State
from controller.device.fpga.session import Session
from controller.device.fpga.status import parse_status
from controller.errors import LinkError

sys.path.insert(0, str(Path(__file__).parent.parent / "conformance"))

from hard_limits import broken_limits

pytestmark = pytest.mark.gateware

ULX3S = files("ulx3s").board
LETTERS = {"ulx3s": b"ULX3", "colorlight_i5": b"CLI5", "tang_primer_20k": b"TP20"}
WORDS = np.random.default_rng(5).integers(0, 1 << 32, ULX3S.waveform.samples, dtype=np.uint32).repeat(8)[: ULX3S.waveform.samples]


def opened(pi):
    return SpiLink(pi.files.board.link, pi.now_s)


def session_on(pi, link):
    return Session(link, pi.files.board, build_hash(data_folder("fpga_rtl")), pi.now_s)


def arm(pi, session):
    armed_s = session.arm()
    while pi.now_s() < armed_s:
        session.heartbeat()
        pi.board.run(2e-3 * PS)
    session.require_armed()


@each_row("name", BOARDS)
def test_the_readme_has_the_pins_of_the_top_and_the_wires_of_board_toml(name):
    """Its file of pins says which port of the top is at which pin of the headers."""
    board, pins = files(name), signal_pins()
    link = board.board.link
    ends = [(link.trigger_line, "trigger"), (link.configured_line, "configured"), (link.permit_line, "run permit")]
    ends += [("GPIO11", "SCK"), ("GPIO8", "CS"), ("GPIO10", "MOSI"), ("GPIO9", "MISO")]
    assert board.wires == {line: pins[signal] for line, signal in ends}
    told = {}
    for signal, cell, *_ in board.section("signal"):
        if channels := re.fullmatch(r"channels (\d+)–(\d+)", signal):
            first, last = map(int, channels.groups())
            told |= dict(zip(CHANNELS[first : last + 1], names_in(cell), strict=True))
        elif names := names_in(cell):
            told |= dict(zip((SIGNALS[one.removeprefix("SPI ")] for one in signal.split(", ")), names, strict=True))
    assert told == {pin.port: pin.name for pin in board.pins.values() if pin.name}
    assert len(told) == len(set(told.values())) == 32 + 13
    of_fpga = {"clock_hz": ULX3S.link.clock_hz, "sck_hz": ULX3S.link.sck_hz}
    assert msgspec.structs.replace(link, **of_fpga) == ULX3S.link, "the host's side is the same"


def test_it_says_that_it_is_configured_once_its_pll_has_locked_and_drives_nothing_high_before(pi):
    board = CompiledTop(pi.name)
    board.run(500_000)
    assert not board.high(signal_pins()["configured"])
    board.run(1_500_000)
    assert board.high(signal_pins()["configured"])
    _, words = board.take()
    high = np.bitwise_or.reduce(words)
    assert high == signal_pins()["configured"] | UART  # and the UART's line at rest
    assert board.leds == (0b1_0000_0001 if pi.name == "ulx3s" else 0)  # configured; the ESP32 lets the board be


def test_an_fpga_whose_oscillator_has_stopped_is_not_configured(pi):
    pi.board.oscillate(False)
    pi.board.run(1e-6 * PS)
    with pytest.raises(LinkError, match="the FPGA is not configured: its line 'GPIO24' is low"):
        opened(pi)
    pi.board.oscillate(True)
    pi.board.run(3e-6 * PS)
    opened(pi).close()


def test_it_is_known_armed_and_plays_an_upload_bit_for_bit_behind_the_trigger_line(pi):
    link = opened(pi)
    assert link.sck_hz == pytest.approx(pi.files.board.link.sck_hz)
    session = session_on(pi, link)
    read = session.exchange.read
    assert read(Register.IDENTITY) == IDENTITY_MAGIC
    assert read(Register.BOARD).to_bytes(4, "big") == LETTERS[pi.name]
    assert read(Register.CLOCK_HZ) == pi.files.board.link.clock_hz
    assert read(Register.GEOMETRY) & 0xFF == ULX3S.link.slots
    assert not pi.board.high(signal_pins()["hv_enable"])

    arm(pi, session)
    assert pi.board.high(signal_pins()["hv_enable"])
    assert channels_of(np.array([pi.board.levels], np.uint64))[0] == ULX3S.idle_word

    session.upload(3, memoryview(WORDS).cast("B"))
    assert session.exchange.read_slot_crc(3) == zlib.crc32(WORDS)
    session.play(Play(3), stop=False)
    assert State.WAITING in session.heartbeat().state
    assert pi.board.high(signal_pins()["waiting"])
    pi.board.take()
    edge_s = session.trigger()
    emission_ps = round(ULX3S.waveform.duration_ms * 1e-3 * pi.files.board.link.clock_hz) * pi.files.clock_ps
    pi.board.run(emission_ps + 10 * pi.files.clock_ps)
    assert not pi.board.high(signal_pins()["waiting"])

    times, pins = pi.board.take()
    times, words = times.astype(np.int64), channels_of(pins)
    assert times[(pins & np.uint64(signal_pins()["focus"])) != 0][0] == times[words != ULX3S.idle_word][0] + emission_ps
    changed = np.diff(words, prepend=np.uint32(ULX3S.idle_word)) != 0
    times, words = times[changed], words[changed]
    assert times.size > 100
    first_ps = int(times[0])
    trigger_ps = round(edge_s * PS) - 1_000_000  # the call returned 1 us behind the edge
    latency = (first_ps - trigger_ps) / pi.files.clock_ps
    assert TRIGGER_LATENCY_TICKS < latency <= TRIGGER_LATENCY_TICKS + 2  # the pin is sampled by the next edge
    starts = first_ps + np.arange(ULX3S.waveform.samples) * (session.bit_period / 65536 * pi.files.clock_ps)
    shown = words[np.searchsorted(times, starts + 1, side="right") - 1]
    assert np.array_equal(shown, WORDS)
    assert (times[-1], words[-1]) == (first_ps + emission_ps, ULX3S.idle_word)

    link.close()  # the permit goes with it
    pi.board.run(5 * pi.files.clock_ps)
    assert not pi.board.high(signal_pins()["hv_enable"])
    assert channels_of(np.array([pi.board.levels], np.uint64))[0] == 0


def test_a_frame_damaged_on_its_way_is_refused_and_the_next_one_taken(pi):
    session = session_on(pi, opened(pi))
    end = pack_nop(session.exchange.sent, 0, session.exchange.sequence)
    end = pack_nop(session.exchange.sent, end, session.exchange.sequence + 1)
    damaged = iter([True])
    pi.damage = lambda frame: bytes([*frame[:-1], frame[-1] ^ next(damaged, False)])
    with pytest.raises(Refused) as caught:
        session.exchange.send_short(end)
    assert caught.value.result is Result.BAD_CRC
    session.heartbeat()


def test_unlocked_and_armed_with_no_setting_written_it_keeps_the_limits_of_its_board(pi):
    """What any program at the port could send: one endless play of alternating words."""
    link, sequence = opened(pi), 0
    buffer, answer = bytearray(LOAD_FRAME_BYTES), bytearray(LOAD_FRAME_BYTES)

    def send(pack, *arguments, **named):
        nonlocal sequence
        sequence += 1
        end = pack(buffer, 0, sequence, *arguments, **named)
        link.exchange(memoryview(buffer)[:end], [end], memoryview(answer)[:end])

    words = np.tile(np.array([0xFFFFFFFF, 0], "<u4"), 500)
    send(pack_nop)
    for chunk in range(8):
        send(pack_load, chunk, memoryview(words[125 * chunk : 125 * chunk + 125]).cast("B"))
    send(pack_store, 0, 1000, zlib.crc32(words))
    send(pack_unlock, build_hash(data_folder("fpga_rtl")))
    send(pack_control, Control.ARM)
    pi.board.run((ULX3S.limits.arming_s + 0.1e-3) * PS)
    send(pack_play, Play(0, emissions=0, period_ticks=pi.files.board.link.clock_hz // 500, start=Start.NOW))
    pi.board.run(26e-3 * PS)
    send(pack_nop)
    status = parse_status(answer[:FRAME_BYTES])
    assert status.faults == Fault.TOTAL_EDGES
    assert not pi.board.high(signal_pins()["hv_enable"])

    times, pins = pi.board.take()
    words, hv = channels_of(pins), (pins & np.uint64(signal_pins()["hv_enable"])) != 0
    ticks = np.round(times.astype(np.int64) / pi.files.clock_ps).astype(np.int64)
    changed = (np.diff(words, prepend=np.uint32(0)) != 0) | (np.diff(hv, prepend=False) != 0)
    capture = Capture(ticks[changed].astype(np.uint64), words[changed], hv[changed].astype(np.uint8), np.empty(0, np.uint64))
    assert capture.words.size > 10_000
    assert broken_limits(capture, BuildParameters.of(pi.files.board, 0), pi.files.board.bit_ticks) == []
    link.close()


def test_when_its_oscillator_stops_the_outputs_are_low_as_soon_as_the_pll_says_so(pi):
    session = session_on(pi, opened(pi))
    arm(pi, session)
    assert channels_of(np.array([pi.board.levels], np.uint64))[0] == ULX3S.idle_word
    outputs = sum(channel_pins()) | sum(signal_pins()[name] for name in ("hv_enable", "hv_alive", "focus", "waiting", "fault"))
    assert pi.board.levels & outputs
    pi.board.take()
    pi.board.oscillate(False)
    pi.board.run(400_000)  # ten periods of the oscillator
    assert not pi.board.high(signal_pins()["configured"])
    assert pi.board.levels & outputs == 0
    times, pins = pi.board.take()
    configured = times[(pins & np.uint64(signal_pins()["configured"])) == 0][0]
    assert times[(pins & np.uint64(outputs)) == 0][0] == configured, "at once: there is no clock any more"
    pi.board.oscillate(True)
    pi.board.run(3e-6 * PS)
    assert pi.board.high(signal_pins()["configured"])
    assert pi.board.levels & outputs == 0, "armed no longer"


def test_when_its_clock_stops_under_a_lock_that_stays_the_outputs_are_low_within_3_us_and_a_permit_stops_them_at_once(pi):
    outputs = sum(channel_pins()) | sum(signal_pins()[name] for name in ("hv_enable", "hv_alive", "focus"))
    link = opened(pi)
    pi.board.pll("lock_stays")
    for lost in (None, "run permit", "temperature good"):
        arm(pi, session_on(pi, link))
        pi.board.oscillate(False)
        pi.board.run(500_000)
        assert pi.board.high(signal_pins()["configured"] | signal_pins()["hv_enable"])
        if lost:
            pi.board.drive(signal_pins()[lost], 0)
        else:
            pi.board.run(2_500_000)
            assert not pi.board.high(signal_pins()["configured"])
        assert pi.board.levels & outputs == 0, lost
        pi.board.run(3_000_000)
        assert pi.board.levels & outputs == 0
        pi.board.drive(signal_pins()["run permit"] | signal_pins()["temperature good"], 1)
        pi.board.oscillate(True)
        pi.board.run(5_000_000)
        assert pi.board.high(signal_pins()["configured"])
        assert pi.board.levels & outputs == 0, "armed no longer"
    arm(pi, session_on(pi, link))
    pi.board.pll("clk_stops")
    pi.board.run(500_000)
    assert pi.board.high(signal_pins()["hv_enable"])
    pi.board.run(2_500_000)
    assert pi.board.levels & outputs == 0, "the PLL alone"


def test_a_lock_that_is_lost_for_a_nanosecond_resets_the_panel(pi):
    """Which no clock sees: outputs that came back with it would be on without an ARM."""
    outputs = sum(channel_pins()) | signal_pins()["hv_enable"]
    session = session_on(pi, opened(pi))
    arm(pi, session)
    assert pi.board.levels & outputs
    pi.board.take()
    pi.board.pll("lock_blinks")
    pi.board.run(1_000_000)
    assert pi.board.high(signal_pins()["configured"])
    assert pi.board.levels & outputs == 0
    words = pi.board.take()[1].tolist()
    assert not words[0] & (outputs | signal_pins()["configured"])
    assert not any(word & outputs for word in words), "not for a moment"
    with pytest.raises(FpgaReset):
        session.heartbeat()


def test_a_permit_that_is_lost_for_a_nanosecond_is_lost(pi):
    outputs = sum(channel_pins()) | signal_pins()["hv_enable"]
    link = opened(pi)
    for name, cause in (("run permit", Fault.NO_PERMIT), ("temperature good", Fault.OVER_TEMPERATURE)):
        session = session_on(pi, link)
        arm(pi, session)
        pi.board.drive(signal_pins()[name], 0)
        assert pi.board.levels & outputs == 0
        pi.board.run(1_000)
        pi.board.drive(signal_pins()[name], 1)
        pi.board.take()
        pi.board.run(1_000_000)
        assert not any(word & outputs for word in pi.board.take()[1].tolist())
        exchange = session.exchange
        end = pack_nop(exchange.sent, 0, exchange.sequence)
        assert exchange.send_short(pack_nop(exchange.sent, end, exchange.sequence + 1), raise_faults=False).faults == cause
