"""The grid of cells: the points of the plate for which a bank may hold an entry."""

from __future__ import annotations

import math
from dataclasses import dataclass
from math import floor, sqrt
from typing import Final

import numpy as np

from controller.arrays import Floats
from controller.device.board.plate.plate import Plate
from controller.errors import ConfigError

TO_WHOLE: Final = 1.5 * 2**52  # added and taken away it leaves the nearest whole number, as `round` does, in two additions

Four = tuple[int, int, int, int]
FourWeights = tuple[float, float, float, float]


@dataclass(frozen=True, slots=True)
class Grid:
    """A square lattice; cell `iy * nx + ix` is the point `(x0 + ix pitch, y0 + iy pitch)`."""

    pitch_m: float
    nx: int
    ny: int
    x0_m: float
    y0_m: float

    @classmethod
    def of(cls, plate: Plate, pitch_m: float) -> Grid:
        """Grid of the most cells that are at least one pitch from every side of the plate, centred.

        Raises ConfigError if the pitch leaves no cell, or is not above zero.
        """
        extents = (plate.length_m, plate.width_m)
        if not (math.isfinite(pitch_m) and 0 < pitch_m <= min(extents) / 2):
            raise ConfigError(
                f"pitch_mm = {pitch_m * 1e3:g}: not between 0 and half of the plate's shorter side ({min(extents) * 500:g} mm)"
            )
        # the slack lets 210 mm hold 42 pitches of 5 mm although neither is a binary fraction
        nx, ny = (math.floor(extent / pitch_m - 2 + 1e-9) + 1 for extent in extents)
        x0_m, y0_m = ((extent - (n - 1) * pitch_m) / 2 for extent, n in zip(extents, (nx, ny), strict=True))
        return cls(pitch_m, nx, ny, x0_m, y0_m)

    @property
    def cells(self) -> int:
        """Cells of the whole grid, built or not."""
        return self.nx * self.ny

    def place(self, cell: int) -> tuple[float, float]:
        """Point of a cell in m."""
        iy, ix = divmod(cell, self.nx)
        return self.x0_m + ix * self.pitch_m, self.y0_m + iy * self.pitch_m

    def nearest(self, x_m: float, y_m: float) -> tuple[int, float]:
        """Cell nearest to the point (x_m, y_m), and their distance in m."""
        cell = self.within(x_m, y_m, math.inf)
        return cell, math.dist((x_m, y_m), self.place(cell))

    def within(self, x_m: float, y_m: float, distance_m: float) -> int:
        """Cell nearest to the point (x_m, y_m) if it is no farther away than `distance_m`, else -1."""
        pitch_m, nx = self.pitch_m, self.nx
        x_m -= self.x0_m
        ix = floor(x_m / pitch_m + TO_WHOLE - TO_WHOLE)
        ix = 0 if ix < 0 else ix if ix < nx else nx - 1
        off_x_m = x_m - ix * pitch_m
        if not -distance_m <= off_x_m <= distance_m:
            return -1
        y_m -= self.y0_m
        iy = floor(y_m / pitch_m + TO_WHOLE - TO_WHOLE)
        iy = 0 if iy < 0 else iy if iy < self.ny else self.ny - 1
        off_y_m = y_m - iy * pitch_m
        return iy * nx + ix if sqrt(off_x_m * off_x_m + off_y_m * off_y_m) <= distance_m else -1

    def corners(self, x_m: float, y_m: float) -> tuple[Four, FourWeights]:
        """Four cells around the point (x_m, y_m) and their bilinear weights, which sum to one.

        A point beyond the outermost cells is replaced by the nearest point between them. A cell may be listed twice, with
        weight zero.
        """
        fx = min(max((x_m - self.x0_m) / self.pitch_m, 0.0), self.nx - 1.0)
        fy = min(max((y_m - self.y0_m) / self.pitch_m, 0.0), self.ny - 1.0)
        ix, iy = min(int(fx), max(self.nx - 2, 0)), min(int(fy), max(self.ny - 2, 0))
        # to a millionth of a pitch, so that a point on a cell needs no neighbours
        fx, fy = round(fx - ix, 6), round(fy - iy, 6)
        right = 1 if self.nx > 1 else 0
        up = self.nx if self.ny > 1 else 0
        cell = iy * self.nx + ix
        return (
            (cell, cell + right, cell + up, cell + up + right),
            ((1 - fx) * (1 - fy), fx * (1 - fy), (1 - fx) * fy, fx * fy),
        )

    def points(self) -> Floats:
        """Every cell's point, (cells, 2) in m, in the order of the cells."""
        x_m = self.x0_m + self.pitch_m * np.arange(self.nx)
        y_m = self.y0_m + self.pitch_m * np.arange(self.ny)
        return np.stack([np.tile(x_m, self.ny), np.repeat(y_m, self.nx)], axis=1)
