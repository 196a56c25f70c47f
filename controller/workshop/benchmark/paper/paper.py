"""`haptic-panel benchmark paper`: every figure of the paper that can be simulated, beside what this panel's model gives.

Nothing is tuned: plate, driver, waveform and patches are those of the paper's section IV-A; the one constant fitted to it is
the piezo's `moment_n_per_v`, which scales displacements and, squared, energies. Foci are drawn at random, none is left out.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

from threadpoolctl import threadpool_limits

from controller.device.board.board import Board
from controller.workshop.benchmark.environment import environment
from controller.workshop.benchmark.paper import paper_energy, paper_equations, paper_finger, paper_focus, paper_losses
from controller.workshop.benchmark.paper.paper_panel import PaperPanel
from controller.workshop.benchmark.paper.paper_row import Row

Figures = dict[str, Any]
Progress = Callable[[int, int], None]
LONGEST_S = 4e-3  # of emissions


@dataclass(frozen=True)
class PaperEffort:
    """How many of the foci are looked at by what takes long, and which other plates; those not in closed form take seconds."""

    foci: int
    over_time: int
    repeated: int
    thrown: int
    loaded: int
    plates: int
    foam: bool


QUICK = PaperEffort(foci=10, over_time=3, repeated=2, thrown=2, loaded=4, plates=paper_losses.CLOSED_FORM, foam=False)
FULL = PaperEffort(foci=100, over_time=20, repeated=20, thrown=20, loaded=20, plates=len(paper_losses.OTHERS), foam=True)


def paper_figures(board: Board, effort: PaperEffort, seed: int = 1, progress: Progress = lambda _done, _total: None) -> Figures:
    """All rows and curves.

    The board is evaluated as if it were the paper's; `progress` is called with what is done and all there is to do. Plain values:
    `rows` (`Row.figures`), `curves` for the picture, `fitted`, `environment`.
    """
    reported = environment()
    curves: Figures = {}
    rows: list[Row] = []
    with threadpool_limits(1, "blas"):
        panel = PaperPanel(board, seed, effort.foci)
        parts = _parts(panel, effort, curves)
        for done, part in enumerate(parts, 1):
            rows += part()
            progress(done, len(parts))
        curves["foci"] = paper_focus.four_foci_maps(panel)
    return {
        "board": board.name,
        "seed": seed,
        "foci": effort.foci,
        "modes": panel.modes.count,
        "environment": reported,
        "fitted": {
            "name": "moment_n_per_v",
            "value": board.driver.moment_n_per_v,
            "why": "to the paper's 7.68 µm (laminate theory: 1.9e-3)",
        },
        "rows": [row.figures() for row in rows],
        "curves": curves,
    }


def _parts(panel: PaperPanel, effort: PaperEffort, curves: Figures) -> list[Callable[[], list[Row]]]:
    """What computes the rows of each of the paper's subjects, in its order; some also put what the picture draws in `curves`."""

    def over_time() -> list[Row]:
        energies = [paper_energy.energy_over_time(panel, index) for index in range(effort.over_time)]
        curves["energy"] = paper_energy.energy_curves(panel, energies)
        return paper_energy.energy_rows(panel, energies)

    def durations() -> list[Row]:
        curves["duration"] = paper_focus.longer_emission_amplitudes(panel, LONGEST_S)
        return paper_focus.duration_rows(curves["duration"])

    def repetition() -> list[Row]:
        curves["repetition"] = paper_focus.repetition_curve(panel, effort.repeated)
        return paper_focus.repetition_rows(panel, effort.repeated, curves["repetition"])

    def finger() -> list[Row]:
        found, curves["finger"] = paper_finger.finger_rows(panel, effort.loaded)
        return found

    def skin() -> list[Row]:
        found, curves["skin"] = paper_finger.skin_rows(panel, effort.thrown)
        return found

    return [
        lambda: paper_equations.constant_rows(panel.board, panel.modes),
        lambda: paper_equations.driver_rows(panel.board),
        lambda: paper_focus.focus_rows(panel),
        durations,
        over_time,
        lambda: paper_focus.four_foci_rows(panel),
        repetition,
        finger,
        *(partial(of_loss, panel) for of_loss in paper_losses.OF_PANEL),
        lambda: paper_losses.wrong_plate_rows(panel, effort.plates),
        *([lambda: paper_losses.foam_rows(panel)] if effort.foam else []),
        skin,
    ]
