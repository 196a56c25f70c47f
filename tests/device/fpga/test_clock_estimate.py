"""The clock estimate: its bound holds for every drift and delay, and it recovers from resets and jumps."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tables import each_row

from controller.device.fpga.clock_estimate import ClockEstimate

CLOCK_HZ = 80_000_000


def exchanges(drift, delays_s, every_s=0.033, start_ticks=1_000_000):
    """(before_s, after_s, ticks) of exchanges with these durations, whose frame is on the wire half way."""
    for number, delay_s in enumerate(delays_s):
        before_s = 5.0 + number * every_s
        at_s = before_s + delay_s / 2
        yield before_s, before_s + delay_s, start_ticks + round((at_s - 5.0) * (1 + drift) * CLOCK_HZ)


@given(st.floats(-200e-6, 200e-6), st.lists(st.floats(20e-6, 5e-3), min_size=1, max_size=60))
def test_the_true_time_is_within_the_error_it_states(drift, delays_s):
    estimate = ClockEstimate(CLOCK_HZ)
    for before_s, after_s, ticks in exchanges(drift, delays_s):
        estimate.add(before_s, after_s, ticks)
        true_s = (1_000_000 / CLOCK_HZ) + (after_s - 5.0) * (1 + drift)
        slack_s = 1 / CLOCK_HZ + 300e-6 * 5e-3
        assert abs(estimate.fpga_s(after_s) - true_s) <= estimate.error_s + slack_s
        assert estimate.host_s(estimate.fpga_s(after_s)) == pytest.approx(after_s, abs=1e-9)


def test_a_delayed_exchange_does_not_spoil_the_estimate():
    estimate = ClockEstimate(CLOCK_HZ)
    for exchange in exchanges(0.0, [40e-6] * 5):
        estimate.add(*exchange)
    known_s = estimate.error_s
    for exchange in list(exchanges(0.0, [40e-6] * 5 + [20e-3]))[5:]:
        estimate.add(*exchange)
    assert estimate.error_s < known_s + 20e-6
    assert estimate.error_s < 1e-3, "what 20 ms alone would have left"


def test_a_reset_of_the_fpga_restarts_the_estimate():
    estimate = ClockEstimate(CLOCK_HZ)
    estimate.add(10.0, 10.0001, 800_000_000)
    estimate.add(11.0, 11.0001, 8_000)
    assert estimate.fpga_s(11.0001) == pytest.approx(8_000 / CLOCK_HZ, abs=1e-4)


@each_row("jump_s", [-2e-3, 2e-3, 3600.0])
def test_a_jump_of_the_clock_is_followed_with_the_next_exchange(jump_s):
    """A host that was suspended, or an FPGA that was reset soon after power-up."""
    estimate = ClockEstimate(CLOCK_HZ)
    *before, last = exchanges(50e-6, [40e-6] * 20)
    for exchange in before:
        estimate.add(*exchange)
    before_s, after_s, ticks = last
    jumped = ticks + round(jump_s * CLOCK_HZ)
    estimate.add(before_s, after_s, jumped)
    assert abs(float(estimate.fpga_s((before_s + after_s) / 2)) - jumped / CLOCK_HZ) <= estimate.error_s
    assert estimate.error_s == pytest.approx(20e-6)


def test_a_time_is_rounded_to_the_nearest_tick():
    estimate = ClockEstimate(CLOCK_HZ)
    assert estimate.ticks(1.0) == CLOCK_HZ
    assert estimate.ticks(1.0 + 0.6 / CLOCK_HZ) == CLOCK_HZ + 1
