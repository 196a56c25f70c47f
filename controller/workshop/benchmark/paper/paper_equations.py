"""Rows of the paper's equations (1) to (7) and of its driver, from the board's constants alone."""

from __future__ import annotations

import numpy as np
from scipy.optimize import brentq

from controller.device.board.board import Board
from controller.device.board.relations.bending_waves import kirchhoff_wavelength_m
from controller.workshop.benchmark.paper.paper_row import Row
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
    duration_s, decay_s = waveform.duration_ms * 1e-3, plate.decay_time_s
    hz = modes.angular_frequency / (2 * np.pi)
    counted = np.count_nonzero((hz >= waveform.band_low_hz) & (hz < waveform.band_high_hz))
    shortest_m = kirchhoff_wavelength_m(plate, waveform.band_high_hz)
    channels = len(board.actuators)
    contrast = design.contrast(bandwidth_hz, tc_s, channels, duration_s, decay_s)
    return [
        Row.of("tc_ms", "Tc, eq. (2) (ms)", 19.5, tc_s * 1e3, "the same numbers in the same formula"),
        Row.of(
            "modes_per_khz",
            "modes counted in the band, per kHz (ms)",
            19.5,
            counted / bandwidth_hz * 1e3,
            "eq. (2) is the law for a large plate; held edges take away half a wave along them",
        ),
        Row.of("contrast_eq1", "contrast, eq. (1)", 24.0, contrast, "print garbled; read so that the paper's values give its 24"),
        Row.of(
            "contrast_bound",
            "bound of the contrast, √(B Tc)",
            31.0,
            design.contrast_bound(bandwidth_hz, tc_s),
            "eq. (1) with endless Q τ; over all points, so the paper's 29 outside the spot is not against it",
        ),
        Row.of(
            "wavelength_mm",
            "shortest wavelength, eq. (5) (mm)",
            10.0,
            shortest_m * 1e3,
            "eq. (5) at 70 kHz gives this, not the ≃ 10 printed",
        ),
        Row.of("resolution_mm", "resolution λ/2, eq. (3) (mm)", 5.0, design.half_wave_m(shortest_m) * 1e3, "follows from eq. (5)"),
        Row.of(
            "gate_us",
            "pulse at T, eq. (4) (µs)",
            7.0,
            design.gate_duration_s(waveform.band_high_hz) * 1e6,
            "the same formula; printed as 7",
        ),
        Row.of(
            "learning_points",
            "points to learn, pitch λ/2",
            None,
            design.learning_points(plate, shortest_m),
            "with eq. (5)'s own λ; the paper names no number (with its 10 mm: 1,243)",
        ),
        Row.of(
            "eq6_printed_uj",
            "energy, eq. (6) with the paper's A and Rs (µJ)",
            59.0,
            design.energy_j(plate, PAPER_AMPLITUDE_M, PAPER_SPOT_M) * 1e6,
            "eq. (6) as printed does not give 59; that needs Rs = 4.05 mm, near λ/2",
        ),
    ]


def driver_rows(board: Board) -> list[Row]:
    """Rows of one channel's R, L and C."""
    driver = board.driver
    centre_hz = 1 / (2 * np.pi * np.sqrt(driver.inductance_h * driver.capacitance_f))
    printed_hz = np.sqrt(3) / (2 * np.pi * driver.resistance_ohm * driver.capacitance_f)
    response = DriverResponse.of(driver)

    def above_half_power(hz: float) -> float:
        return float(np.abs(response.transfer(2j * np.pi * hz))) - HALF_POWER

    corner_hz = float(np.float64(brentq(above_half_power, centre_hz / 10, centre_hz * 10)))
    return [
        Row.of("driver_centre_khz", "driver: f0 (kHz)", 43.0, centre_hz * 1e-3, "the same formula"),
        Row.of("driver_width_khz", "driver: Δf as printed (kHz)", 69.0, printed_hz * 1e-3, "the same formula, √3 / (2π R C)"),
        Row.of(
            "driver_corner_khz",
            "driver: voltage on the piezo falls to −3 dB (kHz)",
            None,
            corner_hz * 1e-3,
            "the voltage sees a low-pass, not a band-pass: what is audible is kept out by the bits alone",
        ),
    ]
