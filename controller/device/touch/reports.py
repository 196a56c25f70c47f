"""Reports of a touch panel: kinds of anomalies, correction of report times, measured report rate."""

from __future__ import annotations

from array import array
from collections import Counter
from collections.abc import Mapping
from itertools import accumulate
from math import inf
from typing import Final

# Anomalies that are handled, counted by kind and listed once at the end of a run
WARNINGS: Final = {
    "garbage_lines": "lines that are no text of a recorder were skipped",
    "not_utf8": "lines with bytes that are not UTF-8",
    "unknown_version": "version line of a newer evemu format: read as far as known",
    "no_axis_lines": "axes without a usable range: the recording's own minimum and maximum taken",
    "time_backwards": "events earlier than the one before: given the time of the one before",
    "time_absurd": "events with an impossible time: given the time of the one before",
    "value_absurd": "event values beyond 32 bits were clamped",
    "outside_axes": "positions a little outside the axes were clamped",
    "far_outside": "positions far outside the axes were taken for no finger",
    "no_finger": "positions where the board says that there is no finger were left out",
    "too_fast": "positions that no hand reaches so soon, and that no further report confirmed, were left out",
    "fallen_silent": "fingers of a panel that repeats its reports and fell silent were released",
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
    "points_refused": "reports of which only the first contacts could be read: the touch panel refuses the registers of the others",
    "interrupt_silent": "times the touch panel had reports and its interrupt line no edge: polled; is it wired, and to this line?",
    "interrupt_noisy": "times the touch panel's interrupt line had over 1,000 edges a second: polled, and not listened to",
    "interrupt_active": "starts with the touch panel's interrupt line active and nothing touched: held, or of the other polarity?",
    "contact_stuck": "contacts of a touch panel that stopped reporting were released",
    "bytes_skipped": "bytes from the serial touch panel that belong to no packet",
    "no_packets": "times 100 bytes from the serial touch panel held no packet: is its baud rate right, and its protocol SmartSet?",
    "share_lost": "times that contacts could not be handed on to other programs: no more are until the panel is opened again",
    "still_down_at_end": "fingers still down at the end of the recording were released",
}

FAULTS: Final = frozenset({"interrupt_silent", "interrupt_noisy", "interrupt_active", "points_refused", "no_packets", "share_lost"})
"""Kinds of `WARNINGS` that are a matter of wiring or settings: somebody should look, and is informed at once."""

MAX_AHEAD_S: Final = 0.01  # an event may be stamped after the loop read its clock, but not much later

INITIAL_PERIOD_S: Final = 10e-3  # until the first interval is measured
MIN_PERIOD_S: Final = 2e-3  # limits of the running median: a flood or a slow finger must not lead it astray
MAX_PERIOD_S: Final = 40e-3
FIRST_INTERVALS: Final = 9  # of this many the median is exact, from the first on
MEDIAN_STEP: Final = 0.02  # relative step of the running median per report, afterwards
LONGER, SHORTER = 1 + MEDIAN_STEP, 1 - MEDIAN_STEP
SILENT_PERIODS: Final = 2.5  # of a panel that repeats its reports, and may lose one
# Nobody lifts a finger and taps again sooner: a shorter silence is not distinguished from a finger at rest.
SHORTEST_PAUSE_S: Final = 60e-3
REPEATING_REPORTS: Final = 16  # in a row without any contact having moved: such a panel repeats its reports
LATE_PERIODS: Final = 2.0  # after so long a report no longer follows on the one before

BIN_S: Final = 0.25e-3
BINS: Final = 256  # up to 64 ms; longer is a pause


def describe_warnings(warnings: Mapping[str, int]) -> list[str]:
    """Lines that describe `warnings`, counts by kind, one for each kind that occurred; a kind of a newer release by its name."""
    return [f"{count} × {WARNINGS.get(kind, kind)}" for kind, count in warnings.items() if count]


def off_plate_warning(positions: int, off_plate: int) -> str:
    """Line that says that the board's map of the axes does not fit the panel; empty unless most positions lie off the plate."""
    if off_plate * 2 <= positions:
        return ""
    return (
        f"{off_plate} of {positions} positions lie off the plate by touch.x_mm_from_axes and y_mm_from_axes, and were moved to its"
        " edge: these are not of this panel; haptic-panel calibrate-touch finds them"
    )


class ReportClock:
    """Corrects the times of reports: never later than now, never decreasing; counts `time_ahead` and `time_backwards`."""

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
    """

    def __init__(self) -> None:
        # Median of the intervals: of the first ones exactly, then a running one that follows a change within some ten
        # reports
        self.period_s = INITIAL_PERIOD_S
        self.measured = 0  # intervals that it is of so far, at most `FIRST_INTERVALS`; 0: it is assumed
        self._first_s = array("d", [0.0]) * FIRST_INTERVALS  # sorted
        self._last_s = -inf
        self._counts = array("L", [0]) * BINS

    def restart(self) -> None:
        """Measure again: another panel may have been connected. What was counted stays in `median_s` and `jitter_s`."""
        self.period_s = INITIAL_PERIOD_S
        self.measured = 0
        self._last_s = -inf

    def interval(self, interval_s: float) -> None:
        """Count a time between two consecutive reports."""
        last_s, self._last_s = self._last_s, 0.0
        self.report(interval_s)
        self._last_s = last_s

    def report(self, time_s: float) -> None:
        """Count a report at `time_s` (loop's clock) with a finger down."""
        interval_s = time_s - self._last_s
        self._last_s = time_s
        bins = interval_s / BIN_S
        if not 1.0 <= bins < BINS:
            return
        self._counts[int(bins)] += 1
        if self.measured < FIRST_INTERVALS:
            first_s, at = self._first_s, self.measured
            while at and first_s[at - 1] > interval_s:
                first_s[at] = first_s[at - 1]
                at -= 1
            first_s[at] = interval_s
            self.period_s = min(max(first_s[self.measured // 2], MIN_PERIOD_S), MAX_PERIOD_S)
            self.measured += 1
            return
        period_s = self.period_s
        if interval_s > period_s:
            period_s *= LONGER
            self.period_s = period_s if period_s < MAX_PERIOD_S else MAX_PERIOD_S
        else:
            period_s *= SHORTER
            self.period_s = period_s if period_s > MIN_PERIOD_S else MIN_PERIOD_S

    def pause(self) -> None:
        """Ignore the time until the next report: no finger is down."""
        self._last_s = -inf

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


class PanelHabits:
    """How a panel reports, learnt from its reports: its period, and what it means if it falls silent while it is touched.

    Each report of a panel that `tells_all` (protocol A) lists all contacts: then it repeats itself, and a panel that has never
    reported that no contact is left reports releases by silence.
    """

    def __init__(self, rate: ReportRate, *, tells_all: bool) -> None:
        rate.restart()
        self.rate = rate  # of the reports with a contact down
        self.report_s = self.before_s = 0.0  # times of the last report and of the one before
        # When it has fallen silent unless there is a report before; inf: it may be silent for ever while fingers rest
        self.silent_s = inf
        # Set it once the panel has gone on with a contact after a silence: silence means nothing then
        # Set it after a silence: a release that is reported next shows that the panel was touched all the time
        self.rests = self.fell_silent = False
        self._tells_all = tells_all
        self._tells_releases = False  # it has reported that no contact is left
        self._repeats = False  # it has reported again and again what had not moved
        self._still = 0  # reports in a row without any contact having moved
        self._down = 0  # contacts of the last report

    def arrived(self, down: int, time_s: float, *, moved: bool) -> None:
        """Learn from a report at `time_s` with `down` contacts, of which any has `moved` or none."""
        self.before_s, self.report_s = self.report_s, time_s
        self.silent_s = inf
        rate = self.rate
        if down:
            rate.report(time_s)
            if moved or down != self._down or time_s - self.before_s > LATE_PERIODS * rate.period_s:
                self._still = 0
            elif self._still < REPEATING_REPORTS:
                self._still += 1
                self._repeats = self._repeats or self._still == REPEATING_REPORTS
            if (self._tells_all and not self._tells_releases) or (self._repeats and not self.rests):
                self.silent_s = time_s + max(SHORTEST_PAUSE_S, SILENT_PERIODS * rate.period_s)
        elif self._down or self.fell_silent:
            self._tells_releases = True
            rate.pause()
        self.fell_silent = False
        self._down = down

    def forget(self) -> None:
        """Take it that no contact is down."""
        self._down = self._still = 0
        self.silent_s = inf
        self.rate.pause()
