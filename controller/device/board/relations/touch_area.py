"""The part of the plate that a touch panel's axes reach: both run from 0 to 1, and an affine map makes mm of them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

Point = tuple[float, float]
Row = tuple[float, float, float]


class Reached(NamedTuple):
    """What the panel's whole range reaches."""

    x_mm: tuple[float, float]  # x_mm, y_mm: (lowest, highest): of its corners
    y_mm: tuple[float, float]
    area_mm2: float  # of the whole range; 0: all touches fall onto one line or point
    on_plate_mm2: float  # of its part on the plate


def reached(x_row: Row, y_row: Row, length_mm: float, width_mm: float) -> Reached:
    """What the axes reach of a plate, by the factors of both axes and the offset, of x and of y."""
    corners = [
        (x_row[0] * one + x_row[1] * other + x_row[2], y_row[0] * one + y_row[1] * other + y_row[2])
        for one, other in ((0, 0), (1, 0), (1, 1), (0, 1))
    ]
    part: Sequence[Point] = corners
    for axis, extent in ((0, length_mm), (1, width_mm)):
        part = _above(part, axis, 0.0, 1)
        part = _above(part, axis, extent, -1)
    xs, ys = zip(*corners, strict=True)
    return Reached((min(xs), max(xs)), (min(ys), max(ys)), _area(corners), _area(part))


def _above(polygon: Sequence[Point], axis: int, limit: float, sign: int) -> list[Point]:
    """The part of a convex polygon on one side of a line (Sutherland and Hodgman)."""
    found: list[Point] = []
    for index, point in enumerate(polygon):
        before = polygon[index - 1]
        depth, depth_before = sign * (point[axis] - limit), sign * (before[axis] - limit)
        if (depth >= 0) != (depth_before >= 0):
            way = depth_before / (depth_before - depth)
            found.append((before[0] + way * (point[0] - before[0]), before[1] + way * (point[1] - before[1])))
        if depth >= 0:
            found.append(point)
    return found


def _area(polygon: Sequence[Point]) -> float:
    turned = sum(polygon[i - 1][0] * y - x * polygon[i - 1][1] for i, (x, y) in enumerate(polygon))
    return abs(turned) / 2
