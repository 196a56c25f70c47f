"""The bits of one sample: rounded, then flipped where that gains."""

import numpy as np

from controller.arrays import Floats

FLIPS_PER_SAMPLE = 3  # of one cell in one pass of the descent


def settle(levels: Floats, slope: Floats, curvature: Floats, change: Floats) -> None:
    """Choose the bits of one sample: round levels between 0 and 1, then flip the bits that gain most.

    `levels` (cell, 32) become 0 or 1; `slope` (cell, 32), the derivative of the gain by each, is overwritten; `curvature` (cell,
    32, 32) is that of the loss; `change` (cell, 32) receives the change of the levels.
    """
    half = np.diagonal(curvature, axis1=1, axis2=2) / 2
    between = (levels > 0) & (levels < 1)
    for channel in np.flatnonzero(between.any(axis=0)).tolist():
        level = levels[:, channel]
        up = slope[:, channel] > (1 - 2 * level) * half[:, channel]  # the gain of 1 - level over that of -level
        by = np.where(between[:, channel], up - level, 0.0)
        change[:, channel] = by
        slope -= by[:, None] * curvature[:, channel]
    levels += change
    sense = 1 - 2 * levels
    for _ in range(FLIPS_PER_SAMPLE):
        gain = sense * slope - half
        best = gain.argmax(axis=1)
        cells = np.flatnonzero(gain[np.arange(len(gain)), best] > 0)
        if not cells.size:
            break
        channels = best[cells]
        by = sense[cells, channels]
        change[cells, channels] += by
        levels[cells, channels] += by
        sense[cells, channels] = -by
        slope[cells] -= by[:, None] * curvature[cells, channels]
