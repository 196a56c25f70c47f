"""Rows of a finger's mass at the focus (paper, section V, fig. 11, appendix C): eq. (7), and a point mass on the modal plate."""

from __future__ import annotations

from typing import Any

import numpy as np

from controller.benchmark.paper_panel import PaperPanel
from controller.benchmark.paper_row import Row
from controller.benchmark.paper_spectrum import focus_spectrum
from controller.physics import design

MASSES_MG = (10.0, 20.0, 50.0, 100.0, 140.0, 230.0)
PAPER_KEPT = 3 / 7  # fig. 11 at 1 N
PAPER_RESOLUTION_M = 5e-3  # section V
PARTS = 8  # of a bit, at whose ends the peak is looked for
NEAR_S = 12e-6  # of T: half a period at 42 kHz, within which the peak is looked for, as the paper's vibrometer did


def finger_rows(panel: PaperPanel, count: int) -> tuple[list[Row], dict[str, Any]]:
    """Rows of the first `count` foci, and both curves over the mass."""
    loaded = np.array([loaded_shares(panel, index) for index in range(count)])
    by_mass = dict(zip(MASSES_MG, loaded.T, strict=True))
    plate = panel.board.plate
    formula = [design.gate_attenuation(plate, mass * 1e-6, PAPER_RESOLUTION_M) for mass in MASSES_MG]
    rows = [
        Row.of(
            "finger_eq7",
            "finger of 140 mg at the focus: kept, eq. (7)",
            PAPER_KEPT,
            formula[MASSES_MG.index(140.0)],
            "the paper's own formula, its M for 1 N from literature, and 7 → 3 µm of fig. 11",
        ),
        *(
            Row.of(
                f"finger_{mass:g}_mg",
                f"finger of {mass:g} mg: kept, point mass on the modal plate",
                design.gate_attenuation(plate, mass * 1e-6, PAPER_RESOLUTION_M),
                by_mass[mass],
                "against eq. (7), whose gate has a part at 0 Hz that no mass holds back",
            )
            for mass in (20.0, 100.0, 140.0, 230.0)
        ),
    ]
    curve = {
        "mass_mg": [0.0, *MASSES_MG],
        "formula": [1.0, *formula],
        "modal": [1.0, *np.median(loaded, axis=0).tolist()],
    }
    return rows, curve


def loaded_shares(panel: PaperPanel, index: int) -> list[float]:
    """Share of the peak at a focus that each of `MASSES_MG` leaves."""
    of = focus_spectrum(panel, index)
    end = panel.board.waveform.samples * PARTS
    near = round(NEAR_S / of.bit_period_s * PARTS)

    def peak(mass_kg: float) -> float:
        moved_m = of.over_time(of.displacement / (1 - of.omega**2 * mass_kg * of.receptance), PARTS)
        return float(moved_m[end - near : end + near].max())

    free_m = peak(0.0)
    return [peak(mass_mg * 1e-6) / free_m for mass_mg in MASSES_MG]
