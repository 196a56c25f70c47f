"""Times of reports put on the loop's clock."""

from __future__ import annotations

from collections import Counter

AHEAD_S = 0.01  # an event may come after the loop has looked at its clock, but not much


class ReportTimes:
    """Times of reports on the loop's clock: never later than now, never going back.

    Attributes
    ----------
    warnings : Counter of str
        Counts `time_ahead` and `time_backwards`.
    """

    def __init__(self, warnings: Counter[str]) -> None:
        self.warnings = warnings
        self._last_s = 0.0

    def settled(self, time_s: float, now_s: float) -> float:
        """The time to give a report that says it is of `time_s` and is read at `now_s`."""
        if time_s > now_s:
            if time_s > now_s + AHEAD_S:
                self.warnings["time_ahead"] += 1
            time_s = now_s
        if time_s < self._last_s:
            self.warnings["time_backwards"] += 1
            return self._last_s
        self._last_s = time_s
        return time_s
