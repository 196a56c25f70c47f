"""Errors of single points, found and corrected on a plate with free edges, which no prior knows."""

import numpy as np
import pytest
from small_plate import small_board
from workshop.calibration.true_plate import TruePlate

from controller.workshop.calibration.banks.bank_figures import _of_points
from controller.workshop.calibration.interpolation.interpolate import interpolate
from controller.workshop.calibration.interpolation.point_fit import PointFit
from controller.workshop.calibration.learned import LearnedResponses
from controller.workshop.calibration.point_plan import scattered_points

BOARD = small_board()
STATED_M = scattered_points(BOARD, 110, 3e-3)
DRIFT = 0.004  # from the first point to the last


@pytest.fixture(scope="module")
def plate():
    return TruePlate(BOARD, 1.6, edges="free", theory="mindlin")


def drifting(plate, actual_m):
    """Points measured while all frequencies rise, in steps: each step is a plate with another stiffness."""
    parts = []
    for some, off in zip(np.array_split(np.arange(len(actual_m)), 6), np.linspace(-0.5, 0.5, 6) * DRIFT, strict=True):
        young_pa = BOARD.plate.young_modulus_pa * (1 + off) ** 2
        parts.append(TruePlate(BOARD, 1.6, edges="free", theory="mindlin", young_modulus_pa=young_pa).learned(actual_m[some]))
    whole = {name: np.concatenate([getattr(one, name) for one in parts]) for name in ("responses", "known", "coherence", "noise")}
    return LearnedResponses(actual_m, **whole, bit_clock_hz=parts[0].bit_clock_hz, provenance=parts[0].provenance)


def stated(learned, gain=None):
    """As the files say it: at the stated places, with a sensor whose sensitivity is not that of the others."""
    responses = learned.responses if gain is None else (learned.responses * gain[:, None, None]).astype(np.float32)
    return LearnedResponses(**{**vars(learned), "points_m": STATED_M, "responses": responses})


@pytest.mark.slow
def test_places_gains_and_drift_are_found_together(plate):
    """0.4 mm in each axis, 20 %, 0.5 % from the first point to the last."""
    random = np.random.default_rng(4)
    actual_m = np.clip(STATED_M + random.normal(0, 0.4e-3, STATED_M.shape), 1e-4, (0.0699, 0.0499))
    gain = np.exp(random.normal(0, 0.2, len(STATED_M)))
    found, _ = interpolate(BOARD, stated(drifting(plate, actual_m), gain))
    errors = found.errors
    slope, deviation = errors.drift()
    of_places = np.corrcoef((actual_m - STATED_M).ravel(), errors.errors[:, :2].ravel())[0, 1]
    of_gains = np.corrcoef(np.log(gain), errors.errors[:, 2])[0, 1]
    print(f"places {of_places:.3f}, gains {of_gains:.3f} alike; drift {1e2 * slope:.3f} ± {1e2 * deviation:.3f} %")
    assert errors.corrected == ("places", "sensitivity", "frequencies")
    assert of_places > 0.9
    assert of_gains > 0.9
    assert slope == pytest.approx(1.2 * DRIFT, rel=0.12)  # in six steps, the first of which lasts for a sixth of the points
    assert errors.unforeseen[1] < 0.5 * errors.unforeseen[0]


def test_what_is_right_is_left_alone(plate):
    said = {}
    found, _ = interpolate(BOARD, plate.learned(STATED_M), progress=lambda what, *done: said.setdefault(what, []).append(done))
    for of_one in said.values():
        assert of_one == [(number + 1, len(of_one)) for number in range(len(of_one))]
    assert found.errors.corrected == ()
    assert not found.errors.errors.any()
    off = np.array([1.5e-3, 1.5e-3, 0.2, 0.0])
    figures = _of_points(PointFit(np.array([off, -off]), np.array([0.1e-3, 0.1e-3, 0.01, 1e-4]), ("places",), (0.2, 0.1)))
    assert (figures["places_mm"], figures["sensitivity_percent"]) == ([1.5, 0.1], [20.0, 1.0])
