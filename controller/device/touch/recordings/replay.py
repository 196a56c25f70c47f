"""A recording as a source of touch samples, one report at a time, in its own time."""

from __future__ import annotations

from collections import Counter

from controller.device.touch import event_codes as ev
from controller.device.touch.axes import PanelAxes
from controller.device.touch.recordings.recording import Recording
from controller.device.touch.source import Counts, TouchSample


class RecordingSource:
    """Replays a recording; a `TouchSource`.

    Fingers still down at the end are released then.

    The first event is at `start_s` on the loop's clock.
    """

    def __init__(self, recording: Recording, axes: PanelAxes, start_s: float) -> None:
        self._decoder = recording.decoder(axes)
        self.counts: Counts = self._decoder.counts  # reports, contacts and fingers replayed so far
        self._events = recording.events
        self._start_s = start_s
        self._next = 0  # first event not yet fed
        self._report_ends = [i for i, (kind, code, _, _) in enumerate(self._events) if (kind, code) == (ev.EV_SYN, ev.SYN_REPORT)]
        self._report = 0
        self._warnings = recording.warnings
        self._ended = not self._events
        self.touched = False  # see `TouchSource.touched`
        self._end_warnings: Counter[str] = Counter()

    @property
    def warnings(self) -> Counter[str]:
        """Anomalies of the file and of the events replayed so far, by kind."""
        return self._warnings + self._decoder.warnings + self._end_warnings

    def fileno(self) -> None:
        """None: only time is waited for."""
        return

    def next_time_s(self) -> float | None:
        """When the next report is due, or a decision without one; None after the last."""
        return None if self._ended else min(self._report_s(), self._decoder.due_s)

    def read(self, now_s: float) -> tuple[TouchSample, ...]:
        """Samples of the next report if it is due by `now_s`; see `TouchSource.read`."""
        self.touched = False
        if self._ended:
            return ()
        due_s, decision_s = self._report_s(), self._decoder.due_s
        if decision_s < due_s:
            return self._decoder.overdue(decision_s) if decision_s <= now_s else ()
        if due_s > now_s:
            return ()
        if self._report == len(self._report_ends):
            self._ended = True
            released = self._decoder.release(due_s)
            self._end_warnings["still_down_at_end"] += len(released)
            self._end_warnings["never_reported"] += len(self._events) - self._next
            return released
        start, self._next = self._next, self._report_ends[self._report] + 1
        self._report += 1
        samples = self._decoder.feed_report(self._events[start : self._next], due_s)
        self.touched = self._decoder.touched
        return samples or ()

    def close(self) -> None:
        """End the replay."""
        self._ended = True

    def _report_s(self) -> float:
        """Time of the next report; after the last, of the last event."""
        last = self._report_ends[self._report] if self._report < len(self._report_ends) else -1
        return self._start_s + self._events[last][3]
