"""The modes of a board's plate: the one place where they are built."""

from __future__ import annotations

import math
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


def in_words(board: Board, modes: Modes) -> str:
    """The plate model that `modes` of a board come from, for the header of a bank."""
    plate = board.plate
    sides = plate.sides
    supports = (sides.x0, sides.x1, sides.y0, sides.y1)
    each = supports[:1] if len(set(supports)) == 1 else supports
    edges = " / ".join(support.replace("_", " ") for support in each)
    highest_hz = float(modes.angular_frequency[-1]) / (2 * math.pi)
    return (
        f"{plate.theory.capitalize()} plate, edges {edges}, decay {plate.decay_time_ms:g} ms,"
        f" {modes.count} modes to {highest_hz * 1e-3:.1f} kHz"
    )
