"""Amplitudes below full: their steps, and how many bits are held at idle for one.

Where a response is weak against its own surroundings in time, the channel stays at its idle bit. The
contrast stays what it was and the edges become fewer; starting later or masking channels would cost
contrast (README.md). How much is left at a given threshold hardly depends on the point while little
is held, and by tenths when much is; so the table only begins the search, and the bits themselves are
measured against the responses they are meant for.
"""

from __future__ import annotations

import math

STEPS_PER_HALF = 16  # a step is 4.4 %: what is rounded to one is at most 2.2 % off
LEAST_STEP = 2 * STEPS_PER_HALF  # a quarter of full amplitude
AMPLITUDES = tuple(2 ** (-step / STEPS_PER_HALF) for step in range(LEAST_STEP + 1))

# Share of the full amplitude that is left when every sample is held whose response is below a threshold,
# in units of the mean of its absolute value over 96 us: median over 120 points of the simulated board.
THRESHOLDS = (0.0, 0.3, 0.6, 0.9, 1.2, 1.5, 1.8, 2.1, 2.5, 3.0)
SHARES = (1.0, 0.9764, 0.9089, 0.8022, 0.6727, 0.5347, 0.3991, 0.2781, 0.155, 0.067)


def amplitude_step(amplitude: float) -> int:
    """Nearest step of an amplitude: 0 is full, `LEAST_STEP` a quarter; below that, a quarter.

    Raises
    ------
    ValueError
        If it is not above 0 and at most 1.
    """
    if not 0 < amplitude <= 1:
        raise ValueError(f"amplitude {amplitude} is not above 0 and at most 1")
    return min(round(-STEPS_PER_HALF * math.log2(amplitude)), LEAST_STEP)


def hold_threshold(share: float) -> float:
    """Threshold, in local means, at which about this share of the full amplitude is left."""
    for index in range(1, len(SHARES)):
        if share >= SHARES[index]:
            above, below = SHARES[index - 1], SHARES[index]
            part = max(above - share, 0.0) / (above - below)
            return THRESHOLDS[index - 1] + part * (THRESHOLDS[index] - THRESHOLDS[index - 1])
    return THRESHOLDS[-1]
