"""Map from a touch panel's axes to the plate."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from controller.device.board.touch_panels import TouchPanel
from controller.device.touch.source import TouchedPlate

if TYPE_CHECKING:
    from controller.device.board.board import Board

OFF_M: Final = 2e-3  # beyond the plate's edge: the map of a calibrated panel is not better than that


@dataclass(frozen=True, slots=True)
class AxisRange:
    """Smallest and largest value of one axis, as the device declares it."""

    minimum: int
    maximum: int


class PanelAxes:
    """Both axes of one panel on one board.

    A raw value is normalised to 0..1 by the range of its axis; the board's affine map (`touch.x_mm_from_axes`,
    `touch.y_mm_from_axes`: per unit of x, per unit of y, at their minimum) gives the position on the plate. PanelAxes may be
    mirrored or swapped, and may reach beyond the glass.

    An axis without extent (guessed from one single tap) reads as its middle.
    """

    __slots__ = ("from_axes", "plate_m", "settings", "size_m_per_unit", "unit_m", "x", "y")

    def __init__(self, board: Board | TouchedPlate, x: AxisRange, y: AxisRange) -> None:
        self.x = x
        self.y = y
        self.settings: TouchPanel = board.touch  # the board's [touch]
        self.plate_m = (board.plate.length_m, board.plate.width_m)  # length and width of the plate
        # The map: metres along x per raw unit of x, of y, at raw (0, 0); the same along y
        self.from_axes = (*_per_raw(board.touch.x_mm_from_axes, x, y), *_per_raw(board.touch.y_mm_from_axes, x, y))
        x_by_x, x_by_y, _, y_by_x, y_by_y, _ = self.from_axes
        # The kernel gives a contact's size in units of its position, which may differ between the axes
        # Metres on the plate per raw unit of x, and of y; 0 of an axis without extent
        self.unit_m = (math.hypot(x_by_x, y_by_x), math.hypot(x_by_y, y_by_y))
        self.size_m_per_unit = sum(self.unit_m) / 2  # metres per raw unit of a contact's size, the mean of both axes

    def clamp(self, x: int, y: int) -> tuple[int, int]:
        """Raw position (`x`, `y`) clamped to both ranges."""
        return _clamped(x, self.x), _clamped(y, self.y)

    def position_m(self, x: int, y: int) -> tuple[float, float]:
        """Position (x_m, y_m) on the plate, clamped to it, of a raw position inside the ranges."""
        length_m, width_m = self.plate_m
        x_m, y_m = self.mapped_m(x, y)
        return min(max(x_m, 0.0), length_m), min(max(y_m, 0.0), width_m)

    def mapped_m(self, x: int, y: int) -> tuple[float, float]:
        """The same, not clamped: on the plate or beside it."""
        x_by_x, x_by_y, x_at_0, y_by_x, y_by_y, y_at_0 = self.from_axes
        return x_by_x * x + x_by_y * y + x_at_0, y_by_x * x + y_by_y * y + y_at_0

    def plain(self) -> tuple[float, float, float, float]:
        """Smallest and largest x, smallest and largest y: raw positions within are inside the ranges, and places of fingers.

        Neither products nor sums lose their order by rounding, so the corners speak for all between them. They are one unit inside
        the ranges, as those of a map to the whole plate may lie beside it by a rounding. If one lies beside it, nothing is within.
        """
        low_x, high_x = self.x.minimum + 1, self.x.maximum - 1
        low_y, high_y = self.y.minimum + 1, self.y.maximum - 1
        corners = [self.mapped_m(x, y) for x in (low_x, high_x) for y in (low_y, high_y)]
        length_m, width_m = self.plate_m
        plain = not self.settings.no_finger_m and all(0 <= x_m <= length_m and 0 <= y_m <= width_m for x_m, y_m in corners)
        return (low_x, high_x, low_y, high_y) if plain else (math.inf, math.inf, math.inf, math.inf)


def _clamped(value: int, axis: AxisRange) -> int:
    return min(max(value, axis.minimum), axis.maximum)


def _per_raw(mm_from_axes: tuple[float, float, float], x: AxisRange, y: AxisRange) -> tuple[float, float, float]:
    """Metres per raw unit of x, of y, and at raw (0, 0)."""
    at_minimum = mm_from_axes[2]
    per_raw = []
    for mm, axis in zip(mm_from_axes, (x, y), strict=False):
        extent = axis.maximum - axis.minimum
        per_raw.append(mm / extent if extent else 0.0)
        at_minimum += -per_raw[-1] * axis.minimum if extent else mm / 2
    return per_raw[0] * 1e-3, per_raw[1] * 1e-3, at_minimum * 1e-3
