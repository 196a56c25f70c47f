"""Holds bits at idle where a response is weak against its own surroundings in time."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from controller.bank.file_format import REST_SAMPLES
from controller.bank.packing import CHANNELS

LOCAL_S = 96e-6  # over which the strength of a response is taken
SIDE_BY_SIDE = REST_SAMPLES  # samples for which strengths are laid out at a time: longer runs for numpy's inner loop
TINY = np.array(1e-30, np.float32)  # below every strength but that of nothing

Values = NDArray[np.float32]


class Holding:
    """Divides a response by its own local strength, in memory taken once.

    Time is cut into blocks of 96 us; in each the strength of a channel is the mean of the absolute
    values of its response. Strengths are laid out by copies, since a ufunc that broadcasts allocates.

    Parameters
    ----------
    samples : int
        Of an emission.
    bit_clock_hz : float

    Attributes
    ----------
    padded_samples : int
        Whole blocks, and whole rows of the rest: what lies behind the last sample has to be zero.
    """

    def __init__(self, samples: int, bit_clock_hz: float) -> None:
        block = SIDE_BY_SIDE * max(round(LOCAL_S * bit_clock_hz / SIDE_BY_SIDE), 1)
        blocks = -(-samples // block)
        self.padded_samples = blocks * block
        self._mean = np.full((1, block), 1 / block, np.float32)
        self._strength = np.empty((blocks, 1, CHANNELS), np.float32)
        self._few = np.empty((blocks, SIDE_BY_SIDE, CHANNELS), np.float32)
        self._all = np.empty(self.padded_samples * CHANNELS, np.float32)  # one over the strength; first the absolute values
        self._all_by_sample = self._all.reshape(blocks, block, CHANNELS)
        self._all_by_runs = self._all.reshape(blocks, block // SIDE_BY_SIDE, SIDE_BY_SIDE * CHANNELS)
        self._few_of_runs = self._few.reshape(blocks, 1, SIDE_BY_SIDE * CHANNELS)

    def measure(self, response: Values) -> None:
        """Take the local strength of a response (padded_samples * 32,)."""
        np.abs(response, out=self._all)
        np.matmul(self._mean, self._all_by_sample, out=self._strength)
        np.maximum(self._strength, TINY, out=self._strength)
        np.reciprocal(self._strength, out=self._strength)
        np.copyto(self._few, self._strength)
        np.copyto(self._all_by_runs, self._few_of_runs)

    def normalise(self, response: Values, out: Values) -> None:
        """Divide a response by the strength of the one that was measured."""
        np.multiply(response, self._all, out=out)
