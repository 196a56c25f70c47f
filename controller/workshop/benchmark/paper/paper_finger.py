"""Rows of a finger at the focus.

Its mass (paper, section V, fig. 11, appendix C): by eq. (7), and a point mass on the modal plate. Skin that a focus throws (section
VI, fig. 12): an illustration with numbers from literature, none fitted.
"""

from dataclasses import dataclass
from typing import Any, Self

import numpy as np
from scipy.interpolate import CubicSpline

from controller.arrays import Floats
from controller.workshop.benchmark.paper.paper_panel import PaperPanel
from controller.workshop.benchmark.paper.paper_row import Row, rows
from controller.workshop.physics.design import design
from controller.workshop.physics.finger import Finger, point_motion
from controller.workshop.physics.skin import Pulp, SkinMotion, skin_motion

MASSES_MG = (10.0, 20.0, 35.0, 50.0, 70.0, 100.0, 140.0, 230.0)
SHOWN_MG = (20.0, 100.0, 140.0, 230.0)
PAPER_KEPT = 3 / 7  # fig. 11 at 1 N
PAPER_RESOLUTION_M = 5e-3  # section V
NEAR_S = 12e-6  # of T: half a period at 42 kHz, within which the peak is looked for; mass makes it late
AROUND_S = np.linspace(-NEAR_S, NEAR_S, 97)
STEP_S = 0.5e-6  # of the displacement that a spline goes through
AFTER_S = 0.8e-3  # of T: the skin has come down
BEFORE_S = 0.3e-3  # of T: what the skin does until then, waves of 0.3 µm, is forgotten
MASS_KG = (0.07e-3, 0.23e-3)  # the paper's range from literature
PRESS_N = (0.1, 1.0)  # a light touch; the most of fig. 11
CURVE_N = (0.05, 0.1, 0.2, 0.5, 1.0)


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


@dataclass(frozen=True, eq=False)
class FreeFocus:
    """A focus without finger, from `BEFORE_S` before T on: times in s and displacement in m, (time,) each."""

    time_s: Floats
    displacement_m: Floats

    @classmethod
    def of(cls, panel: PaperPanel, index: int) -> Self:
        """One of a panel's foci."""
        time_s: Floats = np.arange(0, BEFORE_S + AFTER_S, STEP_S, dtype=np.float64)
        motion = point_motion(
            panel.board, panel.modes, panel.words[index], panel.points_m[index : index + 1], after_s=AFTER_S, modes_above=False
        )
        return cls(time_s, motion.displacement({}, time_s - BEFORE_S)[:, 0])

    def throw(self, panel: PaperPanel, pulp: Pulp) -> SkinMotion:
        """What skin on it does, at rest on the plate at first."""
        velocity = CubicSpline(self.time_s, self.displacement_m).derivative()
        impedance = design.point_impedance_kg_s(panel.board.plate)
        return skin_motion(lambda t: float(velocity(t)), impedance, pulp, float(self.time_s[-1]))


def skin_rows(panel: PaperPanel, count: int) -> tuple[list[Row], dict[str, Any]]:
    """Rows of a light and a firm touch on the first `count` foci, and curves for the picture (fig. 12).

    The mass is drawn from the range that the paper has from literature.
    """
    random = np.random.default_rng(panel.seed)
    curve: dict[str, Any] = {}
    motions: dict[float, list[SkinMotion]] = {press_n: [] for press_n in PRESS_N}
    for index in range(count):
        free = FreeFocus.of(panel, index)
        mass_kg = random.uniform(*MASS_KG)
        for press_n, some in motions.items():
            some.append(free.throw(panel, Pulp(mass_kg=mass_kg, press_n=press_n)))
        if not index:
            curve = _curve(free, {press_n: free.throw(panel, Pulp(press_n=press_n)) for press_n in PRESS_N})
            thrown = [free.throw(panel, Pulp(press_n=press_n)).longest_flight() for press_n in CURVE_N]
            curve |= {"press_n": list(CURVE_N)}
            curve |= {"flight_ms": [one[0] * 1e3 for one in thrown], "height_um": [one[1] * 1e6 for one in thrown]}
    found: dict[str, Floats] = {}
    for press_n, some in motions.items():
        flights = np.array([motion.longest_flight() for motion in some])
        found |= {f"skin_um_{press_n:g}_n": flights[:, 1] * 1e6, f"skin_ms_{press_n:g}_n": flights[:, 0] * 1e3}
    return rows(found), curve


def _curve(free: FreeFocus, motions: dict[float, SkinMotion]) -> dict[str, Any]:
    """Free plate and, by force in N, skin around T, in ms and µm."""
    grid_s: Floats = np.arange(0, BEFORE_S + AFTER_S - 1e-9, 1e-6)
    return {
        "time_ms": ((grid_s - BEFORE_S) * 1e3).tolist(),
        "free_um": (np.interp(grid_s, free.time_s, free.displacement_m) * 1e6).tolist(),
        "shown_n": list(motions),
        **{f"skin_um_{press_n:g}": (np.interp(grid_s, one.time_s, one.skin_m) * 1e6).tolist() for press_n, one in motions.items()},
    }
