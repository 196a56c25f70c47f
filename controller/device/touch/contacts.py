"""Contacts of a source as the tracker has them, and fingers that a panel has lost for a moment.

A contact that begins near where a lost finger would be meanwhile is the same finger. A lost finger is kept for `BRIDGE_PERIODS`
of the panel's own period. Until that is measured, a finger that is lost soon after a report is taken to have been lost by the next,
as late as it may be on a panel of `SLOW_PERIOD_S`; one that was released and is back sooner than any hand shows the period.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot, inf
from typing import Final

from controller.device.touch.prediction import Motion
from controller.device.touch.reports import MAX_PERIOD_S, ReportRate

BRIDGE_RADIUS_M: Final = 5e-3  # from its predicted position, at least
BRIDGE_SPEED: Final = 0.25  # m/s: by so much its velocity may have been unknown; on a slow panel that is farther
BRIDGE_SHARE: Final = 0.5  # of the way from its last report: the same of a fast finger
BRIDGE_PERIODS: Final = 1.5  # the panel finds it one period after it has reported the loss
SLOW_PERIOD_S: Final = 30e-3  # it takes 45 ms at most to come back: nobody taps again in less than 50
UNKNOWN_LOSSES: Final = 3  # after this many, a panel without a measured period reports taps that do not move, and loses none


class TrackedContact:
    """One contact of the source: waiting or played."""

    __slots__ = ("finger", "first_s", "lost_s", "motion", "played", "reports", "size_m", "suspect")

    def __init__(self, finger: int, x_m: float, y_m: float, time_s: float, *, suspect: bool) -> None:
        self.finger = finger  # number in the loop's samples: the source's number of its first contact
        self.first_s = time_s
        self.motion = Motion(x_m, y_m, time_s)
        self.reports = 1
        self.size_m = 0.0
        self.suspect = suspect
        self.played = False
        self.lost_s = inf  # time of its release by the panel


@dataclass(slots=True)
class TrackerCounts:
    """Contacts that were not simply fingers."""

    held_back: int = 0  # suspects
    ghosts: int = 0  # suspects released before they were cleared
    flickers: int = 0  # contacts released before `confirm_reports` reports
    bridged: int = 0  # fingers lost and found again
    listened_s: float = 0.0  # time in which emissions were held back to judge suspects
    longest_hold_s: float = 0.0  # longest time from the first report of a suspect to its first sample
    # Longest time from first report to release of a ghost; if it is close to `ghost_ms`, that is too short
    longest_ghost_s: float = 0.0

    def count_unplayed(self, contact: TrackedContact, released_s: float) -> None:
        """Count a contact that was released before it was played."""
        if contact.suspect:
            self.ghosts += 1
            self.longest_ghost_s = max(self.longest_ghost_s, released_s - contact.first_s)
        else:
            self.flickers += 1


class LostFingers:
    """Fingers that may come back; they show the panel's period, too."""

    def __init__(self, rate: ReportRate) -> None:
        self.kept: list[TrackedContact] = []
        self.due_s = inf  # when the next one is given up, as `given_up` last had it
        self.gone: TrackedContact | None = None  # the finger that was released last
        self._rate = rate
        self._losses = 0  # while the period is not measured

    def restart(self) -> None:
        """It may be another panel from now on."""
        self._losses = 0
        self._rate.restart()

    def add(self, contact: TrackedContact, time_s: float) -> None:
        """The panel has reported the release of a finger."""
        contact.lost_s = time_s
        self.kept.append(contact)
        self._losses += not self._rate.measured

    def found_again(self, x_m: float, y_m: float, time_s: float) -> TrackedContact | None:
        """The lost finger to whose predicted position a new contact is nearest, for how far it may be off it."""
        found, nearest = None, 1.0
        for lost in self.kept:
            motion = lost.motion
            since_s = min(time_s - motion.time_s, motion.pause_s)
            way_x_m, way_y_m = motion.vx * since_s, motion.vy * since_s
            off_m = hypot(x_m - motion.x_m - way_x_m, y_m - motion.y_m - way_y_m)
            share = off_m / max(BRIDGE_RADIUS_M, BRIDGE_SPEED * since_s, BRIDGE_SHARE * hypot(way_x_m, way_y_m))
            if share <= nearest and time_s <= self._until_s(lost):
                found, nearest = lost, share
        if found is not None:
            self.kept.remove(found)
            self._rate.interval(time_s - found.lost_s)
            found.lost_s = inf
        elif not self._rate.measured and self.gone is not None:
            self._learn(self.gone, x_m, y_m, time_s)
        return found

    def given_up(self, known_s: float) -> list[TrackedContact]:
        """Take those that no report up to `known_s` has brought back in time."""
        given_up = [lost for lost in self.kept if known_s >= self._until_s(lost)]
        for lost in given_up:
            self.kept.remove(lost)
        self.due_s = min([self._until_s(lost) for lost in self.kept], default=inf)
        return given_up

    def _learn(self, gone: TrackedContact, x_m: float, y_m: float, time_s: float) -> None:
        """Learn the period from a finger that comes back sooner than any hand."""
        back_s = time_s - gone.lost_s
        if back_s <= BRIDGE_PERIODS * SLOW_PERIOD_S and hypot(x_m - gone.motion.x_m, y_m - gone.motion.y_m) <= BRIDGE_RADIUS_M:
            self._rate.interval(back_s)

    def _until_s(self, lost: TrackedContact) -> float:
        period_s = self._rate.period_s
        if not self._rate.measured and self._losses <= UNKNOWN_LOSSES:
            since_s = lost.lost_s - lost.motion.time_s
            if since_s <= MAX_PERIOD_S:
                period_s = max(period_s, min(since_s, SLOW_PERIOD_S))
        return lost.lost_s + BRIDGE_PERIODS * period_s
