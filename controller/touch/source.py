"""The interfaces between what gives touch samples and the event loop.

A source gives samples: a recording, or a panel on a real bus. The tracker stands between a source and the
loop: it decides what is a finger, and says where a finger will be. The loop waits until `fileno()` is
readable or `next_time_s()` has come, then calls `read`.
"""

from __future__ import annotations

from collections import Counter
from typing import Protocol

from controller.touch.panel import Counts
from controller.touch.samples import TouchSample


class TouchSource(Protocol):
    """A touch panel, or what stands in for one."""

    @property
    def counts(self) -> Counts:
        """Reports, contacts and fingers seen so far."""

    @property
    def warnings(self) -> Counter[str]:
        """What had to be skipped or clamped so far, counted by kind (`warnings.in_words`)."""

    def fileno(self) -> int | None:
        """File to wait on for reading; None where only `next_time_s` says when. Another one after a panel was plugged in again."""

    def next_time_s(self) -> float | None:
        """When to call `read`, in the loop's clock; None: when the file is readable, or, without a file, never again."""

    def read(self, now_s: float) -> tuple[TouchSample, ...]:
        """Samples of at most one report (SYN_REPORT) due by `now_s`; empty if none is due or no finger changed."""

    def close(self) -> None:
        """Give the device back."""


class TrackedTouch(TouchSource, Protocol):
    """A source behind the tracker: fingers that may be played, and where they will be."""

    def place(self, finger: int, at_s: float) -> tuple[float, float] | None:
        """Where a finger will be, (x_m, y_m) on the plate; None once it is released.

        Parameters
        ----------
        finger : int
            As in the samples.
        at_s : float
            In the loop's clock, at most some tens of ms ahead: the T of an emission.
        """

    @property
    def report_s(self) -> float:
        """Time from one report of the panel to the next, as far as it is known."""

    def confirmed(self, finger: int) -> bool:
        """Whether the panel has confirmed the contact; the emissions of one that is not are capped.

        It is known of a finger that was released too, until the next `read`: lifting it may be felt.
        """

    def emitted(self, start_s: float, end_s: float, period_s: float = 0.0) -> None:
        """An emission sounds from `start_s` to `end_s`: what appears on the panel meanwhile may be a ghost.

        To be told in the order of `start_s`, at the latest when it starts; it ends what was told before.

        Parameters
        ----------
        start_s, end_s : float
            In the loop's clock.
        period_s : float
            Above 0 it is repeated so, until the next call; `emitted(now_s, now_s)` where nothing follows.
        """

    def quiet_until_s(self, now_s: float, next_s: float) -> float:
        """Until when no emission may begin, so that a contact that may be a ghost shows whether it is one.

        To be asked before anything is played, and while anything is repeated. It is at most one emission and the life of
        its ghosts ahead, and what it may take of the time is bounded.

        Parameters
        ----------
        now_s : float
            In the loop's clock.
        next_s : float
            When the next emission would begin, now or later.

        Returns
        -------
        float
            `now_s` or earlier: go ahead.
        """
