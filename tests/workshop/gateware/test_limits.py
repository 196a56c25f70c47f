"""The stage limits of the model against a reference that goes tick by tick, with plans that are replaced."""

from bisect import bisect_right
from dataclasses import asdict

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from limits_reference import NO_LIMITS, Inputs, limits_reference
from tables import each_row

from controller.workshop.gateware.model.activity_limits import (
    CHANNEL_EDGES,
    DUTY,
    LONG_EMISSION,
    SHORT_PULSE,
    TOTAL_EDGES,
    LimitSettings,
)
from controller.workshop.gateware.model.edge_counts import part_ticks, turn
from controller.workshop.gateware.model.limits import LATEST_TICKS, TOTAL_TICKS, TURN_TICKS, StageLimits

WINDOW_TICKS = 60
DAY_TICKS = 720  # more than 16 parts of 32
words = st.sampled_from([0, 1, 2, 3, 0x80000000, 0xFFFFFFFF]) | st.integers(0, 2**32 - 1)
plans = st.tuples(
    st.integers(0, 60) | st.integers(0, 350),  # begins this long after the plan before was made
    st.lists(st.tuples(st.integers(1, 30) | st.integers(1, 200), words), min_size=1, max_size=40),
)
limits = st.builds(
    LimitSettings,
    pulse_ticks=st.integers(0, 12),
    channel_edges=st.integers(0, 12) | st.just(2**24 - 1),
    total_edges=st.integers(0, 200) | st.just(2**32 - 1),
    emission_ticks=st.integers(0, 40),
    duty_share=st.sampled_from([0, 65536, 70000]) | st.integers(0, 65536),
    duty_ticks=st.integers(0, 30),
)


def reference(limit_settings, inputs):
    return limits_reference(inputs, asdict(limit_settings), WINDOW_TICKS)


@settings(deadline=None, max_examples=60)
@given(limits, st.lists(plans, max_size=8), st.lists(st.tuples(st.integers(1, 50), st.booleans()), max_size=8), st.data())
def test_every_tick_is_as_in_the_reference(limit_settings, shown, turns, data):
    """Random plans that replace earlier ones, with emissions, activity, clears and settling in between."""
    limits_ = StageLimits(limit_settings, WINDOW_TICKS)
    inputs = [Inputs() for _ in range(DAY_TICKS)]
    starts, at = {}, 1
    for wait, rows in shown:
        starts[at] = rows
        at += wait + 1
    emissions, activities = {}, {}
    tick = 0
    for wait, sounding in turns:
        tick += wait
        emissions[tick] = sounding
        activities[tick + data.draw(st.integers(-1, 3), label="activity")] = sounding
    clears = data.draw(st.sets(st.integers(0, DAY_TICKS - 1), max_size=3), label="clears")

    seen, foreseen = [], {}
    for now in range(DAY_TICKS):  # what is planned at `now` is on the pins from now + 1 on
        seen.append((limits_.cause(now), limits_.channels(now), limits_.duty_level(now)))
        if now in clears:
            limits_.clear(now)
        if now in starts:
            times = now + np.cumsum([wait for wait, _ in starts[now]])
            limits_.show(times.astype(np.int64), np.array([word for _, word in starts[now]], np.uint32))
            for (_, word), start in zip(starts[now], times.tolist(), strict=True):
                for later in inputs[start:]:
                    later.word = word
        if now + 1 in emissions:
            limits_.emission(now + 1, playing=emissions[now + 1])
            inputs[now].start |= emissions[now + 1]
            for later in inputs[now + 1 :]:
                later.emission = emissions[now + 1]
        if now + 1 in activities:
            limits_.activity(now + 1, active=activities[now + 1])
            for later in inputs[now + 1 :]:
                later.active = activities[now + 1]
        inputs[now].clear = now in clears
        foreseen[now] = limits_.next_change(now + 1)
        if now % 7 == 0:
            limits_.settle(now)
    expected = reference(limit_settings, inputs)
    assert seen == [(tick.cause, tick.channels, tick.duty_level) for tick in expected[:DAY_TICKS]]
    planned = max([*starts, *emissions, *activities], default=0)
    following = limits_.next_change(DAY_TICKS)
    for now in reversed(range(planned, DAY_TICKS)):
        assert foreseen[now] == following
        following = now if expected[now].cause else following


def test_channels_of_two_plans_that_trip_in_the_same_tick_are_all_known():
    """Channel 1 has an edge too many of the first plan as both channels make a short pulse with the second."""
    limits_ = StageLimits(LimitSettings(**NO_LIMITS | {"pulse_ticks": 11, "channel_edges": 2}), WINDOW_TICKS)
    limits_.show(np.array([16, 33, 68, 248]), np.array([0, 2, 0, 3], np.uint32))
    limits_.show(np.array([258]), np.array([0], np.uint32))
    assert (limits_.cause(260), limits_.channels(259), limits_.channels(260)) == (SHORT_PULSE | CHANNEL_EDGES, 0, 3)


def test_planned_words_that_never_come_do_not_count():
    """A fault cuts an emission after its first edges: its remaining plan is dropped, and the cut itself is checked."""
    limits_ = StageLimits(LimitSettings(channel_edges=3, total_edges=40), 1000)
    limits_.show(np.arange(10, 100, 10), np.array([1, 0, 1, 0, 1, 0, 1, 0, 1], np.uint32))
    assert limits_.next_change(0) == 67
    limits_.show(np.array([25]), np.array([0], np.uint32))
    assert limits_.next_change(0) is None
    limits_.show(np.array([300, 310]), np.array([1, 0], np.uint32))
    assert (limits_.cause(323), limits_.next_change(0)) == (CHANNEL_EDGES, 323)
    assert (limits_.channels(322), limits_.channels(323)) == (0, 1)
    limits_.show(np.array([300, 1000 + 16 * part_ticks(1000)]), np.array([1, 0], np.uint32))
    assert limits_.next_change(0) is None, "the second edge is beyond all parts of the first"


@settings(deadline=None, max_examples=40)
@given(
    st.lists(st.tuples(st.integers(1, 40) | st.integers(1, 3), words), max_size=60),
    st.integers(0, 700),
    st.integers(0, 20),
    st.integers(0, 80),
    st.sampled_from([60, 479, 480, 481, 700]),
)
def test_no_interval_of_a_window_has_more_edges_than_the_limit_wherever_it_begins(gaps, start, channel_edges, total_edges, window):
    """Or else the edge that is too many has its cause, by the reference, within the ticks that are promised."""
    inputs, word = [Inputs() for _ in range(start)], 0
    for wait, following in gaps:
        inputs += [Inputs(word) for _ in range(wait)]
        word = following
    inputs += [Inputs(word) for _ in range(LATEST_TICKS + 1)]
    seen = limits_reference(inputs, NO_LIMITS | {"channel_edges": channel_edges, "total_edges": total_edges}, window)
    edges = {channel: [] for channel in range(32)}
    every = []
    for tick in range(1, len(inputs) - LATEST_TICKS):
        change = inputs[tick].word ^ inputs[tick - 1].word
        every += [tick] * change.bit_count()
        if change and len(every) - bisect_right(every, tick - window) > total_edges:
            assert seen[tick + TOTAL_TICKS].cause & TOTAL_EDGES
        for channel, ticks in edges.items():
            if change >> channel & 1:
                ticks.append(tick)
                if len(ticks) - bisect_right(ticks, tick - window) > channel_edges:
                    at = turn(tick, channel) + TURN_TICKS
                    assert at <= tick + LATEST_TICKS
                    assert seen[at].cause & CHANNEL_EDGES


def test_twice_the_limit_across_the_end_of_a_window_is_too_many():
    """Which counting in windows at fixed times would allow."""
    for window in (480, 4800):
        for end in (window, 2 * window, 15 * part_ticks(window), 16 * part_ticks(window)):
            limits_ = StageLimits(LimitSettings(channel_edges=20, total_edges=20), window)
            limits_.show(np.arange(end - 20, end + 20), np.arange(1, 41, dtype=np.uint32) & 1)
            assert limits_.next_change(0) == end + 3
            assert limits_.cause(end + 3) == TOTAL_EDGES
            assert limits_.cause(end + 3 + 32) == CHANNEL_EDGES


@each_row(
    ("less", "cause", "at"),
    [
        ({"pulse_ticks": 11}, SHORT_PULSE, 22),
        ({"channel_edges": 1}, CHANNEL_EDGES, 35),
        ({"total_edges": 3}, TOTAL_EDGES, 23),
        ({"emission_ticks": 29}, LONG_EMISSION, 40),
        ({"duty_ticks": 29, "duty_share": 0}, DUTY, 41),
    ],
)
def test_each_limit_holds_at_its_value_and_trips_one_below(less, cause, at):
    just = {"pulse_ticks": 10, "channel_edges": 2, "total_edges": 4, "emission_ticks": 30, "duty_ticks": 30, "duty_share": 0}
    for values, expected in ((just, None), (just | less, at)):
        limits_ = StageLimits(LimitSettings(**values), 1000)
        limits_.show(np.array([10, 20]), np.array([3, 0], np.uint32))
        limits_.emission(10, playing=True)
        limits_.activity(10, active=True)
        limits_.emission(40, playing=False)
        limits_.activity(41, active=False)
        assert limits_.next_change(0) == expected
        assert limits_.cause(at) == (cause if expected else 0)


def test_a_new_share_counts_from_the_tick_it_is_set():
    limits_ = StageLimits(LimitSettings(duty_share=0, duty_ticks=100), 1000)
    limits_.activity(10, active=True)
    limits_.activity(50, active=False)
    assert limits_.duty_level(200) == 40
    limits_._settings.duty_share = 32768
    limits_.activity(200, active=False)
    assert [limits_.duty_level(tick) for tick in (199, 200, 202, 280, 300)] == [40, 40, 39, 0, 0]


def test_memory_stays_bounded_through_an_endless_repetition():
    limits_ = StageLimits(LimitSettings(**NO_LIMITS), 1_000_000)
    waveform = np.arange(1000, dtype=np.uint32)
    for start in range(0, 100_000_000, 320_000):
        limits_.emission(start, playing=True)
        limits_.activity(start, active=True)
        limits_.show(start + 160 * np.arange(1000), waveform)
        limits_.settle(start)
        assert len(limits_._plans) <= 3
        assert max(len(limits_._activity._emissions), len(limits_._activity._flows)) <= 3


def test_an_emission_of_1000_words_costs_little(benchmark):
    limits_ = StageLimits(LimitSettings(pulse_ticks=80, channel_edges=40_000, emission_ticks=170_000), 20_000_000)
    waveforms = np.repeat(np.random.default_rng(1).integers(0, 2**32, (8, 250), np.uint32), 4, axis=1)
    starts = iter(range(0, 10**12, 320_000))
    offsets = 160 * np.arange(1000)

    def emission():
        start = next(starts)
        limits_.emission(start, playing=True)
        limits_.activity(start, active=True)
        limits_.show(start + offsets, waveforms[start // 320_000 % 8])
        limits_.next_change(start)
        limits_.emission(start + 160_000, playing=False)
        limits_.activity(start + 160_000, active=False)
        limits_.show(np.array([start + 160_003]), np.zeros(1, np.uint32))
        limits_.next_change(start + 160_000)
        limits_.settle(start + 160_004)

    benchmark(emission)
