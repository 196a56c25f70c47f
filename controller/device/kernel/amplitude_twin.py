"""Drive words for less than full amplitude; a part of `words_twin`.

An amplitude is a share of what the same point would get if all points were composed at full amplitude. The ratio of the weights
sets the ratio of the amplitudes; their common level is set by leaving bits at idle where `S` is weak against the mean of its
absolute value in the same block of samples and the same channel. Both are found by measuring: the displacement at a point is
linear in the bits, an inner product of them with the point's response, in the band and outside it. A few rounds come near what is
wanted. What is left is mended bit by bit: bits whose sum is next to its threshold are flipped, those of the last samples first, as
they move most, wherever all errors together become smaller by at least half of what a flip could take from them.

Full amplitude is the level that all points have together: the mean of their shares, weighed as they are, which is next to the
largest share that all can have. A point whose share in the band differs by more than an eighth has its own, since its neighbours
move it.

Points that are near move together. Where responses are more than half alike (correlation of the sketches), points are one place,
and none is asked for more than the least of them; soon below that each has its own. What is too much in the end is lowered together
with all others.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from controller.device.kernel.polarity_twin import product

if TYPE_CHECKING:
    from controller.device.kernel.words_twin import _Composition

Numbers = NDArray[Any]

# Share of the full amplitude that is left when every sample is masked whose response is below a threshold,
# in units of the mean of its absolute value over 96 us: median over 120 points of the simulated board.
THRESHOLDS: Final = (0.0, 0.3, 0.6, 0.9, 1.2, 1.5, 1.8, 2.1, 2.5, 3.0)
SHARES: Final = (1.0, 0.9764, 0.9089, 0.8022, 0.6727, 0.5347, 0.3991, 0.2781, 0.155, 0.067)
MAX_ROUNDS: Final = 6  # of measuring what the bits give; the best one is mended
ROUNDS: Final = 3  # that come near in most scenes; further ones only where an amplitude is still off by more than `FAR`
MAX_LOWERINGS: Final = 3  # behind them
TOO_MUCH: Final = 1.03  # of what was asked for: then all are lowered
NEARLY: Final = 0.03  # error of an amplitude that is left to flips
FAR: Final = 0.25  # error that flips alone do not mend
CLOSE: Final = 0.002  # error at which they end
SWEEPS: Final = 2  # over the bits that may be flipped


class Solution:
    """Bits for wanted displacements, by rounds of weighing, masking and measuring.

    The ratio of the weights sets the ratio of the displacements; the Euclidean norm of the weights sets how much is
    masked, since the displacements of independent points are proportional to their weights.

    `asked`, the amplitude of each point, are the first weights; `divisors` are the sums of the absolute values of the points'
    responses, with their polarities; `balance` are the weights at full amplitude.
    """

    def __init__(self, points: _Composition, asked: list[float], divisors: list[float], balance: list[float]) -> None:
        self._points, self._asked, self._divisors, self._balance = points, asked, divisors, balance
        self._sum, self._first_unit = points.weighted(_products(balance, asked), divisors)
        self._unit = self._first_unit
        self._first_norm = math.sqrt(product(asked, asked))
        self._strength = points.strength(self._sum)

    def bits(self, wanted: list[float]) -> Numbers:
        """The bits, which give what is wanted or as near to it as they come."""
        weights, measured = self._nearest(wanted)
        for lowering in range(MAX_LOWERINGS + 1):
            bits, threshold = self._weigh(weights, again=True)
            if not measured:
                measured = self._points.measured(bits, self._divisors)
            near = self._points.near(self._sum, self._strength, threshold)
            most = self._flip(bits, near, wanted, measured)
            if most <= TOO_MUCH or lowering == MAX_LOWERINGS:
                break
            weights, wanted, measured = [one / most for one in weights], [one / most for one in wanted], []
        return bits

    def _nearest(self, wanted: list[float]) -> tuple[list[float], list[float]]:
        """Weights that come next to what is wanted in some rounds, and what their bits give."""
        weights = best = self._asked
        best_measured: list[float] = []
        before: tuple[list[float], list[float]] | None = None
        gain, least = 0.0, math.inf
        for turn in range(MAX_ROUNDS):
            bits, _ = self._weigh(weights, again=turn > 0)
            measured = self._points.measured(bits, self._divisors)
            errors = [(want - got) / want if want > 0 else 0.0 for want, got in zip(wanted, measured, strict=True)]
            squares = product(errors, errors)
            if not turn or squares < least:
                least, best, best_measured = squares, weights, measured
            if max(map(abs, errors)) <= (NEARLY if turn + 1 < ROUNDS else FAR):
                break
            gain = gain or product(measured, weights) / product(weights, weights)
            if not gain > 0:
                break
            residuals = [(want - got) / gain for want, got in zip(wanted, measured, strict=True)]
            before, weights = (weights, residuals), _next_weights(weights, residuals, before)
        return best, best_measured

    def _weigh(self, weights: list[float], *, again: bool) -> tuple[Numbers, float]:
        """Bits of these weights, and their threshold; the sum of a single point stays as it is."""
        norm = math.sqrt(product(weights, weights)) or self._first_norm
        if again and len(weights) > 1:
            scaled = [weight * self._first_norm / norm for weight in weights]
            self._sum, self._unit = self._points.weighted(_products(self._balance, scaled), self._divisors)
        threshold = masking_threshold(norm / math.sqrt(len(weights))) * (self._unit / self._first_unit)
        return self._points.masked(self._sum, self._strength, threshold), threshold

    def _flip(self, bits: Numbers, near: Numbers, wanted: list[float], measured: list[float]) -> float:
        """Flip some of the bits that are `near`; the largest share that a point then gets of what is wanted."""
        units, missing = [], []
        for want, got, divisor in zip(wanted, measured, self._divisors, strict=True):
            units.append(1 / (divisor * want) if want > 0 else 0.0)
            missing.append((want - got) / want if want > 0 else 0.0)
        places = np.argwhere(near)[::-1]
        values = self._points.moved_by(places).tolist()
        places = places.tolist()
        for _ in range(SWEEPS):
            for (sample, channel), value in zip(places, values, strict=True):
                if max(map(abs, missing)) <= CLOSE:
                    break
                sense = -1.0 if bits[sample, channel] else 1.0
                change = [sense * one * unit for one, unit in zip(value, units, strict=True)]
                if product(missing, change) > product(change, change):
                    bits[sample, channel] ^= True
                    missing = [left - one for left, one in zip(missing, change, strict=True)]
        return max(1 - left for left in missing)


def _next_weights(weights: list[float], residuals: list[float], before: tuple[list[float], list[float]] | None) -> list[float]:
    """Weights with their residuals added, from the second round on by Anderson acceleration of depth one.

    Points that are near each other are not independent; `before`: weights and residuals of the round before.
    """
    if before is None:
        return [weight + residual for weight, residual in zip(weights, residuals, strict=True)]
    weights_before, residuals_before = before
    change = [new - old for new, old in zip(residuals, residuals_before, strict=True)]
    squared = product(change, change)
    mixing = product(residuals, change) / squared if squared > 0 else 0.0
    further = []
    for index in range(len(weights)):
        new, old = weights[index] + residuals[index], weights_before[index] + residuals_before[index]
        further.append(new + mixing * (old - new))
    return further


def masking_threshold(share: float) -> float:
    """Threshold, in local strengths, that leaves about this share of the full amplitude."""
    for index in range(1, len(SHARES)):
        if share >= SHARES[index]:
            above, below = SHARES[index - 1], SHARES[index]
            part = max(above - share, 0.0) / (above - below)
            return THRESHOLDS[index - 1] + part * (THRESHOLDS[index] - THRESHOLDS[index - 1])
    return THRESHOLDS[-1]


def _products(left: list[float], right: list[float]) -> list[float]:
    return [one * other for one, other in zip(left, right, strict=True)]
