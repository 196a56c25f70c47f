"""The schedule's knowledge of its host: a running percentile in constant memory, and what follows from it."""

import math
import random

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from controller.device.loop.playing import host_timing
from controller.device.loop.playing.host_timing import (
    HANDOVER_S,
    MAX_S,
    PRIOR_S,
    PULSE_LEAD_S,
    QUICK_UP,
    SAID_AFTER,
    UP,
    HostTiming,
    RunningPercentile,
)
from controller.log import Event

SIGMA = math.log(4) / 2.3263  # of a log-normal distribution whose 99th percentile is four times its median
BITS_S, COMMAND_S, PLATE_S = 1.36e-3, 23e-6, 2e-3
durations_s = st.floats(0, 10, allow_nan=False)


def recorded(durations, **bounds):
    percentile = RunningPercentile(**bounds)
    for duration_s in durations:
        percentile.record(duration_s)
    return percentile


def lognormal_s(p50_s, count, seed=1):
    rng = random.Random(seed)
    return [p50_s * math.exp(SIGMA * rng.gauss(0, 1)) for _ in range(count)]


@given(st.lists(durations_s, max_size=300))
def test_the_percentile_stays_within_its_bounds(durations):
    percentile = RunningPercentile()
    for duration_s in durations:
        percentile.record(duration_s)
        assert PRIOR_S <= percentile.value_s <= MAX_S


@given(st.lists(durations_s, max_size=100), durations_s)
def test_a_record_above_raises_the_percentile_but_not_beyond_a_factor_and_one_below_does_not_raise_it(durations, last_s):
    percentile = recorded(durations)
    before_s = percentile.value_s
    percentile.record(last_s)
    if last_s > before_s:
        assert percentile.value_s == MAX_S or before_s < percentile.value_s <= before_s * QUICK_UP
    else:
        assert before_s * 0.99 <= percentile.value_s <= before_s


@given(st.floats(50e-6, 1.3e-3), st.integers(0, 5))
def test_one_record_of_a_hundred_exceeds_the_percentile_in_the_long_run(p50_s, seed):
    percentile = recorded(lognormal_s(p50_s, 1000, seed), least_s=1e-9)
    above = 0
    for duration_s in lognormal_s(p50_s, 5000, seed + 100):
        above += duration_s > percentile.value_s
        percentile.record(duration_s)
    assert 0.005 <= above / 5000 <= 0.016


@pytest.mark.parametrize("before", [0, 300])
def test_one_second_of_a_stall_hardly_changes_the_percentile(before):
    calm = recorded(lognormal_s(0.2e-3, before))
    stalled = recorded([*lognormal_s(0.2e-3, before), 1.0])
    assert stalled.value_s <= calm.value_s * (UP if before else QUICK_UP) * (1 + 1e-12)


def test_old_records_fade():
    percentile = recorded([5e-3] * 100)
    assert percentile.value_s > 4e-3
    for _ in range(1500):
        percentile.record(0.1e-3)
    assert percentile.value_s == PRIOR_S


def test_a_slow_host_is_known_after_some_ten_records():
    for p50_s in (0.14e-3, 0.55e-3, 1.3e-3):
        percentile = recorded(lognormal_s(p50_s, 40))
        assert 2 * p50_s < percentile.value_s < min(9 * p50_s, 1.01 * MAX_S)


def test_a_host_that_takes_no_time_keeps_the_shortest_lead():
    timing = HostTiming(BITS_S, COMMAND_S, PLATE_S)
    for _ in range(500):
        timing.woken(0.0)
        timing.uploaded(BITS_S + 3e-6)
        timing.command.record(COMMAND_S)
    assert timing.lead_s == BITS_S + PULSE_LEAD_S
    assert timing.upload.promised_s == BITS_S + HANDOVER_S
    assert timing.upload.expected_s == pytest.approx(BITS_S + 3e-6, abs=1e-9)
    assert timing.uploads_hz == pytest.approx(1 / PLATE_S)


@given(st.floats(0.1e-3, 1.5e-3), st.floats(0.0, 0.5e-3), st.floats(0.0, 0.3e-3))
def test_the_lead_covers_waking_deciding_composing_the_kernel_and_the_wire(p50_s, kernel_s, late_s):
    timing = HostTiming(BITS_S, COMMAND_S, PLATE_S)
    extra_s = [host_s + kernel_s for host_s in lognormal_s(p50_s, 800)]
    for one_s in extra_s:
        timing.woken(late_s)
        timing.uploaded(BITS_S + one_s)
    need_s = BITS_S + float(np.percentile(extra_s, 98)) + late_s
    assert min(need_s, BITS_S + MAX_S) <= timing.lead_s <= BITS_S + MAX_S
    assert timing.upload.expected_s == pytest.approx(BITS_S + float(np.mean(extra_s)), rel=0.35)
    assert timing.upload.expected_s < timing.upload.promised_s


def test_what_the_host_cannot_do_is_logged_once(monkeypatch):
    said = []
    monkeypatch.setattr(host_timing, "log", lambda message, about: said.append((message, about)))
    slow, fast = HostTiming(BITS_S, COMMAND_S, PLATE_S), HostTiming(BITS_S, COMMAND_S, PLATE_S)
    for _ in range(3 * SAID_AFTER):
        slow.decided_s = 0.2e-3
        slow.uploaded(BITS_S + 1.2e-3)
        fast.uploaded(BITS_S + 0.2e-3)
    assert said == [("this host reaches 363 emissions/s with a moving finger; the plate allows 500", Event.SLOW_HOST)]
    assert slow.figures()["uploads_hz"] == pytest.approx(362, abs=1)
