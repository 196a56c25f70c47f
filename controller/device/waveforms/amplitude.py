"""The steps to which amplitudes are rounded, so that equal waveforms have equal keys."""

from __future__ import annotations

import math

from controller.device.board.devices import MIN_AMPLITUDE

STEPS_PER_HALF = 128  # a step is 0.54 %: rounding to one is at most 0.27 % off
LAST_STEP = round(-STEPS_PER_HALF * math.log2(MIN_AMPLITUDE))
AMPLITUDES = *(2 ** (-step / STEPS_PER_HALF) for step in range(LAST_STEP)), MIN_AMPLITUDE


def amplitude_step(amplitude: float) -> int:
    """Nearest step of an amplitude: 0 is full, `LAST_STEP` is `MIN_AMPLITUDE` and everything below.

    Raises ValueError if it is not above 0 and at most 1.
    """
    if not 0 < amplitude <= 1:
        raise ValueError(f"amplitude {amplitude} is not above 0 and at most 1")
    return min(round(-STEPS_PER_HALF * math.log2(amplitude)), LAST_STEP)
