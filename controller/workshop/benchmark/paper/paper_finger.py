"""Rows of a finger's mass at the focus (paper, section V, fig. 11, appendix C): eq. (7), and a point mass on the modal plate."""

from __future__ import annotations

from typing import Any

import numpy as np

from controller.workshop.benchmark.paper.paper_panel import PaperPanel
from controller.workshop.benchmark.paper.paper_row import Row, rows
from controller.workshop.physics.design import design
from controller.workshop.physics.finger import Finger, point_motion

MASSES_MG = (10.0, 20.0, 35.0, 50.0, 70.0, 100.0, 140.0, 230.0)
SHOWN_MG = (20.0, 100.0, 140.0, 230.0)
PAPER_KEPT = 3 / 7  # fig. 11 at 1 N
PAPER_RESOLUTION_M = 5e-3  # section V
NEAR_S = 12e-6  # of T: half a period at 42 kHz, within which the peak is looked for; mass makes it late
AROUND_S = np.linspace(-NEAR_S, NEAR_S, 97)


def finger_rows(panel: PaperPanel, count: int) -> tuple[list[Row], dict[str, Any]]:
    """Rows of the first `count` foci, and both curves over the mass."""
    loaded = np.array([loaded_shares(panel, index) for index in range(count)])
    by_mass = dict(zip(MASSES_MG, loaded.T, strict=True))
    plate = panel.board.plate
    formula = [design.gate_attenuation(plate, mass * 1e-6, PAPER_RESOLUTION_M) for mass in MASSES_MG]
    by_formula = dict(zip(MASSES_MG, formula, strict=True))
    reads = [float(np.interp(-PAPER_KEPT, -np.array([1.0, *shares]), [0.0, *MASSES_MG])) for shares in loaded]
    found = rows(
        {
            "finger_eq7": by_formula[140.0],
            **{f"finger_{mass:g}_mg": by_mass[mass] for mass in SHOWN_MG},
            "finger_mass_mg": reads,
        },
        {
            "finger_eq7": PAPER_KEPT,
            **{f"finger_{mass:g}_mg": by_formula[mass] for mass in SHOWN_MG},
            "finger_mass_mg": design.gate_mass_kg(plate, PAPER_KEPT, PAPER_RESOLUTION_M) * 1e6,
        },
    )
    curve = {
        "mass_mg": [0.0, *MASSES_MG],
        "formula": [1.0, *formula],
        "modal": [1.0, *np.median(loaded, axis=0).tolist()],
    }
    return found, curve


def loaded_shares(panel: PaperPanel, index: int) -> list[float]:
    """Share of the peak at a focus that each of `MASSES_MG` leaves."""
    at = panel.points_m[index : index + 1]
    motion = point_motion(panel.board, panel.modes, panel.words[index], at, after_s=NEAR_S)
    free, *loaded = (
        float(motion.displacement({0: Finger(mass_kg=mass_mg * 1e-6)} if mass_mg else {}, AROUND_S).max())
        for mass_mg in (0.0, *MASSES_MG)
    )
    return [peak / free for peak in loaded]
