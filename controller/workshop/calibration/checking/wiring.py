"""Which patch each channel drives, and with which sign; or that the measured points are too few to say.

Regression on the direct waves gives the strength of each channel at each patch, which is 1 at its own and 0 at the others. How far
chance moves it is seen at the patches that a channel cannot drive: patches side by side, of which a few points cannot tell the
waves apart, show that by themselves. A channel is decided if it drives a patch with a strength that chance does not reach, and if
no exchange of patches with another channel fits the records about as well.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import linear_sum_assignment

from controller.arrays import Bools, Floats, Indices
from controller.workshop.calibration.transfer_functions.direct_wave import DirectWaves

FIRST_POINTS = 8  # that mostly give a verdict, 30 mm from the edges
SIGNIFICANT = 3.0  # standard errors
LEAST_STRENGTH = 0.5  # of the median channel's: below, waves that an edge sends back may have turned the sign
LUCK = 1.0  # standard errors by which the least certain of all pairs falls short of what is expected of it
PRIOR_ROWS = 8  # channels that are taken to show the error of the regression before any channel is looked at
ROUND = 1e-9


@dataclass(frozen=True)
class Wiring:
    """What records say of the wires; a channel whose partner is dead is `swapped` with it all the same."""

    swapped: tuple[tuple[int, ...], ...] = ()  # channels that drive each other's patches: pairs, or longer circles
    inverted: tuple[int, ...] = ()  # against most others
    all_inverted: bool = False
    undecided: tuple[int, ...] = ()
    points: int = 0  # measured
    points_needed: int = 0  # for a verdict on every channel, foreseen from the errors; `points` if there is one


def wiring_of(waves: DirectWaves | None, channels: Sequence[int], alive: Sequence[int], points: int) -> Wiring:
    """Verdict on the channels that are `alive` among all that have an actuator; `points` were measured."""
    unknown = Wiring(undecided=tuple(alive), points=points, points_needed=max(2 * points, FIRST_POINTS))
    if waves is None:
        return unknown
    names, living = np.asarray(channels), np.isin(channels, alive)
    table = np.where(living[:, None], waves.strength[np.ix_(channels, channels)], 0.0)
    error = waves.error[list(channels)]
    if not (living.any() and np.isfinite(table).all() and np.isfinite(error).all() and (error[living] > 0).all()):
        return unknown
    of_row, taken = linear_sum_assignment(-abs(table) - ROUND * np.eye(len(table)))  # what is dead keeps its patch, if it is free
    there = table[of_row, taken]
    single, pair = _errors(table, error, living, taken)
    scale = float(np.median(abs(there[living])))
    gained = abs(there)[:, None] - abs(table[:, taken])  # by row: over the patch that each other channel drives
    gained = gained + gained.T
    gained[np.diag_indices_from(gained)] = np.inf
    unsure = (gained <= SIGNIFICANT * pair + ROUND) & (living[:, None] | living)
    undecided = (unsure.any(axis=1) | (abs(there) <= np.maximum(SIGNIFICANT * single, LEAST_STRENGTH * scale))) & living
    circles = [circle for circle in _circles(taken) if living[circle].any()]
    for circle in circles:
        undecided[circle] |= living[circle] & undecided[circle].any()
    sure = living & ~undecided
    majority = 1.0 if np.sign(there[sure]).sum() >= 0 else -1.0
    expected = scale * (1.0 * living[:, None] + living)  # of `gained`, with any number of points
    worst = float(((SIGNIFICANT + LUCK) * pair / np.maximum(expected, ROUND)).max(where=unsure, initial=0.0))
    return Wiring(
        swapped=tuple(tuple(sorted(names[circle].tolist())) for circle in circles if not undecided[circle].any()),
        inverted=tuple(names[sure & (majority * there < 0)].tolist()),
        all_inverted=majority < 0 and 2 * int(sure.sum()) > int(living.sum()),
        undecided=tuple(names[undecided].tolist()),
        points=points,
        points_needed=max(math.ceil(points * worst**2), points + 1) if undecided.any() else points,
    )


def _errors(table: Floats, error: Floats, living: Bools, taken: Indices) -> tuple[Floats, Floats]:
    """Standard errors: of each channel's strength at its patch, and of what a pair gains over the exchange of their patches.

    A channel's error is what the regression found, or more if its strength at other patches shows more. How much more than that a
    patch, or the difference of two, has is seen at the channels that drive neither. A channel that is dead has no error.
    """
    others = np.where(living[:, None], table, np.nan)
    others[np.arange(len(taken)), taken] = np.nan
    own = np.where(living, np.fmax(error, np.sqrt(np.nansum(others**2, axis=1) / max(len(taken) - 1, 1))), 0.0)
    others = others[:, taken] / np.where(living, own, 1.0)[:, None]  # by column: the patch that this row's channel drives
    apart = _rms(others[:, :, None] - others[:, None, :], 2.0)
    return own * _rms(others, 1.0), apart * np.hypot(own[:, None], own)


def _rms(values: Floats, prior: float) -> Floats:
    """Root mean square over the first axis of what is known, and of `PRIOR_ROWS` values whose mean square is `prior`."""
    known = np.isfinite(values).sum(axis=0) + PRIOR_ROWS
    return np.asarray(np.sqrt((np.nansum(values**2, axis=0) + PRIOR_ROWS * prior) / known))


def _circles(taken: Indices) -> list[list[int]]:
    """Of a permutation, rows that take each other's place."""
    circles: list[list[int]] = []
    seen: set[int] = set()
    for start in range(len(taken)):
        circle = [start]
        while (following := int(taken[circle[-1]])) != start:
            circle.append(following)
        if len(circle) > 1 and start not in seen:
            circles.append(circle)
        seen |= set(circle)
    return circles
