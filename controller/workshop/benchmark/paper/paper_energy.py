"""Rows of energy and power (paper, section IV-B, fig. 8, appendix B): of the plate over time, and in the stages' resistors."""

from typing import Any

import numpy as np

from controller.arrays import Floats
from controller.device.board.relations.bending_waves import bending_stiffness
from controller.workshop.benchmark.focus.focus_emission import emission_figures
from controller.workshop.benchmark.paper.paper_panel import PaperPanel
from controller.workshop.benchmark.paper.paper_row import Row, rows
from controller.workshop.physics.design import design
from controller.workshop.physics.field import Field
from controller.workshop.physics.responses.modal_history import Energy, modal_energy, modal_history

AFTER_S = 3e-3  # fig. 8 ends 3 ms after T
SCAN_M = 2e-3  # steps of the paper's vibrometer
SETTLED_S = 0.2e-3  # after T, from when on the decay is measured


def energy_over_time(panel: PaperPanel, index: int, after_s: float = AFTER_S) -> Energy:
    """Energy of the plate during one emission and after it, at the ends of the bits: (time,) each."""
    waveform = panel.board.waveform
    volts = panel.volts(panel.words[index], after=round(after_s / waveform.bit_period_s))
    blocks = [
        modal_energy(panel.modes, motion)
        for motion in modal_history(panel.twin.step, panel.twin.forces, volts, waveform.bit_period_s)
    ]
    return Energy(*(np.concatenate(some) for some in zip(*blocks, strict=True)))


def energy_rows(panel: PaperPanel, energies: list[Energy]) -> list[Row]:
    """Rows of the energy at T, of its decay, and of power. `energies` are those of the first foci, over time."""
    plate, waveform = panel.board.plate, panel.board.waveform
    count, last = len(energies), waveform.samples - 1
    evaluated = [emission_figures(emission, waveform.duration_s) for emission in panel.emissions[:count]]
    total_uj, kinetic, power_mw, heat_w = (
        np.array([one[name] for one in evaluated]) for name in ("energy_uj", "kinetic_share", "mechanical_power_mw", "stages_w")
    )
    amplitudes_m = panel.amplitudes_m[:count]
    spots_m = [
        field.focus_metrics(*point).spot_m for field, point in zip(panel.fields[:count], panel.points_m.tolist(), strict=False)
    ]
    printed_uj = np.array([design.energy_j(plate, a, s) for a, s in zip(amplitudes_m, spots_m, strict=True)]) * 1e6
    scanned_uj = kinetic * total_uj + [scanned_energy_j(panel, field, SCAN_M) * 1e6 for field in panel.fields[:count]]
    band_uj = band_energy_j(panel, amplitudes_m) * 1e6
    decay_ms = np.array([_decay_s(energy, last, waveform.bit_period_s) for energy in energies]) * 1e3
    return rows(
        {
            "energy_uj": total_uj,
            "energy_scan_uj": scanned_uj,
            "energy_kinetic": kinetic,
            "eq6_here_uj": printed_uj,
            "appendix_b_uj": band_uj,
            "power_mw": power_mw,
            "resistor_w": heat_w,
            "energy_decay_ms": decay_ms,
        }
    )


def band_energy_j(panel: PaperPanel, amplitudes_m: Floats) -> Floats:
    """Appendix B with the modes of the band alone, all with the same amplitude A / N: sum of M w^2 / 2 (A / N)^2."""
    plate, waveform = panel.board.plate, panel.board.waveform
    low, high = waveform.band_low_hz, waveform.band_high_hz
    plate_kg = plate.density_kg_m3 * plate.thickness_m * plate.length_m * plate.width_m
    mean_square = (2 * np.pi) ** 2 * (high**3 - low**3) / (3 * (high - low))
    modes = (high - low) * design.characteristic_time_s(plate)
    return plate_kg / 2 * amplitudes_m**2 * mean_square / modes


def scanned_energy_j(panel: PaperPanel, field: Field, step_m: float) -> float:
    """Bending energy at T by eq. (8), with central differences of a map in steps of `step_m`."""
    plate = panel.board.plate
    x_m, y_m, u = field.map(step_m)
    dx, dy = x_m[1] - x_m[0], y_m[1] - y_m[0]
    inner = u[1:-1, 1:-1]
    xx = (u[1:-1, 2:] - 2 * inner + u[1:-1, :-2]) / dx**2
    yy = (u[2:, 1:-1] - 2 * inner + u[:-2, 1:-1]) / dy**2
    xy = (u[2:, 2:] - u[2:, :-2] - u[:-2, 2:] + u[:-2, :-2]) / (4 * dx * dy)
    density = xx**2 + yy**2 + 2 * plate.poisson_ratio * xx * yy + 2 * (1 - plate.poisson_ratio) * xy**2
    return float(bending_stiffness(plate) / 2 * density.sum() * dx * dy)


def energy_curves(panel: PaperPanel, energies: list[Energy]) -> dict[str, Any]:
    """Median energy over time for the picture, µJ, thinned to every tenth bit."""
    totals = np.array([energy.kinetic_j + energy.potential_j for energy in energies])
    times_ms = (np.arange(totals.shape[1]) + 1) * panel.board.waveform.bit_period_s * 1e3
    kinetic = np.median([energy.kinetic_j for energy in energies], axis=0)
    median = np.median(totals, axis=0)
    some = slice(9, None, 10)
    return {
        "time_ms": times_ms[some].tolist(),
        "energy_uj": (median[some] * 1e6).tolist(),
        "kinetic_uj": (kinetic[some] * 1e6).tolist(),
    }


def _decay_s(energy: Energy, last: int, bit_period_s: float) -> float:
    """Time constant of the energy after T."""
    total = (energy.kinetic_j + energy.potential_j)[last + round(SETTLED_S / bit_period_s) :]
    slope = np.polyfit(np.arange(len(total)) * bit_period_s, np.log(total), 1)[0]
    return float(-1 / slope)
