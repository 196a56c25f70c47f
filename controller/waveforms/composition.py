"""Drive words for several points at once, for points between cells, and for less than full amplitude.

Responses are interpolated and added before the sign is taken. Each point's response is first divided
by the amplitude that point would get alone: equal weights then give every finger the same share of
its own best, however strongly the plate answers there.

An amplitude is a share of what the same point would get if all points of the emission were played at
full amplitude. It is reached by weights, for what fingers have more or less of than each other, and
by holding bits at idle where the sum is weak, for what they have less of together. Both are set by
what the bits really do at each point: amplitudes are linear in the bits, so that is one inner
product for each point, and few rounds are enough.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from operator import mul

import numpy as np
from numpy.typing import NDArray

from controller.bank.file_format import REST_SAMPLES
from controller.bank.packing import CHANNELS, WORD, WordPacker
from controller.bank.reader import Bank
from controller.waveforms.amplitude import hold_threshold
from controller.waveforms.amplitude_masking import Holding
from controller.waveforms.interpolation import Interpolation, aligned

MOST_POINTS = 10
ROUNDS = 5  # at most, of looking what the bits do; most need two or three
CLOSE = 0.01  # near enough: well below a step of amplitude
NO_SUM = np.array(0, np.float32)

Point = tuple[float, float, float]  # x_m, y_m, amplitude


class Composer:
    """Composes drive words from a bank's responses in memory taken once.

    Everything is done in deviations from idle: a response of a channel that idles high is negated, so
    that a bit deviates where its sum is above a threshold of at least zero, and what it then adds to
    the displacement is the response itself. A sum of zero leaves the channel idle.

    Parameters
    ----------
    bank : Bank
        The open bank; its response section is mapped with the first composition.
    idle_word : int
        Level of each channel while nothing is to be gained by another.
    """

    def __init__(self, bank: Bank, idle_word: int) -> None:
        if not 0 <= idle_word < 1 << CHANNELS:
            raise ValueError(f"idle word {idle_word:#x} is not {CHANNELS} bits")
        samples, rest_rows = bank.samples, bank.header.rest_rows
        values = samples * CHANNELS
        self._holding = Holding(samples, bank.header.bit_clock_hz)
        self._packer = WordPacker(self._holding.padded_samples)
        padded = self._holding.padded_samples * CHANNELS
        self._band = Interpolation(bank, samples)
        self._band_and_rest = Interpolation(bank, samples + rest_rows)
        self._interpolated = aligned(values + rest_rows * CHANNELS)
        self._in_band, self._outside = self._interpolated[:values], self._interpolated[values:]
        self._points = np.zeros((MOST_POINTS, padded), np.float32)
        self._points_of_samples = self._points[:, :values]
        self._rests = np.empty((MOST_POINTS, rest_rows * CHANNELS), np.float32)
        self._sum = np.empty(padded, np.float32)
        self._normalised = np.empty(padded, np.float32)
        self._held = np.empty((), np.float32)
        self._ones = np.ones(padded, np.float32)
        self._deviates = np.empty(padded, np.float32)  # bits as numbers; also the room for absolute values
        of_rest = self._deviates[: rest_rows * REST_SAMPLES * CHANNELS]
        self._deviates_of_rest = of_rest.reshape(rest_rows, REST_SAMPLES, CHANNELS)
        self._deviations = np.empty((rest_rows, 1, CHANNELS), np.float32)
        self._deviations_in_a_row = self._deviations.reshape(-1)
        self._eight = np.ones((1, REST_SAMPLES), np.float32)
        self._weights = np.empty(MOST_POINTS, np.float32)
        self._reached = np.empty((2, MOST_POINTS), np.float32)
        idle_high = np.array([idle_word >> q & 1 for q in range(CHANNELS)], np.int16)
        self._flip = np.tile(1 - 2 * idle_high, samples + rest_rows)
        self._flip_in_band = self._flip[:values]
        self._low_at = np.tile(-idle_high, samples)  # largest whole number that plays low
        self._idle_word = np.array(idle_word, WORD)
        self._bits = self._packer.bits
        self._bits_of_samples = self._bits[:values]
        self._view = self._packer.words.data.cast("B")[: 4 * samples].toreadonly()

    def compose(self, points: Sequence[Point]) -> memoryview:
        """Drive words that make every point jump at T.

        Parameters
        ----------
        points : sequence of (x_m, y_m, amplitude)
            1 to `MOST_POINTS`; above 0 to 1. Points beyond the outermost cells take the nearest place
            among the cells.

        Returns
        -------
        memoryview
            4 bytes a sample, as they go to the wire; valid until the next call.

        Raises
        ------
        BankError
            If a cell that a point needs is not in the bank, or damaged.
        ValueError
            If there are no points or too many, or numbers that are not finite or beyond their range.
        """
        count = len(points)
        if not 1 <= count <= MOST_POINTS:
            raise ValueError(f"{count} points to compose, not 1 to {MOST_POINTS}")
        full = True
        for _, _, amplitude in points:
            if not 0 < amplitude <= 1:
                raise ValueError(f"amplitude {amplitude} is not above 0 and at most 1")
            full = full and amplitude == 1
        if count == 1 and full:
            x_m, y_m, _ = points[0]
            self._band.at(x_m, y_m, self._in_band)
            np.greater(self._in_band, self._low_at, out=self._bits_of_samples)
            self._packer.pack()
        else:
            self._compose(points, full)
            self._packer.pack()
            np.bitwise_xor(self._packer.words, self._idle_word, out=self._packer.words)
        return self._view

    def _compose(self, points: Sequence[Point], full: bool) -> None:
        """Set the bits for several points, or for less than full amplitude."""
        count = len(points)
        sizes = []  # of each response alone
        for row, point in enumerate(points):
            if full:
                self._band.at(point[0], point[1], self._in_band)
                np.multiply(self._in_band, self._flip_in_band, out=self._in_band)
            else:
                self._band_and_rest.at(point[0], point[1], self._interpolated)
                np.multiply(self._interpolated, self._flip, out=self._interpolated)
                np.copyto(self._rests[row], self._outside)
            np.copyto(self._points_of_samples[row], self._in_band)
            sizes.append(self._size(row) if count > 1 else 1.0)
        np.greater(self._total([1.0] * count, sizes), NO_SUM, out=self._bits)
        if full:
            return
        asked = [amplitude for _, _, amplitude in points]
        wanted = [share * reached for share, reached in zip(asked, self._reach(sizes), strict=True)]
        total = self._total(asked, sizes)
        self._holding.measure(total)
        self._holding.normalise(total, self._normalised)
        self._settle(asked, wanted, sizes)

    def _settle(self, asked: list[float], wanted: list[float], sizes: list[float]) -> None:
        """Search the bits that reach what is wanted at each point.

        The shares by which responses are added say two things: how points compare by their ratio, and how
        much is held by their length, since independent points reach in proportion to their shares. So what
        is missing is added to the shares; from the second round on with the change that this had brought
        (Anderson's method of depth one), since points that are near each other are not independent.
        """
        shares, length = asked, _length(asked)
        gain = 0.0
        shares_before, missing_before = shares, shares
        for turn in range(ROUNDS):
            strength = _length(shares) or length
            if turn and len(shares) > 1:  # of one point the sum stays
                total = self._total([share * length / strength for share in shares], sizes)
                self._holding.normalise(total, self._normalised)
            self._held[...] = hold_threshold(strength / math.sqrt(len(shares)))
            np.greater(self._normalised, self._held, out=self._bits)
            if turn == ROUNDS - 1:
                return
            reached = self._reach(sizes)
            if all(abs(want - got) <= CLOSE * want for want, got in zip(wanted, reached, strict=True)):
                return
            gain = gain or sum(map(mul, reached, shares)) / strength**2
            if gain <= 0:
                return
            missing = [(want - got) / gain for want, got in zip(wanted, reached, strict=True)]
            further = [share + part for share, part in zip(shares, missing, strict=True)]
            if turn:
                change = [new - old for new, old in zip(missing, missing_before, strict=True)]
                spread = sum(map(mul, change, change))
                back = sum(map(mul, missing, change)) / spread if spread else 0.0
                before = [share + part for share, part in zip(shares_before, missing_before, strict=True)]
                further = [new + back * (old - new) for new, old in zip(further, before, strict=True)]
            shares_before, missing_before = shares, missing
            shares = further

    def _size(self, row: int) -> float:
        """Twice what a point would get alone, in the band: the sum of its response's absolute values."""
        np.abs(self._points[row], out=self._deviates)
        return float(np.dot(self._deviates, self._ones)) or 1.0

    def _total(self, shares: list[float], sizes: list[float]) -> NDArray[np.float32]:
        """Sum of the points' responses, each of size one, with these shares; of one point its response as it is."""
        count = len(shares)
        if count == 1:
            alone: NDArray[np.float32] = self._points[0]
            return alone
        for row, (share, size) in enumerate(zip(shares, sizes, strict=True)):
            self._weights[row] = share / size
        np.dot(self._weights[:count], self._points[:count], out=self._sum)
        return self._sum

    def _reach(self, sizes: list[float]) -> list[float]:
        """What the bits do at each point, in sizes of its response."""
        count = len(sizes)
        np.copyto(self._deviates, self._bits)
        np.matmul(self._eight, self._deviates_of_rest, out=self._deviations)
        in_band, outside = self._reached
        np.dot(self._points[:count], self._deviates, out=in_band[:count])
        np.dot(self._rests[:count], self._deviations_in_a_row, out=outside[:count])
        return [float(in_band[row] + outside[row]) / size for row, size in enumerate(sizes)]


def _length(shares: list[float]) -> float:
    return math.sqrt(sum(map(mul, shares, shares)))
