"""Which waveform serves a set of points: an entry as it is, or responses composed.

A lone finger near a cell's centre plays the bank's entry without any arithmetic. Farther off, and
for several points at once, responses are interpolated, summed and signed. Points are first rounded
to a lattice, so that a finger at rest asks for the same waveform again and finds it resident.
"""

from __future__ import annotations

from collections.abc import Sequence

from controller.bank.composition import Composer
from controller.bank.reader import Bank

LATTICE_M = 0.25e-3  # at most 0.18 mm off: less than 1 % of the amplitude

Point = tuple[float, float, float]  # x_m, y_m, weight
Key = int | tuple[tuple[int, int, float], ...]  # a cell, or points on the lattice with their weights


class Selection:
    """Keys and drive words for points on the plate.

    Parameters
    ----------
    bank : Bank
        The open bank.
    snap_m : float
        A lone finger at most this far from a cell's centre plays that cell.
    idle_word : int
        Level of every channel whose summed response is exactly zero.
    """

    def __init__(self, bank: Bank, snap_m: float, idle_word: int) -> None:
        self._bank = bank
        self._snap_m = snap_m
        self._idle_word = idle_word
        self._composer: Composer | None = None

    @property
    def composes(self) -> bool:
        """Whether anything had to be composed so far, and the response section with it mapped."""
        return self._composer is not None

    def key(self, points: Sequence[Point]) -> Key:
        """Name of the waveform for these points; equal keys have equal words."""
        if len(points) == 1:
            x_m, y_m, _ = points[0]
            cell, distance_m = self._bank.grid.nearest(x_m, y_m)
            if distance_m <= self._snap_m:
                return cell
        return tuple(sorted((round(x_m / LATTICE_M), round(y_m / LATTICE_M), weight) for x_m, y_m, weight in points))

    def words(self, key: Key) -> memoryview:
        """Drive words of a key, valid until the next call.

        Raises
        ------
        BankError
            If an entry it needs is damaged or not in the bank.
        """
        if isinstance(key, int):
            return self._bank.words(key)
        if self._composer is None:  # maps the response section: only scenes that need it pay for it
            self._composer = Composer(self._bank, self._idle_word)
        return self._composer.compose([(x * LATTICE_M, y * LATTICE_M, weight) for x, y, weight in key])

    def reusable(self, key: Key, resident: Key) -> bool:
        """Whether a resident waveform serves instead."""
        return key == resident
