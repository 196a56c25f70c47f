"""What the always-on spots of a scene play together, composed beforehand: no device has the time for the best drive words."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from controller.bank.grid import Grid
from controller.board.board import Board
from controller.clocks import FpgaTime
from controller.errors import ConfigError
from controller.kernel import Point
from controller.loop.batching import select_batch
from controller.loop.spots import Spots
from controller.physics.plate import wave_scale
from controller.physics.response_source import ResponseSource
from controller.scene.emission import Emission
from controller.scene.scene import Spot
from controller.waveform_design.exact_composition import ExactComposition
from controller.waveforms.selection import LATTICE_M, LatticePoint, lattice_key

WINDOW_S: Final = 2.0  # of spots with different rates the sets that meet within this time
MOST: Final = 64  # sets of a scene

Composition = tuple[tuple[LatticePoint, ...], NDArray[np.uint32]]


def played_together(spots: Sequence[Spot], duration_s: float, wave_scale: float = 1.0) -> list[tuple[Point, ...]]:
    """Sets of points (x_m, y_m, amplitude) that a scene's spots play as one waveform, without any finger; 64 at most.

    Parameters
    ----------
    spots : sequence of Spot
    duration_s : float
        Of an emission: beats nearer to each other than this are played together, if they may be.
    wave_scale : float
        Of the plate (`Bank.wave_scale`).
    """
    found: dict[frozenset[Point], tuple[Point, ...]] = {}
    beats = Spots(spots, FpgaTime(0.0), wave_scale=wave_scale)
    due: tuple[Emission, ...] = ()
    while (next_s := beats.next_s()) < FpgaTime(WINDOW_S) and len(found) < MOST:
        due = (*due, *beats.due(next_s, next_s + duration_s))
        while due:
            chosen, due = select_batch(due, duration_s, wave_scale=wave_scale)
            points = tuple((emission.x_m, emission.y_m, emission.amplitude) for emission in chosen)
            found.setdefault(frozenset(points), points)
    return list(found.values())[:MOST]


def compositions(board: Board, grid: Grid, source: ResponseSource, spots: Sequence[Spot]) -> list[Composition]:
    """Keys and drive words of what a scene's spots play together, and of single ones that no cell of the grid serves.

    Raises
    ------
    ConfigError
        If a spot is where nothing can move.
    """
    method, found, scale = ExactComposition(board, source), [], wave_scale(board)
    for points in played_together(spots, board.waveform.duration_s, scale):
        if len(points) == 1 and points[0][2] == 1 and grid.nearest(*points[0][:2])[1] <= board.bank.snap_mm * 1e-3:
            continue
        try:
            words = method.design(points).words
        except ValueError as error:
            where = ", ".join(f"({1e3 * x_m:g}, {1e3 * y_m:g})" for x_m, y_m, _ in points)
            raise ConfigError(f"the scene's spots at {where} mm cannot be composed: {error}") from error
        found.append((lattice_key(points, LATTICE_M * scale), words))
    return list(dict(found).items())
