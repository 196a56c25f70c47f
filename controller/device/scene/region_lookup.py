"""Which region contains a point: asked for every touch sample, and compiled with the loop."""

from __future__ import annotations

from collections.abc import Sequence
from math import floor
from typing import Final

from controller.device.scene.shapes import Circle, Polygon, Rectangle

OUTSIDE: Final = -1
TILES: Final = 32  # of the spatial index, along each axis


class RegionLookup:
    """Finds the first region that contains a point."""

    __slots__ = ("_boxes", "_candidates", "_low_x_m", "_low_y_m", "_shapes", "_tiles_per_m_x", "_tiles_per_m_y")

    def __init__(
        self,
        shapes: Sequence[Rectangle | Circle | Polygon],  # of the regions, in the order of the scene
        low_x_m: float,  # low_x_m, low_y_m, tiles_per_m_x, tiles_per_m_y, candidates: as in `SpatialIndex`
        low_y_m: float,
        tiles_per_m_x: float,
        tiles_per_m_y: float,
        candidates: tuple[tuple[int, ...], ...],
    ) -> None:
        self._shapes = shapes
        self._boxes = [shape.bounds if isinstance(shape, Rectangle) else None for shape in shapes]  # most regions are rectangles
        self._low_x_m = low_x_m
        self._low_y_m = low_y_m
        self._tiles_per_m_x = tiles_per_m_x
        self._tiles_per_m_y = tiles_per_m_y
        self._candidates = candidates

    def at(self, x_m: float, y_m: float) -> int:
        """Index of the first region that contains the point (x_m, y_m), or OUTSIDE."""
        column, row = floor((x_m - self._low_x_m) * self._tiles_per_m_x), floor((y_m - self._low_y_m) * self._tiles_per_m_y)
        if 0 <= column < TILES and 0 <= row < TILES:
            for number in self._candidates[column * TILES + row]:
                box = self._boxes[number]
                if box is None:
                    if self._shapes[number].contains(x_m, y_m):
                        return number
                elif box[0] <= x_m <= box[2] and box[1] <= y_m <= box[3]:
                    return number
        return OUTSIDE


class StackedLookup:
    """Finds the first region that contains a point, in layers over a scene: the topmost layer first, the scene last.

    Of each layer: its lookup, the place (x_m, y_m) of its origin, the scale of its lengths, and how many regions it has.
    """

    __slots__ = ("_layers", "_scene", "_under")

    def __init__(self, layers: Sequence[tuple[RegionLookup, float, float, float, int]], scene: RegionLookup) -> None:
        stacked = []
        first = 0
        for lookup, x_m, y_m, scale, regions in layers:
            stacked.append((lookup, x_m, y_m, 1 / scale, first))
            first += regions
        self._layers = stacked
        self._scene = scene
        self._under = first

    def at(self, x_m: float, y_m: float) -> int:
        """Index of the first region that contains the point (x_m, y_m), or OUTSIDE; those of the scene come after all layers'."""
        for lookup, left_m, low_m, per_scale, first in self._layers:
            number = lookup.at((x_m - left_m) * per_scale, (y_m - low_m) * per_scale)
            if number != OUTSIDE:
                return first + number
        number = self._scene.at(x_m, y_m)
        return number if number == OUTSIDE else self._under + number
