"""Plays without fingers and lets the panel report what it will: the loop's ends that find out what emissions do to a panel.

To the loop this is a panel without touches, and a client that asks for one click after another at random places.
"""

from __future__ import annotations

import os
import random
from collections import Counter
from collections.abc import Callable, Sequence

from controller.board.panel_state import Condition
from controller.clocks import NEVER
from controller.errors import ControllerError, FaultError
from controller.loop.commands import Outcome, PanelControl
from controller.touch.ghost_figures import MAX_GHOST_LIFE_S, MIN_EMISSIONS, MIN_GHOSTS
from controller.touch.source import Counts, TouchSample, TouchSource

KNOCK = "knock"  # the effect that is asked for
MOST_EMISSIONS = 600
# From the end of an emission to the next, at random within the panel's scans
GAP_S = (MAX_GHOST_LIFE_S + 0.03, MAX_GHOST_LIFE_S + 0.08)
SETTLED_S = 0.5  # what the ramp of arming has made is gone
PATIENCE_S = 10.0  # for outputs that are off
STAYS_S = 1.0  # no ghost: the rest need not be waited for


class Overheard:
    """A `TrackedTouch` that listens to a source and tells the loop of nothing.

    Parameters
    ----------
    source : TouchSource
        The panel.

    Attributes
    ----------
    ghosts : int
        Contacts so far.
    since_s : float
        When the one began that is down and was first; inf: none is down.
    """

    def __init__(self, source: TouchSource) -> None:
        self.ghosts = 0
        self.since_s = NEVER
        self._source = source
        self._down: dict[int, float] = {}

    @property
    def counts(self) -> Counts:
        """Of the source."""
        return self._source.counts

    @property
    def warnings(self) -> Counter[str]:
        """Of the source."""
        return self._source.warnings

    def fileno(self) -> int | None:
        """Of the source."""
        return self._source.fileno()

    def next_time_s(self) -> float | None:
        """Of the source."""
        return self._source.next_time_s()

    def close(self) -> None:
        """Close the source."""
        self._source.close()

    def read(self, now_s: float) -> tuple[TouchSample, ...]:
        """Nothing; see `TouchSource.read`."""
        for sample in self._source.read(now_s):
            if not sample.contact:
                self._down.pop(sample.finger, None)
            elif sample.finger not in self._down:
                self._down[sample.finger] = sample.time_s
                self.ghosts += 1
        self.since_s = min(self._down.values(), default=NEVER)
        return ()

    def predict(self, _finger: int, _at_s: float) -> None:
        """No finger is anywhere."""

    @property
    def report_s(self) -> float:
        """Of no use without fingers."""
        return 0.0

    def confirmed(self, _finger: int) -> bool:
        """No finger is."""
        return False

    def emitted(self, start_s: float, end_s: float, period_s: float = 0.0) -> None:
        """Nobody is suspected."""

    def quiet_until_s(self, now_s: float, _next_s: float) -> float:
        """No silence is asked for."""
        return now_s


class Knocks:
    """A `CommandSource` that asks for clicks, far enough apart that each ghost has one that made it, and ends the loop.

    Hand `ready` to the loop's `run`.

    Parameters
    ----------
    panel : Overheard
        Tells how many ghosts there were.
    places : sequence of (x_m, y_m)
        Where to knock.
    duration_s : float
        T.
    stop : callable
        Ends the loop.
    progress : callable
        Told of knocks played and the most there will be.
    seed : int
        Of the places and times.

    Attributes
    ----------
    error : ControllerError or None
        Why it was given up.
    played : int
        Knocks that sounded.
    """

    def __init__(
        self,
        panel: Overheard,
        places: Sequence[tuple[float, float]],
        duration_s: float,
        stop: Callable[[], None],
        progress: Callable[[int, int], None],
        seed: int = 0,
    ) -> None:
        self.error: ControllerError | None = None
        self.played = 0
        self._panel = panel
        self._places = places
        self._duration_s = duration_s
        self._stop = stop
        self._progress = progress
        self._random = random.Random(seed)
        self._asked = 0
        self._next_s = -NEVER
        self._begin_s = NEVER
        self._on = False
        self._wait = os.eventfd(0)  # the loop wants a file; it is never readable

    def fileno(self) -> int:
        """Never readable."""
        return self._wait

    def next_time_s(self) -> float:
        """The next knock."""
        return self._next_s

    def ready(self) -> None:
        """The outputs are on."""
        self._on = True

    def serve(self, now_s: float, control: PanelControl) -> None:
        """Knock, if it is time."""
        if now_s < self._next_s:
            return
        if not self._on:
            self._begin_s = min(self._begin_s, now_s)
            if now_s - self._begin_s > PATIENCE_S:
                self._give_up(FaultError(f"the outputs do not come on: {control.figures()['outputs']}"))
            else:
                self._next_s = now_s + SETTLED_S
        elif now_s - self._panel.since_s > STAYS_S or self._asked >= MOST_EMISSIONS or self._enough:
            self._give_up(None)
        else:
            self._asked += 1
            self._next_s = now_s + self._duration_s + self._random.uniform(*GAP_S)
            try:
                control.play(self._asked, KNOCK, *self._random.choice(self._places), None, 1.0, now_s)
            except ControllerError as error:
                self._give_up(error)

    def _give_up(self, error: ControllerError | None) -> None:
        self.error = error
        self._next_s = NEVER
        self._stop()

    @property
    def _enough(self) -> bool:
        return self.played >= MIN_EMISSIONS and self._panel.ghosts >= MIN_GHOSTS

    def outcome(self, _ticket: int, outcome: Outcome, _age_s: float) -> None:
        """A knock was played, or left out."""
        self.played += outcome is Outcome.PLAYED
        self._progress(self.played, MOST_EMISSIONS)

    def touches(self, samples: Sequence[TouchSample]) -> None:
        """There are none."""

    def loaded(self, ticket: int, reason: str) -> None:
        """No scene is asked for."""

    def changed(self, condition: Condition) -> None:
        """What matters comes with the next knock."""

    def close(self) -> None:
        """Give the file back."""
        os.close(self._wait)
