"""The modes of a board's plate: the one place where they are built."""

from __future__ import annotations

from functools import lru_cache

from controller.board.board import Board
from controller.board.panel import Plate
from controller.physics.closed_form import SimplySupported
from controller.physics.damping import damped
from controller.physics.mindlin import MindlinPlate
from controller.physics.modes import Modes
from controller.physics.plate import mode_cut_hz

KEPT = 4  # plates whose modes are remembered


def modes_of(board: Board, highest_hz: float | None = None) -> Modes:
    """Modes of a board's plate, kept for the next call.

    Parameters
    ----------
    board : Board
    highest_hz : float, optional
        Modes above are left out; `mode_cut_hz` by default.

    Raises
    ------
    ConfigError
        If there is none, or more than can be computed with; if the edges have no closed form.
    """
    return _modes(board.plate, mode_cut_hz(board.waveform) if highest_hz is None else highest_hz)


@lru_cache(maxsize=KEPT)
def _modes(plate: Plate, highest_hz: float) -> Modes:
    """Modes from all that they depend on, which must be hashable records: edges, then theory, then damping."""
    if plate.theory == "mindlin":
        theory = MindlinPlate.of(plate)
        modes = theory.corrected(_of_edges(plate, theory.without_correction_hz(highest_hz)))
    else:
        modes = _of_edges(plate, highest_hz)
    return damped(modes, plate)


def _of_edges(plate: Plate, highest_hz: float) -> Modes:
    """Modes by Kirchhoff's theory."""
    return SimplySupported.of(plate, highest_hz)
