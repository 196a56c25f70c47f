"""Drive words from responses, in NumPy: the specification of the compiled kernel, and what serves where there is none.

All that reaches a bit is whole numbers; what sets weights and thresholds is IEEE double arithmetic in one order, without library
functions. So the words are the same on every machine. It is written to be read: the kernel works in the memory of its caller, this
takes its own.

Responses
---------
A point between cells has the response `r = sum(w level)` of up to four cells, six if it is one of many points or much fainter
than another, their weights in 256ths: 16 bits. It is negated in channels that idle high, so that a bit deviates from idle where a
sum of responses is above a threshold of at least zero, and then adds the response itself to the displacement. Between cells waves
cancel in part, the shorter the more: but for a single point at full amplitude, a share of what is met 8 us before and after is
taken away, and so the band's slope is given back.

Several points
--------------
`S = sum(q r)`, with a weight of 15 bits and a polarity for each point: 32 bits. A response is divided by the sum of its absolute
values, which is what the point would get alone; one of zeros has no part in the sum.

A kick is felt either way, so polarities are free. Those are taken for which the energy of the sum is largest (`s' G s`, G: inner
products of the responses), so that responses that are opposite add up; of those and their opposites the one with fewer negative
points. Then weights are balanced: twice, each is divided by what its point gets, first in a sketch, then with all that bits do, for
more than four points at full amplitude once again; so that all points move by the same share of what each would get alone, next to
the largest that all can have.
How amplitudes below the full one are met: `amplitude_twin`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from controller.device.kernel.amplitude_twin import Solution
from controller.device.kernel.bank_twin import (
    LARGEST,
    MAX_FOCI,
    BankBuffers,
    PlaceCells,
    Point,
    Responses,
    Writable,
    checked_words,
)
from controller.device.kernel.polarity_twin import Signs, Sketch, corrected, product, whole_weights

Numbers = NDArray[Any]

LEAST_AMPLITUDE: Final = 1 / 1024  # less is no displacement either, and quotients of it would leave the range of floats
STRENGTH_SHIFT: Final = 8  # bits that absolute values of sums lose before they are added up
THRESHOLD_BITS: Final = 24  # behind the point of a threshold
# Sums are near a threshold within 1/8 of it and 1/32 of the local strength
NEAR_LEVEL_SHIFT: Final = 3
NEAR_STRENGTHS: Final = 1 / 32
FEW_POINTS: Final = 4  # whose weights have settled after one round with all that bits do, and to whom four cells do
FAINT: Final = 1 / 3  # of the strongest, which moves a fainter point so much that four cells are too few there
OWN_LEVEL: Final = 1 / 8  # difference from the common level from which on a point has its own


def compose(
    words: Writable,  # filled with 4 bytes for each sample
    room: Writable,  # `room_bytes` at least, in which the kernel works; what is in it does not matter
    bank: BankBuffers,
    # each (x_m, y_m, amplitude): 1 to `MAX_FOCI`; above 0 to 1, less than `LEAST_AMPLITUDE` counts as that. Points beyond the
    # outermost cells take the nearest place among the cells
    points: Sequence[Point],
    # `MAX_FOCI` signed bytes, where other words move the same points: of each point 1 or -1; all 0: chosen here, and filled in
    polarities: Writable | None = None,
) -> int:
    """Drive words that make every point jump at the end of the emission.

    Returns -1 when done; otherwise a cell that a point needs, which has no response or one that may not be used: nothing was
    composed. Raises ValueError if there are no points or too many, or numbers that are not finite or beyond their range, or buffers
    too short for them.
    """
    responses, count = Responses(bank), len(points)
    if not 1 <= count <= MAX_FOCI:
        raise ValueError(f"{count} points to compose, not 1 to {MAX_FOCI}")
    filled = checked_words(responses, words, room, points)
    signs = np.zeros(MAX_FOCI, np.int8) if polarities is None else np.frombuffer(polarities, np.int8)
    if len(signs) != MAX_FOCI:
        raise ValueError(f"{len(signs)} polarities, not {MAX_FOCI}")
    patches, asked = [], [max(amplitude, LEAST_AMPLITUDE) for _, _, amplitude in points]
    for (x_m, y_m, _), amplitude in zip(points, asked, strict=True):
        patch, cell = responses.patch(x_m, y_m, wide=count > FEW_POINTS or amplitude < max(asked) * FAINT)
        if cell >= 0:
            return cell
        patches.append(patch)
    if asked == [1]:
        bits = responses.turned(patches[0])[: responses.samples] > 0
    else:
        bits = _Composition(responses, patches).bits(asked, signs)
    packed = np.packbits(bits, axis=1, bitorder="little").view("<u4")[:, 0]
    np.frombuffer(filled, "<u4", responses.samples)[:] = packed ^ np.uint32(responses.idle_word)
    return -1


class _Composition:
    """Responses of some points, in whole numbers."""

    def __init__(self, bank: Responses, patches: list[PlaceCells]) -> None:
        responses = np.array([bank.equalised(patch) for patch in patches], np.int32)
        self.in_band, self.whole = responses[:, : bank.samples], bank.whole(responses)  # (points, samples, 32)
        self._sketch_step, self._faint = bank.sketch_step, bank.tables is not None
        # Sums of their absolute values in the band; inf for a response of zeros, which has no part in any sum
        self.norms = [float(np.abs(response).sum()) or math.inf for response in self.in_band]
        self._block_samples = bank.block_samples

    def bits(self, asked: list[float], polarities: Signs) -> Numbers:
        """Where the words deviate from idle, (samples, 32), for these amplitudes; `polarities` as in `Sketch.polarised`."""
        divisors, balance = self.norms, [1.0]
        if len(asked) > 1:
            sketch = Sketch(self.in_band, self._sketch_step, faint=self._faint)
            asked, divisors = sketch.polarised(asked, self.norms, polarities)
            balance = sketch.balanced(divisors)
        weighted, unit = self.weighted(balance, divisors)
        bits, full = weighted > 0, all(amplitude == 1 for amplitude in asked)
        if not unit:
            return bits
        measured = self.measured(bits, divisors)
        if len(asked) == 1:
            return Solution(self, asked, divisors, balance).bits([asked[0] * measured[0]])
        before, balance = balance, corrected(balance, measured, divisors)
        if full and len(asked) > FEW_POINTS:
            measured = self.measured(self.weighted(balance, divisors)[0] > 0, divisors)
            balance = corrected(balance, measured, divisors)
        if full:
            return self.weighted(balance, divisors)[0] > 0
        wanted = _wanted(asked, before, measured, _given(self.in_band, bits, divisors))
        return Solution(self, asked, divisors, balance).bits(wanted)

    def weighted(self, weights: list[float], divisors: list[float]) -> tuple[Numbers, float]:
        """Sum of the responses, each divided by its divisor, in whole multiples next to the weights times the unit."""
        whole, unit = whole_weights(weights, divisors)
        total = np.zeros(self.in_band.shape[1:], np.int32)
        for weight, response in zip(whole, self.in_band, strict=True):
            total += weight * response
        return total, unit

    def measured(self, bits: Numbers, divisors: list[float]) -> list[float]:
        """Displacement that bits give at each point, divided by its divisor."""
        return _given(self.whole, bits, divisors)

    def strength(self, weighted: Numbers) -> Numbers:
        """Sum of the absolute values of a sum of responses over the block of each sample, (samples, 32)."""
        block = self._block_samples
        starts = np.arange(0, len(weighted), block)
        sums = np.add.reduceat(np.abs(weighted) >> STRENGTH_SHIFT, starts, axis=0)
        by_sample: Numbers = np.repeat(sums, block, axis=0)[: len(weighted)]
        return by_sample

    def masked(self, weighted: Numbers, strength: Numbers, threshold: float) -> Numbers:
        """Bits where a sum is above a threshold, in units of the local strength."""
        bits: Numbers = weighted > self._level(strength, threshold)
        return bits

    def near(self, weighted: Numbers, strength: Numbers, threshold: float) -> Numbers:
        """Bits whose sum is near a threshold, in units of the local strength."""
        level = self._level(strength, threshold)
        aside = (level >> NEAR_LEVEL_SHIFT) + self._level(strength, NEAR_STRENGTHS)
        near: Numbers = (weighted > level - aside) & (weighted <= np.minimum(level + aside, LARGEST))
        return near

    def _level(self, strength: Numbers, threshold: float) -> Numbers:
        scale = threshold / self._block_samples * (1 << THRESHOLD_BITS)
        whole = round(scale) if scale < LARGEST else LARGEST
        level: Numbers = np.minimum(strength * whole >> (THRESHOLD_BITS - STRENGTH_SHIFT), LARGEST)
        return level

    def moved_by(self, places: Numbers) -> Numbers:
        """What bits at `places`, (bit, 2) of samples and channels, add at each point: (bit, point)."""
        samples, channels = places.T
        moved: Numbers = self.whole[:, samples, channels].T
        return moved


def _given(responses: Numbers, bits: Numbers, divisors: list[float]) -> list[float]:
    return [int(np.sum(response, where=bits)) / divisor for response, divisor in zip(responses, divisors, strict=True)]


def _wanted(asked: list[float], balance: list[float], measured: list[float], in_band: list[float]) -> list[float]:
    """Displacements of several points at less than full amplitude, from those at nearly balanced weights: all, and in the band."""
    in_sum, weights = product(balance, in_band), product(balance, [1.0] * len(balance))
    in_sum = in_sum if in_sum > 0 else math.inf
    level, more = in_sum / weights, product(balance, measured) / in_sum
    nearly = level * OWN_LEVEL
    return [
        share * (got - max(-nearly, min(nearly, got - level))) * more if got > 0 else 0.0
        for share, got in zip(asked, in_band, strict=True)
    ]
