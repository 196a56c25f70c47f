"""Arming, ramps, disarming and every cause of a fault in the gateware model.

SHORT_PULSE and LONG_EMISSION stand behind what registers and PLAY refuse already: test_limits.py has them.
"""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from model_host import (
    ARMED,
    BIT_TICKS,
    HASH,
    HEARTBEAT_TICKS,
    IDLE,
    ON,
    PARAMETERS,
    RAMP_SAMPLES,
    SETTLE_TICKS,
    WORDS,
    Host,
    T,
    word_at,
)
from tables import each_row

from controller.device.fpga import frames
from controller.device.fpga.frames import Play
from controller.device.fpga.registers import DUTY_FULL, Control, Fault, Register, Result, Start, State
from controller.workshop.gateware.gateware import Permit
from controller.workshop.gateware.model.edge_counts import PARTS, part_ticks, turn
from controller.workshop.gateware.model.limits import TURN_TICKS
from controller.workshop.gateware.model.pins import modulate, ramp_bits

RAMP_TICKS = RAMP_SAMPLES * BIT_TICKS
SHUT_TICKS = 3  # from a permit pin to the pins
# of the channels that idle high
RAMP_EDGES = 16 * int(np.abs(np.diff(ramp_bits(RAMP_SAMPLES, up=True).astype(int), prepend=0)).sum())
TOGGLING = np.array([IDLE, ~IDLE & 0xFFFFFFFF] * 15, np.uint32)


def test_arming_needs_to_be_unlocked_by_the_frame_directly_before(host):
    host.settings()
    host.send(frames.pack_unlock, HASH)
    host.status()
    assert host.control(Control.ARM) is Result.LOCKED
    host.send(frames.pack_unlock, HASH)
    host.exchange(b"damaged")
    assert host.control(Control.ARM) is Result.LOCKED
    host.send(frames.pack_unlock, HASH + 1)
    assert host.control(Control.ARM) is Result.LOCKED
    assert State.HV_ENABLE not in host.status().state
    assert host.unlock_and_arm() is Result.OK
    assert host.control(Control.ARM) is Result.LOCKED, "once"
    assert host.unlock_and_arm() is Result.ARMED


@each_row("permits", [(), (Permit.RUN,), (Permit.TEMPERATURE,)])
def test_arming_needs_both_permits(permits):
    host = Host(permits=permits)
    host.settings()
    assert host.unlock_and_arm() is Result.NO_PERMIT
    capture = host.pins_after(10_000)
    assert not capture.hv.any()
    assert not capture.words.any()
    state = host.status().state
    assert (State.RUN_PERMIT in state, State.TEMPERATURE_GOOD in state) == (Permit.RUN in permits, Permit.TEMPERATURE in permits)


def test_arming_glides_to_the_idle_word_and_disarming_back(host):
    host.arm(RAMP_SAMPLES=500)
    ramp_ticks = 500 * BIT_TICKS
    capture = host.pins_after(ramp_ticks)
    assert capture.hv[0] == 1
    assert set(capture.words.tolist()) <= {0, IDLE}
    assert word_at(capture, host.tick) == IDLE
    rise = int(capture.ticks[0]) + SETTLE_TICKS
    assert capture.words[capture.ticks < rise].tolist() == [0]
    up = [word_at(capture, rise + BIT_TICKS * n) == IDLE for n in range(500)]
    assert up == ramp_bits(500, up=True).tolist()
    host.send(frames.pack_control, Control.DISARM)
    disarmed = host.tick
    state = host.status().state
    assert State.RAMPING in state
    assert State.ARMED not in state
    capture = host.pins_after(ramp_ticks + 10)
    assert (capture.words[-1], capture.hv[-1]) == (0, 0)
    assert host.status().state == ON
    assert capture.ticks[-1] - disarmed == pytest.approx(ramp_ticks + 6, abs=2)


def test_nothing_plays_during_a_ramp(host):
    host.settings(RAMP_SAMPLES=5000)
    host.store(0)
    assert host.unlock_and_arm() is Result.OK
    assert State.RAMPING in host.status().state
    assert host.result(frames.pack_play, Play(0)) is Result.NOT_ARMED
    host.pins_after(5000 * BIT_TICKS)
    host.play()
    host.send(frames.pack_control, Control.DISARM)
    assert host.result(frames.pack_play, Play(0)) is Result.NOT_ARMED
    host.trigger()
    assert set(host.pins_after(5000 * BIT_TICKS).words.tolist()) <= {0, IDLE}
    assert host.status().state == ON


def test_disarming_on_the_way_up_turns_back_from_where_it_has_come_to(host):
    host.settings(RAMP_SAMPLES=5000)
    assert host.unlock_and_arm() is Result.OK
    host.pins_after(5000)
    host.send(frames.pack_control, Control.DISARM)
    turned = host.tick
    capture = host.pins_after(20_000)
    assert (capture.words[-1], capture.hv[-1]) == (0, 0)
    reached = turned - int(turned - 5000 - 3474)
    assert capture.ticks[-1] - turned < reached + 50 < 5000 * BIT_TICKS, "no longer down than up"
    assert host.status().state == ON


@pytest.mark.parametrize("offset", range(BIT_TICKS))
def test_disarming_in_the_middle_of_a_word_lets_that_word_end_and_no_focus_comes(armed, offset):
    armed.play()
    disarm = armed.packed(frames.pack_control, Control.DISARM)
    carried_out = armed.tick + 5 + len(disarm) * 48 + 4
    armed.model.trigger(carried_out - 9 - 7 * BIT_TICKS - offset)  # in its eighth word
    armed.exchange(disarm)
    start = carried_out - 7 * BIT_TICKS - offset
    capture = armed.pins_after(5000)
    shown = capture.words.tolist()
    played = shown[: shown.index(IDLE)]
    assert played == WORDS[: len(played)].tolist()
    assert len(played) in {8, 9}, "what the state is at, four ticks before the pins"
    idle_from = int(capture.ticks[len(played)])
    assert idle_from == start + len(played) * BIT_TICKS, "the last one is held for its whole bit period"
    assert capture.ticks[len(played) + 1] >= idle_from + BIT_TICKS
    assert capture.focus_ticks.size == 0
    assert (capture.words[-1], capture.hv[-1]) == (0, 0)
    assert (armed.status().emissions, armed.status().state) == (0, ON)


def test_disarming_drops_what_plays_and_what_waits(armed):
    armed.play(emissions=0, period_ticks=5000)
    armed.trigger()
    armed.play()
    armed.play(start=Start.NOW, when_ticks=1000)
    armed.control(Control.DISARM)
    armed.pins_after(1000)
    status = armed.status()
    assert (status.state, status.queued) == (ON, 0)
    armed.trigger()
    assert armed.pins_after(10_000).words.size == 0


@pytest.mark.parametrize(
    ("permit", "fault"), [(Permit.RUN, Fault.NO_PERMIT), (Permit.TEMPERATURE, Fault.OVER_TEMPERATURE)], ids=["run", "temperature"]
)
def test_shuts_when_a_permit_goes_and_stays_so_until_cleared(armed, permit, fault):
    armed.play()
    armed.play()
    start = armed.trigger()
    lost = start + 42
    armed.model.permit(lost, level=False, which=permit)
    armed.model.permit(lost + 1, level=True, which=permit)
    capture = armed.pins_after(1000)
    assert (capture.ticks[-1], capture.words[-1], capture.hv[-1]) == (lost + SHUT_TICKS, 0, 0)
    assert capture.focus_ticks.size == 0
    status = armed.status()
    assert (status.faults, status.state, status.emissions, status.queued) == (fault, ON, 0, 0)
    assert armed.unlock_and_arm() is Result.FAULTED
    assert armed.result(frames.pack_play, Play(0)) is Result.FAULTED
    assert armed.read(Register.FAULT) == fault
    assert armed.read(Register.FAULT_COUNT) == 1
    assert armed.read_time(Register.FAULT_TIME_LOW) == lost + 2
    assert armed.control(Control.CLEAR) is Result.OK
    assert armed.read(Register.FAULT) == 0
    assert armed.read(Register.FAULT_COUNT) == 1, "is kept"
    assert armed.unlock_and_arm() is Result.OK


def test_both_permits_lost_at_once_are_both_reported(armed):
    for permit in Permit:
        armed.model.permit(armed.tick, level=False, which=permit)
    armed.tick += 10
    assert armed.status().faults == Fault.NO_PERMIT | Fault.OVER_TEMPERATURE
    assert armed.read(Register.FAULT_COUNT) == 1


def test_a_permit_missing_while_disarmed_is_no_fault(host):
    host.model.permit(host.tick, level=False)
    host.tick += 1000
    assert host.status().faults == Fault(0)


def test_shuts_one_heartbeat_time_after_the_last_good_frame(armed):
    armed.status()
    accepted = armed.tick
    capture = armed.pins_after(HEARTBEAT_TICKS - 10)
    assert capture.ticks.size == 0
    capture = armed.pins_after(20)
    assert capture.ticks.tolist() == [accepted + HEARTBEAT_TICKS + 2]
    assert capture.hv.tolist() == [0]
    assert armed.status().faults == Fault.HOST_SILENT


def test_damaged_frames_do_not_keep_the_heart_beating(armed):
    for _ in range(HEARTBEAT_TICKS // 1737 + 2):
        frame = bytearray(armed.packed(frames.pack_nop))
        frame[-1] ^= 1
        armed.exchange(bytes(frame))
    assert armed.status().faults == Fault.HOST_SILENT


def test_a_channel_with_more_edges_in_a_window_than_its_stage_takes_is_named(host):
    parameters = replace(PARAMETERS, edge_window_ticks=1 << 40)  # one window: the sum of all
    host = Host(parameters).arm(CHANNEL_EDGES=50)
    words = np.where(np.arange(30) % 2, IDLE ^ 1 << 9, IDLE).astype(np.uint32)  # channel 9 alone moves: 29 edges
    host.store(0, words)
    host.pins_after(0)
    host.play(length=29)
    host.trigger()
    host.pins_after(1000)
    assert host.status().faults == Fault(0)
    host.play()
    start = host.trigger()
    capture = host.pins_after(1000)
    status = host.status()
    assert (status.faults, status.emissions) == (Fault.CHANNEL_EDGES, 1)
    assert host.read(Register.FAULT_CHANNELS) == 1 << 9
    over = 51 - 28 - RAMP_EDGES // 16  # the first edge too many of this emission, whose first word has none
    seen = turn(start + BIT_TICKS * over, 9)
    assert capture.ticks[-1] == seen + TURN_TICKS + 1
    assert (capture.words[-1], capture.hv[-1]) == (0, 0)
    host.control(Control.CLEAR)
    assert host.read(Register.FAULT_CHANNELS) == 0


@pytest.mark.parametrize(("limit", "fault"), [(32 * 30 + RAMP_EDGES, Fault(0)), (32 * 30 + RAMP_EDGES - 1, Fault.TOTAL_EDGES)])
def test_all_channels_together_with_more_edges_than_the_supply_takes_are_a_fault(limit, fault):
    host = Host(replace(PARAMETERS, edge_window_ticks=1 << 40)).arm(TOTAL_EDGES=limit)
    host.store(0, TOGGLING)  # begins with the idle word: 29 times all channels, and once more back to it
    host.play()
    host.trigger()
    host.pins_after(1000)
    status = host.status()
    assert status.faults == fault
    assert status.emissions == 1, "the edge too many is the one behind it"


def test_edges_are_forgotten_with_their_window():
    host = Host(replace(PARAMETERS, edge_window_ticks=20_000)).arm(CHANNEL_EDGES=40)
    host.store(0, TOGGLING)
    for _ in range(6):
        host.play()
        host.tick += PARTS * part_ticks(20_000)  # 30 edges each time
        host.trigger()
        host.tick += 1000
    assert host.status().faults == Fault(0)
    host.play()
    host.play()
    host.tick += PARTS * part_ticks(20_000)
    host.trigger()
    host.tick += 19_000  # a window of 20,000 ticks that slides holds both
    host.trigger()
    host.tick += 1000
    status = host.status()
    assert (status.faults, status.emissions) == (Fault.CHANNEL_EDGES, 7)


@each_row(("share", "budget", "emissions"), [(DUTY_FULL, 2 * T, 6), (DUTY_FULL // 2, 2 * T, 4), (0, 2 * T, 2)])
def test_more_emission_than_the_duty_allows_is_a_fault(share, budget, emissions):
    """Back to back, so that the bucket fills at one less its share: it holds two emissions, and what drains meanwhile."""
    host = Host()
    host.settings(DUTY_SHARE=share, DUTY_TICKS=budget + 2 * RAMP_TICKS)
    assert host.unlock_and_arm() is Result.OK
    host.tick += RAMP_TICKS
    host.store(0)
    level = host.read(Register.DUTY_LEVEL)
    assert level == (RAMP_TICKS if share == 0 else 0), "what the ramp left of it"
    host.play(emissions=6, period_ticks=T)
    host.trigger()
    host.pins_after(10 * T)
    status = host.status()
    assert status.faults == (Fault(0) if emissions == 6 else Fault.DUTY)
    if share == DUTY_FULL // 2:
        assert status.emissions == (budget + 2 * RAMP_TICKS) * 2 // T
    else:
        assert status.emissions == emissions


def test_the_bucket_drains_while_nothing_plays(host):
    host.settings(DUTY_SHARE=DUTY_FULL // 4, DUTY_TICKS=3 * T)
    assert host.unlock_and_arm() is Result.OK
    host.store(0)
    assert host.read(Register.DUTY_LEVEL) == 0
    for _ in range(5):
        host.play(emissions=3, period_ticks=T)
        host.trigger()
        host.tick += 4 * T
        capture = host.pins_after(0)
        level = host.model._gate.limits.duty_level(host.tick - T)  # right after the third
        assert level == pytest.approx(3 * T * 3 / 4, abs=10)
        host.pins_after(3 * 3 * T)
        assert host.read(Register.DUTY_LEVEL) == 0
    assert host.status().faults == Fault(0)
    assert capture.hv.all()


def test_a_fault_at_the_end_of_an_emission_takes_its_focus(armed):
    armed.play()
    start = armed.trigger()
    armed.model.permit(start + T - SHUT_TICKS, level=False)
    capture = armed.pins_after(1000)
    assert capture.focus_ticks.size == 0
    armed.model.permit(armed.tick, level=True)
    assert armed.status().emissions == 0
    armed.control(Control.CLEAR)
    assert armed.unlock_and_arm() is Result.OK
    armed.tick += RAMP_TICKS
    armed.play()
    start = armed.trigger()
    armed.model.permit(start + T - SHUT_TICKS + 1, level=False)
    assert armed.pins_after(1000).focus_ticks.tolist() == [start + T]


def test_slots_outlive_a_fault(armed):
    armed.model.permit(armed.tick, level=False)
    armed.model.permit(armed.tick + 1, level=True)
    armed.tick += 10
    armed.control(Control.CLEAR)
    assert armed.unlock_and_arm() is Result.OK
    armed.tick += RAMP_TICKS
    assert armed.status().state == ARMED
    armed.play()


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
