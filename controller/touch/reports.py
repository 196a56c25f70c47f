"""Reports of a touch panel: kinds of anomalies, correction of report times, measured report rate."""

from __future__ import annotations

from array import array
from collections import Counter
from collections.abc import Mapping
from itertools import accumulate
from typing import Final

# Anomalies that are handled, counted by kind and listed once at the end of a run
WARNINGS: Final = {
    "garbage_lines": "lines that are not evemu text were skipped",
    "not_utf8": "lines with bytes that are not UTF-8",
    "unknown_version": "version line of a newer evemu format: read as far as known",
    "no_axis_lines": "axes without a usable range: the recording's own minimum and maximum taken",
    "time_backwards": "events earlier than the one before: given the time of the one before",
    "time_absurd": "events with an impossible time: given the time of the one before",
    "value_absurd": "event values beyond 32 bits were clamped",
    "outside_axes": "positions outside the axes were clamped",
    "slot_beyond_range": "contacts in slots that the device does not declare were decoded all the same",
    "slot_absurd": "slot numbers that no device has: their events were skipped",
    "contacts_absurd": "contacts beyond 256 in one report were skipped",
    "never_reported": "events after the last SYN_REPORT were not played",
    "dropped": "losses of events (SYN_DROPPED): fingers released or read again",
    "more_than_played": "contacts beyond the ten that are played were left out",
    "time_ahead": "reports with a time in the future: given the current time",
    "panel_lost": "times the touch panel was disconnected; fingers released until it was back",
    "bus_retried": "failed transfers on the touch panel's bus that were tried again",
    "report_absurd": "reports of the touch panel with impossible content were skipped",
    "ghost_points": "spurious points of the touch panel at (0, 0) were skipped",
    "stale_reports": "reports from before the touch panel was started were skipped",
    "contact_stuck": "contacts of a touch panel that stopped reporting were released",
    "bytes_skipped": "bytes from the serial touch panel that belong to no packet",
    "still_down_at_end": "fingers still down at the end of the recording were released",
}

MAX_AHEAD_S: Final = 0.01  # an event may be stamped after the loop read its clock, but not much later

INITIAL_PERIOD_S: Final = 10e-3
MIN_PERIOD_S: Final = 2e-3  # limits of the running median: a flood or a slow finger must not lead it astray
MAX_PERIOD_S: Final = 25e-3
MEDIAN_STEP: Final = 0.02  # relative step of the running median per report
BIN_S: Final = 0.25e-3
BINS: Final = 256  # up to 64 ms; longer is a pause


def describe_warnings(warnings: Mapping[str, int]) -> list[str]:
    """Lines that describe `warnings`, counts by kind (`WARNINGS`), one for each kind that occurred."""
    return [f"{count} × {WARNINGS[kind]}" for kind, count in warnings.items() if count]


def off_plate_warning(positions: int, off_plate: int) -> str:
    """Line that says that the board's map of the axes does not fit the panel; empty unless most positions lie off the plate.

    Parameters
    ----------
    positions, off_plate : int
        As in `source.Counts`.
    """
    if off_plate * 2 <= positions:
        return ""
    return (
        f"{off_plate} of {positions} positions lie off the plate by touch.x_mm_from_axes and y_mm_from_axes, and were moved to its"
        " edge: these are not of this panel; haptic-panel calibrate-touch finds them"
    )


class ReportClock:
    """Corrects the times of reports: never later than now, never decreasing.

    Parameters
    ----------
    warnings : Counter of str
        Counts `time_ahead` and `time_backwards`.
    """

    def __init__(self, warnings: Counter[str]) -> None:
        self.warnings = warnings
        self._last_s = 0.0

    def corrected_s(self, time_s: float, now_s: float) -> float:
        """Corrected time of a report that the device stamped `time_s` and that is read at `now_s`, on the loop's clock."""
        if time_s > now_s:
            if time_s > now_s + MAX_AHEAD_S:
                self.warnings["time_ahead"] += 1
            time_s = now_s
        if time_s < self._last_s:
            self.warnings["time_backwards"] += 1
            return self._last_s
        self._last_s = time_s
        return time_s


class ReportRate:
    """Report period of a panel while it is touched, measured in constant memory.

    Counts the times between consecutive reports with a finger down in both. A panel that does not report stationary fingers
    shows its period only while one moves; the median is right as long as fingers move half of the time that they are down.

    Attributes
    ----------
    period_s : float
        Running median, for the tracker; it follows a change within about ten reports.
    """

    __slots__ = ("_counts", "_last_s", "period_s")

    def __init__(self) -> None:
        self.period_s = INITIAL_PERIOD_S
        self._last_s: float | None = None
        self._counts = array("L", [0]) * BINS

    def report(self, time_s: float) -> None:
        """Count a report at `time_s` (loop's clock) with a finger down."""
        last_s, self._last_s = self._last_s, time_s
        if last_s is None:
            return
        index = int((time_s - last_s) / BIN_S)
        if 0 < index < BINS:
            self._counts[index] += 1
            if time_s - last_s > self.period_s:
                self.period_s = min(self.period_s * (1 + MEDIAN_STEP), MAX_PERIOD_S)
            else:
                self.period_s = max(self.period_s * (1 - MEDIAN_STEP), MIN_PERIOD_S)

    def pause(self) -> None:
        """Ignore the time until the next report: no finger is down."""
        self._last_s = None

    @property
    def median_s(self) -> float | None:
        """Median period since the start, to half a bin of `BIN_S`; None before the second report."""
        return self._quantile_s(0.5)

    @property
    def jitter_s(self) -> float | None:
        """95th minus 5th percentile of the periods; None before the second report."""
        low_s, high_s = self._quantile_s(0.05), self._quantile_s(0.95)
        return None if low_s is None or high_s is None else high_s - low_s

    def _quantile_s(self, share: float) -> float | None:
        total = sum(self._counts)
        if not total:
            return None
        return (next(i for i, below in enumerate(accumulate(self._counts)) if below >= share * total) + 0.5) * BIN_S
