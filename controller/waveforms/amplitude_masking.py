"""Amplitude masking: bits stay at idle where a response is weak against its own surroundings in time.

Masking keeps the contrast and lowers the number of edges; starting later or masking whole channels would cost contrast
(README.md). The share of amplitude that a threshold leaves hardly depends on the point while little is masked, and by tenths
when much is: the table gives the first threshold of a search, and the bits themselves are then measured against the responses
for which they are meant.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from controller.bank.file_format import REST_SAMPLES
from controller.bank.packing import CHANNELS

BLOCK_S = 96e-6  # over which the local strength of a response is taken
RUN_SAMPLES = REST_SAMPLES  # samples for which strengths are laid out at a time: longer runs for numpy's inner loop
TINY = np.array(1e-30, np.float32)  # below every strength but that of a response of zeros

# Share of the full amplitude that is left when every sample is masked whose response is below a threshold,
# in units of the mean of its absolute value over 96 us: median over 120 points of the simulated board.
THRESHOLDS = (0.0, 0.3, 0.6, 0.9, 1.2, 1.5, 1.8, 2.1, 2.5, 3.0)
SHARES = (1.0, 0.9764, 0.9089, 0.8022, 0.6727, 0.5347, 0.3991, 0.2781, 0.155, 0.067)

Values = NDArray[np.float32]


def masking_threshold(share: float) -> float:
    """Threshold, in local strengths, that leaves about this share of the full amplitude."""
    for index in range(1, len(SHARES)):
        if share >= SHARES[index]:
            above, below = SHARES[index - 1], SHARES[index]
            part = max(above - share, 0.0) / (above - below)
            return THRESHOLDS[index - 1] + part * (THRESHOLDS[index] - THRESHOLDS[index - 1])
    return THRESHOLDS[-1]


class LocalStrength:
    """Local strength of a response, by which responses are divided; works in memory taken once.

    Time is cut into blocks of `BLOCK_S`; in each block the strength of a channel is the mean of the absolute values of its
    response. Strengths are laid out by copies, since a ufunc that broadcasts allocates.

    Parameters
    ----------
    samples : int
        Of an emission.
    bit_clock_hz : float

    Attributes
    ----------
    padded_samples : int
        Samples in whole blocks; what lies behind the last sample must be zero.
    """

    def __init__(self, samples: int, bit_clock_hz: float) -> None:
        block = RUN_SAMPLES * max(round(BLOCK_S * bit_clock_hz / RUN_SAMPLES), 1)
        blocks = -(-samples // block)
        self.padded_samples = blocks * block
        self._mean = np.full((1, block), 1 / block, np.float32)
        self._by_block = np.empty((blocks, 1, CHANNELS), np.float32)
        self._run = np.empty((blocks, RUN_SAMPLES, CHANNELS), np.float32)
        self._run_of_blocks = self._run.reshape(blocks, 1, RUN_SAMPLES * CHANNELS)
        self._factors = np.empty(self.padded_samples * CHANNELS, np.float32)  # 1 / strength; absolute values before that
        self._factors_by_sample = self._factors.reshape(blocks, block, CHANNELS)
        self._factors_by_run = self._factors.reshape(blocks, block // RUN_SAMPLES, RUN_SAMPLES * CHANNELS)

    def measure(self, response: Values) -> None:
        """Take the local strength of a response, (padded_samples * 32,)."""
        np.abs(response, out=self._factors)
        np.matmul(self._mean, self._factors_by_sample, out=self._by_block)
        np.maximum(self._by_block, TINY, out=self._by_block)
        np.reciprocal(self._by_block, out=self._by_block)
        np.copyto(self._run, self._by_block)
        np.copyto(self._factors_by_run, self._run_of_blocks)

    def normalise(self, response: Values, out: Values) -> None:
        """Divide a response by the local strength of the one that was measured, into `out`, both (padded_samples * 32,)."""
        np.multiply(response, self._factors, out=out)
