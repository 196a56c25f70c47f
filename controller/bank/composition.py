"""Drive words for several points at once, or for points between cells: add responses, then take the sign.

Between cells a response is interpolated bilinearly, before the sign. Of several points each response
is first divided by the sum of its absolute values, which is the amplitude that point would get alone:
equal weights then give every finger the same share of its own best, however strongly the plate
answers there. Added as they are, the strongest would take the bits of the others.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from controller.bank.packing import CHANNELS
from controller.bank.reader import Bank

TYPICAL_POINTS = 10  # room taken in advance; more are composed too
# A sum is either exactly zero or far above this: a channel that idles high plays high at zero.
JUST_BELOW_ZERO = -np.finfo(np.float32).tiny


class Composer:
    """Composes drive words from a bank's responses in memory taken once.

    Parameters
    ----------
    bank : Bank
        The open bank; its response section is mapped with the first composition.
    idle_word : int
        Level of each channel where the sum is exactly zero.
    """

    def __init__(self, bank: Bank, idle_word: int) -> None:
        if not 0 <= idle_word < 1 << CHANNELS:
            raise ValueError(f"idle word {idle_word:#x} is not {CHANNELS} bits")
        values = bank.samples * CHANNELS
        self._bank = bank
        self._corners = np.empty((4, values), np.float32)
        self._points = np.empty((TYPICAL_POINTS, values), np.float32)
        self._sum = np.empty(values, np.float32)
        self._ones = np.ones(values, np.float32)
        self._bits = np.empty(values, np.bool_)
        self._corner_weights = np.empty(4, np.float32)
        self._point_weights = np.empty(TYPICAL_POINTS, np.float32)
        idle_high = np.array([idle_word >> q & 1 for q in range(CHANNELS)], np.float32)
        self._threshold = np.tile(idle_high * JUST_BELOW_ZERO, bank.samples)

    def compose(self, points: Sequence[tuple[float, float, float]]) -> memoryview:
        """Drive words that make every point jump at T.

        Parameters
        ----------
        points : sequence of (x_m, y_m, weight)
            Where, and with what share; a negative weight pulls instead of pushing. Points beyond the
            outermost cells take the nearest place among the cells.

        Returns
        -------
        memoryview
            4 bytes a sample, as they go to the wire.

        Raises
        ------
        BankError
            If a cell that a point needs is not in the bank, or damaged.
        ValueError
            If there are no points, or numbers that are not finite.
        """
        if not points:
            raise ValueError("no points to compose")
        if len(points) > len(self._points):
            self._points = np.empty((len(points), self._sum.size), np.float32)
            self._point_weights = np.empty(len(points), np.float32)
        for row, (x_m, y_m, _) in enumerate(points):
            self._interpolate(x_m, y_m, self._points[row])
        if len(points) == 1 and points[0][2] > 0:
            summed = self._points[0]  # its sign does not depend on its size
        else:
            summed = self._sum
            for row, (_, _, weight) in enumerate(points):
                np.abs(self._points[row], out=self._sum)
                total = float(np.dot(self._sum, self._ones))
                self._point_weights[row] = weight / total if total else 0.0
            if not np.isfinite(self._point_weights[: len(points)]).all():
                raise ValueError("a weight is not finite")
            np.dot(self._point_weights[: len(points)], self._points[: len(points)], out=summed)
        np.greater(summed, self._threshold, out=self._bits)
        return np.packbits(self._bits, bitorder="little").data

    def _interpolate(self, x_m: float, y_m: float, out: np.ndarray[tuple[int], np.dtype[np.float32]]) -> None:
        """Response at a point in m per V, from the cells around it that count."""
        used = 0
        for cell, weight in zip(*self._bank.grid.corners(x_m, y_m), strict=True):
            if weight > 0:
                levels, scale_m_per_v = self._bank.response(cell)
                np.copyto(self._corners[used], levels.reshape(-1))
                self._corner_weights[used] = weight * scale_m_per_v
                used += 1
        np.dot(self._corner_weights[:used], self._corners[:used], out=out)
