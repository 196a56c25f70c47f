"""Touches that are meant: one finger alone, held still; for calibration."""

from __future__ import annotations

from collections.abc import Sequence
from math import hypot, inf
from statistics import median

from controller.touch.samples import TouchSample

HELD_S = 0.3
STILL_M = 2e-3  # how far the reports of a held finger may lie from its first


class HeldTouches:
    """Watches samples for a finger held still for `HELD_S`; each counts once, until it is lifted."""

    def __init__(self) -> None:
        self._down: set[int] = set()
        self._reports: list[tuple[float, float]] = []
        self._since_s = inf
        self._counted = False  # or not alone

    @property
    def due_s(self) -> float:
        """When the finger that is down will have been held for long enough; inf while none is on the way to it."""
        return inf if self._counted else self._since_s + HELD_S

    def take(self, samples: Sequence[TouchSample], now_s: float) -> tuple[float, float] | None:
        """Watch the samples of one read, or just the time.

        Returns
        -------
        (x_m, y_m) or None
            Median of the reports of a finger that has now been held for long enough.
        """
        found = self._held(samples[0].time_s if samples else now_s)
        for sample in samples:
            self._watch(sample)
        return found

    def _held(self, known_s: float) -> tuple[float, float] | None:
        """The finger that was held until `known_s`, the time of the first news of it since."""
        if known_s < self.due_s:
            return None
        self._counted = True
        return median(x_m for x_m, _ in self._reports), median(y_m for _, y_m in self._reports)

    def _watch(self, sample: TouchSample) -> None:
        finger, x_m, y_m, time_s, contact, _ = sample
        if not contact:
            self._down.discard(finger)
            if not self._down:
                self._counted = False
            self._since_s = inf
            return
        if finger not in self._down:
            self._down.add(finger)
            if len(self._down) > 1:
                self._counted = True  # nobody knows which is meant
                return
        elif hypot(x_m - self._reports[0][0], y_m - self._reports[0][1]) <= STILL_M:
            self._reports.append((x_m, y_m))
            return
        self._reports = [(x_m, y_m)]
        self._since_s = time_s
