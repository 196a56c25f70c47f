"""Constants of a plate from its measurements: decay and drift, against those it was made with."""

import json

import msgspec
import numpy as np
import pytest
from small_plate import WHOLE, small_board
from tables import each_row
from workshop.calibration.true_plate import TruePlate, random_places

from controller.cli import main
from controller.device.board.records import load_toml
from controller.errors import CalibrationError
from controller.workshop.calibration.fits.clock_fit import fit_clock
from controller.workshop.calibration.fits.decay_fit import fit_decays
from controller.workshop.calibration.fits.drift_fit import fit_drift
from controller.workshop.calibration.interpolation.wave_fit import lowest
from controller.workshop.calibration.point_plan import scattered_points
from controller.workshop.physics.responses.impulse_response import ResponseModel
from controller.workshop.tolerance.tolerances import SHIPPED, Tolerances, draw

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
    known, of_two = learned.known.copy(), learned.known.copy()
    known[::2, BOARD.actuators[0].channel] = False
    of_two[:, [actuator.channel for actuator in BOARD.actuators[2:]]] = False
    for some, off in ((known, 0.02), (of_two, 0.1)):
        fewer = fit_decays(learned.responses, some, learned.noise, BOARD.waveform, learned.bit_clock_hz)
        assert [one.time_s for one in fewer] == pytest.approx([one.time_s for one in found], rel=off)
        assert all(0 < one.error_s < np.inf for one in fewer)
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
    assert lowest(np.arange(4.0), np.ones(4)) == 1, "of what is flat there is no lowest"


@each_row(
    ("plate", "ratio"),
    [
        ({"thickness_mm": 1.015 * BOARD.plate.thickness_mm, "young_modulus_pa": 0.992 * BOARD.plate.young_modulus_pa}, 1.01093),
        ({"density_kg_m3": 1.05 * BOARD.plate.density_kg_m3, "length_mm": BOARD.plate.length_mm + 0.2}, 0.9731),
        ({}, 1.0),
    ],
)
def test_ten_points_tell_the_bit_clock_that_suits_a_plate(plate, ratio):
    """To the thousandth that costs 5 % of the amplitude; a modulus set by it keeps what the model had lost."""
    true, places = TruePlate(BOARD, 1.6, **plate), random_places(BOARD, 20, 5e-3)
    found = fit_clock(BOARD, true.learned(POINTS_M[:10], noise=0.03))
    set_right = msgspec.structs.replace(BOARD.plate, young_modulus_pa=found.young_modulus_pa)
    models = [ResponseModel(msgspec.structs.replace(BOARD, plate=one)) for one in (BOARD.plate, set_right)]
    before, after = (float(np.median(true.kept(model, places))) for model in models)
    print(f"{ratio}: {found.figures()}, kept {before:.3f}, then {after:.3f}")
    assert found.ratio == pytest.approx(ratio, abs=1e-3)
    assert found.error < 1e-3
    assert found.bit_clock_hz == pytest.approx(found.ratio * BOARD.waveform.bit_clock_hz)
    assert after > 0.9
    assert plate == {} or before < 0.6


def test_a_plate_that_no_bit_clock_makes_the_model_is_refused():
    with pytest.raises(CalibrationError, match=r"no bit clock within 5% makes the board's model alike to the plate"):
        fit_clock(BOARD, TruePlate(BOARD, 1.6, edges="free").learned(POINTS_M[:10]))
    learned = TruePlate(BOARD, 1.6).learned(POINTS_M[:1], missing=1.0)
    with pytest.raises(CalibrationError, match="0 responses are known of 1 points"):
        fit_clock(BOARD, learned)


@pytest.mark.slow
def test_the_command_finds_it_on_the_papers_plate(tmp_path, capsys):
    """1 % too thick, through records of 40 dB."""
    folder = str(tmp_path / "measured")
    thick = f"thickness_mm={1.01 * WHOLE.plate.thickness_mm}"
    assert main(["calibrate", "simulate", "--plate", thick, "--scattered", "10", folder]) == 0
    capsys.readouterr()
    assert main(["calibrate", "clock", folder, "--json"]) == 0
    figures = json.loads(capsys.readouterr().out)
    print(figures)
    assert figures["frequency_ratio"][0] == pytest.approx(1.01, abs=5e-4)
    assert figures["alike"] > 0.9
    assert figures["alike_before"] < 0.6


@pytest.mark.slow
def test_plates_of_a_production_are_set_right_by_ten_points(capfd):
    """Tolerances as shipped but for capacitance; 30 dB. What words of the model keep on each, at the weakest of 20 places."""
    tolerances, places = load_toml(SHIPPED, Tolerances), random_places(WHOLE, 20, 2e-2)
    weakest = []
    for number in range(10):
        drawn = draw(WHOLE, tolerances, 1, number)
        true = TruePlate(drawn.board, 2.0)
        learned = true.learned(scattered_points(WHOLE, 10, 2e-2, seed=number), noise=0.03, seed=number)
        learned.responses[:] *= drawn.gain
        found = fit_clock(WHOLE, learned)
        plate = msgspec.structs.replace(WHOLE.plate, young_modulus_pa=found.young_modulus_pa)
        there = true.model.responses(places, band_limited=True) * drawn.gain
        for board in (WHOLE, msgspec.structs.replace(WHOLE, plate=plate)):
            signs = np.sign(ResponseModel(board).responses(places, band_limited=True))
            weakest.append(((signs * there).sum(axis=(1, 2)) / np.abs(there).sum(axis=(1, 2))).min())
    before, after = np.array(weakest).reshape(-1, 2).T
    with capfd.disabled():
        print(f"\nbefore {np.median(before):.2f} (least {before.min():.2f}), then {np.median(after):.3f} (least {after.min():.3f})")
    assert after.min() > 0.94
    assert np.median(before) < 0.6
