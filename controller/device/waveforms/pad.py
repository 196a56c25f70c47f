"""A fingertip's pad: what of it touches the plate, and the places that stand for it where it shall feel nothing."""

from __future__ import annotations

import math
from typing import Final

PAD_M: Final = 8e-3  # diameter: an assumption (`physics/felt.py`)
RING_M: Final = 0.35 * PAD_M  # radius of the six places around the middle: no point of the pad is 2 mm from all of them
OFFSETS: Final = ((0.0, 0.0), *((math.cos(k * math.pi / 3), math.sin(k * math.pi / 3)) for k in range(6)))


def pad_places(x_m: float, y_m: float) -> list[tuple[float, float]]:
    """Seven places (x_m, y_m) of a pad around a point."""
    return [(x_m + RING_M * along_x, y_m + RING_M * along_y) for along_x, along_y in OFFSETS]
