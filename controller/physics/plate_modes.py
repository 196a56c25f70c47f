"""The modes of a board's plate: the one place where they are built."""

from __future__ import annotations

from functools import lru_cache

import msgspec

from controller.board.board import Board
from controller.board.panel import Plate
from controller.physics.closed_form import SimplySupported
from controller.physics.modes import Modes
from controller.physics.plate import mode_cut_hz
from controller.physics.ritz_modes import RitzModes

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
        If there is none, or more than can be computed with.
    """
    return _modes(board.plate, mode_cut_hz(board.waveform) if highest_hz is None else highest_hz)


@lru_cache(maxsize=KEPT)
def _modes(plate: Plate, highest_hz: float) -> Modes:
    """Modes from all that they depend on, which must be hashable records."""
    if set(msgspec.structs.astuple(plate.sides)) == {"simply_supported"}:
        return SimplySupported.of(plate, highest_hz)
    return RitzModes.of(plate, highest_hz)
