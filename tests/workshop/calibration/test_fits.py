"""Constants of a plate from its measurements: decay and drift, against those it was made with."""

import msgspec
import numpy as np
import pytest
from small_plate import small_board
from workshop.calibration.true_plate import TruePlate

from controller.errors import CalibrationError
from controller.workshop.calibration.decay_fit import fit_decays
from controller.workshop.calibration.drift_fit import fit_drift
from controller.workshop.calibration.point_plan import scattered_points

BOARD = small_board()
POINTS_M = scattered_points(BOARD, 20, 3e-3)


@pytest.mark.parametrize("time_ms", [0.5, pytest.param(1.0, marks=pytest.mark.slow)])
def test_the_decay_is_that_of_the_plate(time_ms):
    """Within three standard deviations, which are 3 % at most."""
    learned = TruePlate(BOARD, 2.4, decay_time_ms=time_ms).learned(POINTS_M)
    found = fit_decays(learned.responses, learned.known, learned.noise, BOARD.waveform, learned.bit_clock_hz)
    print([f"{one.time_s * 1e3:.3f} +- {one.error_s * 1e3:.3f} ms" for one in found])
    assert len(found) == 5
    for one in found:
        assert one.error_s < 0.03e-3 * time_ms * 1.01
        assert abs(one.time_s - time_ms * 1e-3) < 3 * one.error_s + 0.01e-3 * time_ms
    untold = fit_decays(learned.responses, learned.known, np.full_like(learned.noise, np.nan), BOARD.waveform, learned.bit_clock_hz)
    assert [one.time_s for one in untold] == pytest.approx([one.time_s for one in found], rel=0.02)


def at_temperature(learned, temperature_c):
    provenance = msgspec.structs.replace(learned.provenance, temperature_c=temperature_c)
    return type(learned)(**{**vars(learned), "provenance": provenance})


@pytest.mark.parametrize(("ratio", "warm_c"), [(0.995, 40.0), pytest.param(1.002, 12.0, marks=pytest.mark.slow)])
def test_a_drift_is_found_to_a_hundredth_of_its_size(ratio, warm_c):
    """1 K of glass is some 1e-4 in frequency; the drivers do not drift, which is the hundredth."""
    cold = at_temperature(TruePlate(BOARD, 1.6).learned(POINTS_M), 20.0)
    plate = TruePlate(BOARD, 1.6, young_modulus_pa=BOARD.plate.young_modulus_pa * ratio**2)
    found = fit_drift(BOARD, cold, at_temperature(plate.learned(POINTS_M + 1e-4, seed=3), warm_c))
    print(f"{ratio}: {found}")
    assert found.frequency_ratio == pytest.approx(ratio, abs=max(3 * found.error, 1e-5))
    assert found.error < 1e-4
    coefficient, error = found.coefficient_per_k
    assert coefficient == pytest.approx((ratio - 1) / (warm_c - 20), rel=0.02)
    assert error < 0.02 * abs(coefficient)


def test_two_measurements_that_do_not_belong_together_are_refused():
    plate = TruePlate(BOARD, 1.0)
    here, random = plate.learned(POINTS_M), np.random.default_rng(2)
    with pytest.raises(CalibrationError, match="share 0 records"):
        fit_drift(BOARD, here, plate.learned(POINTS_M + 2e-3))
    other = type(here)(**{**vars(here), "responses": random.permutation(here.responses)})
    with pytest.raises(CalibrationError, match="not one plate"):
        fit_drift(BOARD, here, other)
    assert fit_drift(BOARD, here, here).coefficient_per_k is None
