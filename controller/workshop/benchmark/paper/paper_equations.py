"""Rows of the paper's equations (1) to (7) and of its driver, from the board's constants alone."""

import numpy as np
from scipy.optimize import brentq

from controller.device.board.board import Board
from controller.device.board.relations.bending_waves import kirchhoff_wavelength_m
from controller.workshop.benchmark.paper.paper_row import Row, rows
from controller.workshop.physics.design import design
from controller.workshop.physics.modes.modes import Modes
from controller.workshop.physics.responses.driver import DriverResponse

HALF_POWER = 0.5**0.5
PAPER_AMPLITUDE_M, PAPER_SPOT_M = 7.68e-6, 5.2e-3


def constant_rows(board: Board, modes: Modes) -> list[Row]:
    """Rows of the plate and of eqs. (1) to (6)."""
    plate, waveform = board.plate, board.waveform
    tc_s = design.characteristic_time_s(plate)
    bandwidth_hz = waveform.band_high_hz - waveform.band_low_hz
    hz = modes.angular_frequency / (2 * np.pi)
    counted = np.count_nonzero((hz >= waveform.band_low_hz) & (hz < waveform.band_high_hz))
    shortest_m = kirchhoff_wavelength_m(plate, waveform.band_high_hz)
    return rows(
        {
            "tc_ms": tc_s * 1e3,
            "modes_per_khz": counted / bandwidth_hz * 1e3,
            "contrast_eq1": design.contrast(
                bandwidth_hz, tc_s, len(board.actuators), waveform.duration_ms * 1e-3, plate.decay_time_s
            ),
            "contrast_bound": design.contrast_bound(bandwidth_hz, tc_s),
            "wavelength_mm": shortest_m * 1e3,
            "resolution_mm": design.half_wave_m(shortest_m) * 1e3,
            "gate_us": design.gate_duration_s(waveform.band_high_hz) * 1e6,
            "learning_points": design.learning_points(plate, shortest_m),
            "eq6_printed_uj": design.energy_j(plate, PAPER_AMPLITUDE_M, PAPER_SPOT_M) * 1e6,
        }
    )


def driver_rows(board: Board) -> list[Row]:
    """Rows of one channel's R, L and C."""
    driver = board.driver
    centre_hz = 1 / (2 * np.pi * np.sqrt(driver.inductance_h * driver.capacitance_f))
    printed_hz = np.sqrt(3) / (2 * np.pi * driver.resistance_ohm * driver.capacitance_f)
    response = DriverResponse.of(driver)

    def above_half_power(hz: float) -> float:
        return float(np.abs(response.transfer(2j * np.pi * hz))) - HALF_POWER

    corner_hz = float(np.float64(brentq(above_half_power, centre_hz / 10, centre_hz * 10)))
    return rows(
        {"driver_centre_khz": centre_hz * 1e-3, "driver_width_khz": printed_hz * 1e-3, "driver_corner_khz": corner_hz * 1e-3}
    )
