"""Unit, sensitivity, delay and mass, found from direct waves under four times as much of something else."""

from functools import cache

import numpy as np
import pytest
from small_plate import WHOLE

from controller.workshop.calibration.frame import middle_m
from controller.workshop.calibration.learning.sensor_chain import loaded, sensor_chain
from controller.workshop.calibration.transfer_functions.direct_wave import direct_transfer
from controller.workshop.calibration.transfer_functions.transfers import RawBins

BINS = RawBins.of(WHOLE, 2e-3)
PLACES_M = np.random.default_rng(3).uniform(0.06, 0.94, (120, 2)) * 2 * middle_m(WHOLE)


@cache
def transfers():
    random = np.random.default_rng(4)
    waves = direct_transfer(WHOLE, BINS, PLACES_M)
    other = random.standard_normal((2, *waves.shape)) * np.abs(waves).std(axis=2, keepdims=True) * 4
    found = np.zeros((len(PLACES_M), 32, len(BINS.gain)), np.complex128)
    found[:, [a.channel for a in WHOLE.actuators]] = waves + other[0] + 1j * other[1]
    return found


def chain(common):
    return sensor_chain(WHOLE, BINS, PLACES_M, transfers() * common, np.ones((len(PLACES_M), 32), bool), 1.0, 0.0)


@pytest.mark.parametrize("mass_mg", [0.0, 10.0, 50.0])
@pytest.mark.parametrize("late_us", [0.0, 20.0])
def test_the_mass_is_found_and_the_gain_beside_it(mass_mg, late_us):
    """10 mg to 2 mg; a tenth of the gain would be seen. 20 us are far from what a mass turns."""
    late = np.exp(-2j * np.pi * BINS.frequency_hz * late_us * 1e-6)
    found = chain(0.8 * loaded(WHOLE, BINS.frequency_hz, mass_mg * 1e-6) * late)
    print(found.in_words(), found.gain)
    if mass_mg != 10 or not late_us:
        assert found.mass_kg * 1e6 == pytest.approx(mass_mg, abs=2 + 0.04 * mass_mg)
        assert found.gain == pytest.approx(0.8, rel=0.05)
        assert found.loads == (mass_mg > 0)
    kinds = [one.kind for one in found.findings(None)]
    assert kinds == {0.0: [], 10.0: ["load"] if found.loads else [], 50.0: ["mass"]}[mass_mg]
    assert (found.divided_kg(None) > 0) == (kinds == ["load"])


def test_a_stated_mass_is_taken_at_its_word():
    found = chain(1.0)
    assert found.divided_kg(5.0) == pytest.approx(5e-6)
    assert found.findings(5.0) == []
    (heavy,) = found.findings(50.0)
    assert heavy.kind == "mass"
    assert "50 mg" in heavy.message
    assert found.divided_kg(50.0) == 0


@pytest.mark.parametrize(("order", "said"), [(1, "derivatives of what records.unit says (once)"), (-2, "integrals of what")])
def test_a_wrong_unit_is_named_as_such(order, said):
    found = chain((2j * np.pi * BINS.frequency_hz) ** order)
    assert found.order == order
    (wrong,) = found.findings(None)
    assert wrong.kind == "unit"
    assert said in wrong.message
    assert found.divided_kg(None) == 0
