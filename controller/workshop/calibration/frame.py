"""A frame in which places of points are stated, and where they lie on the plate."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from controller.arrays import Floats
from controller.device.board.board import Board

MOVED_M = 0.4e-3  # a frame that moves no point by more is left as stated: patches and edges leave so much open
SURE = 4.0  # standard deviations
OPEN = 0.01  # error of the scale beyond which it is left as stated
MIRRORS = {  # from stated coordinates to those of the plate, about its middle
    "": ((1, 0), (0, 1)),
    "x runs the other way": ((-1, 0), (0, 1)),
    "y runs the other way": ((1, 0), (0, -1)),
    "x and y run the other way": ((-1, 0), (0, -1)),
    "x and y are exchanged": ((0, 1), (1, 0)),
    "x and y are exchanged, x runs the other way": ((0, -1), (1, 0)),
    "x and y are exchanged, y runs the other way": ((0, 1), (-1, 0)),
    "x and y are exchanged, both run the other way": ((0, -1), (-1, 0)),
}


@dataclass(frozen=True)
class MeasuringFrame:
    """How stated places become those on the plate: mirrored, turned and stretched about the plate's middle, then moved."""

    mirror: str = ""  # a key of `MIRRORS`
    offset_m: tuple[float, float] = (0.0, 0.0)
    rotation: float = 0.0  # in rad, from x to y
    scale: float = 1.0
    factor: float = 1.0  # of the wavenumber, with which the direct waves fit best
    offset_error_m: tuple[float, float] = (0.0, 0.0)  # these three: standard deviations
    rotation_error: float = 0.0
    scale_error: float = 0.0

    def places(self, points_m: Floats, middle_m: Floats) -> Floats:
        """Where stated points, (point, 2), lie on the plate."""
        cos, sin = self.scale * np.cos(self.rotation), self.scale * np.sin(self.rotation)
        turned = np.array([[cos, -sin], [sin, cos]]) @ np.array(MIRRORS[self.mirror])
        found: Floats = (points_m - middle_m) @ turned.T + middle_m + self.offset_m
        return found

    @property
    def changes(self) -> Floats:
        """Offset along x and y, rotation, and scale less 1: (4,)."""
        return np.array([*self.offset_m, self.rotation, self.scale - 1])

    @property
    def errors(self) -> Floats:
        """Standard deviations of `changes`."""
        return np.array([*self.offset_error_m, self.rotation_error, self.scale_error])

    def with_changes(self, changes: Floats, errors: Floats) -> MeasuringFrame:
        """The same mirror, and other `changes`."""
        x_m, y_m, rotation, larger = changes.tolist()
        x_error_m, y_error_m, rotation_error, scale_error = errors.tolist()
        offsets = (x_m, y_m), rotation, 1 + larger
        return MeasuringFrame(self.mirror, *offsets, self.factor, (x_error_m, y_error_m), rotation_error, scale_error)

    @property
    def sure(self) -> tuple[bool, ...]:
        """Whether each of `changes` is surely not nil."""
        return tuple((np.abs(self.changes) > SURE * self.errors).tolist())

    def differs(self, board: Board, points_m: Floats) -> bool:
        """Whether it is surely another frame than the stated one, and not by so little that patches and edges leave it open."""
        moved_m = self.places(points_m, middle_m(board)) - points_m
        return (bool(self.mirror) or any(self.sure)) and float(np.hypot(moved_m[:, 0], moved_m[:, 1]).max()) > MOVED_M

    def in_words(self) -> str:
        """Figures with their standard deviations."""
        x, y = (
            f"{1e3 * value:+.2f} ± {1e3 * error:.2f} mm" for value, error in zip(self.offset_m, self.offset_error_m, strict=True)
        )
        turned = f"{np.degrees(self.rotation):+.2f} ± {np.degrees(self.rotation_error):.2f}°"
        stretched = f"larger by {100 * (self.scale - 1):+.2f} ± {100 * self.scale_error:.2f} %"
        if self.scale == 1 and self.scale_error > OPEN:
            stretched = f"scale as stated: the waves do not tell it, to {100 * self.scale_error:.1f} %"
        return f"{self.mirror + ', ' if self.mirror else ''}x {x}, y {y}, turned by {turned}, {stretched}"


def middle_m(board: Board) -> Floats:
    """Of the plate: (2,)."""
    return np.array([board.plate.length_m, board.plate.width_m]) / 2
