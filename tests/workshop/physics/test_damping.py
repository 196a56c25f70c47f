"""Rates of decay of each mode: against closed forms, and a plate's free vibration on a dashpot solved as it is."""

import msgspec
import numpy as np
import pytest

from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.device.board.plate.plate import Damping, DecayAt, Foam
from controller.workshop.physics.damping import damped, decay_rates, foam_strips, strip_share
from controller.workshop.physics.modes.closed_form import SimplySupported
from controller.workshop.physics.modes.ritz_modes import RitzModes
from controller.workshop.physics.responses.driver import DriverResponse
from controller.workshop.physics.responses.step_response import StepResponse

BOARD = load_board(find_board("simulated"))
PLATE = msgspec.structs.replace(BOARD.plate, length_mm=70.0, width_mm=50.0)
MODES = SimplySupported.of(PLATE, 100e3)
ALL_FOAM = msgspec.structs.replace(PLATE, edges="foam", foam=Foam(stiffness_n_m3=1e8, width_mm=9.0, dashpot_pa_s_m=1.15e4))


class WithoutFactors:
    """The same modes, known by their shapes alone."""

    factors = None

    def __init__(self, modes):
        self._modes = modes

    def __getattr__(self, name):
        return getattr(self._modes, name)


def test_left_out_all_modes_decay_alike():
    assert np.array_equal(damped(MODES, PLATE).decay_rate, np.full(MODES.count, 1000.0))
    assert np.array_equal(damped(MODES, PLATE).angular_frequency, MODES.angular_frequency)


def test_a_table_is_straight_in_the_logarithms_and_level_beyond_its_ends():
    table = (DecayAt(frequency_hz=10e3, decay_time_ms=4.0), DecayAt(frequency_hz=40e3, decay_time_ms=1.0))
    plate = msgspec.structs.replace(PLATE, damping=Damping(decay_times=table))
    frequency = MODES.angular_frequency / (2 * np.pi)
    expected_ms = np.clip(4.0 * (10e3 / frequency), 1.0, 4.0)  # slope of -1 in logarithms
    assert decay_rates(MODES, plate) == pytest.approx(1e3 / expected_ms, rel=1e-12)
    assert decay_rates(MODES, plate) != pytest.approx(1e3 / np.clip(4.0 * (10.1e3 / frequency), 1.0, 4.0), rel=1e-3)


def test_a_loss_factor_adds_half_of_it_times_the_frequency():
    plate = msgspec.structs.replace(PLATE, damping=Damping(loss_factor=0.01))
    assert decay_rates(MODES, plate) == pytest.approx(1000.0 + 0.005 * MODES.angular_frequency, rel=1e-12)


def test_the_share_on_a_strip_is_that_of_the_closed_form_with_factors_or_without():
    strips = foam_strips(ALL_FOAM)
    assert sum((b - a) * (d - c) for a, b, c, d in strips) == pytest.approx(0.07 * 0.05 - 0.052 * 0.032, rel=1e-12)
    kx, ky = (MODES.factors.x_index + 1) * np.pi / 0.07, (MODES.factors.y_index + 1) * np.pi / 0.05

    def inside(k, extent, edge):  # of the mean square of a sine, between both edges
        return 1 - 2 * edge / extent + np.sin(2 * k * edge) / (k * extent)

    expected = 1 - inside(kx, 0.07, 9e-3) * inside(ky, 0.05, 9e-3)
    few = slice(0, None, 12)
    found = strip_share(MODES, strips, 7e-3)
    assert found == pytest.approx(expected, abs=1e-10)
    assert strip_share(WithoutFactors(MODES), strips, 7e-3)[few] == pytest.approx(expected[few], abs=1e-10)
    wider = msgspec.structs.replace(ALL_FOAM, foam=Foam(stiffness_n_m3=1e8, width_mm=9.1))
    assert strip_share(MODES, foam_strips(wider), 7e-3) != pytest.approx(expected, abs=1e-3)


def test_the_share_on_foam_of_solved_plates_is_that_of_their_shapes():
    plate = msgspec.structs.replace(ALL_FOAM, edges=msgspec.structs.replace(ALL_FOAM.sides, x0="free"))
    modes = RitzModes.of(plate, 12e3)
    found = strip_share(modes, foam_strips(plate), 20e-3)
    assert found == pytest.approx(modes.foam_share, abs=1e-6)  # splines have knots that Gauss does not know of
    per_area = plate.density_kg_m3 * plate.thickness_m
    assert decay_rates(modes, plate) == pytest.approx(1000 + 1.15e4 * found / (2 * per_area), rel=1e-6)


def test_only_sides_on_foam_have_strips():
    one = msgspec.structs.replace(
        ALL_FOAM, edges=msgspec.structs.replace(ALL_FOAM.sides, x0="free", x1="clamped", y0="simply_supported")
    )
    assert foam_strips(one) == [(0.0, 0.07, pytest.approx(0.041), 0.05)]
    assert foam_strips(PLATE) == []


def test_a_dashpot_takes_what_the_damped_plate_loses_in_the_median():
    """Against the eigenvalues of the quadratic problem with the whole matrix of the strip: first order is right where modes
    do not overlap, and here half of them do."""
    modes = SimplySupported.of(PLATE, 60e3)
    points, weights = [], []
    for a, b, c, d in foam_strips(ALL_FOAM):
        x, xw = (np.polynomial.legendre.leggauss(40)[i] for i in (0, 1))
        grid = np.array([(a + (b - a) * (1 + u) / 2, c + (d - c) * (1 + v) / 2) for u in x for v in x])
        points.append(grid)
        weights.append(np.outer(xw, xw).ravel() * (b - a) * (d - c) / 4)
    shapes = modes.shapes(np.concatenate(points))
    dashpot = 1.15e4 * (shapes.T * np.concatenate(weights)) @ shapes / modes.mass_kg
    count = modes.count
    free = msgspec.structs.replace(ALL_FOAM, decay_time_ms=10e3)
    state = np.block(
        [[np.zeros((count, count)), np.eye(count)], [-np.diag(modes.angular_frequency**2), -dashpot - 0.2 * np.eye(count)]]
    )
    poles = np.linalg.eigvals(state)
    exact = -poles.real[poles.imag > 2 * np.pi * 20e3]
    found = decay_rates(modes, free)[modes.angular_frequency > 2 * np.pi * 20e3]
    print(f"tau in ms, first order {1e3 / np.median(found):.3f}, exact {1e3 / np.median(exact):.3f}")
    assert found.sum() == pytest.approx(exact.sum(), rel=0.02)  # the trace; modes cross 20 kHz
    assert np.median(found) == pytest.approx(np.median(exact), rel=0.08)
    assert 1.05 * found.sum() != pytest.approx(exact.sum(), rel=0.02)


def test_modes_slower_than_their_decay_still_come_to_rest_where_they_should():
    plate = msgspec.structs.replace(PLATE, damping=Damping(decay_times=(DecayAt(frequency_hz=1e3, decay_time_ms=0.1),)))
    modes = damped(MODES, plate)
    assert np.count_nonzero(modes.decay_rate > modes.angular_frequency) >= 1
    step = StepResponse.of(modes, DriverResponse.of(BOARD.driver))
    assert np.all(step.poles.real < 0)
    at_once = step.static + step.by_mode(step.residues.real) + step.driver_residues.real.sum(1)
    assert at_once == pytest.approx(0.0, abs=1e-6 * abs(step.static).max())
