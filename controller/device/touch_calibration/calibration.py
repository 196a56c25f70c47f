"""Axis calibration: stationary touches at known targets, and the affine map from the panel's axes to the plate.

The axes are normalised to 0..1 by the ranges that the panel declares; the least-squares affine map from them to
millimetres on the plate is `x_mm_from_axes`, `y_mm_from_axes` of board.toml. Implausible touches and maps are refused.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import atan, degrees, dist, hypot, inf
from statistics import median
from typing import Final, Protocol

import numpy as np

from controller.arrays import Floats
from controller.device.touch.source import TouchSample
from controller.errors import CalibrationError

HOLD_S: Final = 0.3
STATIONARY_RADIUS_M: Final = 2e-3  # how far the reports of a stationary finger may lie from its first

MIN_TARGETS, MAX_TARGETS = 3, 5
INSET: Final = 0.15  # of the plate: where the targets lie, away from the edge where panels are least linear
MIN_SPACING_MM: Final = 10.0  # of the targets: nearer to each other, or to one straight line, they determine no map
MIN_SPACING_RAW: Final = 0.02  # the same of the touches, in shares of the axes
# Leave-one-out residual of a touch. Touches within 1 mm of four corners and a middle never exceed it; a corner missed by
# 6.3 mm does while the others are within 0.75 mm: a corner predicted from the others has three times their own errors.
MAX_RESIDUAL_MM: Final = 4.0
MIN_REDUNDANCY: Final = 0.02  # of a touch, 1 - leverage: below, the others cannot show whether it missed its target
AMBIGUOUS_SHARE: Final = 0.95  # of the largest residual: of opposite corners either may be the one that was missed
MIN_SCALE, MAX_SCALE = 0.5, 5.0  # an axis' length over the plate's side along it
MAX_SKEW_DEG: Final = 15.0  # of an axis against the plate's side

Point = tuple[float, float]


class PlateSize(Protocol):
    """What a calibration has to know of a plate."""

    @property
    def length_mm(self) -> float:
        """Along x."""

    @property
    def width_mm(self) -> float:
        """Along y."""


Row = tuple[float, float, float]


class StationaryTouches:
    """Finds fingers held stationary for `HOLD_S`, one finger alone on the panel; each counts once until it is lifted."""

    def __init__(self) -> None:
        self._down: set[int] = set()
        self._reports: list[tuple[float, float]] = []
        self._since_s = inf
        self._ignored = False  # counted already, or not alone

    @property
    def due_s(self) -> float:
        """When the finger that is down will have been held for long enough, on the loop's clock; inf: no finger is waiting."""
        return inf if self._ignored else self._since_s + HOLD_S

    def take(self, samples: Sequence[TouchSample], now_s: float) -> tuple[float, float] | None:
        """Take the `samples` of one read at `now_s` (loop's clock).

        Returns the median (x_m, y_m) of the reports of a finger that has now been held for long enough, else None.
        """
        found = self._held(samples[0].time_s if samples else now_s)
        for sample in samples:
            self._watch(sample)
        return found

    def _held(self, known_s: float) -> tuple[float, float] | None:
        """The finger that was held until `known_s`, the time of its next report or of no report."""
        if known_s < self.due_s:
            return None
        self._ignored = True
        return median(x_m for x_m, _ in self._reports), median(y_m for _, y_m in self._reports)

    def _watch(self, sample: TouchSample) -> None:
        finger, x_m, y_m, time_s, contact, _ = sample
        if not contact:
            self._down.discard(finger)
            if not self._down:
                self._ignored = False
            self._since_s = inf
            return
        if finger not in self._down:
            self._down.add(finger)
            if len(self._down) > 1:
                self._ignored = True  # which of them is meant is not known
                return
        elif hypot(x_m - self._reports[0][0], y_m - self._reports[0][1]) <= STATIONARY_RADIUS_M:
            self._reports.append((x_m, y_m))
            return
        self._reports = [(x_m, y_m)]
        self._since_s = time_s


@dataclass(frozen=True, slots=True)
class Calibration:
    """Affine map from normalised axes to the plate."""

    x_mm_from_axes: Row  # x_mm_from_axes, y_mm_from_axes: in mm: per unit of x, per unit of y, and at the minimum of both
    y_mm_from_axes: Row
    # leave-one-out residual of each target (the map of all touches follows a single one by up to 0.7 of its error at a corner);
    # empty with three targets, which an affine map always meets
    residuals_mm: tuple[float, ...]

    @property
    def rms_mm(self) -> float | None:
        """Root mean square of the residuals; None where there are none."""
        return float(np.sqrt(np.mean(np.square(self.residuals_mm)))) if self.residuals_mm else None

    @property
    def worst_mm(self) -> float | None:
        """Largest residual; None where there are none."""
        return max(self.residuals_mm, default=None)


def default_targets(plate: PlateSize, count: int) -> list[Point]:
    """Targets (x_mm, y_mm) near the corners of a `plate`; `count` 3: without the last corner, 5: with the middle."""
    near_x, near_y = INSET * plate.length_mm, INSET * plate.width_mm
    far_x, far_y = plate.length_mm - near_x, plate.width_mm - near_y
    corners = [(near_x, near_y), (far_x, near_y), (near_x, far_y), (far_x, far_y)]
    return [*corners, (plate.length_mm / 2, plate.width_mm / 2)][:count]


def check_targets(targets: Sequence[Point], plate: PlateSize) -> None:
    """Refuse `targets`, each (x_mm, y_mm) on the `plate`, that determine no calibration, before they are touched.

    Raises CalibrationError if there are not three to five, one is not on the plate, two coincide, or all lie on one line.
    """
    if not MIN_TARGETS <= len(targets) <= MAX_TARGETS:
        raise CalibrationError(f"give {MIN_TARGETS} to {MAX_TARGETS} targets, not {len(targets)}")
    for x_mm, y_mm in targets:
        if not (0 <= x_mm <= plate.length_mm and 0 <= y_mm <= plate.width_mm):  # NaN too
            raise CalibrationError(
                f"target ({x_mm:g}, {y_mm:g}) mm is not on the plate (0 to {plate.length_mm:g}, 0 to {plate.width_mm:g})"
            )
    _refuse_coincident(targets, MIN_SPACING_MM, "targets {} and {} coincide: put them at least 10 mm apart")
    if _distance_from_line(np.array(targets)) < MIN_SPACING_MM:
        raise CalibrationError("the targets lie on one line: move one of them aside")


def calibrate(targets: Sequence[Point], touches: Sequence[Point], plate: PlateSize) -> Calibration:
    """Fit the least-squares affine map from touches to targets.

    `targets` are three to five points (x_mm, y_mm) on the plate; `touches` are on the panel's axes, normalised to 0..1. Raises
    CalibrationError if targets or touches coincide or lie on one line, a value is not finite, an axis would have an implausible
    scale or skew, or a residual exceeds `MAX_RESIDUAL_MM`.
    """
    check_targets(targets, plate)
    if len(touches) != len(targets):
        raise CalibrationError(f"{len(touches)} touches for {len(targets)} targets")
    raw = np.array(touches, np.float64)
    if not np.isfinite(raw).all():
        raise CalibrationError("a touch has no position: the panel reported no number")
    _refuse_coincident(touches, MIN_SPACING_RAW, "touches {} and {} coincide: touch each target in turn")
    if _distance_from_line(raw) < MIN_SPACING_RAW:
        raise CalibrationError("the touches lie on one line: touch each target in turn")
    wanted = np.array(targets, np.float64)
    columns = np.column_stack([raw, np.ones(len(raw))])
    found = np.linalg.lstsq(columns, wanted, rcond=None)[0].astype(np.float64)
    residuals = _leave_one_out_mm(columns, columns @ found - wanted) if len(targets) > MIN_TARGETS else np.zeros(0)
    if residuals.size and residuals.max() > MAX_RESIDUAL_MM:
        missed = " or ".join(str(number + 1) for number in np.flatnonzero(residuals > AMBIGUOUS_SHARE * residuals.max()))
        raise CalibrationError(
            f"touch {missed} is {residuals.max():.1f} mm off what the others say,"
            f" more than {MAX_RESIDUAL_MM:g} mm: were the targets touched in this order? Do it again"
        )
    _check_axes(found, plate)
    x_row, y_row = ((float(per_x), float(per_y), float(at_0)) for per_x, per_y, at_0 in found.T)
    return Calibration(x_row, y_row, tuple(float(off) for off in residuals))


def _leave_one_out_mm(columns: Floats, off_mm: Floats) -> Floats:
    """Distance of each touch from the least-squares map of all others.

    `columns` (touch, 3) is the design matrix of the fit, `off_mm` (touch, 2) are the residuals of the fit of all; a leave-one-out
    residual is that over 1 - leverage (Cook and Weisberg, Residuals and Influence in Regression, 2.2).
    """
    q, _ = np.linalg.qr(columns)
    redundancy = 1 - np.sum(q * q, axis=1)
    if redundancy.min() < MIN_REDUNDANCY:
        raise CalibrationError(
            f"without touch {redundancy.argmin() + 1} the others lie on one line, so they cannot show whether it missed its target:"
            " put the targets near the plate's corners"
        )
    residuals_mm: Floats = np.hypot(*off_mm.T) / redundancy
    return residuals_mm


def _check_axes(found: Floats, plate: PlateSize) -> None:
    """Refuse axes that are not nearly parallel to different sides of the plate, or of implausible length."""
    sides = []
    for name, (along_x, along_y) in zip("xy", np.abs(found[:2]), strict=True):
        side = int(along_y > along_x)
        long_mm, across_mm = max(along_x, along_y), min(along_x, along_y)
        tilt = degrees(atan(across_mm / long_mm)) if long_mm else 90.0
        if tilt > MAX_SKEW_DEG:
            raise CalibrationError(
                f"the panel's {name} axis would lie {tilt:.0f} degrees oblique to the plate:"
                " were the targets touched in this order? Do it again"
            )
        scale = long_mm / (plate.width_mm if side else plate.length_mm)
        if not MIN_SCALE <= scale <= MAX_SCALE:
            raise CalibrationError(
                f"the panel's {name} axis would be {scale:.3g} times as long as the plate's side: "
                "were the targets touched in this order? Do it again"
            )
        sides.append(side)
    if sides[0] == sides[1]:
        raise CalibrationError("both axes of the panel would lie along one side of the plate: do it again")


def _refuse_coincident(points: Sequence[Point], closest: float, message: str) -> None:
    for j, one in enumerate(points):
        for i, other in enumerate(points[:j]):
            if dist(one, other) < closest:
                raise CalibrationError(message.format(i + 1, j + 1))


def _distance_from_line(points: Floats) -> float:
    """Root mean square distance of points from the straight line that fits best."""
    return float(np.linalg.svd(points - points.mean(axis=0), compute_uv=False)[-1] / np.sqrt(len(points)))
