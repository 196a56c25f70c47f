"""Where a finger of a recording was at any time: what a focus is compared with."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, slots=True, eq=False)
class Track:
    """One finger from its first report to its last.

    Attributes
    ----------
    finger : int
        Number in the touch samples.
    time_s, x_m, y_m : (report,) float64 arrays
        One entry for each report while the finger was down.
    """

    finger: int
    time_s: NDArray[np.float64]
    x_m: NDArray[np.float64]
    y_m: NDArray[np.float64]

    @classmethod
    def of(cls, finger: int, reports: Sequence[tuple[float, float, float]]) -> Track:
        """From (time_s, x_m, y_m) of each report."""
        time_s, x_m, y_m = np.array(reports, np.float64).T
        return cls(finger, time_s, x_m, y_m)

    @classmethod
    def joined(cls, finger: int, parts: Iterable[Track]) -> Track:
        """One finger that the panel lost and found again, from the track of each contact in the order of time."""
        kept = list(parts)
        return cls(finger, *(np.concatenate([getattr(part, name) for part in kept]) for name in ("time_s", "x_m", "y_m")))

    @property
    def begin_s(self) -> float:
        """Time of the first report."""
        return float(self.time_s[0])

    @property
    def end_s(self) -> float:
        """Time of the last report before the finger was lifted."""
        return float(self.time_s[-1])

    def position(self, time_s: float) -> tuple[float, float]:
        """(x_m, y_m), linear between reports and between contacts, held before the first and after the last."""
        return float(np.interp(time_s, self.time_s, self.x_m)), float(np.interp(time_s, self.time_s, self.y_m))
