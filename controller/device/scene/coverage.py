"""Which cells of a bank a scene needs."""

from __future__ import annotations

import numpy as np

from controller.arrays import Bools, Floats
from controller.device.scene.scene import Scene
from controller.device.scene.shapes import Boxes

# A point may be rounded by this much, times the wave scale, before its cells are looked up (device/waveforms/selection.py).
SLACK_M = 0.25e-3
FAR_M = 1e3  # beyond every plate


def cells_needed(scene: Scene, points_m: Floats, pitch_m: float, margin_m: float = 0.0, *, wave_scale: float = 1.0) -> Bools:
    """Cells that a scene can ask for: the four cells around every point where it may emit.

    A point beyond the outermost cells needs those nearest to it. An effect of `leave` may be felt anywhere, and the
    fingers that a region keeps still may be anywhere.

    `points_m` (cell, 2) are cells of a whole regular grid, in any order. An emission for a finger may be `margin_m` beyond its
    region's border, because its place is predicted. `wave_scale` is that of the plate (`Bank.wave_scale`). Returns (cell,).
    """
    x, y = points_m[:, 0], points_m[:, 1]
    near, wide = (
        Boxes(*_influence(x, half_m, pitch_m), *_influence(y, half_m, pitch_m))
        for half_m in (pitch_m + SLACK_M * wave_scale, pitch_m + SLACK_M * wave_scale + margin_m)
    )
    needed = np.zeros(len(points_m), bool)
    for region in scene.regions:
        if region.leave or region.nulled:
            needed[:] = True
        elif region.felt:
            needed |= region.shape.meets(wide)
        if region.emitter:
            needed |= near.contain(region.emitter.x_m, region.emitter.y_m)
    return needed


def _influence(at: Floats, half_m: float, pitch_m: float) -> tuple[Floats, Floats]:
    """Along one axis, lower and upper end of the points that need each cell, both (cell,): a pitch to either side.

    The interval of the two outermost rows has no end: a point beyond the outermost row is treated as if it lay on that row, and
    there the second row counts too (with weight 0).
    """
    rim_m = 1.5 * pitch_m
    low = np.where(at < at.min() + rim_m, at - FAR_M, at - half_m)
    high = np.where(at > at.max() - rim_m, at + FAR_M, at + half_m)
    return low, high
