"""Where a panel's axes lie on the plate, from touches at known places.

The axes are normalised to 0..1 by the ranges that the panel declares; the least-squares affine map from them to
millimetres on the plate is `x_mm_from_axes`, `y_mm_from_axes` of board.toml. What cannot be meant is refused.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import atan, degrees, dist
from typing import Final

import numpy as np
from numpy.typing import NDArray

from controller.board.board import Plate
from controller.errors import CalibrationError

FEWEST, MOST = 3, 5
INSET = 0.15  # of the plate: where the targets lie, away from the edge where panels are least linear
CLOSEST_MM = 10.0  # targets nearer to each other, or to one straight line, tell nothing
CLOSEST_RAW = 0.02  # the same of the touches, in shares of the axes
# Of a touch from where the map of the others puts it. Touches within 1 mm of four corners and a middle never exceed it; a corner
# missed by 6.3 mm does while the others are within 0.75 mm: what they say of a corner has three times their own errors.
LARGEST_RESIDUAL_MM = 4.0
LEAST_FREEDOM = 0.02  # of a touch: less, and no other tells whether it was missed
ALIKE = 0.95  # of opposite corners either may be the one that was missed: nothing tells which
SMALLEST_SCALE, LARGEST_SCALE = 0.5, 5.0  # an axis' length over the plate's side along it
LARGEST_TILT: Final = 15.0  # degrees, of an axis against the plate's side

Point = tuple[float, float]
Row = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class Calibration:
    """The map from normalised axes to the plate, in mm: per unit of x, per unit of y, at their minimum.

    Attributes
    ----------
    residuals_mm : tuple of float
        Distance of each target from where the map of the other touches puts its own (leave one out: the map of all follows
        each touch by as much as 0.7 of its error at a corner); empty with three targets, which any map meets.
    """

    x_mm_from_axes: Row
    y_mm_from_axes: Row
    residuals_mm: tuple[float, ...]

    @property
    def rms_mm(self) -> float | None:
        """Root mean square of the residuals; None where there are none."""
        return float(np.sqrt(np.mean(np.square(self.residuals_mm)))) if self.residuals_mm else None

    @property
    def worst_mm(self) -> float | None:
        """Largest residual; None where there are none."""
        return max(self.residuals_mm, default=None)


def default_targets(plate: Plate, count: int) -> list[Point]:
    """So many (x_mm, y_mm) on a plate: the corners, without the last for three; with the middle for five."""
    near_x, near_y = INSET * plate.length_mm, INSET * plate.width_mm
    far_x, far_y = plate.length_mm - near_x, plate.width_mm - near_y
    corners = [(near_x, near_y), (far_x, near_y), (near_x, far_y), (far_x, far_y)]
    return [*corners, (plate.length_mm / 2, plate.width_mm / 2)][:count]


def check_targets(targets: Sequence[Point], plate: Plate) -> None:
    """Refuse targets from which no calibration could follow, before anybody touches them.

    Raises
    ------
    CalibrationError
        If there are not three to five, one is not on the plate, or they lie at one place or on one line.
    """
    if not FEWEST <= len(targets) <= MOST:
        raise CalibrationError(f"give {FEWEST} to {MOST} targets, not {len(targets)}")
    for x_mm, y_mm in targets:
        if not (0 <= x_mm <= plate.length_mm and 0 <= y_mm <= plate.width_mm):  # NaN too
            raise CalibrationError(
                f"target ({x_mm:g}, {y_mm:g}) mm is not on the plate (0 to {plate.length_mm:g}, 0 to {plate.width_mm:g})"
            )
    _refuse_one_place(targets, CLOSEST_MM, "targets {} and {} are at one place: put them at least 10 mm apart")
    if _breadth(np.array(targets)) < CLOSEST_MM:
        raise CalibrationError("the targets lie on one line: put one of them aside")


def calibrate(targets: Sequence[Point], touches: Sequence[Point], plate: Plate) -> Calibration:
    """Least-squares map from touches to targets.

    Parameters
    ----------
    targets : sequence of (x_mm, y_mm)
        Three to five places on the plate.
    touches : sequence of (x, y)
        Where the panel's axes said each was touched, normalised to 0..1.
    plate : Plate
        Its sides are what the scales are judged by.

    Raises
    ------
    CalibrationError
        If targets or touches lie at one place or on one line, a value is not finite, an axis would be absurdly long or
        short, or oblique to the plate, or a target is farther off than `LARGEST_RESIDUAL_MM`.
    """
    check_targets(targets, plate)
    if len(touches) != len(targets):
        raise CalibrationError(f"{len(touches)} touches for {len(targets)} targets")
    raw = np.array(touches, np.float64)
    if not np.isfinite(raw).all():
        raise CalibrationError("a touch has no place: the panel gave no number")
    _refuse_one_place(touches, CLOSEST_RAW, "touches {} and {} are at one place: touch each target in its turn")
    if _breadth(raw) < CLOSEST_RAW:
        raise CalibrationError("the touches lie on one line: touch each target in its turn")
    wanted = np.array(targets, np.float64)
    columns = np.column_stack([raw, np.ones(len(raw))])
    found = np.linalg.lstsq(columns, wanted, rcond=None)[0].astype(np.float64)
    residuals = _left_out_mm(columns, columns @ found - wanted) if len(targets) > FEWEST else np.zeros(0)
    if residuals.size and residuals.max() > LARGEST_RESIDUAL_MM:
        missed = " or ".join(str(number + 1) for number in np.flatnonzero(residuals > ALIKE * residuals.max()))
        raise CalibrationError(
            f"touch {missed} is {residuals.max():.1f} mm off what the others say,"
            f" more than {LARGEST_RESIDUAL_MM:g} mm: were the targets touched in this order? Do it again"
        )
    _check_axes(found, plate)
    x_row, y_row = ((float(per_x), float(per_y), float(at_0)) for per_x, per_y, at_0 in found.T)
    return Calibration(x_row, y_row, tuple(float(off) for off in residuals))


def _left_out_mm(columns: NDArray[np.float64], off_mm: NDArray[np.float64]) -> NDArray[np.float64]:
    """How far each touch is from where the least-squares map of all others puts it.

    Parameters
    ----------
    columns : (touches, 3) array
        What the map was fitted on.
    off_mm : (touches, 2) array
        How far each is from the map of all: less by its leverage (Cook and Weisberg, Residuals and Influence in Regression, 2.2).
    """
    q, _ = np.linalg.qr(columns)
    freedom = 1 - np.sum(q * q, axis=1)
    if freedom.min() < LEAST_FREEDOM:
        raise CalibrationError(
            f"without touch {freedom.argmin() + 1} the others lie on one line, so nothing tells whether it was missed:"
            " put the targets near the plate's corners"
        )
    left_out: NDArray[np.float64] = np.hypot(*off_mm.T) / freedom
    return left_out


def _check_axes(found: NDArray[np.float64], plate: Plate) -> None:
    """Refuse axes that are not about parallel to different sides of the plate, and about as long."""
    sides = []
    for name, (along_x, along_y) in zip("xy", np.abs(found[:2]), strict=True):
        side = int(along_y > along_x)
        long_mm, across_mm = max(along_x, along_y), min(along_x, along_y)
        tilt = degrees(atan(across_mm / long_mm)) if long_mm else 90.0
        if tilt > LARGEST_TILT:
            raise CalibrationError(
                f"the panel's {name} axis would lie {tilt:.0f} degrees oblique to the plate:"
                " were the targets touched in this order? Do it again"
            )
        scale = long_mm / (plate.width_mm if side else plate.length_mm)
        if not SMALLEST_SCALE <= scale <= LARGEST_SCALE:
            raise CalibrationError(
                f"the panel's {name} axis would be {scale:.3g} times as long as the plate's side: "
                "were the targets touched in this order? Do it again"
            )
        sides.append(side)
    if sides[0] == sides[1]:
        raise CalibrationError("both axes of the panel would lie along one side of the plate: do it again")


def _refuse_one_place(points: Sequence[Point], closest: float, message: str) -> None:
    for j, one in enumerate(points):
        for i, other in enumerate(points[:j]):
            if dist(one, other) < closest:
                raise CalibrationError(message.format(i + 1, j + 1))


def _breadth(points: NDArray[np.float64]) -> float:
    """Root mean square distance from the straight line that fits best."""
    return float(np.linalg.svd(points - points.mean(axis=0), compute_uv=False)[-1] / np.sqrt(len(points)))
