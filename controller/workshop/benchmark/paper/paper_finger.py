"""Rows of a finger's mass at the focus (paper, section V, fig. 11, appendix C): eq. (7), and a point mass on the modal plate."""

from __future__ import annotations

from typing import Any

import numpy as np

from controller.workshop.benchmark.paper.paper_panel import PaperPanel
from controller.workshop.benchmark.paper.paper_row import Row
from controller.workshop.physics.design import design
from controller.workshop.physics.finger import Finger, point_motion

MASSES_MG = (10.0, 20.0, 35.0, 50.0, 70.0, 100.0, 140.0, 230.0)
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
    reads = [float(np.interp(-PAPER_KEPT, -np.array([1.0, *shares]), [0.0, *MASSES_MG])) for shares in loaded]
    rows.append(
        Row.of(
            "finger_mass_mg",
            "mass that leaves 3 of 7 µm (mg)",
            design.gate_mass_kg(plate, PAPER_KEPT, PAPER_RESOLUTION_M) * 1e6,
            reads,
            "the paper's column: read by eq. (7); a point mass on the modal plate need be less than half",
        )
    )
    curve = {
        "mass_mg": [0.0, *MASSES_MG],
        "formula": [1.0, *formula],
        "modal": [1.0, *np.median(loaded, axis=0).tolist()],
    }
    return rows, curve


def loaded_shares(panel: PaperPanel, index: int) -> list[float]:
    """Share of the peak at a focus that each of `MASSES_MG` leaves."""
    at = panel.points_m[index : index + 1]
    motion = point_motion(panel.board, panel.modes, panel.words[index], at, after_s=NEAR_S)
    free, *loaded = (
        float(motion.displacement({0: Finger(mass_kg=mass_mg * 1e-6)} if mass_mg else {}, AROUND_S).max())
        for mass_mg in (0.0, *MASSES_MG)
    )
    return [peak / free for peak in loaded]
