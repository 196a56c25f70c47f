"""How far a finger has come to the next emission of a spacing.

A finger at rest trembles by the noise of its reports, which must not count as movement: a distance counts once it is REST_M
or more from the last counted place, and a grid line is felt again only after the finger was a part of a spacing away from it.
"""

from __future__ import annotations

import math
from typing import Final

ROUNDING_M: Final = 1e-9  # so that a spacing reached exactly is reached
REST_M: Final = 0.25e-3  # noise of a finger at rest; for fine spacings a quarter of the spacing
REARM_SHARE: Final = 0.25  # of a spacing: distance from a line after which it is felt again
MAX_REARM_M: Final = 0.5e-3


class DistanceProgress:
    """Distance that a finger has travelled since the last emission, in any direction.

    The finger's first report inside the region was at (x_m, y_m).
    """

    __slots__ = ("_anchor_x_m", "_anchor_y_m", "_rest_m", "_spacing_m", "_travelled_m", "amplitude")

    def __init__(self, spacing_m: float, amplitude: float, x_m: float, y_m: float) -> None:
        self.amplitude = amplitude
        self._spacing_m = spacing_m
        self._rest_m = min(REST_M, spacing_m / 4)
        self._travelled_m = 0.0
        self._anchor_x_m, self._anchor_y_m = x_m, y_m

    def crossed(self, x_m: float, y_m: float) -> bool:
        """Whether the finger's move to (x_m, y_m) completes a spacing; if several, the rest of the distance is kept."""
        off_x_m, off_y_m = x_m - self._anchor_x_m, y_m - self._anchor_y_m
        step_m = math.sqrt(off_x_m * off_x_m + off_y_m * off_y_m)
        travelled_m = self._travelled_m + step_m
        if travelled_m >= self._spacing_m - ROUNDING_M:
            self._travelled_m = max(math.fmod(travelled_m + ROUNDING_M, self._spacing_m) - ROUNDING_M, 0.0)
            self._anchor_x_m, self._anchor_y_m = x_m, y_m
            return True
        if step_m >= self._rest_m:
            self._travelled_m = travelled_m
            self._anchor_x_m, self._anchor_y_m = x_m, y_m
        return False

    def shift(self, x_m: float, y_m: float) -> None:
        """What the finger lies on has moved by (x_m, y_m): that counts as way of the finger the other way."""
        self._anchor_x_m += x_m
        self._anchor_y_m += y_m

    def remaining_m(self, x_m: float, y_m: float, _x: float, _y: float) -> float:
        """Distance from (x_m, y_m) to the next emission, whatever the direction."""
        return max(self._spacing_m - self._travelled_m - math.hypot(x_m - self._anchor_x_m, y_m - self._anchor_y_m), 0.0)


class GridProgress:
    """Between which grid lines a finger is, and which line it has just felt.

    The finger's first report inside the region was at `at_m` along the axis.
    """

    __slots__ = ("_axis", "_cell", "_felt", "_origin_m", "_rearm", "_spacing_m", "amplitude")

    def __init__(self, spacing_m: float, amplitude: float, axis: int, origin_m: float, at_m: float) -> None:
        self.amplitude = amplitude
        self._spacing_m = spacing_m
        self._origin_m = origin_m
        self._axis = axis
        self._rearm = min(REARM_SHARE, MAX_REARM_M / spacing_m)
        self._cell = math.floor((at_m - origin_m + ROUNDING_M) / spacing_m)
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

    def shift(self, x_m: float, y_m: float) -> None:
        """The lines have moved by (x_m, y_m), and with them those that the finger is between."""
        self._origin_m += y_m if self._axis else x_m

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
