"""How often a panel reports, and how evenly: measured while it is touched, in constant memory."""

from __future__ import annotations

from array import array
from itertools import accumulate

FIRST_GUESS_S = 10e-3
SHORTEST_S, LONGEST_S = 2e-3, 25e-3  # the running median is held to these: a flood or a slow finger must not lead it astray
STEP = 0.02  # of the running median, per report
BIN_S = 0.25e-3
BINS = 256  # up to 64 ms; longer is a pause


class ReportRate:
    """Times between one report and the next with a finger down in both.

    A panel that does not report fingers at rest shows its period only while one moves: the median tells it,
    as long as fingers move half of the time that they are down.

    Attributes
    ----------
    period_s : float
        Running median, for the tracker: follows within some ten reports.
    """

    __slots__ = ("_counts", "_last_s", "period_s")

    def __init__(self) -> None:
        self.period_s = FIRST_GUESS_S
        self._last_s: float | None = None
        self._counts = array("L", [0]) * BINS

    def report(self, time_s: float) -> None:
        """A report came with a finger down."""
        last_s, self._last_s = self._last_s, time_s
        if last_s is None:
            return
        index = int((time_s - last_s) / BIN_S)
        if 0 < index < BINS:
            self._counts[index] += 1
            period_s = self.period_s * (1 + STEP if time_s - last_s > self.period_s else 1 - STEP)
            self.period_s = min(max(period_s, SHORTEST_S), LONGEST_S)

    def pause(self) -> None:
        """No finger is down: the time to the next report tells nothing."""
        self._last_s = None

    @property
    def median_s(self) -> float | None:
        """Median period since the start, to half a bin of `BIN_S`; None before there is one."""
        return self._quantile_s(0.5)

    @property
    def jitter_s(self) -> float | None:
        """From the 5th to the 95th percentile of the periods; None before there is one."""
        low_s, high_s = self._quantile_s(0.05), self._quantile_s(0.95)
        return None if low_s is None or high_s is None else high_s - low_s

    def _quantile_s(self, share: float) -> float | None:
        total = sum(self._counts)
        if not total:
            return None
        return (next(i for i, below in enumerate(accumulate(self._counts)) if below >= share * total) + 0.5) * BIN_S
