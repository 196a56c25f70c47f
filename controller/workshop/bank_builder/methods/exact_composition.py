"""The best drive words for several points at once: no others push the worst of them farther.

`max over directions s of min over weights w of ||sum(w s h)||_1`, computed by its dual (`dual.py`): for scenes that are known
beforehand, such as spots that always play. Each point is pushed up or down, whichever lets all of them move farther: a finger feels
either. The bits are the sign of a weighted sum of band-limited responses; the weights are chosen so that the whole displacements,
not only those in the band, are in the proportions that were asked for, each relative to what its point would move alone: the sum of
the absolute values of its response in the band. The device equalises the same.
"""

import math
from collections.abc import Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray
from threadpoolctl import threadpool_limits

from controller.arrays import Bools, Reals
from controller.device.bank.packing import CHANNELS, WORD
from controller.device.board.board import Board
from controller.device.kernel import Point
from controller.device.kernel.amplitude_twin import masking_threshold
from controller.device.waveforms.composition import BLOCK_S, MAX_FOCI
from controller.workshop.bank_builder.methods.design import Place, WaveformDesign
from controller.workshop.bank_builder.methods.dual import cheapest, farthest, flip, likely_polarities
from controller.workshop.physics.responses.response_source import ResponseSource
from controller.workshop.physics.word_capture import idle_levels

EQUAL: Final = 5e-4  # of what a point shall get: flips mend a larger difference
ROUNDS: Final = 3  # of choosing proportions in the band such that whole displacements come out as wanted
FULL_POLARITIES: Final = 8  # of ten points; fewer need fewer
SEPARABLE: Final = 0.2  # of a response has to be left without its part at nulls: at a null itself it is 0.16
ALIKE: Final = 0.999  # correlation of the responses of points that are one place
NULL_SHARE: Final = 30.0  # a null counts this many times more than the same error of a focus
SMALLEST_THRESHOLD: Final = 0.05  # to begin with, in local strengths


class ExactComposition:
    """Up to ten points at amplitudes of 0.25 to 1; nobody is kept still."""

    name = "exact composition"

    def __init__(self, board: Board, source: ResponseSource) -> None:
        self.idle_word, self.bit_period_s = board.idle_word, board.waveform.bit_period_s
        self._source = source
        self.volts = np.where(idle_levels(board), -1.0, 1.0) * board.driver.supply_v  # of a bit that deviates from idle, (32,)

    def design(self, points: Sequence[Point], nulls: Sequence[Place] = ()) -> WaveformDesign:
        """As `DesignMethod.design`."""
        if nulls:
            raise ValueError(f"{self.name} has no nulls")
        places_m, asked = checked_points(points)
        return WaveformDesign(*self.words(places_m, asked, np.zeros((0, self._source.samples * CHANNELS))), np.zeros(0))

    def words(self, places_m: Reals, asked: Reals, nulls: Reals) -> tuple[NDArray[np.uint32], Reals]:
        """Drive words for points at which (point,) amplitudes are asked for, and rows (row, bit) that shall stay zero.

        With the displacements that they give, (point,) in m.
        """
        in_band = self.deviations(self._source.drive_order_responses(places_m, dtype=np.float64))
        whole = self.deviations(self._source.responses(places_m)[:, ::-1])
        with threadpool_limits(1, "blas"):  # small products
            bits = best_bits(in_band, whole, asked, nulls, round(BLOCK_S / self.bit_period_s))
        packed: NDArray[np.uint32] = np.packbits(bits.reshape(-1, CHANNELS), axis=1, bitorder="little").view(WORD)[:, 0]
        return packed ^ np.uint32(self.idle_word), whole @ bits

    def deviations(self, responses: Reals) -> Reals:
        """What each bit adds where it deviates from idle, (point, bit) in m, from responses in drive order."""
        return (responses * self.volts).reshape(len(responses), -1)


def checked_points(points: Sequence[Point]) -> tuple[Reals, Reals]:
    """Places (point, 2) and amplitudes (point,) of points.

    Raises ValueError if there are none or too many, or a number is not finite or beyond its range.
    """
    if not 1 <= len(points) <= MAX_FOCI:
        raise ValueError(f"{len(points)} points to compose, not 1 to {MAX_FOCI}")
    reported = np.array(points, np.float64)
    if not np.isfinite(reported).all():
        raise ValueError("a point to compose is not finite")
    if not all(0 < amplitude <= 1 for amplitude in reported[:, 2].tolist()):
        raise ValueError("an amplitude of the points to compose is not above 0 and at most 1")
    return reported[:, :2], reported[:, 2]


def best_bits(in_band: Reals, whole: Reals, asked: Reals, nulls: Reals, block_samples: int) -> Bools:
    """Where to deviate from idle.

    `in_band` and `whole` (point, bit) are what each bit adds at each point in m: in the band, of which the sum is made, and in
    truth. `asked` (point,) are amplitudes, above 0 to 1, of what all points would get together at full amplitude. `nulls` (row,
    bit) shall stay zero, in m; rows are orthogonal to each other. The local strength of a sum is taken over `block_samples`.
    Returns (bit,). Raises ValueError if a point cannot be moved, or not while others move as asked or nulls stay still.
    """
    count = len(in_band)
    sizes = np.linalg.norm(nulls, axis=1, keepdims=True)
    still = nulls / sizes  # of one size
    left = in_band - (in_band @ still.T) @ still
    _require_independent(in_band, left, asked)
    alone = np.abs(in_band).sum(axis=1, keepdims=True)  # next to what each point moves alone: all get the same share of it
    in_band, whole, left = (some * (alone.mean() / alone) for some in (in_band, whole, left))
    rows = np.concatenate([in_band, still * float(np.linalg.norm(in_band, axis=1).mean())])
    signs = _polarities(left, rows)

    def proportions(shares: Reals) -> Reals:
        return np.append(shares, np.zeros(len(nulls)))

    shares = signs
    bits: Bools = np.zeros(rows.shape[1], bool)
    for _ in range(ROUNDS):
        weights, _ = farthest(rows, proportions(shares))
        sums = weights @ rows
        bits = sums > 0
        shares = signs * np.abs((in_band @ bits) / (whole @ bits))
    wanted = signs * float(np.abs(whole @ bits).mean())
    if not np.all(asked == 1):
        wanted = wanted * asked
        from scipy.ndimage import uniform_filter1d  # noqa: PLC0415 - imports that most builds of a bank do without

        strength = uniform_filter1d(np.abs(sums).reshape(-1, CHANNELS), block_samples, axis=0, mode="nearest").ravel()
        threshold = max(masking_threshold(float(np.sqrt((asked**2).mean()))), SMALLEST_THRESHOLD)
        weights = np.append(weights[:count] * asked, weights[count:]) / threshold
        aimed = wanted * np.abs(shares)
        for _ in range(ROUNDS):
            weights = cheapest(rows, proportions(aimed), strength, weights)
            sums = weights @ rows - strength
            bits = sums > 0
            aimed = aimed + wanted * np.abs(shares) - (whole @ bits) * np.abs(shares)
    scale = 1 / float(np.abs(wanted).mean())
    measured = np.concatenate([whole * (scale / asked[:, None]), nulls * (NULL_SHARE * scale)])
    flip(bits, sums, measured, proportions(wanted * scale / asked), EQUAL if not len(nulls) else 0.0)
    return bits


def _polarities(left: Reals, rows: Reals) -> Reals:
    """Directions of the points with the largest bound, of those that are likely to have it."""
    count = len(left)
    likely = likely_polarities(left, min(FULL_POLARITIES, 2 ** max(count - 3, 0)) if count > 2 else 1)
    best, signs = -math.inf, likely[0]
    for some in likely if len(likely) > 1 else []:
        _, bound = farthest(rows, np.append(some, np.zeros(len(rows) - count)), (1.0, 0.3))
        if bound > best:
            best, signs = bound, some
    return signs


def _require_independent(in_band: Reals, left: Reals, asked: Reals) -> None:
    """Refuse points that cannot move, and those that would have to move otherwise than another one at the same place."""
    norms, kept = np.linalg.norm(in_band, axis=1), np.linalg.norm(left, axis=1)
    if not norms.all():
        raise ValueError("nothing can move a point to compose")
    if (kept < SEPARABLE * norms).any():
        raise ValueError("a point to compose is where the plate shall stay still")
    alike = in_band @ in_band.T / np.outer(norms, norms)
    for first, second in zip(*np.nonzero(np.triu(alike > ALIKE, 1)), strict=True):
        if asked[first] != asked[second]:
            raise ValueError(f"points {first} and {second} are one place, and have different amplitudes")
