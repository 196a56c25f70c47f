"""Tracker between a source and the loop: which contacts are fingers that may be played, and where each will be.

States of a contact:

- It waits until its `confirm_reports`-th report, or until the time in which that many reports would have shown its release; a
  suspect (`ghost_guard.py`) waits until it is cleared. Then it is a finger; its first sample has the time of this decision.
- A lost finger may be found again (`contacts.py`). A release therefore reaches the loop that much later, with the time at
  which the panel reported it. One that has become a palm does not wait.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from dataclasses import asdict
from math import inf
from typing import Any, Final

from controller.device.board.touch_panels import TouchPanel
from controller.device.touch.contacts import LostFingers, TrackedContact, TrackerCounts
from controller.device.touch.ghost_guard import GhostGuard, QuietBudget
from controller.device.touch.prediction import MAX_INTERVAL_S, SILENT_PERIODS
from controller.device.touch.reports import ReportRate
from controller.device.touch.source import Counts, Heard, TouchSample, TouchSource

MISSED_REPORT_PERIODS: Final = 1.5  # without a release in this time, a contact counts as reported once more, unmoved
CONFIRMING_REPORTS: Final = 2


class Tracker:
    """Debounce, ghost rejection, bridging of short losses and prediction behind a source; a `TrackedTouch`."""

    def __init__(
        self,
        source: TouchSource,  # gives contacts with identities
        settings: TouchPanel,  # the board's [touch]
        length_m: float,  # length_m, width_m: of the plate: predicted positions are clamped to it
        width_m: float,
        # Called when a finger was lost and found again, with its number and that of the source's new contact
        bridged: Callable[[int, int], None] | None = None,
    ) -> None:
        self.counts: Counts = source.counts  # reports, contacts and fingers of the source
        self.touched = False  # of the source: see `TouchSource.touched`
        self.heard: Heard | None = None  # see `TrackedTouch`
        self.tracking = TrackerCounts()  # contacts held back and bridged
        self.rate = ReportRate()  # measured report period and jitter of the panel
        self._source = source
        self.fileno, self.close = source.fileno, source.close
        self._bridged = bridged
        self._lag_s = settings.lag_s
        self._confirm_reports = settings.confirm_reports
        self._length_m, self._width_m = length_m, width_m
        self._guard = GhostGuard(settings.ghost_s)
        self._quiet = QuietBudget(settings.ghost_s)
        self._contacts: dict[int, TrackedContact] = {}  # by the source's number
        self._fingers: dict[int, TrackedContact] = {}  # played, by number in the loop's samples
        self._released: dict[int, TrackedContact] = {}  # by the last read: their release effects are decided after it
        self._lost = LostFingers(self.rate)
        self._devices = source.counts.devices
        self._known_s = -inf  # time up to which all reports have been taken
        self._due_s = inf  # when a decision is due without a report

    @property
    def warnings(self) -> Counter[str]:
        """Anomalies found by the source, by kind."""
        return self._source.warnings

    def figures(self) -> dict[str, Any]:
        """`TrackerCounts`, report period and jitter in ms (None before the second report), `Counts.plausibility`; for JSON."""
        median_s, jitter_s = self.rate.median_s, self.rate.jitter_s
        self.tracking.listened_s = round(self._quiet.total_s, 6)
        return asdict(self.tracking) | {
            "palms": self.counts.palms,
            "plausibility": self.counts.plausibility(self._source.warnings),
            "report_period_ms": None if median_s is None else round(median_s * 1e3, 3),
            "report_jitter_ms": None if jitter_s is None else round(jitter_s * 1e3, 3),
        }

    def next_time_s(self) -> float | None:
        """When the source is due, a contact that waits is due, or quiet time may be asked for again."""
        source_s = self._source.next_time_s()
        next_s = min(inf if source_s is None else source_s, self._due_s, self._quiet.retry_s)
        return None if next_s == inf else next_s

    def read(self, now_s: float) -> tuple[TouchSample, ...]:
        """Samples of at most one report of the source and of contacts that are due by `now_s`; see `TouchSource.read`."""
        if self._released:
            self._released.clear()
        if now_s >= self._quiet.retry_s:
            self._quiet.retry_s = inf
        samples = self._source.read(now_s)
        if samples and self.heard is not None:
            self.heard(samples)
        known_s = self._known_s = samples[0].time_s if samples else now_s  # more reports may follow this one
        self.touched = touched = self._source.touched
        if not samples and not touched and now_s < self._due_s:
            return ()
        if self._devices != self.counts.devices:  # it may be another panel
            self._devices = self.counts.devices
            self._lost.restart()
        if touched:
            self.rate.report(known_s)
        out: list[TouchSample] = []
        for sample in samples:
            self._take(sample, out)
        if touched:
            self._found_still(known_s)
        if self._due_s != inf:
            self._decide(known_s, out)
        if not self._contacts:
            self.rate.pause()
        return tuple(out)

    def down(self) -> tuple[int, ...]:
        """Numbers of the fingers that are down; see `TrackedTouch.down`."""
        return tuple(self._fingers)

    def predict(self, finger: int, at_s: float) -> tuple[float, float] | None:
        """(x_m, y_m) of `finger` at `at_s`, clamped to the plate; None once it is released. See `TrackedTouch.predict`."""
        contact = self._fingers.get(finger)
        if contact is None:
            return None
        if contact.lost_s != inf:
            x_m, y_m = contact.motion.x_m, contact.motion.y_m
        else:
            x_m, y_m = contact.motion.predict(at_s, self._known_s, self._lag_s, self.rate.period_s)
        length_m, width_m = self._length_m, self._width_m
        return (
            0.0 if x_m < 0.0 else length_m if x_m > length_m else x_m,
            0.0 if y_m < 0.0 else width_m if y_m > width_m else y_m,
        )

    def missed_m(self, finger: int) -> float:
        """Distance of the last report of `finger` from where it was predicted; see `TrackedTouch.missed_m`."""
        contact = self._fingers.get(finger)
        return inf if contact is None else contact.motion.missed_m

    @property
    def report_s(self) -> float:
        """Measured report period of the panel in s."""
        return self.rate.period_s

    def confirmed(self, finger: int) -> bool:
        """Whether a second report of `finger`, or no release in that time, has confirmed it; see `TrackedTouch.confirmed`."""
        contact = self._fingers.get(finger) or self._released.get(finger)
        if contact is None:
            return False
        stayed_s = min(self._known_s, contact.lost_s) - contact.first_s  # a lost one may come back, but was not confirmed meanwhile
        return contact.reports >= CONFIRMING_REPORTS or stayed_s >= MISSED_REPORT_PERIODS * self.rate.period_s

    def emitted(self, start_s: float, end_s: float, period_s: float = 0.0) -> None:
        """Announce an emission from `start_s` to `end_s`, repeated every `period_s` if above 0; see `TrackedTouch.emitted`."""
        if not self._guard.expects_ghosts:
            return
        self._guard.emitted(start_s, end_s, period_s)
        for contact in self._contacts.values():  # the end of a repetition clears suspects earlier
            if contact.suspect and not contact.played:
                self._due_s = min(self._due_s, self._played_from_s(contact))

    def quiet_until_s(self, now_s: float, next_s: float) -> float:
        """Time until which no emission may begin, asked at `now_s` for one at `next_s`; see `TrackedTouch.quiet_until_s`."""
        cleared_s = -inf
        for contact in self._contacts.values():
            if contact.suspect and not contact.played:
                cleared_s = max(cleared_s, self._guard.cleared_if_quiet_s(contact.first_s, now_s))
        if cleared_s <= next_s:
            if self._quiet.asked:
                self._quiet.end(now_s)
        elif self._quiet.begin(now_s, cleared_s):
            return cleared_s
        return now_s

    def _take(self, sample: TouchSample, out: list[TouchSample]) -> None:
        number, x_m, y_m, time_s, down, size_m = sample
        contact = self._contacts.get(number)
        if not down:
            if contact is not None:
                del self._contacts[number]
                if size_m != inf:
                    self._lift(contact, time_s)
                elif contact.played:
                    contact.lost_s = time_s
                    self._release(contact, time_s, out)
            return
        if contact is None:
            contact = self._begin(sample)
            if not contact.played:
                return
        contact.motion.report(x_m, y_m, time_s)
        contact.reports += 1
        contact.size_m = size_m
        if contact.played:
            out.append(sample if contact.finger == number else TouchSample(contact.finger, x_m, y_m, time_s, True, size_m))

    def _begin(self, sample: TouchSample) -> TrackedContact:
        """Contact for a new number of the source: a lost finger found again, or a contact that waits."""
        finger, x_m, y_m, time_s, _, size_m = sample
        found = self._lost.found_again(x_m, y_m, time_s)
        if found is not None:
            self._contacts[finger] = found
            self.tracking.bridged += 1
            if self._bridged is not None:
                self._bridged(found.finger, finger)
            return found
        guard = self._guard
        contact = TrackedContact(finger, x_m, y_m, time_s, suspect=guard.expects_ghosts and guard.suspects(time_s))
        contact.motion.pause_s = max(MAX_INTERVAL_S, SILENT_PERIODS * self.rate.period_s)
        contact.size_m = size_m
        self._due_s = -inf  # it is decided now, or from when on it waits
        self.tracking.held_back += contact.suspect
        self._contacts[finger] = contact
        return contact

    def _lift(self, contact: TrackedContact, time_s: float) -> None:
        if contact.played:
            self._due_s = -inf
            self._lost.add(contact, time_s)
        else:
            self.tracking.count_unplayed(contact, time_s)

    def _release(self, contact: TrackedContact, time_s: float, out: list[TouchSample]) -> None:
        self._released[contact.finger] = self._lost.gone = self._fingers.pop(contact.finger)
        out.append(TouchSample(contact.finger, contact.motion.x_m, contact.motion.y_m, time_s, False))

    def _found_still(self, time_s: float) -> None:
        """Count a report for contacts that it did not mention: they have not moved."""
        for contact in self._contacts.values():
            motion = contact.motion
            if motion.time_s < time_s:
                motion.report(motion.x_m, motion.y_m, time_s)
                contact.reports += 1

    def _decide(self, known_s: float, out: list[TouchSample]) -> None:
        """Begin contacts that have waited long enough and release lost fingers, as far as due by `known_s`."""
        self._due_s = inf
        if self._lost.kept:
            for lost in self._lost.given_up(known_s):
                self._release(lost, lost.lost_s, out)
            self._due_s = self._lost.due_s
        for contact in self._contacts.values():
            if contact.played:
                continue
            due_s = self._played_from_s(contact)
            if due_s > known_s:
                self._due_s = min(self._due_s, due_s)
                continue
            contact.played = True
            self._fingers[contact.finger] = contact
            motion = contact.motion
            from_s = max(due_s, motion.time_s)
            out.append(TouchSample(contact.finger, motion.x_m, motion.y_m, from_s, True, contact.size_m))
            if contact.suspect:
                self.tracking.longest_hold_s = max(self.tracking.longest_hold_s, from_s - contact.first_s)

    def _played_from_s(self, contact: TrackedContact) -> float:
        """When a contact that waits becomes a finger without any further report."""
        due_s = contact.first_s
        if contact.reports < self._confirm_reports:
            due_s += (self._confirm_reports - 1) * MISSED_REPORT_PERIODS * self.rate.period_s
        if contact.suspect:
            due_s = max(due_s, self._guard.cleared_s(contact.first_s))
        return due_s
