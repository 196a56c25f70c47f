"""Between any source and the loop: which contacts are fingers that may be played, and where they will be.

What a contact goes through:

- It waits until its `confirm_reports`-th report, or until so many reports would have told that it is gone; a suspect
  (`ghost_guard.py`) waits until it is cleared. Then it is a finger, and its first sample carries the time of this decision.
- Wider than `max_size_mm` it is a palm, from then until it is lifted; a finger that becomes one is released at once.
- A finger that is lost keeps its place for `BRIDGED_PERIODS`; a contact that begins near by meanwhile is the same finger.
  So a release reaches the loop that much later, with the time at which the panel told it.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from dataclasses import asdict, dataclass
from math import hypot, inf
from typing import Any

from controller.board.devices import TouchPanel
from controller.touch.ghost_guard import GhostGuard, Listening
from controller.touch.prediction import Motion
from controller.touch.reports import ReportRate
from controller.touch.source import Counts, TouchSample, TouchSource

REUSE_RADIUS_M = 5e-3
BRIDGED_PERIODS = 1.5
UNTOLD_PERIODS = 1.5  # a report that told nothing of a contact is taken for one that found it still there
CONFIRMING_REPORTS = 2


@dataclass(slots=True)
class TrackerCounts:
    """What became of contacts that were not simply fingers."""

    held_back: int = 0  # suspects
    ghosts: int = 0  # suspects that were gone before they were cleared
    flickers: int = 0  # gone before enough reports had told them
    palms: int = 0
    bridged: int = 0  # lost and found again
    listened_s: float = 0.0  # emissions were held back for so long, that suspects could be judged
    longest_hold_s: float = 0.0  # from the first report of a suspect to its first sample
    longest_ghost_s: float = 0.0  # from first report to last; close to `ghost_ms`, that is too short


class _Contact:
    """One contact of the source, waiting, played or refused."""

    __slots__ = ("finger", "first_s", "lost_s", "motion", "played", "refused", "reports", "size_m", "suspect")

    def __init__(self, finger: int, motion: Motion, *, suspect: bool) -> None:
        self.finger = finger  # as the loop knows it: the source's number of its first contact
        self.motion = motion
        self.first_s = motion.time_s
        self.reports = 1
        self.size_m = 0.0
        self.suspect = suspect
        self.played = False
        self.refused = False
        self.lost_s = inf  # when the panel told that it is gone


class Tracker:
    """A source behind debounce, palm and ghost guard, with prediction; a `TrackedTouch`.

    Parameters
    ----------
    source : TouchSource
        Gives contacts with identities.
    settings : TouchPanel
        The board's touch table.
    length_m, width_m : float
        Of the plate: predicted places are held to it.
    bridged : callable, optional
        Told of a finger that was lost and found again: its number, and that of the source's contact which it is now.
    motion : type of Motion
        Another way to predict, to compare with.

    Attributes
    ----------
    tracking : TrackerCounts
        What was held back, bridged and refused.
    rate : ReportRate
        The panel's report period and its jitter, as measured.
    """

    def __init__(
        self,
        source: TouchSource,
        settings: TouchPanel,
        length_m: float,
        width_m: float,
        bridged: Callable[[int, int], None] | None = None,
        motion: type[Motion] = Motion,
    ) -> None:
        self.tracking = TrackerCounts()
        self.rate = ReportRate()
        self._source = source
        self._bridged = bridged
        self._motion = motion
        self._lag_s = settings.lag_s
        self._max_size_m = settings.max_size_m
        self._confirm_reports = settings.confirm_reports
        self._length_m, self._width_m = length_m, width_m
        self._guard = GhostGuard(settings.ghost_s)
        self._listening = Listening(settings.ghost_s)
        self._contacts: dict[int, _Contact] = {}  # by the source's number
        self._fingers: dict[int, _Contact] = {}  # played, by the loop's number
        self._released: dict[int, _Contact] = {}  # of the last read: what they feel as they are lifted is decided after it
        self._lost: list[_Contact] = []
        self._reports = source.counts.reports
        self._known_s = -inf  # until when all reports have been told
        self._due_s = inf  # when something is to be decided without a report

    @property
    def counts(self) -> Counts:
        """Of the source."""
        return self._source.counts

    @property
    def warnings(self) -> Counter[str]:
        """Of the source."""
        return self._source.warnings

    def figures(self) -> dict[str, Any]:
        """What was held back or refused, and how the panel reports, ready for JSON; None where too little is known."""
        median_s, jitter_s = self.rate.median_s, self.rate.jitter_s
        self.tracking.listened_s = round(self._listening.total_s, 6)
        return asdict(self.tracking) | {
            "report_period_ms": None if median_s is None else round(median_s * 1e3, 3),
            "report_jitter_ms": None if jitter_s is None else round(jitter_s * 1e3, 3),
        }

    def fileno(self) -> int | None:
        """Of the source."""
        return self._source.fileno()

    def close(self) -> None:
        """Close the source."""
        self._source.close()

    def next_time_s(self) -> float | None:
        """When the source wants to be read, a contact that waits is due, or silence may be asked for again."""
        source_s = self._source.next_time_s()
        next_s = min(inf if source_s is None else source_s, self._due_s, self._listening.again_s)
        return None if next_s == inf else next_s

    def read(self, now_s: float) -> tuple[TouchSample, ...]:
        """Samples of at most one report of the source, and of contacts whose time to wait is over; see `TouchSource.read`."""
        if self._released:
            self._released.clear()
        if now_s >= self._listening.again_s:
            self._listening.again_s = inf
        samples = self._source.read(now_s)
        known_s = self._known_s = samples[0].time_s if samples else now_s  # more reports may wait behind this one
        reports = self._source.counts.reports
        told = reports != self._reports
        if not samples and not told and now_s < self._due_s:
            return ()
        given: list[TouchSample] = []
        for sample in samples:
            self._take(sample, given)
        if told:
            self._reports = reports
            self.rate.report(known_s)
            self._found_still(known_s)
        self._decide(known_s, given)
        if not self._contacts:
            self.rate.pause()
        return tuple(given)

    def place(self, finger: int, at_s: float) -> tuple[float, float] | None:
        """Where a finger will be, (x_m, y_m) on the plate; None once it is released. See `TrackedTouch.place`."""
        contact = self._fingers.get(finger)
        if contact is None:
            return None
        if contact.lost_s != inf:
            x_m, y_m = contact.motion.x_m, contact.motion.y_m
        else:
            x_m, y_m = contact.motion.place(at_s, self._known_s, self._lag_s, self.rate.period_s)
        length_m, width_m = self._length_m, self._width_m
        return (
            0.0 if x_m < 0.0 else length_m if x_m > length_m else x_m,
            0.0 if y_m < 0.0 else width_m if y_m > width_m else y_m,
        )

    @property
    def report_s(self) -> float:
        """As `TrackedTouch.report_s` has it."""
        return self.rate.period_s

    def confirmed(self, finger: int) -> bool:
        """Whether a second report, or silence for as long, has shown that the contact stays, or that it stayed.

        Of a finger that was released this can be asked until the next `read`.
        """
        contact = self._fingers.get(finger) or self._released.get(finger)
        if contact is None:
            return False
        stayed_s = min(self._known_s, contact.lost_s) - contact.first_s  # a lost one may come back, but did not stay
        return contact.reports >= CONFIRMING_REPORTS or stayed_s >= UNTOLD_PERIODS * self.rate.period_s

    def emitted(self, start_s: float, end_s: float, period_s: float = 0.0) -> None:
        """An emission sounds, or is repeated until the next call; see `TrackedTouch.emitted`."""
        self._guard.emitted(start_s, end_s, period_s)
        for contact in self._contacts.values():  # what is stopped frees suspects earlier than was known
            if contact.suspect and not contact.played and not contact.refused:
                self._due_s = min(self._due_s, self._played_from_s(contact))

    def quiet_until_s(self, now_s: float, next_s: float) -> float:
        """Until when no emission may begin; see `TrackedTouch.quiet_until_s`."""
        silent_s = -inf
        for contact in self._contacts.values():
            if contact.suspect and not contact.played and not contact.refused:
                silent_s = max(silent_s, self._guard.silent_s(contact.first_s, now_s))
        if silent_s <= next_s:
            self._listening.end(now_s)
        elif self._listening.begin(now_s, silent_s):
            return silent_s
        return now_s

    def _take(self, sample: TouchSample, given: list[TouchSample]) -> None:
        contact = self._contacts.get(sample.finger)
        if not sample.contact:
            if contact is not None:
                del self._contacts[sample.finger]
                self._lift(contact, sample.time_s)
            return
        x_m, y_m, time_s = sample.x_m, sample.y_m, sample.time_s
        if contact is None:
            contact = self._begin(sample)
            if not contact.played:
                return
        if contact.refused:
            return
        if sample.size_m > self._max_size_m:
            self._refuse(contact, time_s, given)
            return
        contact.motion.report(x_m, y_m, time_s)
        contact.reports += 1
        contact.size_m = sample.size_m
        if contact.played:
            given.append(
                sample if contact.finger == sample.finger else TouchSample(contact.finger, x_m, y_m, time_s, True, sample.size_m)
            )

    def _begin(self, sample: TouchSample) -> _Contact:
        """Contact for a number of the source that is new: a lost finger found again, or one that waits."""
        finger, x_m, y_m, time_s, _, size_m = sample
        palm = size_m > self._max_size_m
        found = None if palm or not self._lost else self._found_again(x_m, y_m, time_s)
        if found is not None:
            self._lost.remove(found)
            found.lost_s = inf
            self._contacts[finger] = found
            self.tracking.bridged += 1
            if self._bridged is not None:
                self._bridged(found.finger, finger)
            return found
        contact = _Contact(finger, self._motion(x_m, y_m, time_s), suspect=self._guard.suspects(time_s))
        contact.size_m = size_m
        contact.refused = palm
        self.tracking.palms += palm
        self.tracking.held_back += contact.suspect and not palm
        self._contacts[finger] = contact
        return contact

    def _found_again(self, x_m: float, y_m: float, time_s: float) -> _Contact | None:
        """The lost finger that a new contact is: of those that would be near by now, the nearest."""
        found, nearest_m = None, REUSE_RADIUS_M
        for lost in self._lost:
            at_x_m, at_y_m = lost.motion.place(time_s, lost.motion.time_s, 0.0, self.rate.period_s)
            off_m = hypot(x_m - at_x_m, y_m - at_y_m)
            if off_m <= nearest_m and time_s <= self._bridged_until_s(lost):
                found, nearest_m = lost, off_m
        return found

    def _lift(self, contact: _Contact, time_s: float) -> None:
        if contact.refused:
            return
        if contact.played:
            contact.lost_s = time_s
            self._lost.append(contact)
        elif contact.suspect:
            self.tracking.ghosts += 1
            self.tracking.longest_ghost_s = max(self.tracking.longest_ghost_s, time_s - contact.first_s)
        else:
            self.tracking.flickers += 1

    def _refuse(self, contact: _Contact, time_s: float, given: list[TouchSample]) -> None:
        """A contact has become a palm."""
        contact.refused = True
        self.tracking.palms += 1
        if contact.played:
            contact.played = False
            contact.lost_s = time_s
            self._release(contact, time_s, given)

    def _release(self, contact: _Contact, time_s: float, given: list[TouchSample]) -> None:
        self._released[contact.finger] = self._fingers.pop(contact.finger)
        given.append(TouchSample(contact.finger, contact.motion.x_m, contact.motion.y_m, time_s, False))

    def _found_still(self, time_s: float) -> None:
        """A report came: contacts that it did not tell are where they were."""
        for contact in self._contacts.values():
            motion = contact.motion
            if motion.time_s < time_s and not contact.refused:
                motion.report(motion.x_m, motion.y_m, time_s)
                contact.reports += 1

    def _decide(self, known_s: float, given: list[TouchSample]) -> None:
        """Give contacts that have waited long enough, release those that did not come back; all that `known_s` shows."""
        self._due_s = inf
        for lost in tuple(self._lost) if self._lost else ():
            until_s = self._bridged_until_s(lost)
            if known_s >= until_s:
                self._lost.remove(lost)
                self._release(lost, lost.lost_s, given)
            else:
                self._due_s = min(self._due_s, until_s)
        for contact in self._contacts.values():
            if contact.played or contact.refused:
                continue
            due_s = self._played_from_s(contact)
            if due_s > known_s:
                self._due_s = min(self._due_s, due_s)
                continue
            contact.played = True
            self._fingers[contact.finger] = contact
            motion = contact.motion
            given.append(TouchSample(contact.finger, motion.x_m, motion.y_m, max(due_s, motion.time_s), True, contact.size_m))
            if contact.suspect:
                self.tracking.longest_hold_s = max(self.tracking.longest_hold_s, max(due_s, motion.time_s) - contact.first_s)

    def _played_from_s(self, contact: _Contact) -> float:
        """When a contact that waits is a finger, should nothing be told of it."""
        due_s = contact.first_s
        if contact.reports < self._confirm_reports:
            due_s += (self._confirm_reports - 1) * UNTOLD_PERIODS * self.rate.period_s
        if contact.suspect:
            due_s = max(due_s, self._guard.cleared_s(contact.first_s))
        return due_s

    def _bridged_until_s(self, lost: _Contact) -> float:
        return lost.lost_s + BRIDGED_PERIODS * self.rate.period_s
