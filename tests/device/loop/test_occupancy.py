"""When the plate is free: by hand, and over random starts."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from controller.clocks import NEVER
from controller.device.fpga.clock_estimate import ClockEstimate
from controller.device.loop.playing.occupancy import MARGIN_S, Occupancy, Repetition

T_S = 2e-3
OFFSET_S, ERROR_S = 100.0, 5e-6


def occupancy(max_duty=1.0):
    estimate = ClockEstimate(80_000_000)
    estimate.offset_s, estimate.error_s = OFFSET_S, ERROR_S
    return Occupancy(estimate, T_S, max_duty)


def test_a_plate_that_has_not_played_is_free_and_a_command_may_start_as_it_arrives():
    assert occupancy().earliest_start_s(101.0, None) == 101.0
    assert occupancy().earliest_start_s(101.0, 100.5) == 101.0
    assert occupancy().earliest_start_s(101.0, 102.0) == 102.0


def test_the_clock_error_is_added_on_the_clock_that_did_not_start_the_emission():
    by_pin, by_clock = occupancy(), occupancy()
    by_pin.started(1.0, 101.0, by_clock=False)
    by_clock.started(1.0, 101.0, by_clock=True)
    assert (by_pin.free_s, by_clock.free_s) == (1.0 + T_S, 1.0 + T_S + ERROR_S)
    assert by_pin.earliest_start_s(101.0, None) == 101.0 + T_S + ERROR_S + MARGIN_S
    assert by_clock.earliest_start_s(101.0, None) == 101.0 + T_S + MARGIN_S


def test_a_stopped_repetition_plays_to_the_end_of_its_last_emission():
    plate = occupancy(max_duty=0.5)
    plate.started(1.0, 101.0, by_clock=True)
    plate.repetition = Repetition(101.0, 0.025)
    assert plate.next_repetition_s(1.03) == pytest.approx(1.05)
    plate.stop_repetition(1.06)
    assert plate.repetition is None
    assert plate.next_repetition_s(1.06) == NEVER
    assert plate.free_s == pytest.approx(1.05 + 2 * T_S + ERROR_S)


@given(
    st.lists(st.tuples(st.floats(0, 0.02), st.booleans(), st.floats(-0.01, 0.02)), max_size=30),
    st.sampled_from([1.0, 0.5, 0.1]),
    st.floats(0.9, 1.1),
)
def test_no_emission_starts_before_its_command_or_within_the_pause_of_the_former(steps, max_duty, scale):
    plate = occupancy(max_duty)
    plate.set_time_scale(scale)
    now_s, last_s = OFFSET_S, -NEVER
    for after_s, by_clock, wanted_s in steps:
        now_s += after_s
        at_s = now_s + wanted_s if by_clock else None
        start_s = plate.earliest_start_s(now_s, at_s)
        assert start_s >= now_s
        assert start_s >= plate.free_from_s(now_s)
        assert start_s >= last_s + T_S * scale / max_duty + MARGIN_S - 1e-9
        assert at_s is None or start_s >= at_s
        plate.started(start_s - OFFSET_S, start_s, by_clock=by_clock)
        last_s = start_s
    plate.reset()
    assert plate.earliest_start_s(now_s, None) == now_s
