"""Lag of a panel's reports, from strokes of a finger and a mouse that move together.

The reports alone do not show the lag: reports that are all late by the same time are the same strokes later. Therefore a mouse
is held to the finger, and both slide over the glass to and fro. With the mouse's counts M(t), the reported position is
A M(t - lag) + b: A (rotation and scale) is common to the recording, b is separate for each second, since the mouse turns and
slips a little. The lag is the least-squares fit, second by second; the spread of the seconds gives its error. A lag differs from
an offset b only where the speed changes: hence the strokes to and fro.

The mouse itself is taken to be late by half of its report period, with an error of at most as much.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final, NamedTuple

import numpy as np

from controller.arrays import Floats, Indices
from controller.device.board.board import Board
from controller.device.touch.recordings.recording import Recording
from controller.device.touch.recordings.replay import RecordingSource
from controller.device.touch_calibration.event_capture import EV_REL, REL_X, REL_Y
from controller.errors import CalibrationError

MIN_TURNS: Final = 12
MIN_STROKE_M: Final = 10e-3  # a shorter stroke is a tremor
WINDOW_S: Final = 1.0
MIN_WINDOWS: Final = 6
MIN_PATH_M: Final = 40e-3  # of the finger's path in a window that is used
MIN_REPORTS: Final = 20  # in such a window
LAGS_S: Final = np.arange(-20e-3, 151e-3, 1e-3)
MAX_RESIDUAL_M: Final = 1.5e-3  # rms: above, finger and mouse did not move together
MAX_ERROR_S: Final = 2e-3
SEVERAL: Final = "several fingers on the panel: slide one finger alone, and keep the hand off the glass"
MAX_MOUSE_PERIOD_S: Final = 10e-3  # the lag is uncertain by half of it


class TimedPlaces(NamedTuple):
    """When something was where: times in s, (n,), and places, (n, 2), in m or in counts."""

    at_s: Floats
    places: Floats


@dataclass(frozen=True, slots=True)
class LagFigures:
    """Result of a measurement."""

    lag_ms: float  # lag of the panel's positions, for board.toml
    error_ms: float  # random error at 95 % confidence, from the spread of the windows
    mouse_ms: float  # report period of the mouse; half of it is added in `lag_ms`, which may be wrong by as much
    turns: int  # turns, windows: turns of the strokes; seconds that were used
    windows: int
    residual_mm: float  # rms distance of the finger from its position by the mouse


def lag_figures(recording: Recording, board: Board) -> LagFigures:
    """Evaluate a recording of one finger and a mouse that moved together.

    The mouse's EV_REL are among the events of the recording. Raises CalibrationError if there are too few strokes, several fingers,
    no mouse or a slow one, or finger and mouse did not move together.
    """
    return lag_of(_finger(recording, board), _mouse(recording))


def lag_of(finger: TimedPlaces, mouse: TimedPlaces) -> LagFigures:
    """Evaluate the tracks of one finger and of a mouse that moved with it; raises CalibrationError as `lag_figures` does."""
    if (period_s := _period_s(mouse.at_s)) > MAX_MOUSE_PERIOD_S:
        raise CalibrationError(f"the mouse reports every {period_s * 1e3:.0f} ms: take one that reports at least every 8 ms")
    at_s, positions_m = finger
    turns = _turns(positions_m)
    if turns < MIN_TURNS:
        raise CalibrationError(f"only {turns} turns: slide to and fro, by 5 cm or more, at least {MIN_TURNS} times")
    windows = _windows(at_s, positions_m)
    if len(windows) < MIN_WINDOWS:
        raise CalibrationError(f"only {len(windows)} s of strokes fast enough: slide 5 cm to and fro about twice a second")
    coarse_s = LAGS_S[int(np.argmin([_fit(at_s, positions_m, windows, mouse, lag_s)[0] for lag_s in LAGS_S]))]
    if coarse_s in (LAGS_S[0], LAGS_S[-1]):
        raise CalibrationError("finger and mouse did not move together: hold them together, and do it again")
    residual_m, map_of = _fit(at_s, positions_m, windows, mouse, float(coarse_s))
    if residual_m > MAX_RESIDUAL_M:
        raise CalibrationError(
            f"finger and mouse did not move together, they are {residual_m * 1e3:.1f} mm apart: hold them together, and do it again"
        )
    lags_s = np.array([_lag_of(at_s[window], positions_m[window], mouse, map_of, float(coarse_s)) for window in windows])
    error_s = 1.96 * 1.2533 * 1.4826 * float(np.median(np.abs(lags_s - np.median(lags_s))) / np.sqrt(len(lags_s)))
    if error_s > MAX_ERROR_S:
        raise CalibrationError(f"the strokes disagree by {error_s * 1e3:.1f} ms: hold finger and mouse together, and do it again")
    lag_s = float(np.median(lags_s)) + period_s / 2
    if lag_s < -(error_s + period_s / 2):
        raise CalibrationError(f"the panel would be {-lag_s * 1e3:.1f} ms ahead of the mouse: take another mouse")
    return LagFigures(max(lag_s, 0.0) * 1e3, error_s * 1e3, period_s * 1e3, turns, len(windows), residual_m * 1e3)


def _mouse(recording: Recording) -> TimedPlaces:
    """The mouse's reports, and its accumulated counts."""
    steps: dict[float, list[int]] = {}
    for kind, code, value, time_s in recording.events:
        if kind == EV_REL and code in (REL_X, REL_Y):
            steps.setdefault(time_s, [0, 0])[code] += value
    if len(steps) < MIN_REPORTS:
        raise CalibrationError(
            f"{recording.name} has no mouse in it: make one with calibrate-touch --lag --reference DEVICE --out FILE"
        )
    return TimedPlaces(np.array(list(steps)), np.cumsum(np.array(list(steps.values()), np.float64), axis=0))


def _period_s(at_s: Floats) -> float:
    return float(np.median(np.diff(at_s)))


def _finger(recording: Recording, board: Board) -> TimedPlaces:
    """The finger's positions in m."""
    source = RecordingSource(recording, recording.axes(board), 0.0)
    reports: list[tuple[float, float, float]] = []
    while (next_s := source.next_time_s()) is not None:
        for sample in source.read(next_s):
            if sample.contact:
                reports.append((sample.time_s, sample.x_m, sample.y_m))
    if source.counts.max_fingers > 1:
        raise CalibrationError(SEVERAL)
    return finger_track(reports)


def finger_track(reports: list[tuple[float, float, float]]) -> TimedPlaces:
    """The track of a finger's reports (time in s, x and y in m); raises CalibrationError if there are next to none."""
    if len(reports) < MIN_REPORTS:
        raise CalibrationError("no finger slid over the panel")
    table = np.array(reports)
    return TimedPlaces(table[:, 0], table[:, 1:])


def _turns(positions_m: Floats) -> int:
    """Turns of the finger along its principal direction."""
    _, _, axes = np.linalg.svd(positions_m - positions_m.mean(axis=0), full_matrices=False)
    along = (positions_m @ axes[0]).tolist()
    turns, going, farthest = 0, 0, along[0]
    for at in along:
        if going == 0:
            going = (at - farthest > MIN_STROKE_M) - (farthest - at > MIN_STROKE_M)
            farthest = at if going else farthest
        elif (at - farthest) * going > 0:
            farthest = at
        elif (farthest - at) * going > MIN_STROKE_M:
            turns, going, farthest = turns + 1, -going, at
    return turns


def _windows(at_s: Floats, positions_m: Floats) -> list[Indices]:
    """Indices of the reports of each second in which the finger moved far enough."""
    numbers = ((at_s - at_s[0]) // WINDOW_S).astype(int)
    found = []
    for number in range(int(numbers[-1]) + 1):
        window = np.flatnonzero(numbers == number)
        steps_m = np.hypot(*np.diff(positions_m[window], axis=0).T) if len(window) > 1 else np.zeros(0)
        if len(window) >= MIN_REPORTS and steps_m.sum() >= MIN_PATH_M and _turns(positions_m[window]):
            found.append(window)
    return found


def _counts(mouse: TimedPlaces, at_s: Floats) -> Floats:
    """The mouse's counts at times `at_s`, (n, 2), linear between its reports."""
    times_s, counts = mouse
    return np.stack([np.interp(at_s, times_s, counts[:, axis]) for axis in (0, 1)], axis=1)


def _fit(at_s: Floats, positions_m: Floats, windows: list[Indices], mouse: TimedPlaces, lag_s: float) -> tuple[float, Floats]:
    """Rms residual in m, and the (2, 2) map from counts to m that fits all windows best, each about its own mean."""
    counts = _counts(mouse, at_s - lag_s)
    here = np.concatenate([counts[window] - counts[window].mean(axis=0) for window in windows])
    there = np.concatenate([positions_m[window] - positions_m[window].mean(axis=0) for window in windows])
    map_of = np.linalg.lstsq(here, there, rcond=None)[0]
    return float(np.sqrt(np.mean(np.sum((here @ map_of - there) ** 2, axis=1)))), map_of


def _lag_of(at_s: Floats, positions_m: Floats, mouse: TimedPlaces, map_of: Floats, near_s: float) -> float:
    """Least-squares lag of one window within 15 ms of `near_s`, refined by a parabola through the minimum."""
    lags_s = near_s + np.arange(-15e-3, 15.05e-3, 0.5e-3)
    errors = []
    for lag_s in lags_s:
        off = _counts(mouse, at_s - lag_s) @ map_of - positions_m
        errors.append(float(np.sum((off - off.mean(axis=0)) ** 2)))
    best = min(max(int(np.argmin(errors)), 1), len(errors) - 2)
    before, at, after = errors[best - 1 : best + 2]
    bend = before - 2 * at + after
    return float(lags_s[best]) + (0.25e-3 * (before - after) / bend if bend > 0 else 0.0)
