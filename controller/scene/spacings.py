"""Emissions in space: one for every so much of way, or for every line that a finger crosses. Pure but for their own state.

A finger that lies still trembles by a report's noise. Neither kind takes that for movement: a way counts
once it has left its anchor by REST_M, and a line that was felt is felt again once the finger has been a
part of a spacing away from it.
"""

from __future__ import annotations

import math
from typing import Annotated, NamedTuple

from msgspec import Meta

from controller.scene.effects import EffectTable
from controller.scene.shapes import Circle, Polygon, Rectangle
from controller.scene.trains import Loudness

ROUNDING_M = 1e-9  # so that a spacing reached exactly is reached
REST_M = 0.25e-3  # noise of a finger at rest; of finer spacings a quarter
REARM = 0.25  # of a spacing
REARM_MOST_M = 0.5e-3


class Spacing(NamedTuple):
    """What a region does as a finger moves. `axis`: 0 lines across x, 1 across y, None the way; `origin_m`: one of the lines."""

    spacing_m: Annotated[float, Meta(ge=1e-5, le=1)]
    axis: Annotated[int, Meta(ge=0, le=1)] | None
    origin_m: Annotated[float, Meta(ge=-1, le=4)]
    amplitude: Loudness

    def begin(self, x_m: float, y_m: float) -> Way | Lines:
        """Progress of a finger that comes in here."""
        return Way(self, x_m, y_m) if self.axis is None else Lines(self, y_m if self.axis else x_m)


class Way:
    """How far a finger has gone since the last emission, in any direction."""

    __slots__ = ("_anchor_x_m", "_anchor_y_m", "_rest_m", "_spacing_m", "_way_m", "amplitude")

    def __init__(self, spacing: Spacing, x_m: float, y_m: float) -> None:
        self.amplitude = spacing.amplitude
        self._spacing_m = spacing.spacing_m
        self._rest_m = min(REST_M, spacing.spacing_m / 4)
        self._way_m = 0.0
        self._anchor_x_m, self._anchor_y_m = x_m, y_m

    def crossed(self, x_m: float, y_m: float) -> bool:
        """Whether the finger's next place completes a spacing; of several at once the rest of the way is kept."""
        step_m = math.hypot(x_m - self._anchor_x_m, y_m - self._anchor_y_m)
        way_m = self._way_m + step_m
        if way_m >= self._spacing_m - ROUNDING_M:
            self._way_m = max(math.fmod(way_m + ROUNDING_M, self._spacing_m) - ROUNDING_M, 0.0)
            self._anchor_x_m, self._anchor_y_m = x_m, y_m
            return True
        if step_m >= self._rest_m:
            self._way_m = way_m
            self._anchor_x_m, self._anchor_y_m = x_m, y_m
        return False

    def to_go_m(self, x_m: float, y_m: float, _x: float, _y: float) -> float:
        """Way from here to the next emission, whatever the direction."""
        return max(self._spacing_m - self._way_m - math.hypot(x_m - self._anchor_x_m, y_m - self._anchor_y_m), 0.0)


class Lines:
    """Between which of its fixed lines a finger is, and which one it has just felt."""

    __slots__ = ("_axis", "_cell", "_felt", "_origin_m", "_rearm", "_spacing_m", "amplitude")

    def __init__(self, spacing: Spacing, at_m: float) -> None:
        self.amplitude = spacing.amplitude
        self._spacing_m = spacing.spacing_m
        self._origin_m = spacing.origin_m
        self._axis = spacing.axis
        self._rearm = min(REARM, REARM_MOST_M / spacing.spacing_m)
        self._cell = math.floor((at_m - spacing.origin_m + ROUNDING_M) / spacing.spacing_m)
        self._felt: int | None = None

    def crossed(self, x_m: float, y_m: float) -> bool:
        """Whether the finger crossed a line on its way to its next place, one that it has not just felt."""
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

    def to_go_m(self, x_m: float, y_m: float, x: float, y: float) -> float:
        """Way from here to the next line for a finger that moves along a unit vector (x, y); inf along the lines."""
        towards, at_m = (y, y_m) if self._axis else (x, x_m)
        if towards == 0.0:
            return math.inf
        at = (at_m - self._origin_m + ROUNDING_M) / self._spacing_m
        line, step = (math.floor(at) + 1, 1) if towards > 0 else (math.floor(at), -1)
        if line == self._felt:
            line += step
        return abs(line - at) * self._spacing_m / abs(towards)


def spacing_of(effect: EffectTable, shape: Rectangle | Circle | Polygon, amplitude: float) -> Spacing:
    """What an effect with `when = "move"` does in a region of some amplitude."""
    spacing_m = (effect.spacing_mm or 0.0) * 1e-3
    axis = {"x": 0, "y": 1}.get(effect.along or "path")
    origin_m = 0.0 if axis is None else shape.bounds[axis] + (effect.phase or 0.0) * spacing_m
    return Spacing(spacing_m, axis, origin_m, effect.strength * amplitude)
