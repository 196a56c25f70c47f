"""How late a panel tells where a finger is: its strokes against those of a mouse that moves with the finger.

A panel's reports alone cannot tell it: all of them late by the same time are the same strokes later. So a mouse is
held to the finger, or a finger to the mouse, and both slide over the glass to and fro. With the mouse's counts M(t), the
panel's place is A M(t - lag) + b: A, a turn and a scale, is one for the whole recording, b one for each second, since the
mouse turns and slips a little. The lag is where this fits best (least squares), second by second; how far the seconds
disagree is its error. Only where speed changes does a lag differ from a b: hence the strokes to and fro.

The mouse is late itself: by half of its report period, as good a guess as any, and so much off at most.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from controller.board.board import Board
from controller.errors import CalibrationError
from controller.touch.event_capture import EV_REL, REL_X, REL_Y
from controller.touch.recording import Recording
from controller.touch.replay import RecordingSource

FEWEST_TURNS: Final = 12
TURN_M: Final = 10e-3  # a stroke that turns sooner is a tremble
WINDOW_S: Final = 1.0
FEWEST_WINDOWS: Final = 6
LEAST_WAY_M: Final = 40e-3  # of the finger within a window that counts
FEWEST_REPORTS: Final = 20  # within it
LAGS_S: Final = np.arange(-20e-3, 151e-3, 1e-3)
LARGEST_RESIDUAL_M: Final = 1.5e-3  # rms: finger and mouse did not move as one
LARGEST_ERROR_S: Final = 2e-3
SLOWEST_MOUSE_S: Final = 10e-3  # a lag no better known than half of this

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class LagFigures:
    """What was found.

    Attributes
    ----------
    lag_ms : float
        Of the panel's places, for board.toml.
    error_ms : float
        Of chance, at 95 %, from how far the windows disagree.
    mouse_ms : float
        Report period of the mouse; half of it is in `lag_ms`, and it may be wrong by as much.
    turns, windows : int
        Strokes that turned; seconds that were judged.
    residual_mm : float
        How far the finger was from where the mouse says, rms.
    """

    lag_ms: float
    error_ms: float
    mouse_ms: float
    turns: int
    windows: int
    residual_mm: float


def lag_figures(recording: Recording, board: Board) -> LagFigures:
    """Judge a recording of one finger and a mouse that moved as one.

    Parameters
    ----------
    recording : Recording
        Of the panel, with the mouse's EV_REL among its events.
    board : Board
        Where the panel's axes lie.

    Raises
    ------
    CalibrationError
        If there are too few strokes, several fingers, no mouse or a slow one, or the two did not move as one.
    """
    mouse = _mouse(recording)
    at_s, places_m = _finger(recording, board)
    turns = _turns(places_m)
    if turns < FEWEST_TURNS:
        raise CalibrationError(f"only {turns} turns: slide to and fro, by 5 cm or more, at least {FEWEST_TURNS} times")
    windows = _windows(at_s, places_m)
    if len(windows) < FEWEST_WINDOWS:
        raise CalibrationError(f"only {len(windows)} s of strokes fast enough: slide 5 cm to and fro about twice a second")
    coarse_s = LAGS_S[int(np.argmin([_fit(at_s, places_m, windows, mouse, lag_s)[0] for lag_s in LAGS_S]))]
    if coarse_s in (LAGS_S[0], LAGS_S[-1]):
        raise CalibrationError("finger and mouse did not move as one: hold them together, and do it again")
    residual_m, map_of = _fit(at_s, places_m, windows, mouse, float(coarse_s))
    if residual_m > LARGEST_RESIDUAL_M:
        raise CalibrationError(
            f"finger and mouse did not move as one, they are {residual_m * 1e3:.1f} mm apart: hold them together, and do it again"
        )
    lags_s = np.array([_lag_of(at_s[window], places_m[window], mouse, map_of, float(coarse_s)) for window in windows])
    error_s = 1.96 * 1.2533 * 1.4826 * float(np.median(np.abs(lags_s - np.median(lags_s)))) / np.sqrt(len(lags_s))
    if error_s > LARGEST_ERROR_S:
        raise CalibrationError(f"the strokes disagree by {error_s * 1e3:.1f} ms: hold finger and mouse together, and do it again")
    period_s = _period_s(mouse[0])
    lag_s = float(np.median(lags_s)) + period_s / 2
    if lag_s < -(error_s + period_s / 2):
        raise CalibrationError(f"the panel would be {-lag_s * 1e3:.1f} ms ahead of the mouse: take another mouse")
    return LagFigures(max(lag_s, 0.0) * 1e3, error_s * 1e3, period_s * 1e3, turns, len(windows), residual_m * 1e3)


def _mouse(recording: Recording) -> tuple[Array, Array]:
    """Times of the mouse's reports, and its counts up to each, (n,) and (n, 2)."""
    steps: dict[float, list[int]] = {}
    for kind, code, value, time_s in recording.events:
        if kind == EV_REL and code in (REL_X, REL_Y):
            steps.setdefault(time_s, [0, 0])[code] += value
    if len(steps) < FEWEST_REPORTS:
        raise CalibrationError(
            f"{recording.name} has no mouse in it: make one with calibrate-touch --lag --reference DEVICE --out FILE"
        )
    at_s: Array = np.array(list(steps))
    if (period_s := _period_s(at_s)) > SLOWEST_MOUSE_S:
        raise CalibrationError(f"the mouse reports every {period_s * 1e3:.0f} ms: take one that reports at least every 8 ms")
    return at_s, np.cumsum(np.array(list(steps.values()), np.float64), axis=0)


def _period_s(at_s: Array) -> float:
    return float(np.median(np.diff(at_s)))


def _finger(recording: Recording, board: Board) -> tuple[Array, Array]:
    """Times and places of the one finger, (n,) and (n, 2) in m."""
    source = RecordingSource(recording, recording.axes(board), 0.0)
    reports: list[tuple[float, float, float]] = []
    while (next_s := source.next_time_s()) is not None:
        for sample in source.read(next_s):
            if sample.contact:
                reports.append((sample.time_s, sample.x_m, sample.y_m))
    if source.counts.max_fingers > 1:
        raise CalibrationError("several fingers on the panel: slide one finger alone, and keep the hand off the glass")
    if len(reports) < FEWEST_REPORTS:
        raise CalibrationError("no finger slid over the panel")
    table = np.array(reports)
    return table[:, 0], table[:, 1:]


def _turns(places_m: Array) -> int:
    """How often the finger turned along the direction in which it went farthest."""
    _, _, axes = np.linalg.svd(places_m - places_m.mean(axis=0), full_matrices=False)
    along = (places_m @ axes[0]).tolist()
    turns, going, farthest = 0, 0, along[0]
    for at in along:
        if going == 0:
            going = (at - farthest > TURN_M) - (farthest - at > TURN_M)
            farthest = at if going else farthest
        elif (at - farthest) * going > 0:
            farthest = at
        elif (farthest - at) * going > TURN_M:
            turns, going, farthest = turns + 1, -going, at
    return turns


def _windows(at_s: Array, places_m: Array) -> list[NDArray[np.intp]]:
    """Reports of each second in which the finger went far enough."""
    numbers = ((at_s - at_s[0]) // WINDOW_S).astype(int)
    found = []
    for number in range(int(numbers[-1]) + 1):
        window = np.flatnonzero(numbers == number)
        steps_m = np.hypot(*np.diff(places_m[window], axis=0).T) if len(window) > 1 else np.zeros(0)
        if len(window) >= FEWEST_REPORTS and steps_m.sum() >= LEAST_WAY_M and _turns(places_m[window]):
            found.append(window)
    return found


def _counts(mouse: tuple[Array, Array], at_s: Array) -> Array:
    """The mouse's counts at times, linear between its reports, level where it was silent."""
    times_s, counts = mouse
    return np.stack([np.interp(at_s, times_s, counts[:, axis]) for axis in (0, 1)], axis=1)


def _fit(
    at_s: Array, places_m: Array, windows: list[NDArray[np.intp]], mouse: tuple[Array, Array], lag_s: float
) -> tuple[float, Array]:
    """Residual, rms in m, and the (2, 2) map of counts to m that fits all windows best, each about its own middle."""
    counts = _counts(mouse, at_s - lag_s)
    here = np.concatenate([counts[window] - counts[window].mean(axis=0) for window in windows])
    there = np.concatenate([places_m[window] - places_m[window].mean(axis=0) for window in windows])
    map_of = np.linalg.lstsq(here, there, rcond=None)[0]
    return float(np.sqrt(np.mean(np.sum((here @ map_of - there) ** 2, axis=1)))), map_of


def _lag_of(at_s: Array, places_m: Array, mouse: tuple[Array, Array], map_of: Array, near_s: float) -> float:
    """The lag at which one window fits best, within 15 ms of another: least squares, a parabola at its bottom."""
    lags_s = near_s + np.arange(-15e-3, 15.05e-3, 0.5e-3)
    errors = []
    for lag_s in lags_s:
        off = _counts(mouse, at_s - lag_s) @ map_of - places_m
        errors.append(float(np.sum((off - off.mean(axis=0)) ** 2)))
    best = min(max(int(np.argmin(errors)), 1), len(errors) - 2)
    before, at, after = errors[best - 1 : best + 2]
    bend = before - 2 * at + after
    return float(lags_s[best]) + (0.25e-3 * (before - after) / bend if bend > 0 else 0.0)
