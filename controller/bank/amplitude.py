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
IN_BAND = (1.0, 0.9719, 0.8928, 0.7768, 0.6394, 0.4969, 0.3637, 0.2487, 0.1374, 0.0586)
WHOLE = (1.0, 0.9764, 0.9089, 0.8022, 0.6727, 0.5347, 0.3991, 0.2781, 0.155, 0.067)


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


def hold_threshold(in_band: float) -> float:
    """Threshold, in local means, at which about this share of the full in-band amplitude is left."""
    return _interpolate(in_band, IN_BAND, THRESHOLDS)


def in_band_share(whole: float) -> float:
    """Share of the in-band amplitude at which this share of the whole displacement is left."""
    return _interpolate(whole, WHOLE, IN_BAND)


def _interpolate(value: float, falling: tuple[float, ...], result: tuple[float, ...]) -> float:
    """Value of `result` where `falling`, which begins with 1, has a value; linear in between, the last one below the last."""
    for index in range(1, len(falling)):
        if value >= falling[index]:
            part = max(falling[index - 1] - value, 0.0) / (falling[index - 1] - falling[index])
            return result[index - 1] + part * (result[index] - result[index - 1])
    return result[-1]
