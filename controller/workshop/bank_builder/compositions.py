"""What the fixed emitters of a scene play together, composed beforehand: no device has the time for the best drive words."""

from collections.abc import Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from controller.clocks import FpgaTime
from controller.device.bank.grid import Grid
from controller.device.board.board import Board
from controller.device.kernel import Point
from controller.device.loop.fixed_emitters import FixedEmitters
from controller.device.loop.playing.batching import select_batch
from controller.device.scene.emission import Emission
from controller.device.scene.scene import FixedEmitter
from controller.device.waveforms.selection import LATTICE_M, LatticePoint, lattice_key
from controller.errors import ConfigError
from controller.workshop.bank_builder.methods.exact_composition import ExactComposition
from controller.workshop.physics.plate import wave_scale
from controller.workshop.physics.responses.response_source import ResponseSource

WINDOW_S: Final = 2.0  # of fixed emitters with different rates the sets that meet within this time
MOST: Final = 64  # sets of a scene

Composition = tuple[tuple[LatticePoint, ...], NDArray[np.uint32]]


def played_together(emitters: Sequence[FixedEmitter], duration_s: float, wave_scale: float = 1.0) -> list[tuple[Point, ...]]:
    """Sets of points (x_m, y_m, amplitude) that a scene's fixed emitters play as one waveform, without any finger; 64 at most.

    Pulses nearer to each other than `duration_s`, that of an emission, are played together, if they may be; `wave_scale` is that of
    the plate (`Bank.wave_scale`).
    """
    found: dict[frozenset[Point], tuple[Point, ...]] = {}
    pulses = FixedEmitters(emitters, FpgaTime(0.0), wave_scale=wave_scale)
    due: tuple[Emission, ...] = ()
    while (next_s := pulses.next_s()) < FpgaTime(WINDOW_S) and len(found) < MOST:
        due = (*due, *pulses.due(next_s, next_s + duration_s))
        while due:
            chosen, due = select_batch(due, duration_s, wave_scale=wave_scale)
            points = tuple((emission.x_m, emission.y_m, emission.amplitude) for emission in chosen)
            found.setdefault(frozenset(points), points)
    return list(found.values())[:MOST]


def compositions(board: Board, grid: Grid, source: ResponseSource, emitters: Sequence[FixedEmitter]) -> list[Composition]:
    """Keys and drive words of what a scene's fixed emitters play together, and of single ones that no cell of the grid serves.

    Raises ConfigError if a fixed emitter is where nothing can move.
    """
    method, found, scale = ExactComposition(board, source), [], wave_scale(board)
    for points in played_together(emitters, board.waveform.duration_s, scale):
        if len(points) == 1 and points[0][2] == 1 and grid.within(*points[0][:2], board.bank.snap_mm * 1e-3) >= 0:
            continue
        try:
            words = method.design(points).words
        except ValueError as error:
            where = ", ".join(f"({1e3 * x_m:g}, {1e3 * y_m:g})" for x_m, y_m, _ in points)
            raise ConfigError(f"the scene's fixed emitters at {where} mm cannot be composed: {error}") from error
        found.append((lattice_key(points, LATTICE_M * scale), words))
    return list(dict(found).items())
