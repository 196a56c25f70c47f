"""The gateware model by itself: each result, each state, and what the pins do; tests/rtl compares it with the Verilog."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from controller.fpga import frames
from controller.fpga.frames import parse_status
from controller.fpga.model import GatewareModel
from controller.fpga.model_pins import modulate, ramp_bits
from controller.fpga.registers import Control, Fault, Register, Result, State

HASH = 0xC0FFEE
HEARTBEAT_TICKS = 100_000
BIT_TICKS = 10
RAMP_SAMPLES = 8
IDLE = 0x0F0F0F0F
LATENCY = 6  # ticks from the trigger's rise to the first word
TICKS_PER_BYTE = 48
ON = State.RUN_PERMIT | State.HEARTBEAT
ARMED = ON | State.ARMED | State.HV_ENABLE
WORDS = np.arange(1, 31, dtype=np.uint32)


class Host:
    """Sends frames to a model one after another, as fast as it may."""

    def __init__(self):
        self.model = GatewareModel(1_000_000, 2, HASH, HEARTBEAT_TICKS)
        self.tick = 10
        self.buffer = bytearray(512)

    def exchange(self, frame):
        answer = bytearray(max(len(frame), 32))
        release = self.tick + 5 + len(frame) * TICKS_PER_BYTE
        self.model.exchange(self.tick, release, frame, memoryview(answer)[: len(frame)])
        self.tick = release + 4
        return answer

    def send(self, pack, *arguments, **named):
        end = pack(self.buffer, 0, 7, *arguments, **named)
        return parse_status(self.exchange(bytes(self.buffer[:end])))

    def status(self):
        return self.send(frames.pack_nop)

    def result(self, pack, *arguments, **named):
        self.send(pack, *arguments, **named)
        return self.status().result

    def read(self, register):
        self.send(frames.pack_read, register)
        return self.status().data

    def upload(self, slot, words=WORDS):
        data = memoryview(np.asarray(words, "<u4")).cast("B")
        for chunk in range(-(-len(words) // 125)):
            self.send(frames.pack_load, chunk, data[500 * chunk : 500 * chunk + 500])
        return self.result(frames.pack_store, slot, len(words))

    def arm(self):
        self.model.permit(self.tick, True)
        for register, value in ((Register.IDLE_WORD, IDLE), (Register.BIT_TICKS, BIT_TICKS), (Register.RAMP_SAMPLES, RAMP_SAMPLES)):
            assert self.result(frames.pack_write, register, value) is Result.OK
        assert self.result(frames.pack_arm, HASH) is Result.OK
        self.tick += RAMP_SAMPLES * BIT_TICKS
        return self

    def trigger(self):
        tick = self.tick
        self.model.trigger(tick)
        self.tick += 4  # high for two clocks, low for two
        return tick + LATENCY

    def pins_after(self, ticks):
        self.tick += ticks
        self.model.advance(self.tick)
        return self.model.take_capture()


@pytest.fixture
def armed():
    host = Host().arm()
    assert host.upload(0) is Result.OK
    assert host.status().state == ARMED
    host.pins_after(0)
    return host


def word_at(capture, tick):
    return int(capture.words[np.searchsorted(capture.ticks, tick, "right") - 1])


def test_an_emission_is_the_words_stored_each_held_one_bit_and_then_the_idle_word(armed):
    assert armed.result(frames.pack_play, 0) is Result.OK
    assert armed.status().state == ARMED | State.PENDING
    start = armed.trigger()
    capture = armed.pins_after(1000)
    assert capture.ticks.tolist() == [start + BIT_TICKS * n for n in range(31)]
    assert capture.words.tolist() == [*WORDS.tolist(), IDLE]
    assert capture.focus_ticks.tolist() == [start + BIT_TICKS * 30]
    assert armed.status().emissions == 1


def test_captures_taken_at_any_time_add_up_to_the_same(armed):
    armed.send(frames.pack_play, 0, count=3, period_ticks=30 * BIT_TICKS)
    start = armed.trigger()
    parts = [armed.pins_after(ticks) for ticks in (3, 1, 6, 137, 0, 300, 453, 200)]
    expected = np.append(np.tile(WORDS, 3), np.uint32(IDLE))
    assert np.array_equal(np.concatenate([part.words for part in parts]), expected)
    assert np.array_equal(np.concatenate([part.ticks for part in parts]), start + BIT_TICKS * np.arange(91))
    assert np.concatenate([part.focus_ticks for part in parts]).tolist() == [start + 300, start + 600, start + 900]


@pytest.mark.parametrize(
    ("expected", "pack", "arguments"),
    [
        (Result.OK, frames.pack_nop, ()),
        (Result.UNKNOWN_TYPE, lambda b, o, s: frames.pack_short(b, o, 6, s, 0), ()),
        (Result.UNKNOWN_REGISTER, frames.pack_read, (16,)),
        (Result.UNKNOWN_REGISTER, frames.pack_write, (99, 0)),
        (Result.READ_ONLY, frames.pack_write, (Register.FAULT, 0)),
        (Result.BAD_VALUE, frames.pack_write, (Register.BIT_TICKS, 3)),
        (Result.BAD_VALUE, frames.pack_write, (Register.BIT_TICKS, 65536)),
        (Result.BAD_VALUE, frames.pack_write, (Register.RAMP_SAMPLES, 0)),
        (Result.BAD_VALUE, frames.pack_write, (Register.HEARTBEAT_TICKS, HEARTBEAT_TICKS + 1)),
        (Result.BAD_VALUE, frames.pack_write, (Register.HEARTBEAT_TICKS, 0)),
        (Result.BAD_VALUE, frames.pack_write, (Register.CONTROL, 5)),
        (Result.BAD_SLOT, frames.pack_store, (2, 30)),
        (Result.BAD_VALUE, frames.pack_store, (0, 1001)),
        (Result.BAD_VALUE, frames.pack_store, (0, 0)),
        (Result.INCOMPLETE, frames.pack_store, (0, 30)),
        (Result.BAD_CHUNK, frames.pack_load, (8, memoryview(bytes(20)))),
        (Result.BAD_SLOT, frames.pack_play, (2,)),
        (Result.NOT_ARMED, frames.pack_play, (0,)),
        (Result.NO_PERMIT, frames.pack_arm, (HASH,)),
        (Result.BAD_KEY, frames.pack_arm, (HASH + 1,)),
    ],
)
def test_says_in_the_next_answer_what_became_of_a_frame(expected, pack, arguments):
    assert Host().result(pack, *arguments) is expected


def test_refuses_while_armed_what_would_surprise(armed):
    assert armed.result(frames.pack_write, Register.IDLE_WORD, 0) is Result.ARMED
    assert armed.result(frames.pack_arm, HASH) is Result.ARMED
    assert armed.result(frames.pack_play, 1) is Result.EMPTY_SLOT
    for count in (0, 2):
        assert armed.result(frames.pack_play, 0, count=count, period_ticks=299) is Result.BAD_VALUE
    assert armed.result(frames.pack_play, 0, count=1, period_ticks=0) is Result.OK
    assert armed.result(frames.pack_play, 0) is Result.BUSY


@pytest.mark.parametrize(
    ("damage", "reason"),
    [
        (lambda frame: b"\0" + frame[1:], Result.BAD_SYNC),
        (lambda frame: frame[:-1], Result.BAD_LENGTH),
        (lambda frame: frame + b"\0", Result.BAD_LENGTH),
        (lambda frame: frame[:7], Result.BAD_LENGTH),
        (lambda frame: frame[:20] + b"\x55" + frame[21:], Result.BAD_CRC),
    ],
)
def test_a_damaged_frame_changes_nothing_but_the_error_counter(damage, reason):
    host = Host()
    frames.pack_write(host.buffer, 0, 99, Register.IDLE_WORD, 5)
    host.exchange(damage(bytes(host.buffer[:32])))
    status = host.status()
    assert (status.result, status.sequence) == (reason, 0)
    assert not status.state & State.HEARTBEAT, "a refused frame is no sign of life"
    assert host.read(Register.IDLE_WORD) == 0
    assert host.read(Register.FRAME_ERRORS) == 1


def test_a_select_without_bytes_is_nothing():
    host = Host()
    host.exchange(b"")
    assert host.status().result is Result.OK
    assert host.read(Register.FRAME_ERRORS) == 0


def test_a_chunk_counts_only_whole_and_undamaged(armed):
    chunk = memoryview(bytes(80))
    armed.send(frames.pack_load, 0, chunk)
    assert armed.result(frames.pack_store, 1, 21) is Result.INCOMPLETE
    end = frames.pack_load(armed.buffer, 0, 1, 0, chunk)
    armed.exchange(bytes(armed.buffer[: end - 1]))
    assert armed.result(frames.pack_store, 1, 20) is Result.INCOMPLETE
    armed.send(frames.pack_load, 0, chunk)
    assert armed.result(frames.pack_store, 1, 20) is Result.OK
    assert armed.result(frames.pack_store, 1, 20) is Result.INCOMPLETE, "what was stored is not there twice"
    assert armed.read(Register.SLOTS_LOADED) == 0b11


def test_each_trigger_starts_one_play_or_is_counted_as_ignored(armed):
    armed.trigger()
    armed.send(frames.pack_play, 0)
    armed.trigger()
    armed.tick += 50
    armed.trigger()
    armed.pins_after(400)
    armed.trigger()
    armed.pins_after(400)
    status = armed.status()
    assert (status.trigger_count, status.emissions) == (4, 1)
    assert armed.read(Register.TRIGGERS_IGNORED) == 3


def test_a_pending_play_waits_while_another_sounds_and_replaces_it_in_its_pause(armed):
    armed.upload(1, WORDS + 100)
    armed.send(frames.pack_play, 0, count=0, period_ticks=1_000_000)
    start = armed.trigger()
    armed.send(frames.pack_play, 1)
    armed.model.advance(start + 100)
    assert State.PLAYING | State.REPEATING in armed.model.status().state
    armed.tick = max(armed.tick, start + 400)
    second = armed.trigger()
    capture = armed.pins_after(2_000)
    assert word_at(capture, second) == 101
    assert State.REPEATING not in armed.status().state
    assert armed.status().emissions == 2


def test_a_counted_repetition_plays_exactly_its_count_exactly_a_period_apart(armed):
    armed.send(frames.pack_play, 0, count=3, period_ticks=777)
    start = armed.trigger()
    capture = armed.pins_after(5000)
    assert capture.focus_ticks.tolist() == [start + 300 + 777 * n for n in range(3)]
    assert np.flatnonzero(capture.words == 1).size == 3


def test_an_endless_repetition_goes_on_until_stop_lets_the_last_emission_end(armed):
    armed.send(frames.pack_play, 0, count=0, period_ticks=301)
    armed.trigger()
    for _ in range(10):
        assert armed.status().state & State.REPEATING
        armed.pins_after(5000)
    armed.send(frames.pack_control, Control.STOP)
    before = armed.status()
    assert State.REPEATING not in before.state
    capture = armed.pins_after(2000)
    assert armed.status().emissions - before.emissions in (0, 1)
    assert word_at(capture, armed.tick) == IDLE


def test_stop_drops_a_pending_play(armed):
    armed.send(frames.pack_play, 0)
    armed.send(frames.pack_control, Control.STOP)
    armed.trigger()
    assert armed.pins_after(1000).words.size == 0


def test_a_slot_is_replaced_while_it_plays_and_the_emission_stays_what_it_was(armed):
    armed.upload(0, np.arange(1, 126))
    armed.send(frames.pack_play, 0, count=0, period_ticks=2000)
    armed.trigger()
    assert armed.upload(0, WORDS + 1000) is Result.OK
    assert State.LANDING_BUSY in armed.status().state
    assert armed.result(frames.pack_load, 0, memoryview(bytes(40))) is Result.BUSY
    assert armed.result(frames.pack_store, 1, 10) is Result.INCOMPLETE
    armed.send(frames.pack_control, Control.STOP)
    armed.send(frames.pack_play, 0)
    capture = armed.pins_after(8000)
    assert set(capture.words.tolist()) <= {*range(1, 126), IDLE}
    assert State.LANDING_BUSY not in armed.status().state
    start = armed.trigger()
    assert word_at(armed.pins_after(100), start) == 1001


def test_masked_channels_stay_low():
    host = Host()
    assert host.result(frames.pack_write, Register.CHANNEL_MASK, 0x6) is Result.OK
    host.arm().upload(0)
    host.send(frames.pack_play, 0)
    start = host.trigger()
    capture = host.pins_after(1000)
    assert set(capture.words.tolist()) <= {0, 2, 4, 6}
    assert word_at(capture, start + 2 * BIT_TICKS) == 3 & 6


def test_shuts_when_the_permit_goes_and_stays_so_until_cleared(armed):
    armed.send(frames.pack_play, 0)
    start = armed.trigger()
    lost = start + 42
    armed.model.permit(lost, False)
    armed.model.permit(lost + 1, True)
    capture = armed.pins_after(1000)
    assert (capture.ticks[-1], capture.words[-1], capture.hv[-1]) == (lost + 3, 0, 0)
    assert capture.focus_ticks.size == 0
    status = armed.status()
    assert (status.faults, status.state, status.emissions) == (Fault.NO_PERMIT, ON, 0)
    assert armed.result(frames.pack_arm, HASH) is Result.FAULTED
    assert armed.result(frames.pack_play, 0) is Result.FAULTED
    assert armed.read(Register.FAULT) == Fault.NO_PERMIT
    assert armed.result(frames.pack_control, Control.CLEAR) is Result.OK
    assert armed.result(frames.pack_arm, HASH) is Result.OK


def test_shuts_one_heartbeat_time_after_the_last_good_frame(armed):
    armed.status()
    accepted = armed.tick  # four ticks after chip select rose
    armed.pins_after(0)
    capture = armed.pins_after(HEARTBEAT_TICKS - 10)
    assert capture.ticks.size == 0
    capture = armed.pins_after(20)
    assert capture.ticks.tolist() == [accepted + HEARTBEAT_TICKS + 2]
    assert capture.hv.tolist() == [0]
    assert armed.status().faults == Fault.HOST_SILENT


def test_arming_glides_to_the_idle_word_and_disarming_back():
    host = Host().arm()
    capture = host.pins_after(0)
    assert capture.hv[0] == 1
    assert set(capture.words.tolist()) <= {0, IDLE}
    assert word_at(capture, host.tick) == IDLE
    rise = int(capture.ticks[0])
    up = [word_at(capture, rise + BIT_TICKS * n) == IDLE for n in range(RAMP_SAMPLES)]
    assert up == ramp_bits(RAMP_SAMPLES, up=True).tolist()
    host.send(frames.pack_control, Control.DISARM)
    assert State.RAMPING in host.status().state or RAMP_SAMPLES * BIT_TICKS < 32 * TICKS_PER_BYTE
    capture = host.pins_after(RAMP_SAMPLES * BIT_TICKS + 10)
    assert (capture.words[-1], capture.hv[-1]) == (0, 0)
    assert host.status().state == ON


def test_disarming_drops_what_plays_and_what_waits(armed):
    armed.send(frames.pack_play, 0, count=0, period_ticks=5000)
    armed.trigger()
    armed.send(frames.pack_play, 0)
    armed.send(frames.pack_control, Control.DISARM)
    armed.pins_after(1000)
    assert armed.status().state == ON
    armed.trigger()
    assert armed.pins_after(10_000).words.size == 0


def test_inputs_in_the_past_are_refused():
    model = GatewareModel(1_000_000, 2, HASH, HEARTBEAT_TICKS)
    model.advance(1000)
    with pytest.raises(ValueError, match="TRIGGER for tick 502 after"):
        model.trigger(500)


def test_knows_when_it_has_next_something_to_do(armed):
    armed.send(frames.pack_play, 0, count=2, period_ticks=900)
    assert armed.model.next_change() == armed.tick  # carrying out the frame
    start = armed.trigger()
    armed.model.advance(start)
    changes = []
    for _ in range(3):
        changes.append(armed.model.next_change())
        armed.model.advance(changes[-1] + 1)
    state = start - 3  # of the player, before its way to the pins
    assert changes == [state + 299, state + 302, state + 899]
    assert GatewareModel(1_000_000, 2, HASH, HEARTBEAT_TICKS).next_change() is None


@given(st.integers(1, 4000))
def test_the_ramp_is_full_scale_at_its_end_and_its_density_follows_a_straight_line(samples):
    bits = ramp_bits(samples, up=True).astype(float)
    line = np.arange(1, samples + 1) / samples
    # second-order shaping keeps the running sum of bit - line within a few samples; a density 1 % off would leave it
    drift = np.abs(np.cumsum(bits - line))
    assert drift.max() < 12
    assert ramp_bits(samples, up=False).sum() == pytest.approx(samples / 2, abs=12)


def test_the_low_passed_ramp_is_smooth_and_its_audible_part_below_that_of_a_first_order_one():
    samples, bit_clock_hz = 5000, 500e3
    line = np.arange(1, samples + 1) / samples
    first_order = np.diff(np.floor(np.cumsum(line)), prepend=0.0)
    smooth = np.hanning(121) / np.hanning(121).sum()  # about 8 kHz
    error = ramp_bits(samples, up=True) - line
    assert np.abs(np.convolve(error, smooth, "valid")).max() < 0.05

    def audible(error):
        spectrum = np.abs(np.fft.rfft(error, 8 * samples)) ** 2
        frequency_hz = np.fft.rfftfreq(8 * samples, 1 / bit_clock_hz)
        return spectrum[(frequency_hz > 2e3) & (frequency_hz < 16e3)].sum()

    assert audible(error) < audible(first_order - line) / 2


def test_the_errors_of_the_ramp_stay_within_their_limit_where_the_loop_has_no_headroom():
    for samples in (1, 2, 3, 100, 5000):
        _, errors = modulate(range(1, samples + 1), samples)
        assert all(abs(error) <= 1.5 * samples for error in errors)
