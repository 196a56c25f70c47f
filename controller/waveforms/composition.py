"""Drive words for several points at once, for points between cells, and for less than full amplitude.

Responses are interpolated and added before the sign is taken. Each point's response is first divided
by the amplitude that the point would get alone: equal weights then give every finger the same share
of its own maximum, however strongly the plate answers there.

An amplitude is a share of what the same point would get if all points of the emission were played at
full amplitude. Weights set the ratio of the amplitudes to each other; amplitude masking, which leaves
bits at idle where the sum is weak, sets their common level. Both are found from the displacement
that the bits give at each point: it is linear in the bits, one inner product for each point, and a
few rounds are enough.
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
from controller.waveforms.amplitude_masking import LocalStrength, masking_threshold
from controller.waveforms.interpolation import Interpolation, aligned

MAX_FOCI = 10
MAX_ROUNDS = 5  # of measuring what the bits give; most emissions need two or three
TOLERANCE = 0.01  # of an amplitude: well below a step
ZERO = np.array(0, np.float32)

Point = tuple[float, float, float]  # x_m, y_m, amplitude


class Composer:
    """Composes drive words from a bank's responses in memory taken once.

    All bits are deviations from idle: the response of a channel that idles high is negated, so that a
    bit deviates where the sum is above a threshold of at least zero, and then adds the response itself
    to the displacement. A sum of zero leaves the channel idle.

    Parameters
    ----------
    bank : Bank
        The open bank; its response section is mapped with the first composition.
    idle_word : int
        Level of each channel at rest: bit q is channel q.

    Raises
    ------
    ValueError
        If the idle word is not 32 bits.
    """

    def __init__(self, bank: Bank, idle_word: int) -> None:
        if not 0 <= idle_word < 1 << CHANNELS:
            raise ValueError(f"idle word {idle_word:#x} is not {CHANNELS} bits")
        samples, rest_rows = bank.samples, bank.header.rest_rows
        values = samples * CHANNELS
        self._strength = LocalStrength(samples, bank.header.bit_clock_hz)
        self._packer = WordPacker(self._strength.padded_samples)
        padded = self._strength.padded_samples * CHANNELS
        self._band = Interpolation(bank, samples)
        self._band_and_rest = Interpolation(bank, samples + rest_rows)
        self._interpolated = aligned(values + rest_rows * CHANNELS)
        self._in_band, self._outside = self._interpolated[:values], self._interpolated[values:]
        self._points = np.zeros((MAX_FOCI, padded), np.float32)
        self._points_of_samples = self._points[:, :values]
        self._rests = np.empty((MAX_FOCI, rest_rows * CHANNELS), np.float32)
        self._sum = np.empty(padded, np.float32)
        self._normalised = np.empty(padded, np.float32)
        self._threshold = np.empty((), np.float32)
        self._ones = np.ones(padded, np.float32)
        self._bit_values = np.empty(padded, np.float32)  # bits as numbers; also the room for absolute values
        of_rest = self._bit_values[: rest_rows * REST_SAMPLES * CHANNELS]
        self._bit_values_by_rest_row = of_rest.reshape(rest_rows, REST_SAMPLES, CHANNELS)
        self._rest_bits = np.empty((rest_rows, 1, CHANNELS), np.float32)
        self._rest_bits_flat = self._rest_bits.reshape(-1)
        self._rest_ones = np.ones((1, REST_SAMPLES), np.float32)
        self._weights = np.empty(MAX_FOCI, np.float32)
        self._in_and_outside = np.empty((2, MAX_FOCI), np.float32)
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
            1 to `MAX_FOCI`; above 0 to 1. Points beyond the outermost cells take the nearest place
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
        if not 1 <= count <= MAX_FOCI:
            raise ValueError(f"{count} points to compose, not 1 to {MAX_FOCI}")
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
        norms = []  # of each response alone
        for row, point in enumerate(points):
            if full:
                self._band.at(point[0], point[1], self._in_band)
                np.multiply(self._in_band, self._flip_in_band, out=self._in_band)
            else:
                self._band_and_rest.at(point[0], point[1], self._interpolated)
                np.multiply(self._interpolated, self._flip, out=self._interpolated)
                np.copyto(self._rests[row], self._outside)
            np.copyto(self._points_of_samples[row], self._in_band)
            norms.append(self._norm(row) if count > 1 else 1.0)
        np.greater(self._weighted_sum([1.0] * count, norms), ZERO, out=self._bits)
        if full:
            return
        asked = [amplitude for _, _, amplitude in points]
        wanted = [share * full for share, full in zip(asked, self._measured(norms), strict=True)]
        total = self._weighted_sum(asked, norms)
        self._strength.measure(total)
        self._strength.normalise(total, self._normalised)
        self._solve(asked, wanted, norms)

    def _solve(self, asked: list[float], wanted: list[float], norms: list[float]) -> None:
        """Set the bits that give the wanted displacement at each point.

        The ratio of the weights sets the ratio of the displacements; the Euclidean norm of the weights sets how much is
        masked, since the displacements of independent points are proportional to their weights. So each round adds the
        residuals to the weights, from the second round on by Anderson acceleration of depth one, since points that are near
        each other are not independent.

        Parameters
        ----------
        asked : list of float
            Amplitude of each point: the first weights.
        wanted : list of float
            Displacement of each point, as `_measured` gives it.
        norms : list of float
            Of the points' responses.
        """
        weights, first_norm = asked, _euclidean_norm(asked)
        gain = 0.0
        weights_before, residuals_before = weights, weights
        for turn in range(MAX_ROUNDS):
            norm = _euclidean_norm(weights) or first_norm
            if turn and len(weights) > 1:  # the sum of a single point stays as it is
                total = self._weighted_sum([weight * first_norm / norm for weight in weights], norms)
                self._strength.normalise(total, self._normalised)
            self._threshold[...] = masking_threshold(norm / math.sqrt(len(weights)))
            np.greater(self._normalised, self._threshold, out=self._bits)
            if turn == MAX_ROUNDS - 1:
                return
            measured = self._measured(norms)
            if all(abs(want - got) <= TOLERANCE * want for want, got in zip(wanted, measured, strict=True)):
                return
            gain = gain or sum(map(mul, measured, weights)) / norm**2
            if gain <= 0:
                return
            residuals = [(want - got) / gain for want, got in zip(wanted, measured, strict=True)]
            further = [weight + residual for weight, residual in zip(weights, residuals, strict=True)]
            if turn:
                change = [new - old for new, old in zip(residuals, residuals_before, strict=True)]
                change_squared = sum(map(mul, change, change))
                mixing = sum(map(mul, residuals, change)) / change_squared if change_squared else 0.0
                before = [weight + residual for weight, residual in zip(weights_before, residuals_before, strict=True)]
                further = [new + mixing * (old - new) for new, old in zip(further, before, strict=True)]
            weights_before, residuals_before = weights, residuals
            weights = further

    def _norm(self, row: int) -> float:
        """Sum of the absolute values of a point's response: twice what the point would get alone, in the band."""
        np.abs(self._points[row], out=self._bit_values)
        return float(np.dot(self._bit_values, self._ones)) or 1.0

    def _weighted_sum(self, weights: list[float], norms: list[float]) -> NDArray[np.float32]:
        """Weighted sum of the points' responses, each divided by its norm; for a single point its response as it is."""
        count = len(weights)
        if count == 1:
            alone: NDArray[np.float32] = self._points[0]
            return alone
        for row, (weight, norm) in enumerate(zip(weights, norms, strict=True)):
            self._weights[row] = weight / norm
        np.dot(self._weights[:count], self._points[:count], out=self._sum)
        return self._sum

    def _measured(self, norms: list[float]) -> list[float]:
        """Displacement that the bits give at each point, divided by the norm of its response: in the band and outside it."""
        count = len(norms)
        np.copyto(self._bit_values, self._bits)
        np.matmul(self._rest_ones, self._bit_values_by_rest_row, out=self._rest_bits)
        in_band, outside = self._in_and_outside
        np.dot(self._points[:count], self._bit_values, out=in_band[:count])
        np.dot(self._rests[:count], self._rest_bits_flat, out=outside[:count])
        return [float(in_band[row] + outside[row]) / norm for row, norm in enumerate(norms)]


def _euclidean_norm(weights: list[float]) -> float:
    return math.sqrt(sum(map(mul, weights, weights)))
