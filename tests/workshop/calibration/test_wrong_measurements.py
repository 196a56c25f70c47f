"""What a measurement that is wrong in the ways of real ones costs: the amplitude that a finger keeps on the plate measured.

The plate has free edges, Mindlin's theory and 1 % more stiffness; nothing that fits or interpolates knows of its modes. 250
scattered points, 30 dB; means over 50 places that were not measured, half of them 4 to 20 mm from an edge.
A bank of records that drift is one of the plate in the middle of the measurement, and is compared with that.
"""

import re

import numpy as np
import pytest
from small_plate import WHOLE
from threadpoolctl import threadpool_limits
from workshop.calibration.test_calibrated_bank import TrueModel
from workshop.calibration.true_plate import random_places

from controller.cli import main
from controller.errors import CalibrationError
from controller.workshop.calibration.interpolation.interpolate import interpolate
from controller.workshop.calibration.learning.learning import learn

CHANGED = {"edges": "free", "theory": "mindlin", "young_modulus_pa": 73.6e9}
AS_IT_IS = ""


def measured(folder, flaws, unit=None, points=250, mass_mg=None):
    arguments = [part for name, value in CHANGED.items() for part in ("--plate", f"{name}={value}")]
    assert (
        main(["calibrate", "simulate", str(folder), "--scattered", str(points), "--snr-db", "30", *arguments, *flaws.split()]) == 0
    )
    if unit is not None:
        file = folder / "measurement.toml"
        file.write_text(file.read_text().replace('unit = "m/s^2"', f'unit = "{unit}"').replace('unit = "m"', f'unit = "{unit}"'))
    if mass_mg is not None:
        file = folder / "measurement.toml"
        file.write_text(file.read_text().replace("[records]", f"[records]\nsensor_mass_mg = {mass_mg}"))
    with threadpool_limits(1, "blas"):
        learned = learn(folder, WHOLE)
        return learned, interpolate(WHOLE, learned.require())[0]


def halfway(flaws):
    """The plate in the middle of the measurement: all frequencies go with the root of the modulus."""
    drift = float((re.search(r"--drift-percent (\S+)", flaws) or [0, 0])[1]) / 100
    return CHANGED | {"young_modulus_pa": CHANGED["young_modulus_pa"] * (1 + drift / 2) ** 2}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("flaws", "least", "mass_mg"),
    [
        (AS_IT_IS, 0.98, None),
        ("--offset-mm 2 -1", 0.98, None),
        ("--rotation-deg 1.2", 0.98, None),
        ("--scale 1.01", 0.98, None),
        ("--mirror x --offset-mm 0.5 0", 0.98, None),
        ("--position-mm 0.2", 0.975, None),
        ("--position-mm 0.5", 0.95, None),
        ("--gain-percent 20", 0.97, None),
        ("--drift-percent 0.3", 0.97, None),
        ("--sensor-mass-mg 10", 0.97, None),
        ("--sensor-mass-mg 10", 0.97, 10.0),
        ("--offset-mm 2 0 --rotation-deg -1 --position-mm 0.3 --gain-percent 15 --drift-percent 0.2", 0.97, None),
    ],
)
def test_what_is_wrong_is_found_and_costs_next_to_nothing(tmp_path, capsys, flaws, least, mass_mg):
    learned, source = measured(tmp_path / "m", flaws, mass_mg=mass_mg)
    places_m = np.concatenate([random_places(WHOLE, 25, 20e-3), random_places(WHOLE, 25, 4e-3, 20e-3, seed=8)])
    true = TrueModel(WHOLE, **halfway(flaws)).responses(places_m, band_limited=True)
    signs = np.sign(source.responses(places_m, band_limited=True))
    kept = (signs * true).sum(axis=(1, 2)) / np.abs(true).sum(axis=(1, 2))
    errors = source.errors
    capsys.readouterr()
    print(
        f"| `{flaws}` | {kept.mean():.4f} ({kept[:25].mean():.4f}, {kept[25:].mean():.4f}) | {learned.frame.in_words()};"
        f" sensor {learned.chain.in_words()}; {errors.corrected} {np.sqrt((errors.errors**2).mean(axis=0)).round(6).tolist()}"
        f" ± {errors.deviation.round(6).tolist()}, drift {1e2 * errors.drift()[0]:.3f} %; unforeseen {errors.unforeseen} |"
    )
    assert kept.mean() >= least


@pytest.mark.slow
@pytest.mark.parametrize(
    ("flaws", "unit", "cause"),
    [
        ("--sensor-mass-mg 50", None, "the sensor's mass, [45]"),
        ("--sensor-mass-mg 300", None, "the sensor's mass, [23]"),
        ("--quantity m/s^2", "m/s", r"derivatives of what records.unit says \(once\)"),
        ("--quantity m", "m/s", r"integrals of what records.unit says \(once\)"),
    ],
)
def test_what_cannot_be_corrected_is_refused_with_its_cause(tmp_path, flaws, unit, cause):
    with pytest.raises(CalibrationError, match=cause) as refused:
        measured(tmp_path / "m", flaws, unit, 160)
    print(refused.value)
    assert "swapped" not in str(refused.value)
    assert "\n" not in str(refused.value)
