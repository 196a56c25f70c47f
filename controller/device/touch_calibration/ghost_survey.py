"""Measurement of ghosts: plays while nobody touches the panel, and records the contacts that emissions cause.

For the event loop it is a panel without touches, and a client that plays one click after another at random places.
"""

from __future__ import annotations

import os
import random
from collections import Counter
from collections.abc import Callable, Sequence

from controller.clocks import NEVER
from controller.device.board.panel_state import Condition
from controller.device.loop.commands import Outcome
from controller.device.loop.control import PanelControl
from controller.device.loop.preparation import LayerResult
from controller.device.touch.source import Counts, Heard, TouchSample, TouchSource
from controller.device.touch_calibration.ghost_figures import MAX_GHOST_LIFE_S, MIN_EMISSIONS, MIN_GHOSTS
from controller.errors import ControllerError, FaultError

KNOCK = "knock"  # name of the effect that is played
MOST_EMISSIONS = 600
# From the end of an emission to the next, at random within the panel's scans
GAP_S = (MAX_GHOST_LIFE_S + 0.03, MAX_GHOST_LIFE_S + 0.08)
SETTLED_S = 0.5  # after arming, until ghosts of the ramp have gone
PATIENCE_S = 10.0  # longest wait for the outputs to be on
STAYS_S = 1.0  # a contact that lasts longer is no ghost; the measurement ends


class Overheard:
    """A `TrackedTouch` that counts the contacts of a source and passes none to the loop."""

    def __init__(self, source: TouchSource) -> None:
        self.ghosts = 0  # contacts so far
        self.heard: Heard | None = None  # nobody else listens
        self.since_s = NEVER  # start of the contact that has lasted longest, in s of the host's clock; inf: there is none
        self._source = source
        self._down: dict[int, float] = {}

    @property
    def counts(self) -> Counts:
        """Of the source."""
        return self._source.counts

    @property
    def touched(self) -> bool:
        """Of the source."""
        return self._source.touched

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
        """Count new contacts; returns none."""
        for sample in self._source.read(now_s):
            if not sample.contact:
                self._down.pop(sample.finger, None)
            elif sample.finger not in self._down:
                self._down[sample.finger] = sample.time_s
                self.ghosts += 1
        self.since_s = min(self._down.values(), default=NEVER)
        return ()

    def down(self) -> tuple[int, ...]:
        """No finger."""
        return ()

    def predict(self, _finger: int, _at_s: float) -> None:
        """None: there are no fingers."""

    def missed_m(self, _finger: int) -> float:
        """Infinite: there are no fingers."""
        return NEVER

    @property
    def report_s(self) -> float:
        """0: there are no fingers."""
        return 0.0

    def confirmed(self, _finger: int) -> bool:
        """False: there are no fingers."""
        return False

    def emitted(self, start_s: float, end_s: float, period_s: float = 0.0) -> None:
        """Ignored: every contact counts as a ghost."""

    def quiet_until_s(self, now_s: float, _next_s: float) -> float:
        """Now: no quiet time is needed."""
        return now_s


class Knocks:
    """A `CommandSource` that plays clicks, far enough apart that each ghost belongs to one of them, and then ends the loop.

    Pass `ready` to the loop's `run`.
    """

    def __init__(
        self,
        panel: Overheard,  # counts the ghosts
        places: Sequence[tuple[float, float]],  # each (x_m, y_m): places of the clicks, in m
        duration_s: float,  # T
        stop: Callable[[], None],  # ends the loop
        progress: Callable[[int, int], None],  # called with the clicks played and their largest number
        seed: int = 0,  # seed of the random places and times
    ) -> None:
        self.error: ControllerError | None = None  # why the measurement was ended early
        self.played = 0  # clicks that were played
        self._panel = panel
        self._places = places
        self._duration_s = duration_s
        self._stop = stop
        self._progress = progress
        self._random = random.Random(seed)
        self._asked = 0
        self._asked_s = self._next_s = -NEVER
        self._gap_s = GAP_S[1]
        self._begin_s = self._refused_s = NEVER
        self._on = False
        self._wait = os.eventfd(0)  # the loop needs a file to wait on; this one is never readable

    def fileno(self) -> int:
        """File that is never readable."""
        return self._wait

    def next_time_s(self) -> float:
        """Time of the next click, in s of the host's clock."""
        return self._next_s

    def ready(self) -> None:
        """Note that the outputs are on."""
        self._on = True

    def begun(self, start_s: float) -> None:
        """Note when the click began, in s of the host's clock: the next keeps its distance from there."""
        self._next_s = start_s + self._duration_s + self._gap_s

    def serve(self, now_s: float, control: PanelControl) -> None:
        """Play the next click if it is due, or end the measurement."""
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
            self._gap_s = self._random.uniform(*GAP_S)
            self._asked_s, self._next_s = now_s, now_s + PATIENCE_S  # until it begins: over a slow link that takes an upload
            try:
                control.play(self._asked, KNOCK, *self._random.choice(self._places), None, 1.0, now_s)
            except ControllerError as error:
                self._refused(error, now_s)
            else:
                self._refused_s = NEVER

    def _refused(self, error: ControllerError, now_s: float) -> None:
        """Outputs that went off, as after a heartbeat that a busy host missed, are switched on again, and settle; or stay off."""
        self._asked -= 1
        self._refused_s = min(self._refused_s, now_s)
        if now_s - self._refused_s > PATIENCE_S:
            self._give_up(error)
        else:
            self._next_s = now_s + SETTLED_S

    def _give_up(self, error: ControllerError | None) -> None:
        self.error = error
        self._next_s = NEVER
        self._stop()

    @property
    def _enough(self) -> bool:
        return self.played >= MIN_EMISSIONS and self._panel.ghosts >= MIN_GHOSTS

    def outcome(self, _ticket: int, outcome: Outcome, _age_s: float) -> None:
        """Count a click that was played; the next follows one that was not."""
        self.played += outcome is Outcome.PLAYED
        if outcome is not Outcome.PLAYED:
            self.begun(self._asked_s)
        self._progress(self.played, MOST_EMISSIONS)

    def touches(self, samples: Sequence[TouchSample]) -> None:
        """Ignored: there are no touches."""

    def loaded(self, ticket: int, reason: str) -> None:
        """Ignored: no scene is loaded."""

    def scene_changed(self) -> None:
        """Ignored: no scene is loaded."""

    def layered(self, ticket: int, result: LayerResult) -> None:
        """Ignored: no layer is sent."""

    def changed(self, condition: Condition) -> None:
        """Ignored: outputs that are off refuse the next click."""

    def close(self) -> None:
        """Close the file."""
        os.close(self._wait)
