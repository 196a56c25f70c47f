"""What every source of touches hands to the scene."""

from __future__ import annotations

from typing import NamedTuple


class TouchSample(NamedTuple):
    """One finger that began, moved or was released, in plate metres and in the clock of the loop.

    A finger keeps its number from its first sample to the one with `contact` False, and no later
    finger has the same. That last sample repeats the place where it was last seen.
    """

    finger: int
    x_m: float
    y_m: float
    time_s: float
    contact: bool
    size_m: float = 0.0  # widest extent of the contact; 0 where the panel tells none
