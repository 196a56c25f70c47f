"""The session with the gateware model, on good links and on links that damage frames."""

import math
import zlib
from dataclasses import replace
from types import SimpleNamespace

import msgspec
import numpy as np
import pytest
from tables import each_row

from controller.clocks import VirtualClock
from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.device.fpga import frames
from controller.device.fpga.build_parameters import BuildParameters
from controller.device.fpga.configuration import LIMITS
from controller.device.fpga.exchange import Refused
from controller.device.fpga.frames import FRAME_BYTES, Play
from controller.device.fpga.registers import READ_SLOT_CRC, Control, Fault, Register, Result, Start, State
from controller.device.fpga.session import Session
from controller.errors import FaultError, LinkError
from controller.workshop.gateware.gateware import Permit
from controller.workshop.gateware.model.model import GatewareModel
from controller.workshop.gateware.simulated_link import SimulatedLink

BUILD = 0x1234ABCD
WORDS = memoryview(np.random.default_rng(7).integers(0, 1 << 32, 1000, dtype=np.uint32).view(np.uint8)).cast("B")


def gateware(board, build_hash=BUILD, **other):
    return GatewareModel(replace(BuildParameters.of(board, build_hash), **other))


class NoisyLink(SimulatedLink):
    """A link that flips one bit: `noise` maps the number of a frame to (direction, byte)."""

    def __init__(self, *args):
        super().__init__(*args)
        self.noise = {}
        self.frames = 0

    def exchange(self, sent, lengths, received):
        start = 0
        for length in lengths:
            direction, byte = self.noise.get(self.frames, ("", 0))
            self.frames += 1
            frame = bytearray(sent[start : start + length])
            if direction == "to the FPGA":
                frame[byte % length] ^= 4
            if direction == "lost, an old NOP instead":
                frames.pack_nop(frame, 0, 200)
            super().exchange(memoryview(frame), [length], received[start : start + length])
            if direction == "to the host":
                received[start + byte % length] ^= 4
            start += length


@pytest.fixture
def clock():
    return VirtualClock()


@pytest.fixture
def link(board, clock):
    return NoisyLink(board.link, clock.now_s, gateware(board))


@pytest.fixture
def armed(board, clock, link):
    session = Session(link, board, BUILD, clock.now_s)
    clock._now_s = session.arm()
    session.require_armed()
    return session


def wait(clock, link, seconds):
    clock._now_s = max(clock.now_s(), link.wire_free_s()) + seconds


def test_arming_ramps_to_the_idle_word_and_disarming_to_zero(board, clock, link, armed):
    assert State.HV_ENABLE in armed.heartbeat().state
    clock._now_s = armed.disarm()
    assert armed.heartbeat().state & (State.ARMED | State.HV_ENABLE) == 0
    link.close()
    capture = link.take_capture()
    assert board.idle_word in capture.words
    assert not (capture.words & ~np.uint32(board.idle_word)).any()
    assert capture.words[-1] == capture.hv[-1] == 0


@each_row(
    ("change", "said"),
    [
        ({"build_hash": BUILD + 1}, "BUILD_HASH"),
        ({"clock_hz": 50_000_000, "sck_hz": 8_000_000}, "CLOCK_HZ"),
        ({"slots": 3}, "has 3 slots"),
    ],
    afresh=[clock],
)
def test_refuses_another_fpga_than_the_boards_before_anything_is_armed(board, clock, change, said):
    settings = msgspec.structs.replace(board.link, **{k: v for k, v in change.items() if k != "build_hash"})
    other = msgspec.structs.replace(board, link=settings)
    link = SimulatedLink(settings, clock.now_s, gateware(other, change.get("build_hash", BUILD)))
    with pytest.raises(LinkError, match=said):
        Session(link, board, BUILD, clock.now_s)
    link.close()
    assert not link.take_capture().hv.any()


@each_row("by", [-1, 1])
@each_row(("register", "key"), LIMITS.items())
def test_a_bitstream_with_another_limit_is_refused_by_its_name_and_the_boards_key(board, clock, register, key, by):
    name = register.name.lower()
    built = getattr(BuildParameters.of(board, BUILD), name) + by
    if register is Register.CHANNEL_MASK_MAX:
        built = 0xFFFFFFFF - (1 << 5) + by
    link = SimulatedLink(board.link, clock.now_s, gateware(board, **{name: built}))
    with pytest.raises(
        LinkError, match=rf"another board: {register.name} is {built}, not \d+ \({key}\); build its gateware with"
    ) as said:
        Session(link, board, BUILD, clock.now_s)
    assert "\n" not in str(said.value)
    link.close()
    assert not link.take_capture().hv.any()


def test_all_limits_that_differ_are_said_in_one_line(board, clock):
    """The bitstream of the simulated panel behind the board.toml of the ULX3S, at its clock."""
    other = load_board(find_board("ulx3s"))
    loose = msgspec.structs.replace(other, limits=board.limits)
    link = SimulatedLink(other.link, clock.now_s, gateware(loose))
    with pytest.raises(LinkError) as said:
        Session(link, other, BUILD, clock.now_s)
    assert str(said.value) == (
        "the FPGA was built with the limits of another board:"
        " CHANNEL_EDGES_MAX is 37500, not 13250 (limits.max_channel_edge_rate_hz);"
        " TOTAL_EDGES_MAX is 1000000, not 375000 (limits.max_total_edge_rate_hz);"
        " EMISSION_TICKS_MAX is 156250, not 131250 (limits.longest_emission_ms);"
        " DUTY_SHARE_MAX is 65536, not 19661 (limits.max_duty); DUTY_TICKS_MAX is 6250000, not 1500000 (limits.duty_budget_ms);"
        f" build its gateware with the limits of this one: haptic-panel gateware build --board {other.folder}"
    )


def test_every_limit_of_the_board_is_written_to_the_fpga(board, clock):
    limits = msgspec.structs.replace(
        board.limits,
        heartbeat_timeout_ms=90.0,
        ramp_ms=7.0,
        hv_settle_us=700.0,
        max_duty=0.3,
        duty_budget_ms=60.0,
        longest_emission_ms=2.2,
        min_pulse_us=1.21,
        max_channel_edge_rate_hz=12_345.0,
        max_total_edge_rate_hz=67_890.0,
    )
    other = msgspec.structs.replace(board, limits=limits)
    session = Session(SimulatedLink(board.link, clock.now_s, gateware(other)), other, BUILD, clock.now_s)
    window_s = session.exchange.read(Register.EDGE_WINDOW_TICKS) / board.link.clock_hz
    reported = {
        Register.IDLE_WORD: board.idle_word,
        Register.CHANNEL_MASK: 0xFFFFFFFF,
        Register.BIT_PERIOD: 160 << 16,
        Register.RAMP_SAMPLES: 3500,
        Register.HEARTBEAT_TICKS: 7_200_000,
        Register.PULSE_TICKS: 96,
        Register.CHANNEL_EDGES: math.floor(12_345 * window_s),
        Register.TOTAL_EDGES: math.floor(67_890 * window_s),
        Register.EMISSION_TICKS: 176_000,
        Register.DUTY_SHARE: 19_661,
        Register.DUTY_TICKS: 4_800_000,
        Register.HV_SETTLE_TICKS: 56_000,
        Register.CHANNEL_MASK_MAX: 0xFFFFFFFF,
    }
    reported |= {Register[f"{name}_MAX"]: reported[Register[name]] for name in ("HEARTBEAT_TICKS", "CHANNEL_EDGES", "TOTAL_EDGES")}
    reported |= {Register[f"{name}_MAX"]: reported[Register[name]] for name in ("EMISSION_TICKS", "DUTY_SHARE", "DUTY_TICKS")}
    reported |= {Register.PULSE_TICKS_MIN: reported[Register.PULSE_TICKS]}
    assert {register: session.exchange.read(register) for register in reported} == reported


@each_row("bit_clock_hz", [500e3, 300e3, 333_333.0, 299_999.0, 1.9e6], afresh=[clock])
def test_any_bit_clock_of_the_gateware_is_met_within_ten_millionths(board, clock, bit_clock_hz):
    waveform = msgspec.structs.replace(board.waveform, bit_clock_hz=bit_clock_hz, duration_ms=500e3 / bit_clock_hz)
    limits = msgspec.structs.replace(board.limits, min_pulse_us=0.5)
    other = msgspec.structs.replace(board, waveform=waveform, limits=limits)
    session = Session(SimulatedLink(board.link, clock.now_s, gateware(other)), other, BUILD, clock.now_s)
    found_hz = board.link.clock_hz * 65536 / session.exchange.read(Register.BIT_PERIOD)
    assert found_hz == pytest.approx(bit_clock_hz, rel=10e-6)
    assert found_hz != pytest.approx(bit_clock_hz * 1.01, rel=10e-6)


def test_a_missing_permit_is_reported_when_arming(board, clock, link):
    session = Session(link, board, BUILD, clock.now_s)
    link.gateware.permit(round(link.wire_free_s() * link.clock_hz), level=False, which=Permit.TEMPERATURE)
    clock._now_s += 1e-3
    with pytest.raises(Refused, match="run permit") as caught:
        session.arm()
    assert caught.value.result is Result.NO_PERMIT


def test_a_failure_to_arm_is_reported_with_the_state(board, clock, link):
    session = Session(link, board, BUILD, clock.now_s)
    with pytest.raises(LinkError, match=r"its state is run permit, temperature good$"):
        session.require_armed()


def test_three_heartbeats_are_sent_per_timeout(board, clock, link, armed):
    wait(clock, link, 0.0)
    armed.heartbeat()
    assert armed.heartbeat_due_s - clock.now_s() == pytest.approx(board.limits.heartbeat_timeout_ms * 1e-3 / 3)


@each_row("direction", ["to the FPGA", "to the host"])
@each_row("frame", range(4), afresh=[clock, link])  # NOP, UNLOCK, ARM, NOP
def test_a_damaged_frame_while_arming_is_sent_again(board, clock, link, frame, direction):
    session = Session(link, board, BUILD, clock.now_s)
    link.noise = {link.frames + frame: (direction, 9)}
    clock._now_s = session.arm()
    session.require_armed()
    assert session.exchange.read(Register.FRAME_ERRORS) == (direction == "to the FPGA"), "no other frame was damaged"


def test_arming_over_a_link_that_damages_everything_is_given_up_with_outputs_off(board, clock, link):
    session = Session(link, board, BUILD, clock.now_s)
    link.noise = dict.fromkeys(range(link.frames, link.frames + 100), ("to the host", 9))
    with pytest.raises(LinkError):
        session.arm()
    link.noise = {}
    session.off()
    wait(clock, link, board.limits.arming_s)
    assert State.HV_ENABLE not in session.heartbeat().state


@pytest.mark.parametrize("stop", [False, True])
def test_an_upload_plays_at_its_time_without_a_trigger(board, clock, link, armed, stop):
    at = armed.heartbeat().timestamp_ticks + 800_000
    armed.upload_and_play(Play(1, start=Start.TIME, when_ticks=at), WORDS, stop=stop)
    wait(clock, link, 20e-3)
    assert armed.heartbeat().emissions == 1
    link.close()
    assert link.take_capture().focus_ticks.tolist() == [at + 1000 * board.bit_ticks]


def test_the_bit_clock_is_scaled_while_nothing_plays_and_kept_over_a_bring_up(board, clock, link, armed):
    assert armed.set_bit_period(0.99)
    slow = round(board.bit_period / 0.99)
    assert armed.exchange.read(Register.BIT_PERIOD) == slow
    armed.upload_and_play(
        Play(0, emissions=3, period_ticks=armed.timing.period_ticks(board.waveform.duration_s)), WORDS, stop=False
    )
    assert not armed.set_bit_period(1.0), "a play waits"
    armed.trigger()
    wait(clock, link, 3 * 2.1e-3)
    assert armed.heartbeat().emissions == 3, "without a pause between them, as they would be at the board's bit clock"
    link.close()
    emission_ticks = 1000 * slow >> 16
    assert np.diff(link.take_capture().focus_ticks).tolist() in ([], [emission_ticks] * 2)  # one rise if the pin stays high
    assert armed.timing.emission_ticks == emission_ticks
    clock._now_s = armed.disarm() + 1e-3
    armed.bring_up()
    assert armed.exchange.read(Register.BIT_PERIOD) == slow
    assert armed.set_bit_period(1.0)
    assert armed.exchange.read(Register.BIT_PERIOD) == board.bit_period


def test_a_period_without_a_pause_is_one_at_any_bit_clock(board, armed):
    def emission_s():
        return armed.timing.emission_ticks / board.link.clock_hz

    assert armed.timing.actual_period_s(board.waveform.duration_s) == emission_s()
    assert armed.set_bit_period(0.99)
    assert armed.timing.actual_period_s(board.waveform.duration_s) == emission_s() > board.waveform.duration_s


def test_a_bit_clock_beyond_the_gateware_is_refused_and_nothing_is_changed(board, armed):
    with pytest.raises(Refused, match="outside what the FPGA allows"):
        armed.set_bit_period(10.0)
    assert armed.bit_period == armed.exchange.read(Register.BIT_PERIOD) == board.bit_period


def test_a_fault_carries_its_bits(board, clock, link, armed):
    link.gateware.permit(round(link.wire_free_s() * link.clock_hz) + 100, level=False, which=Permit.TEMPERATURE)
    wait(clock, link, 1e-3)
    with pytest.raises(FaultError, match="temperature input went low") as caught:
        armed.heartbeat()
    assert caught.value.faults == Fault.OVER_TEMPERATURE


def test_a_play_at_once_and_one_at_a_time_need_no_trigger(board, clock, link, armed):
    armed.upload(1, WORDS)
    armed.play(Play(1, start=Start.NOW), stop=False)
    wait(clock, link, 3e-3)
    now = armed.heartbeat()
    assert (now.emissions, now.trigger_count) == (1, 0)
    at = now.timestamp_ticks + 400_000
    armed.play(Play(1, start=Start.TIME, mask=0xFF, when_ticks=at), stop=False)
    wait(clock, link, 9e-3)
    assert armed.heartbeat().emissions == 2
    capture = link.take_capture()
    assert int(capture.focus_ticks[-1]) == at + 1000 * board.bit_ticks
    masked = capture.words[capture.ticks >= at]
    assert set((masked & 0xFFFFFF00).tolist()) == {board.idle_word & 0xFFFFFF00}
    with pytest.raises(Refused, match="has passed, or is too near"):
        armed.play(Play(1, start=Start.TIME, when_ticks=at), stop=False)


@pytest.mark.interpreted
def test_a_play_has_begun_in_the_half_of_the_counters_range_that_follows_its_time():
    repeated = Play(1, start=Start.TIME, emissions=0, period_ticks=1 << 16, when_ticks=5)
    for since, began in ((0, True), (1 << 16, True), (1, False), (1 << 31, False), (3 << 30, False)):
        reading = SimpleNamespace(exchange=SimpleNamespace(read=lambda _, since=since: since + 5))
        assert Session._began(reading, repeated) is began


def test_over_a_good_link_the_fpga_finds_no_gap_in_the_numbers_of_the_frames(clock, link, armed):
    """Otherwise SEQUENCE_GAPS would count the host's own gaps as lost frames."""
    first = armed.exchange.read(Register.SEQUENCE_GAPS)  # the number after that of another host, or of a reset
    armed.set_bit_period(0.99)
    armed.upload(1, WORDS)
    for stop in (False, True):
        armed.upload_and_play(Play(0, emissions=0, period_ticks=armed.timing.period_ticks(25e-3)), WORDS, stop=stop)
        armed.play(Play(1), stop=True)
        armed.stop()
    clock._now_s = armed.disarm()
    armed.bring_up()
    clock._now_s = armed.arm()
    assert armed.exchange.read(Register.SEQUENCE_GAPS) == first


def test_an_upload_whose_slot_is_still_checked_is_waited_for_at_any_sck(board, clock):
    for sck_hz in (40_000_000, 80_000_000 // 3, 25_000_000, 13_000_000, 4_000_000):
        settings = msgspec.structs.replace(board.link, sck_hz=sck_hz)
        on = msgspec.structs.replace(board, link=settings)
        link = SimulatedLink(settings, clock.now_s, gateware(on))
        session = Session(link, on, BUILD, clock.now_s)
        clock._now_s = session.arm()
        for stop in (False, True):
            session.upload_and_play(Play(0), WORDS, stop=stop)
        assert session.heartbeat().queued == 1
        assert session.exchange.read_address(READ_SLOT_CRC) == zlib.crc32(WORDS)
        session.off()
        clock._now_s = link.wire_free_s() + 0.1


def test_refuses_an_fpga_that_somebody_else_has_armed(board, clock, link, armed):
    with pytest.raises(LinkError, match="armed already"):
        Session(link, board, BUILD, clock.now_s)


def test_a_silent_link_is_explained(board, clock):
    class Silent(SimulatedLink):
        def exchange(self, _sent, _lengths, received):
            received[:] = bytes(len(received))

    with pytest.raises(LinkError, match="is MISO wired"):
        Session(Silent(board.link, clock.now_s, gateware(board)), board, BUILD, clock.now_s)


def test_an_upload_comes_out_of_the_pins_word_by_word(board, clock, link, armed):
    armed.upload_and_play(Play(2), WORDS, stop=False)
    armed.trigger()
    wait(clock, link, 3e-3)
    assert armed.heartbeat().emissions == 1
    capture = link.take_capture()
    assert armed.exchange.read_slot_crc(2) == zlib.crc32(WORDS)
    start = int(capture.focus_ticks[0]) - 1000 * board.bit_ticks
    sampled = start + board.bit_ticks * np.arange(1000)
    words = capture.words[np.searchsorted(capture.ticks.astype(np.int64), sampled, side="right") - 1]
    assert words.tobytes() == bytes(WORDS)


@each_row("chunk", range(8))
@each_row("byte", [0, 3, 5, 7, 100, 510], afresh=[clock, link, armed])
def test_a_chunk_damaged_on_its_way_is_sent_again_and_played_right(board, clock, link, armed, chunk, byte):
    link.noise = {link.frames + chunk: ("to the FPGA", byte)}
    armed.upload_and_play(Play(0), WORDS, stop=False)
    armed.trigger()
    wait(clock, link, 3e-3)
    assert armed.heartbeat().emissions == 1
    link.close()
    assert link.take_capture().focus_ticks.size == 1


@pytest.mark.parametrize("direction", ["to the FPGA", "to the host"])
def test_a_link_that_damages_everything_is_given_up_with_nothing_left_to_play(clock, link, armed, direction):
    link.noise = dict.fromkeys(range(link.frames, link.frames + 1000), (direction, 20))
    with pytest.raises(LinkError):
        armed.upload_and_play(Play(0), WORDS, stop=False)
    link.noise = {}
    armed.trigger()
    wait(clock, link, 3e-3)
    assert armed.heartbeat().emissions == 0


def test_a_lost_frame_is_detected_by_its_number(clock, link, armed):
    armed.upload_and_play(Play(0), WORDS, stop=False)
    armed.trigger()
    wait(clock, link, 3e-3)
    link.noise = {link.frames: ("lost, an old NOP instead", 0)}
    armed.play(Play(0), stop=False)
    assert State.PENDING in armed.heartbeat().state, "sent again: it is there after all"
    link.noise = {link.frames + 2 * attempt: ("lost, an old NOP instead", 0) for attempt in range(3)}
    with pytest.raises(LinkError, match="a frame was lost"):
        armed.exchange.control(Control.CLEAR, raise_faults=False)


@each_row("frame", range(12), afresh=[clock, link, armed])
def test_an_upload_with_a_damaged_answer_is_sent_again_and_played_once(clock, link, armed, frame):
    link.noise = {link.frames + frame: ("to the host", 9)}
    armed.upload_and_play(Play(0), WORDS, stop=False)
    armed.trigger()
    armed.trigger()
    wait(clock, link, 3e-3)
    assert armed.heartbeat().emissions == 1


def test_a_play_whose_answer_was_damaged_waits_behind_the_one_before_it(clock, link, armed):
    armed.upload(0, WORDS)
    first, second = (link.tick(clock.now_s() + ahead_s) for ahead_s in (20e-3, 30e-3))
    armed.play(Play(0, start=Start.TIME, when_ticks=first), stop=False)
    link.noise = {link.frames + frame: ("to the host", 9) for frame in (0, 1)}
    armed.play(Play(0, start=Start.TIME, when_ticks=second), stop=False)
    assert armed.counters.first_copies_taken == 1
    assert armed.belief.waiting == [first, second]
    wait(clock, link, 40e-3)
    assert armed.heartbeat().emissions == 2
    assert armed.counters.emissions_lost == 0


@each_row("byte", [0, 2, 4, 20, 35], afresh=[clock, link, armed])
def test_damaged_answers_are_asked_for_again_and_never_believed(link, armed, byte):
    link.noise = {link.frames: ("to the host", byte)}
    assert State.ARMED in armed.heartbeat().state
    link.noise = dict.fromkeys(range(link.frames, link.frames + 3), ("to the host", byte))
    with pytest.raises(LinkError, match="status"):
        armed.heartbeat()


def test_a_refusal_is_reported_in_a_sentence_and_changes_nothing(armed):
    with pytest.raises(Refused, match="Nothing has been stored in this slot") as caught:
        armed.play(Play(3), stop=False)
    assert caught.value.result is Result.EMPTY_SLOT
    armed.upload_and_play(Play(3), WORDS, stop=False)
    for _ in range(7):
        armed.play(Play(3), stop=False)
    with pytest.raises(Refused, match="queue of plays is full"):
        armed.play(Play(3), stop=False)
    assert armed.heartbeat().queued == 8
    armed.play(Play(3), stop=True)
    assert armed.heartbeat().queued == 1


def test_time_on_the_wire_is_that_of_the_bits_at_sck_and_a_pause_between_frames(board, link, armed):
    wire_ns, bytes_sent = link.wire_ns, link.bytes_sent
    armed.upload_and_play(Play(0), WORDS, stop=False)
    assert link.bytes_sent - bytes_sent == 4096 + 4 * FRAME_BYTES, "STORE, NOP while the slot is checked, PLAY, NOP"
    bits_ns = 8 * (4096 + 4 * FRAME_BYTES) / board.link.sck_hz * 1e9
    assert bits_ns < link.wire_ns - wire_ns < bits_ns * 1.003 + 12 * 300


def test_a_session_that_is_armed_disarms_before_it_is_brought_up_again(board, clock, link, armed):
    with pytest.raises(LinkError, match="is commanded to disarm: try again when its ramp has passed"):
        armed.bring_up()
    wait(clock, link, board.limits.arming_s + 1e-3)
    armed.bring_up()
    clock._now_s = armed.arm()
    armed.require_armed()


def test_a_link_that_damages_everything_is_reported_as_such(board, clock, link, armed):
    wait(clock, link, 2 * board.limits.heartbeat_timeout_ms * 1e-3)
    link.noise = dict.fromkeys(range(link.frames, link.frames + 100), ("to the FPGA", 9))
    with pytest.raises(Refused, match="damaged on its way"):
        armed.bring_up()
    link.noise = {}
    armed.bring_up()
    assert armed.heartbeat().faults == 0
