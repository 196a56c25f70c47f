"""Bits that are best for goals that are linear in them, found by the dual, which has one variable for each goal.

What bits do at a place is a sum over those that deviate from idle: `rows @ bits`. To push several places as far as possible, in
given proportions, is a linear program in the bits. Its dual is the smallest `sum(max(0, weights @ rows))` of weights with
`proportions @ weights = 1`; a bit deviates where `weights @ rows` is above zero, and no bits push farther than that sum. To reach
given displacements with the least cost is one, too: the smallest `sum(max(0, weights @ rows - cost)) - wanted @ weights`.

Both sums are convex and have few variables: Newton's method on a rounded corner, `max(0, g)` as `(g + sqrt(g^2 + d^2)) / 2`
with `d` becoming smaller. A bit is whole, not a share, so that goals are missed by about a bit; flips of bits near the corner
mend that.
"""

from itertools import product
from typing import Final

import numpy as np

from controller.arrays import Bools, Floats, Reals

ROUNDINGS: Final = (1.0, 0.3, 0.1, 0.03, 0.01)  # d, over the mean of the absolute sums
MAX_STEPS: Final = 30  # of Newton's method for each; most need two
CONVERGED: Final = 1e-6  # of the sum that a further step would gain
RIDGE: Final = 1e-11  # of the mean curvature: for rows that depend on each other
STEP_MIN: Final = 1e-6
MAX_FLIPS: Final = 600
WEAK_SHARE: Final = 0.25  # of all bits: those with the smallest sums may be flipped


def likely_polarities(rows: Reals, count: int) -> list[Floats]:
    """Directions in which to push places so that they get most when all get the same, best ones first.

    For weights `w` the sum of absolute values of `w @ rows` grows about as the root of `w G w` (G: inner products of the rows); its
    smallest value for `signs @ w = 1` is `1 / (signs G^-1 signs)`. So the signs with the smallest `signs G^-1 signs` come first.

    `rows` are (place, bit). Returns at most `count` directions (place,) of -1 and 1; opposite ones count once: the first place is
    pushed upwards.
    """
    inverse = np.linalg.inv(_gram(rows))
    signs = np.array([(1.0, *others) for others in product((1.0, -1.0), repeat=len(rows) - 1)])
    squares = np.einsum("ij,jk,ik->i", signs, inverse, signs)
    return list(signs[np.argsort(squares, kind="stable")[:count]])


def farthest(rows: Reals, proportions: Reals, roundings: tuple[float, ...] = ROUNDINGS) -> tuple[Reals, float]:
    """Weights whose bits push as far as possible in given proportions.

    `rows` are (goal, bit), `proportions` (goal,): wanted displacements, up to a factor, 0 for a goal that shall stay still. The
    last of the roundings is how exact the result is. Returns the weights (goal,), and how many times the proportions no bits
    exceed.
    """
    start = np.linalg.solve(_gram(rows), proportions)
    weights = _newton(rows, np.zeros(rows.shape[1]), np.zeros(len(rows)), start / (proportions @ start), roundings, proportions)
    return weights, float(np.maximum(weights @ rows, 0).sum())


def cheapest(rows: Reals, wanted: Reals, cost: Reals, start: Reals) -> Reals:
    """Weights whose bits, where `weights @ rows > cost`, give `wanted`, (goal,), with the least sum of costs, (bit,)."""
    return _newton(rows, cost, wanted, start, ROUNDINGS, None)


def _gram(rows: Reals) -> Reals:
    """Inner products of rows, (goal, goal), with as much on the diagonal that equal rows do not make it singular."""
    products: Reals = rows @ rows.T
    products += 1e-9 * np.trace(products) / len(rows) * np.eye(len(rows))
    return products


def _newton(
    rows: Reals, cost: Reals, wanted: Reals, weights: Reals, roundings: tuple[float, ...], proportions: Reals | None
) -> Reals:
    """Smallest rounded sum; with `proportions`, over the weights whose product with them stays what it is."""
    count = len(rows)
    system = np.zeros((count + 1, count + 1))
    if proportions is None:
        system[count, count] = 1
    else:
        system[count, :count] = system[:count, count] = proportions
    sums = weights @ rows - cost
    size = float(np.abs(sums).mean())
    for rounding in roundings:
        square = (rounding * size) ** 2
        for _ in range(MAX_STEPS):
            roots = np.sqrt(sums**2 + square)
            slope = rows @ (0.5 + 0.5 * sums / roots) - wanted
            curvature = (rows * (0.5 * square / roots**3)) @ rows.T
            system[:count, :count] = curvature + RIDGE * np.trace(curvature) / count * np.eye(count)
            step = np.linalg.lstsq(system, np.append(-slope, 0.0), rcond=1e-14)[0][:count]
            gain, before = float(-slope @ step), _rounded(sums, square) - float(wanted @ weights)
            part, stepped = 1.0, step @ rows
            while part > STEP_MIN:
                after = _rounded(sums + part * stepped, square) - float(wanted @ (weights + part * step))
                if after <= before - 1e-4 * part * gain:
                    break
                part /= 2
            weights, sums = weights + part * step, sums + part * stepped
            if gain < CONVERGED * abs(before) or part <= STEP_MIN:
                break
    return weights


def _rounded(sums: Reals, square: float) -> float:
    return float((sums + np.sqrt(sums**2 + square)).sum()) / 2


def flip(bits: Bools, strength: Reals, rows: Reals, wanted: Reals, tolerance: float) -> None:
    """Flip bits, those that cost little, until `rows @ bits` is as wanted or no flip brings it nearer.

    `bits` (bit,) are changed in place; `strength` (bit,) is how far each bit's sum is above or below what decides it. `rows` (goal,
    bit) and `wanted` (goal,) are in units of which the sum of squares over the goals counts; its root is good enough within
    `tolerance`.
    """
    weak = np.argpartition(np.abs(strength), round(WEAK_SHARE * len(bits)))[: round(WEAK_SHARE * len(bits))]
    changes = rows[:, weak] * np.where(bits[weak], -1.0, 1.0)
    squares = (changes**2).sum(axis=0)
    missing = wanted - rows @ bits
    for _ in range(MAX_FLIPS):
        if missing @ missing <= tolerance**2:
            return
        nearer = squares - 2 * (missing @ changes)
        best = int(np.argmin(nearer))
        if nearer[best] >= 0:
            return
        missing -= changes[:, best]
        bits[weak[best]] ^= True
        changes[:, best] *= -1
