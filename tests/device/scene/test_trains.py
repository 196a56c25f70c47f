"""Trains: each pulse at its time, the last of those missed, nothing after the end, the envelope's amplitude."""

import math
from itertools import accumulate, pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tables import each_row

from controller.device.scene.effects.effects import EffectTable
from controller.device.scene.effects.trains import NO_PULSE, ActiveTrain, Train, silent, train_of

TENTH = ((0.0, 0.5), (0.1, 1.0))


def started(train, start_s=10.0, gain=1.0):
    return ActiveTrain(train, start_s, 0, ends_on_leave=True, gain=gain)


def felt(train, asked_s, start_s=10.0):
    """Pulses of a train that is asked at some times."""
    active = started(train, start_s)
    return [active.take(at_s)[0] for at_s in asked_s], active


@given(
    st.floats(0, 1e5),
    st.floats(0.5, 500),
    st.integers(1, 200),
    st.floats(0, 0.999),
    st.lists(st.integers(0, 210) | st.floats(0, 210), max_size=30),
)
def test_a_train_gives_the_last_of_the_pulses_that_are_due_each_at_most_once(start_s, rate_hz, pulses, phase, asked):
    """Asked at the very time of a pulse (a whole number) or between two."""
    train = Train(1.0, pulses, 1 / rate_hz, phase / rate_hz)
    first_s = start_s + phase / rate_hz
    times_s = [first_s + pulse * (1 / rate_hz) for pulse in range(pulses)]
    expected, taken = [], NO_PULSE
    asked_s = sorted(first_s + periods * (1 / rate_hz) for periods in asked)
    for at_s in asked_s:
        due = [pulse for pulse, time_s in enumerate(times_s) if pulse > taken and time_s <= at_s]
        taken = max(due, default=taken)
        expected.append(max(due, default=NO_PULSE))
    given, active = felt(train, asked_s, start_s)
    assert given == expected
    assert active.over == (taken == pulses - 1)
    if not active.over:
        assert active.next_s == times_s[taken + 1]


@given(
    st.floats(0, 1e5),
    st.lists(st.tuples(st.floats(1e-3, 2), st.sampled_from([0.0, 0.25, 0.5, 1.0])), min_size=1, max_size=60),
    st.lists(st.integers(0, 60) | st.floats(0, 120), max_size=30),
)
def test_a_rhythm_gives_the_last_of_the_pulses_that_are_due_and_sound_each_at_its_own_time(start_s, gaps, asked):
    gaps[-1] = gaps[-1][0], 0.5  # a rhythm that is silent throughout is refused
    whole = tuple(zip(accumulate(gap_s for gap_s, _ in gaps), (level for _, level in gaps), strict=True))
    train = train_of(EffectTable(when="press", pulses=tuple((at_s * 1e3, level) for at_s, level in whole)))
    rhythm = [pulse for pulse in whole if pulse[1]]  # what is silent is no pulse
    assert train.pulses == len(rhythm)
    assert train.period_s == pytest.approx(min([after - before for (before, _), (after, _) in pairwise(rhythm)], default=3600.0))
    active = started(train, start_s)
    times_s = [active.first_s + train.after_s(pulse) for pulse in range(len(rhythm))]
    assert times_s == pytest.approx([start_s + at_s for at_s, _ in rhythm])
    taken = NO_PULSE
    for at_s in sorted(times_s[min(at, len(rhythm) - 1)] if isinstance(at, int) else start_s + at for at in asked):
        due = [pulse for pulse, time_s in enumerate(times_s) if pulse > taken and time_s <= at_s]
        taken = max(due, default=taken)
        assert active.take(at_s) == ((taken, rhythm[taken][1]) if due else (NO_PULSE, 0.0))
    assert active.over == (taken == len(rhythm) - 1)
    assert not silent(train)


@given(st.floats(0, 1e6), st.floats(0.1, 1000), st.integers(2, 500))
def test_a_train_asked_at_each_pulses_own_time_plays_them_all(start_s, rate_hz, pulses):
    active = started(Train(1.0, pulses, 1 / rate_hz), start_s)
    for pulse in range(pulses):
        assert active.take(active.next_s) == (pulse, 1.0)
    assert active.over


def test_the_hundredth_pulse_tells_a_rate_one_percent_off():
    right, wrong = (started(Train(1.0, 1000, 1 / rate_hz), 0.0) for rate_hz in (50.0, 50.5))
    assert right.take(2.0)[0] == 100
    assert wrong.take(2.0)[0] == 101


def test_rounding_of_the_pulse_does_not_add_up():
    active = started(Train(1.0, 1_000_000, 1 / 300), 0.0)
    active.take(3000.0)
    assert active.next_s == pytest.approx(900_001 / 300, abs=1e-12)


@given(st.integers(0, 40))
def test_an_envelope_is_linear_between_its_points_and_level_beyond_them(pulse):
    train = Train(1.0, 41, 0.01, 0.0, ((0.1, 0.4), (0.2, 1.0), (0.3, 0.5)))
    at_s = pulse * 0.01
    if at_s <= 0.1:
        expected = 0.4
    elif at_s <= 0.2:
        expected = 0.4 + 6 * (at_s - 0.1)
    else:
        expected = max(1.0 - 5 * (at_s - 0.2), 0.5)
    assert train.amplitude_of(pulse, 1.0) == pytest.approx(expected, abs=1e-9)


@each_row(
    ("level", "amplitude", "gain", "played"),
    [
        (1, 1, 1, 1),
        (0.5, 0.8, 1, 0.4),
        (1, 1, 0.3, 0.3),
        (0.5, 0.5, 0.5, 0.125),
        (0.051, 1, 1, 0.1),
        (0.049, 1, 1, 0),
        (0, 1, 1, 0),
    ],
)
def test_what_comes_below_the_weakest_amplitude_is_that_or_silence(level, amplitude, gain, played):
    assert Train(amplitude, 1, 0.0, 0.0, ((0.0, level),)).amplitude_of(0, gain) == pytest.approx(played)


def test_silent_pulses_are_passed_over_and_the_last_one_that_sounds_is_given():
    train = Train(1.0, 6, 0.1, 0.0, ((0.0, 1.0), (0.1, 0.5), (0.15, 0.0), (0.35, 0.0), (0.4, 1.0), (0.5, 0.0)))
    assert [round(train.amplitude_of(pulse, 1.0), 2) for pulse in range(6)] == [1.0, 0.5, 0.0, 0.0, 1.0, 0.0]
    assert felt(train, [10.35], 10.0)[0] == [1]
    assert felt(train, [10.15, 10.35, 11.0], 10.0)[0] == [1, NO_PULSE, 4]


def test_a_train_that_never_sounds_is_known():
    assert silent(Train(1.0, 3, 0.1, 0.0, ((0.05, 0.0), (0.06, 1.0), (0.07, 0.0))))
    assert not silent(Train(1.0, 3, 0.1, 0.0, ((0.05, 0.0), (0.09, 1.0), (0.12, 0.0))))


@given(st.floats(0.1, 500), st.integers(1, 1000), st.floats(0, 0.99))
def test_a_duration_holds_the_pulses_that_begin_within_it(rate_hz, pulses, phase):
    for length, expected in ((pulses - 0.001 + phase, pulses), (pulses + 0.001 + phase, pulses + 1)):
        effect = EffectTable(when="press", rate_hz=rate_hz, phase=phase, duration_ms=length / rate_hz * 1e3)
        assert train_of(effect).pulses == expected
        assert math.isclose(train_of(effect).first_s, phase / rate_hz)
    whole = EffectTable(when="press", rate_hz=rate_hz, duration_ms=pulses / rate_hz * 1e3)
    assert train_of(whole).pulses == pulses, "rounding gives none more"


@given(
    st.integers(1, 40),
    st.sampled_from([0.0, 0.01, 1 / 30, 0.1]),
    st.floats(0, 0.05),
    st.lists(st.tuples(st.floats(0, 2), st.sampled_from([0.0, 0.12, 0.13, 1.0])), min_size=1, max_size=8, unique_by=lambda p: p[0]),
)
def test_a_train_is_silent_if_each_of_its_pulses_is(pulses, period_s, first_s, envelope):
    train = Train(1.0, pulses, period_s, first_s, tuple(sorted(envelope)))
    assert silent(train) == (not any(train.amplitude_of(pulse, 1.0) for pulse in range(pulses)))


def test_of_a_million_pulses_only_those_beside_the_points_of_the_envelope_are_looked_at(monkeypatch):
    looked_at = []
    real = Train.amplitude_of
    monkeypatch.setattr(Train, "amplitude_of", lambda train, pulse, gain: looked_at.append(pulse) or real(train, pulse, gain))
    assert silent(Train(1.0, 1_000_000, 0.01, 0.0, ((0.0, 0.0), (0.011, 0.0), (0.015, 1.0), (0.019, 0.0))))
    assert len(looked_at) < 20
