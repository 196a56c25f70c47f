"""Touch samples, and the interfaces between their sources and the event loop.

A source is a recording or a panel on a real bus. The tracker stands between a source and the loop: it decides which contacts
are fingers, and predicts where each finger will be. The loop waits until `fileno()` is readable or `next_time_s()` has come,
then calls `read`.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Final, NamedTuple, Protocol

from controller.device.board.touch_panels import TouchPanel

LEFT_OUT: Final = ("far_outside", "no_finger", "too_fast", "more_than_played", "fallen_silent")  # of `reports.WARNINGS`


class TouchSample(NamedTuple):
    """One finger that began, moved or was released.

    A finger keeps its number from its first sample to the one with `contact` False; no later finger has the same number.
    The last sample repeats the position at which the finger was last reported.
    """

    finger: int  # number of the finger
    x_m: float  # x_m, y_m: position on the plate
    y_m: float
    time_s: float  # on the loop's clock
    contact: bool  # False: released
    # Major axis of the contact; 0 if the panel reports none, inf if it is released because it has become a palm
    size_m: float = 0.0


touch_sample: Final[Callable[[tuple[int, float, float, float, bool, float]], TouchSample]] = partial(tuple.__new__, TouchSample)
"""A `TouchSample` of a tuple of all its fields, at a third of the instructions: without the function that its class has for it."""


@dataclass(slots=True)
class Counts:
    """What a source has reported, before any limit of the controller."""

    reports: int = 0  # SYN_REPORTs with at least one contact down
    contacts: int = 0  # contacts that began
    max_fingers: int = 0  # most contacts down in one report
    points: int = 0  # positions of contacts that are no palms; what became of them says `plausibility`
    believed: int = 0  # of these, those that became touch samples at once
    held: int = 0  # held, confirmed: of these, those that no hand reaches so soon, and of them those that were right all the same
    confirmed: int = 0
    palms: int = 0  # contacts that were palms, by tool or by size
    devices: int = 0  # devices opened: one more after each reconnection
    off_plate: int = 0  # those that the board's map puts off the plate, by more than `axes.OFF_M`; they were moved to its edge

    @property
    def refused(self) -> int:
        """Positions that were no finger's."""
        return self.points - self.believed - self.confirmed

    def plausibility(self, warnings: Mapping[str, int]) -> dict[str, int]:
        """Figures of what became of the positions, for JSON, with the `warnings` of `LEFT_OUT`.

        `points` = `believed` + `far_outside` + `no_finger` + `held` + `more_than_played`. Of those `held` back because of a step
        that no hand makes, `confirmed` were right and `too_fast` were outliers; the rest still waits. `fallen_silent` are fingers.
        """
        found = {"points": self.points, "believed": self.believed, "held": self.held, "confirmed": self.confirmed}
        return found | {kind: warnings.get(kind, 0) for kind in LEFT_OUT}


@dataclass(slots=True)
class Silence:
    """What the loop tells the source of a panel before each read."""

    # The selector has just found that nothing can be read from the panel's file. False: something can, or nobody looked
    known: bool = False


@dataclass(frozen=True, slots=True)
class Sides:
    """The sides of a plate, along x and y."""

    length_m: float
    width_m: float


@dataclass(frozen=True, slots=True)
class TouchedPlate:
    """What touch has to know of a board, where that is not at hand: the table [touch], and the plate that its axes map to."""

    touch: TouchPanel
    plate: Sides


class TouchSource(Protocol):
    """A touch panel, or a recording of one."""

    @property
    def counts(self) -> Counts:
        """Reports, contacts and fingers so far; the same object at any time."""

    @property
    def touched(self) -> bool:
        """Whether the last `read` took a report with at least one contact down, be it that none has moved.

        False also for a report with a position that is held back (`plausibility.py`): where that finger is, is not known.
        """

    @property
    def warnings(self) -> Counter[str]:
        """Anomalies that were skipped or clamped so far, counted by kind (`reports.WARNINGS`)."""

    def fileno(self) -> int | None:
        """File to wait on for reading; None: wait until `next_time_s` only. It changes when a panel is reconnected."""

    def next_time_s(self) -> float | None:
        """When to call `read`, on the loop's clock; None: when the file is readable or, without a file, never again."""

    def read(self, now_s: float) -> tuple[TouchSample, ...]:
        """Take the samples of at most one report, by `now_s` on the loop's clock; empty if none is due or no finger changed."""

    def close(self) -> None:
        """Close the device or file."""


Heard = Callable[[Sequence[TouchSample]], None]


class TrackedTouch(TouchSource, Protocol):
    """A source behind the tracker: confirmed fingers with predicted positions."""

    heard: Heard | None  # given the contacts of each report before it is decided which are fingers

    def down(self) -> Sequence[int]:
        """Numbers of the fingers that are down."""

    def predict(self, finger: int, at_s: float) -> tuple[float, float] | None:
        """Position (x_m, y_m) on the plate predicted for a finger at most some tens of ms ahead; None once it is released."""

    def missed_m(self, finger: int) -> float:
        """Distance in m of a finger's last report from where it was predicted; inf once the finger is released."""

    @property
    def report_s(self) -> float:
        """Report period of the panel as measured so far, in s."""

    def confirmed(self, finger: int) -> bool:
        """Whether the panel has confirmed a contact; the loop limits the emissions of an unconfirmed one.

        A released finger is still known until the next `read`, for its release effect.
        """

    def emitted(self, start_s: float, end_s: float, period_s: float = 0.0) -> None:
        """Announce an emission: contacts first reported during it may be ghosts.

        Call it in the order of `start_s`, at the latest when the emission starts. It ends the one announced before.

        With `period_s` above 0 the emission repeats until the next call; `emitted(now_s, now_s)` ends it.
        """

    def quiet_until_s(self, now_s: float, next_s: float) -> float:
        """Ask whether emissions must pause so that a suspected ghost can be distinguished from a finger.

        Ask before every emission and while an emission repeats. The pause is at most one emission and the life of its
        ghosts long, and the share of time spent in pauses is limited.

        The next emission would begin at `next_s`, now or later. Returns the time until which none may begin; `now_s` or earlier: no
        pause.
        """
