"""Shapes on the plate, in metres: which points they contain and which boxes they meet.

The types of their fields also say what is accepted in a shape that comes from another process.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated

import numpy as np
from msgspec import Meta, Struct

from controller.arrays import Bools, Floats
from controller.device.board.records import PlaceM, SizeM

Point = tuple[PlaceM, PlaceM]


@dataclass(frozen=True, slots=True)
class Boxes:
    """Many axis-parallel boxes: (box,) arrays of their sides in m."""

    x_low: Floats
    x_high: Floats
    y_low: Floats
    y_high: Floats

    def contain(self, x_m: float, y_m: float) -> Bools:
        """Which boxes contain the point (x_m, y_m), border included: (box,)."""
        return (self.x_low <= x_m) & (x_m <= self.x_high) & (self.y_low <= y_m) & (y_m <= self.y_high)


class Rectangle(Struct, frozen=True, array_like=True, forbid_unknown_fields=True, tag=True):
    """A rectangle along the axes, its border included; sides in m."""

    x_low: PlaceM
    y_low: PlaceM
    x_high: PlaceM
    y_high: PlaceM

    @property
    def bounds(self) -> tuple[float, float, float, float]:
        """Lowest x and y, highest x and y."""
        return self.x_low, self.y_low, self.x_high, self.y_high

    @property
    def centre(self) -> Point:
        """Its centre."""
        return (self.x_low + self.x_high) / 2, (self.y_low + self.y_high) / 2

    def contains(self, x_m: float, y_m: float) -> bool:
        """Whether the point (x_m, y_m) lies in it."""
        return self.x_low <= x_m <= self.x_high and self.y_low <= y_m <= self.y_high

    def meets(self, boxes: Boxes) -> Bools:
        """Which boxes have a point in common with it: (box,)."""
        return (
            (boxes.x_low <= self.x_high)
            & (boxes.x_high >= self.x_low)
            & (boxes.y_low <= self.y_high)
            & (boxes.y_high >= self.y_low)
        )


class Circle(Struct, frozen=True, array_like=True, forbid_unknown_fields=True, tag=True):
    """A disc, its border included."""

    x_m: PlaceM
    y_m: PlaceM
    radius_m: SizeM

    @property
    def bounds(self) -> tuple[float, float, float, float]:
        """Lowest x and y, highest x and y."""
        r = self.radius_m
        return self.x_m - r, self.y_m - r, self.x_m + r, self.y_m + r

    @property
    def centre(self) -> Point:
        """Its centre."""
        return self.x_m, self.y_m

    def contains(self, x_m: float, y_m: float) -> bool:
        """Whether the point (x_m, y_m) lies in it."""
        return math.hypot(x_m - self.x_m, y_m - self.y_m) <= self.radius_m

    def meets(self, boxes: Boxes) -> Bools:
        """Which boxes have a point in common with it: (box,)."""
        nearest_x = np.clip(self.x_m, boxes.x_low, boxes.x_high)
        nearest_y = np.clip(self.y_m, boxes.y_low, boxes.y_high)
        near: Bools = np.hypot(nearest_x - self.x_m, nearest_y - self.y_m) <= self.radius_m
        return near


class Polygon(Struct, frozen=True, array_like=True, forbid_unknown_fields=True, tag=True):
    """A polygon whose edges do not cross, given by its corners in either orientation."""

    corners: Annotated[tuple[Point, ...], Meta(min_length=3, max_length=1000)]

    @property
    def bounds(self) -> tuple[float, float, float, float]:
        """Lowest x and y, highest x and y."""
        xs, ys = zip(*self.corners, strict=True)
        return min(xs), min(ys), max(xs), max(ys)

    @property
    def centre(self) -> Point:
        """Centre of its area."""
        area = x = y = 0.0
        for (ax, ay), (bx, by) in self.edges():
            cross = ax * by - bx * ay
            area += cross / 2
            x += (ax + bx) * cross / 6
            y += (ay + by) * cross / 6
        return x / area, y / area

    def edges(self) -> list[tuple[Point, Point]]:
        """Edges from each corner to the next, the last one back to the first corner."""
        return list(zip(self.corners, (*self.corners[1:], self.corners[0]), strict=True))

    def contains(self, x_m: float, y_m: float) -> bool:
        """Whether the point (x_m, y_m) lies in it: a ray to +x crosses the outline an odd number of times."""
        inside = False
        ax, ay = self.corners[-1]
        for bx, by in self.corners:
            if (ay > y_m) != (by > y_m) and x_m < ax + (y_m - ay) / (by - ay) * (bx - ax):
                inside = not inside
            ax, ay = bx, by
        return inside

    def meets(self, boxes: Boxes) -> Bools:
        """Which boxes have a point in common with it: those that an edge meets, and those entirely inside: (box,)."""
        x, y = (boxes.x_low + boxes.x_high) / 2, (boxes.y_low + boxes.y_high) / 2
        half_x, half_y = (boxes.x_high - boxes.x_low) / 2, (boxes.y_high - boxes.y_low) / 2
        met = self._contain(x, y)
        for (ax, ay), (bx, by) in self.edges():
            dx, dy = bx - ax, by - ay
            aside = np.abs((x - ax) * dy - (y - ay) * dx) > half_x * abs(dy) + half_y * abs(dx)
            met |= ~aside & Rectangle(min(ax, bx), min(ay, by), max(ax, bx), max(ay, by)).meets(boxes)
        return met

    def _contain(self, x: Floats, y: Floats) -> Bools:
        """`contains` of many points."""
        inside = np.zeros(len(x), bool)
        for (ax, ay), (bx, by) in self.edges():
            if ay != by:
                inside ^= ((ay > y) != (by > y)) & (x < ax + (y - ay) / (by - ay) * (bx - ax))
        return inside

    def crossing(self) -> tuple[int, int] | None:
        """First two edges that cross or touch other than at a shared corner, by the numbers of their first corners, or None."""
        edges = self.edges()
        ends = np.array(edges, float)
        low, high = ends.min(axis=1), ends.max(axis=1)  # (edge, 2): only edges whose boxes meet can touch
        slack = 1e-9 * (np.abs(ends).max() + 1.0)
        for i, first in enumerate(edges):
            near = ((low[i + 1 :] <= high[i] + slack) & (high[i + 1 :] >= low[i] - slack)).all(axis=1)
            for j in (near.nonzero()[0] + i + 1).tolist():
                neighbours = j == i + 1 or (i == 0 and j == len(edges) - 1)
                if _folded_back(*first, *edges[j]) if neighbours else _touch(*first, *edges[j]):
                    return i, j
        return None


def _turn(a: Point, b: Point, c: Point) -> float:
    """Twice the signed area of a triangle; 0 within rounding of its size."""
    area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    size = (abs(b[0] - a[0]) + abs(b[1] - a[1])) * (abs(c[0] - a[0]) + abs(c[1] - a[1]))
    return 0.0 if abs(area) <= 1e-12 * size else area


def _on(a: Point, b: Point, c: Point) -> bool:
    """Whether c, collinear with a and b, lies between them."""
    return min(a[0], b[0]) <= c[0] <= max(a[0], b[0]) and min(a[1], b[1]) <= c[1] <= max(a[1], b[1])


def _touch(a: Point, b: Point, c: Point, d: Point) -> bool:
    """Whether the segments ab and cd have a point in common."""
    abc, abd, cda, cdb = _turn(a, b, c), _turn(a, b, d), _turn(c, d, a), _turn(c, d, b)
    if abc * abd < 0 and cda * cdb < 0:
        return True
    ends = ((abc, a, b, c), (abd, a, b, d), (cda, c, d, a), (cdb, c, d, b))
    return any(turn == 0 and _on(*segment) for turn, *segment in ends)


def _folded_back(a: Point, b: Point, c: Point, d: Point) -> bool:
    """Whether two edges that share a corner overlap, or one has no length."""
    shared, from_it, to_it = (b, a, d) if b == c else (a, b, c)
    forth = (from_it[0] - shared[0], from_it[1] - shared[1])
    back = (to_it[0] - shared[0], to_it[1] - shared[1])
    in_line = _turn(shared, from_it, to_it) == 0
    return in_line and forth[0] * back[0] + forth[1] * back[1] >= 0
