"""Times of pulses of a changing rate, against closed forms and against the integral of the rate."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tables import each_row

from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.device.scene.effects.effects import EffectTable
from controller.device.scene.effects.library import resolved
from controller.device.scene.effects.primitives import conflict
from controller.device.scene.effects.rhythms import pulse_times_ms, rhythm_of
from controller.device.scene.effects.trains import train_of
from controller.errors import ConfigError

BOARD = load_board(find_board("simulated"))


def sweep(rates, duration_ms, **more):
    return EffectTable(when="press", rate_envelope=tuple(rates), duration_ms=duration_ms, **more)


def test_a_constant_rate_is_the_train_of_that_rate():
    constant = train_of(EffectTable(when="press", rate_hz=80.0, duration_ms=200.0, phase=0.25))
    swept = train_of(sweep([(50.0, 80.0)], 200.0, phase=0.25))
    assert swept.pulses == constant.pulses == 16
    assert [swept.first_s + swept.after_s(pulse) for pulse in range(16)] == pytest.approx(
        [constant.first_s + constant.after_s(pulse) for pulse in range(16)]
    )


def test_a_linear_sweep_has_the_times_of_its_closed_form():
    """Phase f0 t + (f1 - f0) t² / 2 T = k."""
    times_s = np.array(pulse_times_ms([(0.0, 30.0), (400.0, 200.0)], 400.0, 0.0)) * 1e-3
    assert len(times_s) == 46
    assert 30 * times_s + (200 - 30) * times_s**2 / (2 * 0.4) == pytest.approx(np.arange(46), abs=1e-9)


@given(
    st.lists(st.tuples(st.integers(1, 400), st.floats(0.1, 500)), min_size=1, max_size=6),
    st.floats(1, 900),
    st.floats(0, 0.99),
)
def test_the_integral_of_the_rate_passes_a_whole_number_at_each_pulse(steps, duration_ms, phase):
    at_ms = np.cumsum([step for step, _ in steps]).tolist()
    rates = [(float(at), hz) for at, (_, hz) in zip(at_ms, steps, strict=True)]
    times_ms = pulse_times_ms(rates, duration_ms, phase)
    fine_ms = np.linspace(0, duration_ms, 200_001)
    rate_hz = np.interp(fine_ms, *np.array(rates).T)
    integral = np.concatenate([[0.0], np.cumsum((rate_hz[1:] + rate_hz[:-1]) / 2 * np.diff(fine_ms) * 1e-3)])
    assert np.interp(times_ms, fine_ms, integral) == pytest.approx(phase + np.arange(len(times_ms)), abs=1e-3)
    assert len(times_ms) - (integral[-1] - phase) == pytest.approx(0.5, abs=0.5 + 1e-3)
    assert all(before < after for before, after in pairwise(times_ms))
    assert all(0 <= at < duration_ms for at in times_ms)


def test_an_envelope_goes_over_the_pulses_and_silent_ones_are_left_out():
    effect = sweep([(0.0, 100.0)], 100.0, envelope=((0.0, 0.0), (100.0, 1.0)))
    assert [level for _, level in rhythm_of(effect)] == pytest.approx(np.arange(10) / 10)
    assert [level for _, level in train_of(effect).rhythm] == pytest.approx(np.arange(1, 10) / 10)


@each_row(
    ("effect", "said"),
    [
        (sweep([(0.0, 50.0), (0.0, 60.0)], 100.0), ".rate_envelope[1] = [0.0, 60.0] is not later than the point before, at 0 ms"),
        (sweep([(0.0, 50.0), (200.0, 60.0)], 100.0), ".rate_envelope goes on to 200 ms, but the train ends at 100 ms"),
        (sweep([(0.0, 50.0)], 81_000.0), ".rate_envelope makes more than 4,000 pulses in duration_ms = 81000: shorten it"),
        (sweep([(0.0, 1000.0)], 3.6e6), ".rate_envelope makes more than 4,000 pulses"),
        (sweep([(0.0, 1.0)], 100.0, phase=0.5), ".duration_ms = 100 is too short for an emission"),
        (sweep([(0.0, 10.0)], 300.0, envelope=((0.0, 0.0), (50.0, 1.0), (90.0, 0.0))), ".envelope is silent at each pulse of"),
        (EffectTable(when="press", rate_envelope=((0.0, 50.0),)), ".duration_ms is missing: it is needed for a train of changing"),
        (sweep([(0.0, 50.0)], 100.0, rate_hz=5.0), ".rate_envelope does not go with"),
    ],
)
def test_what_cannot_be_meant_is_refused(effect, said):
    assert conflict(effect).startswith(said)


def test_a_rate_above_the_duty_limit_is_refused_with_its_pulse():
    with pytest.raises(ConfigError, match=r"x\.rate_envelope: pulse \d+, at [\d.]+ ms, is [\d.]+ ms after the one before"):
        resolved("x", sweep([(0.0, 100.0), (100.0, 900.0)], 100.0), {}, BOARD)
