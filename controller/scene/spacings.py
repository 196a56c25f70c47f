"""Emissions by distance: one every `spacing_mm` travelled, or one per grid line crossed.

A finger at rest trembles by the noise of its reports, which must not count as movement: a distance counts once it is REST_M
or more from the last counted place, and a grid line is felt again only after the finger was a part of a spacing away from it.
"""

from __future__ import annotations

import math
from typing import Annotated, Final, NamedTuple

from msgspec import Meta

from controller.scene.effects import EffectTable
from controller.scene.shapes import Circle, Polygon, Rectangle
from controller.scene.trains import EffectiveAmplitude

ROUNDING_M: Final = 1e-9  # so that a spacing reached exactly is reached
REST_M: Final = 0.25e-3  # noise of a finger at rest; for fine spacings a quarter of the spacing
REARM_SHARE: Final = 0.25  # of a spacing: distance from a line after which it is felt again
MAX_REARM_M: Final = 0.5e-3


class Spacing(NamedTuple):
    """How an effect repeats in space as a finger moves within its region.

    Attributes
    ----------
    spacing_m : float
        Distance from one emission to the next.
    axis : int or None
        None: of the finger's path, in any direction; 0: of grid lines at fixed x, 1: at fixed y.
    origin_m : float
        Where one of the grid lines lies.
    amplitude : float
    """

    spacing_m: Annotated[float, Meta(ge=1e-5, le=1)]
    axis: Annotated[int, Meta(ge=0, le=1)] | None
    origin_m: Annotated[float, Meta(ge=-1, le=4)]
    amplitude: EffectiveAmplitude

    def begin(self, x_m: float, y_m: float) -> DistanceProgress | GridProgress:
        """Progress of a finger whose first report inside the region is at (x_m, y_m)."""
        return DistanceProgress(self, x_m, y_m) if self.axis is None else GridProgress(self, y_m if self.axis else x_m)


class DistanceProgress:
    """Distance that a finger has travelled since the last emission, in any direction.

    Parameters
    ----------
    spacing : Spacing
    x_m, y_m : float
        Place of the finger's first report inside the region.
    """

    __slots__ = ("_anchor_x_m", "_anchor_y_m", "_rest_m", "_spacing_m", "_travelled_m", "amplitude")

    def __init__(self, spacing: Spacing, x_m: float, y_m: float) -> None:
        self.amplitude = spacing.amplitude
        self._spacing_m = spacing.spacing_m
        self._rest_m = min(REST_M, spacing.spacing_m / 4)
        self._travelled_m = 0.0
        self._anchor_x_m, self._anchor_y_m = x_m, y_m

    def crossed(self, x_m: float, y_m: float) -> bool:
        """Whether the finger's move to (x_m, y_m) completes a spacing; if several, the rest of the distance is kept."""
        step_m = math.hypot(x_m - self._anchor_x_m, y_m - self._anchor_y_m)
        travelled_m = self._travelled_m + step_m
        if travelled_m >= self._spacing_m - ROUNDING_M:
            self._travelled_m = max(math.fmod(travelled_m + ROUNDING_M, self._spacing_m) - ROUNDING_M, 0.0)
            self._anchor_x_m, self._anchor_y_m = x_m, y_m
            return True
        if step_m >= self._rest_m:
            self._travelled_m = travelled_m
            self._anchor_x_m, self._anchor_y_m = x_m, y_m
        return False

    def remaining_m(self, x_m: float, y_m: float, _x: float, _y: float) -> float:
        """Distance from (x_m, y_m) to the next emission, whatever the direction."""
        return max(self._spacing_m - self._travelled_m - math.hypot(x_m - self._anchor_x_m, y_m - self._anchor_y_m), 0.0)


class GridProgress:
    """Between which grid lines a finger is, and which line it has just felt.

    Parameters
    ----------
    spacing : Spacing
        With an axis.
    at_m : float
        Coordinate along that axis of the finger's first report inside the region.
    """

    __slots__ = ("_axis", "_cell", "_felt", "_origin_m", "_rearm", "_spacing_m", "amplitude")

    def __init__(self, spacing: Spacing, at_m: float) -> None:
        self.amplitude = spacing.amplitude
        self._spacing_m = spacing.spacing_m
        self._origin_m = spacing.origin_m
        self._axis = spacing.axis
        self._rearm = min(REARM_SHARE, MAX_REARM_M / spacing.spacing_m)
        self._cell = math.floor((at_m - spacing.origin_m + ROUNDING_M) / spacing.spacing_m)
        self._felt: int | None = None

    def crossed(self, x_m: float, y_m: float) -> bool:
        """Whether the finger's move to (x_m, y_m) crosses a grid line other than one that it has just felt."""
        at = ((y_m if self._axis else x_m) - self._origin_m + ROUNDING_M) / self._spacing_m
        cell, before, felt = math.floor(at), self._cell, self._felt
        if cell == before:
            if felt is not None and abs(at - felt) >= self._rearm:
                self._felt = None
            return False
        self._cell = cell
        first, last = (before + 1, cell) if cell > before else (before, cell + 1)
        self._felt = None if abs(at - last) >= self._rearm else last
        return first != last or first != felt

    def remaining_m(self, x_m: float, y_m: float, x: float, y: float) -> float:
        """Distance from (x_m, y_m) to the next grid line along the unit vector (x, y); inf if it is parallel to the lines."""
        towards, at_m = (y, y_m) if self._axis else (x, x_m)
        if towards == 0.0:
            return math.inf
        at = (at_m - self._origin_m + ROUNDING_M) / self._spacing_m
        line, step = (math.floor(at) + 1, 1) if towards > 0 else (math.floor(at), -1)
        if line == self._felt:
            line += step
        return abs(line - at) * self._spacing_m / abs(towards)


def spacing_of(effect: EffectTable, shape: Rectangle | Circle | Polygon, amplitude: float) -> Spacing:
    """Spacing of an effect with `when = "move"`, in a region of some shape and amplitude."""
    spacing_m = (effect.spacing_mm or 0.0) * 1e-3
    axis = {"x": 0, "y": 1}.get(effect.along or "path")
    origin_m = 0.0 if axis is None else shape.bounds[axis] + (effect.phase or 0.0) * spacing_m
    return Spacing(spacing_m, axis, origin_m, effect.strength * amplitude)
