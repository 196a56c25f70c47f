"""A contact of a source as the tracker has it, and the counts of those that were not simply fingers."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf

from controller.device.touch.prediction import Motion


class TrackedContact:
    """One contact of the source: waiting or played."""

    __slots__ = ("finger", "first_s", "lost_s", "motion", "played", "reports", "size_m", "suspect")

    def __init__(self, finger: int, motion: Motion, *, suspect: bool) -> None:
        self.finger = finger  # number in the loop's samples: the source's number of its first contact
        self.motion = motion
        self.first_s = motion.time_s
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
