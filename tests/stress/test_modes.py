"""Responses of modes: recursion against closed form, any damping, any driver, any length of transform."""

import dataclasses

import numpy as np
import pytest
from scipy.linalg import expm
from stress.boards import changed
from tables import each_row

from controller.workshop.physics.modes.closed_form import SimplySupported
from controller.workshop.physics.responses import modal_response
from controller.workshop.physics.responses.driver import DriverResponse
from controller.workshop.physics.responses.modal_response import (
    band_gain,
    band_limited_response,
    edge_width_hz,
    modes_at_once,
    pulse_response,
)
from controller.workshop.physics.responses.step_response import StepResponse

BAND_HZ = (20e3, 70e3)
BIT_S = 2e-6
SAMPLES = 1000


def step_response(board, decay_time_s, **driver):
    modes = SimplySupported.of(board.plate, 100e3)
    modes = dataclasses.replace(modes, decay_rate=np.full(modes.count, 1 / decay_time_s))
    return StepResponse.of(modes, DriverResponse.of(changed(board, driver=driver).driver))


def in_band(step, decay_time_s, monkeypatch, longest, band_hz=BAND_HZ):
    monkeypatch.setattr(modal_response, "LONGEST", longest)
    return band_limited_response(step, BIT_S, SAMPLES, band_hz, decay_time_s)


LONG = 1 << 22  # samples of a transform that holds all of a response
CASES = [  # decay time, what the driver differs in, modes, tolerance
    (2e-3, {}, slice(280, 310), 1e-6),
    (50e-3, {}, slice(285, 295), 1e-7),  # at the filter's upper corners
    pytest.param(50e-3, {}, slice(1395, 1405), 1e-7, marks=pytest.mark.stress),
    (
        1e-3,
        {"inductance_h": 0.5, "capacitance_f": 2e-11, "resistance_ohm": 100.0},
        slice(390, 400),
        1e-7,
    ),  # rings longer than the plate
]


@pytest.mark.parametrize(("decay_time_s", "driver", "modes", "tolerance"), CASES)
def test_split_at_the_poles_a_response_is_what_a_long_transform_gives(board, monkeypatch, decay_time_s, driver, modes, tolerance):
    step = step_response(board, decay_time_s, **driver).part(modes)
    whole = in_band(step, decay_time_s, monkeypatch, LONG)
    split = in_band(step, decay_time_s, monkeypatch, (1 << 15) if decay_time_s > 5e-3 or driver else (1 << 12))
    largest = np.abs(whole).max()
    assert np.abs(split - whole).max() <= tolerance * largest
    off = in_band(step_response(board, decay_time_s * 1.01, **driver).part(modes), decay_time_s, monkeypatch, LONG)
    assert np.abs(off - whole).max() > 20 * tolerance * largest or driver, "one per cent of damping would be seen"


@each_row("decay_time_s", [0.1e-3, 1e-3, 10e-3, 0.1, 1.0, 10.0, np.inf])
def test_any_damping_down_to_none_has_finite_responses_next_to_those_of_its_neighbour(board, decay_time_s):
    """Rings of 10 s would need a transform of 70 million samples for each mode."""
    some = slice(200, 1700, 50)
    found, near = (
        band_limited_response(step_response(board, tau_s).part(some), BIT_S, SAMPLES, BAND_HZ, tau_s)
        for tau_s in (decay_time_s, decay_time_s * 1.001 if decay_time_s < np.inf else 1e4)
    )
    assert np.isfinite(found).all()
    assert 0 < np.abs(found - near).max() < 2e-3 * np.abs(found).max()


def test_a_bin_of_the_transform_on_a_mode_without_damping_is_no_division_by_zero(board):
    """The frequency of a mode moved onto a bin, exactly."""
    step = step_response(board, np.inf).part(slice(700, 702))
    bin_hz = 1 / (1 << 15) / BIT_S
    on_bin = np.array([2j * np.pi * bin_hz * round(step.poles[0].imag / 2 / np.pi / bin_hz), step.poles[1]])
    at = dataclasses.replace(step, poles=on_bin)
    beside = dataclasses.replace(step, poles=on_bin + np.array([1e-3j, 0]))
    found, near = (band_limited_response(some, BIT_S, SAMPLES, BAND_HZ, np.inf) for some in (at, beside))
    assert np.abs(found - near).max() < 1e-5 * np.abs(found).max()


@pytest.mark.parametrize("decay_time_s", [1e-3, 10.0])
def test_blocks_of_modes_change_rounding_only(board, decay_time_s):
    step = step_response(board, decay_time_s).part(slice(600, 633))
    at_once = modes_at_once(step, BIT_S, SAMPLES, BAND_HZ, decay_time_s)
    assert 1 <= at_once <= 256
    whole = band_limited_response(step, BIT_S, SAMPLES, BAND_HZ, decay_time_s)
    parts = [band_limited_response(step.part(slice(n, n + 11)), BIT_S, SAMPLES, BAND_HZ, decay_time_s) for n in (0, 11, 22)]
    assert np.abs(np.concatenate(parts) - whole).max() <= 1e-14 * np.abs(whole).max()
    pulses = [pulse_response(step.part(slice(n, n + 11)), BIT_S, SAMPLES) for n in (0, 11, 22)]
    whole = pulse_response(step, BIT_S, SAMPLES)
    assert np.abs(np.concatenate(pulses) - whole).max() <= 1e-14 * np.abs(whole).max()


@each_row("band_hz", [(20e3, 70e3), (1e3, 5e3), (1e3, 1.2e3), (105e3, 125e3), (200e3, 400e3)])
def test_the_filter_passes_its_band_by_half_at_the_edges_and_nothing_at_rest(band_hz):
    low, high = band_hz
    gain = band_gain(np.array([0.0, low * 0.8, low, (low + high) / 2, high, high + edge_width_hz(band_hz) / 2]), band_hz)
    assert gain == pytest.approx([0, 0, 0.5, 1, 0.5, 0], abs=1e-9)
    assert edge_width_hz((20e3, 70e3)) == 8e3


def stepped(step, mode, modes, driver, count):
    """Displacement of a mode, sample by sample: states (q, dq/dt, voltage, current), times the matrix exponential of a bit."""
    omega, rate, mass_kg = modes.angular_frequency[mode], modes.decay_rate[mode], modes.mass_kg[mode]
    matrix = np.zeros((5, 5))
    matrix[0, 1] = 1
    matrix[1, :3] = -(omega**2), -2 * rate, 1 / mass_kg
    matrix[2, 3] = 1 / driver.capacitance_f
    matrix[3, 2:] = np.array([-1.0, -driver.resistance_ohm, 1.0]) / driver.inductance_h
    balance = np.diag([1, 1 / omega, mass_kg**-1 / omega**2, 1 / omega / driver.capacitance_f / mass_kg / omega**2, 1])
    held = expm(np.linalg.inv(balance) @ matrix @ balance * BIT_S)
    state, advance = held[:4, 4].copy(), held[:4, :4].copy()
    response = np.empty(count)
    for sample in range(count):
        response[sample] = state[0]
        state = advance @ state
    return response


@pytest.mark.parametrize("count", [20_000, pytest.param(1_000_000, marks=pytest.mark.stress)])
@pytest.mark.parametrize("mode", [7, 1200])
def test_a_million_samples_of_recursion_are_the_closed_form(board, mode, count):
    """A mode that rings for 10 s. Each step rounds by some 1e-16, and the steps add up: 1e-10 after a million, so 1e-9 is ample."""
    modes = SimplySupported.of(board.plate, 100e3)
    modes = dataclasses.replace(modes, decay_rate=np.full(modes.count, 0.1))
    step = StepResponse.of(modes, DriverResponse.of(board.driver))
    closed = pulse_response(step.part(slice(mode, mode + 1)), BIT_S, count)[0]
    recursive = stepped(step, mode, modes, board.driver, count)
    largest = np.abs(closed).max()
    assert np.abs(recursive - closed).max() <= 1e-9 * largest
    single = np.exp(np.float32(2) * np.float32(1e-6) * np.arange(count) * np.complex64(step.poles[mode]))
    assert np.abs(single - np.exp(step.poles[mode] * BIT_S * np.arange(count))).max() > 1e-7, "float32 would be noticed"
    slower = dataclasses.replace(modes, angular_frequency=modes.angular_frequency * (1 + 1e-6))
    off = pulse_response(StepResponse.of(slower, DriverResponse.of(board.driver)).part(slice(mode, mode + 1)), BIT_S, count)[0]
    assert np.abs(off - closed).max() > 1e-6 * largest, "so would a millionth of the frequency"
