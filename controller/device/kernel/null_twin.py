"""Drive words that leave fingertips still, in NumPy: the specification of the compiled kernel, as `words_twin` is.

Words for some points are given, composed or not. What they do at a place near T is linear in the bits, and the response that
is met a sample later is the same one, a sample on: nothing but the bank's responses is needed. Seven times are looked at, a
twelfth of a block (8 us) apart, so within 25 us of T.

A fingertip's pad is as wide as a wave. Six places in a ring stand for it, and of them five sums: all together, two slopes and two
saddles, next to all that a pad of 8 mm can meet of the band. These hardly depend on each other, so each is kept still by itself.
Of several pads only the first is: more would cost the points too much.

A bit may be changed the sooner, the less the points get from it: its margin is the sum of the points' responses, each divided by
the sum of its absolute values and with the sign of what the words give it, in whole multiples, above zero where the bit deviates
from idle. The sums at nulls are weighed against that: `margin += sum(weight * sum later)`, and a bit deviates where the
margin is above zero.

How much a weight moves the displacements follows from the density of margins at zero, which is next to the inverse of their mean
size in the same block of samples and the same channel. So the weights are the solution of seven equations, whose matrix is taken
from every second block, and to depend on the distance of two times only, with three tenths more on its diagonal, as it is known
roughly. Three sweeps over all sums, each measured again.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from controller.device.kernel.bank_twin import (
    CHANNELS,
    MAX_FOCI,
    STEPS_PER_BLOCK,
    BankBuffers,
    PlaceCells,
    Point,
    Responses,
    Writable,
    checked_words,
)
from controller.device.kernel.polarity_twin import SKETCH_SHIFT
from controller.device.kernel.words_twin import STRENGTH_SHIFT

Numbers = NDArray[Any]

MAX_NULLS: Final = 4
TIMES: Final = 7  # around T
SWEEPS: Final = 3
BLOCKS_APART: Final = 2  # of those from which the equations are taken
RING: Final = (  # places of a null, in m beside its middle: 0.35 of a pad of 8 mm
    (2.8e-3, 0.0),
    (1.4e-3, 2.42487113e-3),
    (-1.4e-3, 2.42487113e-3),
    (-2.8e-3, 0.0),
    (-1.4e-3, -2.42487113e-3),
    (1.4e-3, -2.42487113e-3),
)
SUMS: Final = (  # of what is met in the ring: orthogonal; eight at most, so that they are within 16 bits
    (1, 1, 1, 1, 1, 1),
    (2, 1, -1, -2, -1, 1),
    (0, 1, 1, 0, -1, -1),
    (2, -1, -1, 2, -1, -1),
    (0, 1, -1, 0, 1, -1),
)
SUMS_OF: Final = (len(SUMS), 1, 1, 1)  # of each pad, by the number of pads: more cost the points and are felt no less
SUM_SHIFT: Final = 3  # bits that responses lose before
WITHIN: Final = (-(1 << 15), (1 << 15) - 1)  # 16 bits
LARGEST_SUMMED: Final = (1 << 15 - SUM_SHIFT) - 1  # for the same reason, of a compact bank's responses, too faint to lose bits
MARGIN_WEIGHT_SUM: Final = 4095  # of the points, and 15 times as much for all corrections: below 2^31 together
CORRECTION_WEIGHT_SUM: Final = 61440
LARGEST_WEIGHT: Final = 32767
WEIGHT_BITS: Final = 20
FLOOR: Final = 0.25  # of the mean size of all margins: smaller ones count as this
RIDGE: Final = 0.3
PI: Final = 3.141592653589793


def null_places(
    words: Writable,  # drive words for `points`; changed in place
    room: Writable,  # room, bank: as `compose` takes them
    bank: BankBuffers,
    points: Sequence[Point],  # each (x_m, y_m, amplitude): what the words were made for; amplitudes are not used
    nulls: Sequence[Point],  # each (x_m, y_m, amplitude): middles of 1 to `MAX_NULLS` pads; amplitudes are not used
) -> int:
    """Change drive words so that some pads stay still near T.

    Returns -1 when done; otherwise a cell that is needed, which has no response or one that may not be used: nothing was changed.
    Raises ValueError if there are no points or places or too many, or numbers that are not finite or beyond their range, or buffers
    too short for them.
    """
    responses = Responses(bank)
    if not (1 <= len(points) <= MAX_FOCI and 1 <= len(nulls) <= MAX_NULLS):
        raise ValueError(f"{len(points)} points, not 1 to {MAX_FOCI}, and {len(nulls)} nulls, not 1 to {MAX_NULLS}")
    filled, patches = checked_words(responses, words, room, [*points, *nulls]), []
    ring = [(x_m + to_x_m, y_m + to_y_m) for x_m, y_m, _ in nulls for to_x_m, to_y_m in RING]
    for x_m, y_m in (*[(x_m, y_m) for x_m, y_m, _ in points], *ring):
        patch, cell = responses.patch(x_m, y_m)
        if cell >= 0:
            return cell
        patches.append(patch)
    _Nulls(responses, filled, patches, len(points)).keep_still()
    return -1


class _Met:
    """A response between zeros, (sample, 32) flat in whole float64, as it is met at other times: 2^53 is far above every sum."""

    def __init__(self, response: Numbers, reach: int) -> None:
        self._size, self._reach = response.size, reach
        self._padded = np.zeros(response.size + 2 * reach * CHANNELS)
        self._padded[reach * CHANNELS : reach * CHANNELS + response.size] = response.reshape(-1)

    def later(self, by: int) -> Numbers:
        """The response as it is met this many samples later."""
        start = (self._reach - by) * CHANNELS
        return self._padded[start : start + self._size]


class _Nulls:
    """The bits of drive words, their margins, and the places to be kept still."""

    def __init__(self, bank: Responses, words: memoryview, patches: list[PlaceCells], points: int) -> None:
        self._samples = bank.samples
        self._block, self._blocks = bank.block_samples, -(-bank.samples // bank.block_samples)
        self._step = max(bank.block_samples // STEPS_PER_BLOCK, 1)
        self._idle_word = bank.idle_word
        self._words = np.frombuffer(words, "<u4", bank.samples)
        as_bytes = (self._words ^ np.uint32(bank.idle_word)).view(np.uint8).reshape(-1, 4)
        self._bits = (
            np.unpackbits(as_bytes, axis=1, bitorder="little").reshape(-1).astype(np.float64)
        )  # where they deviate from idle
        turned = [bank.equalised(patch) for patch in patches]
        self._points = [response[: self._samples] for response in turned[:points]]
        self._still, kept = [], SUMS[: SUMS_OF[(len(turned) - points) // len(RING) - 1]]
        for first in range(points, len(turned), len(RING)):
            ring = np.array(turned[first : first + len(RING)], np.int32)
            shorter = np.clip(bank.whole(ring), *WITHIN) >> SUM_SHIFT
            if bank.tables:
                shorter = np.clip(bank.whole(ring), -LARGEST_SUMMED, LARGEST_SUMMED)
            self._still += [np.einsum("p,prc->rc", shares, shorter) for shares in kept]
        self._spent = 0

    def keep_still(self) -> None:
        """Change the words."""
        shares, responses, total = [], [in_band.astype(np.float64).reshape(-1) for in_band in self._points], 0.0
        for response in responses:
            norm = float(np.abs(response).sum())
            share = 1 / norm if norm else 0.0
            total += share
            shares.append(-share if _product(self._bits, response) < 0 else share)
        if total == 0:
            return
        unit = MARGIN_WEIGHT_SUM / total
        margin = np.zeros(self._samples * CHANNELS)
        for share, response in zip(shares, responses, strict=True):
            margin += round(share * unit) * response
        size = np.abs(margin)
        strength = self._by_block(np.floor(size / (1 << STRENGTH_SHIFT)))
        if not strength.any():
            return
        self._margin = np.where(self._bits > 0, size + 1, -size)
        floor = float(strength.sum()) * FLOOR / float(self._blocks * CHANNELS)
        scale = floor * (1 << WEIGHT_BITS)
        self._weight = np.rint(scale / np.maximum(strength, floor)).astype(np.int64)
        self._unit = PI * scale / float(self._block)
        sums: list[tuple[_Met, list[list[float]], list[float]]] = []
        for met in self._still:
            factors = self._prepared(_Met(met >> SKETCH_SHIFT, TIMES * self._step))
            if factors is not None:
                sums.append((_Met(met, TIMES * self._step), *factors))
        for _ in range(SWEEPS):
            for one in sums:
                self._correct(*one)
        bits = self._bits.reshape(-1, CHANNELS).astype(np.uint8)
        self._words[:] = np.packbits(bits, axis=1, bitorder="little").view("<u4")[:, 0] ^ np.uint32(self._idle_word)

    def _by_block(self, values: Numbers) -> Numbers:
        """Sums over the samples of each block: (block, 32)."""
        padded = np.zeros((self._blocks * self._block, CHANNELS))
        padded[: self._samples] = values.reshape(-1, CHANNELS)
        sums: Numbers = padded.reshape(self._blocks, self._block, CHANNELS).sum(axis=1)
        return sums

    def _prepared(self, coarse: _Met) -> tuple[list[list[float]], list[float]] | None:
        """Factors (lower, pivots) of the equations of corrections; None if there is nothing to correct with."""
        products, every = [], float(self._blocks) / float(-(-self._blocks // BLOCKS_APART))
        for lag in range(TIMES):
            sums = self._by_block(coarse.later(0) * coarse.later(lag * self._step)).astype(np.int64)
            products.append(float(int((sums * self._weight)[::BLOCKS_APART].sum())) * every)
        if not products[0] > 0:
            return None
        lower = [[0.0] * TIMES for _ in range(TIMES)]
        pivots: list[float] = []
        for i in range(TIMES):
            for j in range(i + 1):
                value = products[0] * (1 + RIDGE) if i == j else products[i - j]
                for k in range(j):
                    value -= lower[i][k] * lower[j][k] * pivots[k]
                if j < i:
                    lower[i][j] = value / pivots[j]
                    continue
                if not value > 0:
                    return None
                pivots.append(value)
        return lower, pivots

    def _correct(self, met: _Met, lower: list[list[float]], pivots: list[float]) -> None:
        """Weigh the bits against what they give to a sum, and set them again."""
        times = [(j - TIMES // 2) * self._step for j in range(TIMES)]
        value = [_product(self._bits, met.later(later)) for later in times]
        for i in range(TIMES):
            for k in range(i):
                value[i] -= lower[i][k] * value[k]
        for i in range(TIMES):
            value[i] /= pivots[i]
        for i in range(TIMES - 1, -1, -1):
            for k in range(i + 1, TIMES):
                value[i] -= lower[k][i] * value[k]
        scaled = [one * self._unit for one in value]
        if not all(abs(one) < LARGEST_WEIGHT for one in scaled):
            return
        weights = [-round(one) for one in scaled]
        spent = self._spent + sum(map(abs, weights))
        if spent > CORRECTION_WEIGHT_SUM:
            return
        self._spent = spent
        for weight, later in zip(weights, times, strict=True):
            self._margin += weight * met.later(later)
        np.greater(self._margin, 0, out=self._bits)


def _product(left: Numbers, right: Numbers) -> float:
    """Inner product of whole numbers, exact in any order; BLAS would start threads for it."""
    return float((left * right).sum())
