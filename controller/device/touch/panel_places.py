"""Where on the plate a raw position of a touch panel is, and whether a finger can be there.

More than `EDGE_M` outside the axes, or in a rectangle of `touch.no_finger_mm`, there is none; positions that are less far outside
are clamped to the axes.
"""

from __future__ import annotations

from collections import Counter
from math import inf
from typing import Final

from controller.device.touch.axes import OFF_M, PanelAxes
from controller.device.touch.source import Counts

EDGE_M: Final = 5e-3  # half a fingertip: one that is centred farther outside does not touch the panel's outermost electrodes


class PanelPlaces:
    """Places of one device's fingers; counts positions that are none, and those beside axes and plate."""

    def __init__(self, axes: PanelAxes, counts: Counts, warnings: Counter[str]) -> None:
        self._axes = axes
        self._counts = counts
        self._warnings = warnings
        x, y = axes.x, axes.y
        x_edge, y_edge = [EDGE_M / unit_m if unit_m else inf for unit_m in axes.unit_m]
        self._limits: tuple[float, float, float, float] = (x.minimum, x.maximum, y.minimum, y.maximum)
        self._far = (x.minimum - x_edge, x.maximum + x_edge, y.minimum - y_edge, y.maximum + y_edge)
        self._no_finger_m = axes.settings.no_finger_m

    def place_m(self, x: int, y: int) -> tuple[float, float] | None:
        """Place on the plate of a raw position; None, which is counted, if it is no place of a finger."""
        x_low, x_high, y_low, y_high = self._limits
        if not (x_low <= x <= x_high and y_low <= y <= y_high):
            x_low, x_high, y_low, y_high = self._far
            if not (x_low <= x <= x_high and y_low <= y <= y_high):
                self._warnings["far_outside"] += 1
                return None
            self._warnings["outside_axes"] += 1
            x, y = self._axes.clamp(x, y)
        length_m, width_m = self._axes.plate_m
        x_m, y_m = self._axes.mapped_m(x, y)
        if not (0.0 <= x_m <= length_m and 0.0 <= y_m <= width_m):
            self._counts.off_plate += not (-OFF_M <= x_m <= length_m + OFF_M and -OFF_M <= y_m <= width_m + OFF_M)
            x_m = 0.0 if x_m < 0.0 else length_m if x_m > length_m else x_m
            y_m = 0.0 if y_m < 0.0 else width_m if y_m > width_m else y_m
        if self._no_finger_m:
            for left_m, low_m, right_m, high_m in self._no_finger_m:
                if left_m <= x_m <= right_m and low_m <= y_m <= high_m:
                    self._warnings["no_finger"] += 1
                    return None
        return x_m, y_m
