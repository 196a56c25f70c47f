import msgspec
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.linalg import expm
from workshop.physics.steps import step_voltage

from controller.device.board.panel import Driver
from controller.workshop.physics.responses.driver import DriverResponse

PAPER = Driver(supply_v=60.0, resistance_ohm=2000.0, inductance_h=6.8e-3, capacitance_f=2e-9, moment_n_per_v=1e-3)
TIMES_S = np.array([0.3e-6, 2e-6, 7e-6, 30e-6, 200e-6])


def circuit_step(driver, time_s):
    """Capacitor voltage by the matrix exponential of the circuit: states (voltage, current), input 1 V."""
    matrix = np.zeros((3, 3))
    matrix[0, 1] = 1 / driver.capacitance_f
    matrix[1] = [-1 / driver.inductance_h, -driver.resistance_ohm / driver.inductance_h, 1 / driver.inductance_h]
    return expm(matrix * time_s)[0, 2]


@settings(max_examples=30, deadline=None)
@given(st.floats(50.0, 20e3))
def test_the_step_is_that_of_the_circuit_whatever_its_damping(resistance_ohm):
    driver = msgspec.structs.replace(PAPER, resistance_ohm=resistance_ohm)
    expected = [circuit_step(driver, t) for t in TIMES_S]
    assert step_voltage(DriverResponse.of(driver), TIMES_S) == pytest.approx(expected, abs=1e-9)


def test_critical_damping_which_has_no_partial_fractions_is_met_to_1e_9():
    critical = msgspec.structs.replace(PAPER, resistance_ohm=2 * (PAPER.inductance_h / PAPER.capacitance_f) ** 0.5)
    expected = [circuit_step(critical, t) for t in TIMES_S]
    assert step_voltage(DriverResponse.of(critical), TIMES_S) == pytest.approx(expected, abs=1e-9)


def test_a_coil_one_per_cent_off_is_noticed():
    off = msgspec.structs.replace(PAPER, inductance_h=PAPER.inductance_h * 1.01)
    expected = [circuit_step(PAPER, t) for t in TIMES_S]
    assert step_voltage(DriverResponse.of(off), TIMES_S) != pytest.approx(expected, abs=1e-4)


def test_the_transfer_function_is_the_voltage_divider_of_the_impedances():
    s = 2j * np.pi * np.array([0.0, 1e3, 43.16e3, 100e3])
    coil_and_resistor = PAPER.resistance_ohm + s * PAPER.inductance_h
    assert DriverResponse.of(PAPER).transfer(s) == pytest.approx(1 / (1 + s * PAPER.capacitance_f * coil_and_resistor))


def test_the_voltage_begins_at_zero_and_ends_at_that_of_the_stage():
    assert step_voltage(DriverResponse.of(PAPER), [0.0, 1.0]) == pytest.approx([0.0, 1.0])
