"""What is under way on the plate: fingers, effects that commands have started, spots; and what of it is due.

All times are FPGA times but for those of `predict`. The scene decides what a finger feels; here it is kept until it
plays. Whatever a command asked for gets exactly one outcome.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from controller.clocks import FPGA_NEVER, NEVER, FpgaTime
from controller.errors import ConfigError
from controller.loop.batching import select_batch
from controller.loop.commands import Outcome
from controller.loop.spots import Spots
from controller.metrics import Counters
from controller.scene.emission import Emission
from controller.scene.fingers import ActiveEffects
from controller.scene.scene import OUTSIDE, Scene
from controller.touch.source import TouchSample

MAX_WAITING_COMMANDS = 32  # commands; of more the oldest is skipped
PREFETCH_DISTANCE_M = 0.75e-3  # of a finger's way, should that take more than one report
MIN_STEP_M = 0.1e-3  # from report to report; a finger that moves less is at rest
MAX_DEFERRAL_S = 10e-3  # an emission on its own lets the beats of trains pass for so long
COMMAND_MERGE_RADIUS_M = 1e-3  # commands for the same effect nearer than this are one

Owner = int | str
Confirmed = Callable[[int], bool]
Outcomes = Callable[[int, Outcome, float], None]
"""Told of a ticket, what became of it, and when (FPGA time)."""


class Scheduler:
    """Everything that is felt, between two moments.

    Parameters
    ----------
    scene : Scene
        What the plate should feel like.
    counters : Counters
        Where skipped work is counted.
    confirmed : callable
        Whether the panel has confirmed a finger.
    unconfirmed_most : int
        Emissions that a finger gets before it is.
    outcomes : callable
        Told what became of commands.

    Attributes
    ----------
    scene : Scene
    spots : Spots
    due : dict of Emission
        What waits to be played, of each owner the newest, in the order in which the owners began to wait.
    """

    def __init__(self, scene: Scene, counters: Counters, confirmed: Confirmed, unconfirmed_most: int, outcomes: Outcomes) -> None:
        self.scene = scene
        self.spots = Spots(scene.spots, FpgaTime(0.0))
        self._counters = counters
        self._confirmed = confirmed
        self._unconfirmed_most = unconfirmed_most
        self._outcomes = outcomes
        self._active: dict[Owner, ActiveEffects] = {}  # fingers by number, commands at a point by their owner
        self._emission_counts: dict[int, int] = {}  # emissions of each finger so far
        self.due: dict[Owner, Emission] = {}

    def touch(self, sample: TouchSample, time_s: FpgaTime) -> None:
        """A finger began, moved or was released, at a time that is `sample.time_s` in FPGA time."""
        finger, x_m, y_m, _, contact, _ = sample
        active = self._active.get(finger)
        if not contact:
            self._release(finger, active, time_s)
            return
        if active is None:
            active = self._active[finger] = ActiveEffects(self.scene, finger, x_m, y_m)
            emissions = active.press(time_s)
        else:
            emissions = active.move(x_m, y_m, time_s)
        if emissions:
            self._add(emissions)
        elif active.region == OUTSIDE:
            self._counters.skipped.outside_region += 1
        else:
            self._counters.skipped.between_emissions += 1

    def play(self, ticket: int, effect: str, x_m: float, y_m: float, finger: int | None, amplitude: float, now_s: FpgaTime) -> None:
        """A command plays an effect at a point, or for a finger.

        Raises
        ------
        ConfigError
            If there is no such effect, or no such finger.
        """
        if finger is not None:
            if finger not in self._active:
                raise ConfigError(f"finger {finger} is not on the panel")
            self._add(self._active[finger].start(effect, amplitude, now_s, ticket))
            return
        active = ActiveEffects(self.scene, f"command {ticket}", x_m, y_m)
        emissions = active.start(effect, amplitude, now_s, ticket)
        if not active.ended:
            self._active[active.owner] = active
        self._make_room(emissions)
        self._add(emissions)

    def advance(self, until_s: FpgaTime) -> None:
        """Collect what becomes due by itself up to a time."""
        advanced = False
        for active in self._active.values():
            if active.next_s <= until_s:
                self._add(active.advance(until_s))
                advanced = True
        if advanced:
            self._drop_ended()

    def add_spots(self, now_s: FpgaTime, until_s: FpgaTime) -> None:
        """Collect the spots whose beat comes up to a time."""
        for emission in self.spots.due(now_s, until_s):
            self._add((emission,))

    def join_spots(self, emissions: list[Emission], next_s: FpgaTime) -> list[Emission]:
        """These and those spots that may be played with them; the beat of all goes on at `next_s`."""
        self.spots.restart(next_s)
        played = list(select_batch([*emissions, *self.spots.before_start()], NEVER)[0])
        self._counters.due += len(played) - len(emissions)
        return played

    def must_defer(self, now_s: FpgaTime, until_s: FpgaTime) -> bool:
        """Whether what waits, played now and until some time, would be in the way of a train's beat; it is taken with that.

        What has waited for MAX_DEFERRAL_S is not held any longer: of trains so fast that nothing goes between their beats,
        a beat is late then.
        """
        if self.next_s() > until_s:
            return False
        oldest = next(iter(self.due.values()))
        return now_s - oldest.time_s < MAX_DEFERRAL_S and not any(emission.period_s for emission in self.due.values())

    def next_batch(self, duration_s: float, now_s: FpgaTime) -> list[Emission]:
        """What is played next, as one emission; the rest goes on waiting. A beat goes before what could be held for it."""
        if len(self.due) == 1:
            chosen = list(self.due.values())
            self.due.clear()
        else:
            due = tuple(self.due.values())
            if not due[0].period_s and now_s - due[0].time_s < MAX_DEFERRAL_S:
                due = tuple(sorted(due, key=_has_no_beat))
            first, rest = select_batch(due, duration_s)
            chosen = list(first)
            self.due = {emission.owner: emission for emission in rest}
        return chosen

    def next_s(self) -> FpgaTime:
        """When `advance` has something to do."""
        return min([active.next_s for active in self._active.values()], default=FPGA_NEVER)

    def predict(
        self, finger: int, place: Callable[[int, float], tuple[float, float] | None], now_s: float, report_s: float, after_s: float
    ) -> tuple[float, float, float] | None:
        """Where a moving finger will be played, and how strong, if one of its next reports will complete a spacing.

        A spacing is felt at the first report behind it: where it falls is known, where the finger is played depends on
        when the panel reports.

        Parameters
        ----------
        place : callable
            Where the finger will be at a time of the host.
        now_s : float
            In host time: of its last report.
        report_s : float
            From one report to the next.
        after_s : float
            From a report to the focus.
        """
        active = self._active.get(finger)
        here, then = place(finger, now_s), place(finger, now_s + report_s)
        if active is None or here is None or then is None:
            return None
        step_m = math.dist(here, then)
        if step_m < MIN_STEP_M:
            return None
        way_m, amplitude = active.next_crossing((then[0] - here[0]) / step_m, (then[1] - here[1]) / step_m)
        if way_m > max(step_m, PREFETCH_DISTANCE_M):
            return None
        focus = place(finger, now_s + math.ceil(way_m / step_m) * report_s + after_s)
        return None if focus is None else (*focus, amplitude)

    def started(self, emissions: Sequence[Emission], start_s: FpgaTime) -> None:
        """These were started; trains that began with them keep their beat from there."""
        for emission in emissions:
            if emission.ticket:
                self._outcomes(emission.ticket, Outcome.PLAYED, start_s - emission.time_s)
            if emission.period_s and emission.beat == 0 and emission.owner in self._active:
                self._active[emission.owner].shift(emission.time_s, start_s)

    def discarded(self, emissions: Sequence[Emission], outcome: Outcome, now_s: FpgaTime) -> None:
        """These will not be played."""
        for emission in emissions:
            if emission.ticket:
                self._outcomes(emission.ticket, outcome, now_s - emission.time_s)

    def _release(self, finger: int, active: ActiveEffects | None, now_s: FpgaTime) -> None:
        """A finger was lifted."""
        last: tuple[Emission, ...] = ()
        if active is not None:
            last = active.release(now_s)
            self._end_commands(active, Outcome.SKIPPED, now_s)
            del self._active[finger]
        self._add(last)
        self._discard_waiting_of(finger, last, now_s)
        self._emission_counts.pop(finger, None)  # what it felt as it was lifted is counted too

    def _discard_waiting_of(self, finger: int, last: tuple[Emission, ...], now_s: FpgaTime) -> None:
        """What still waits for a finger that is gone would be felt by nobody, but for what it feels as it is lifted."""
        waiting = self.due.get(finger)
        if waiting is not None and waiting not in last:
            del self.due[finger]
            self._counters.skipped.lifted += 1
            self.discarded([waiting], Outcome.SKIPPED, now_s)

    def _end_commands(self, active: ActiveEffects, outcome: Outcome, now_s: FpgaTime) -> None:
        """Commands that end before their first emission."""
        for ticket, given_s in active.unplayed_commands:
            self._outcomes(ticket, outcome, now_s - given_s)

    def reset(self, now_s: FpgaTime) -> None:
        """The outputs went off: what was under way is over; fingers that are down stay known, spots begin anew."""
        waiting = list(self.due.values())
        self.due.clear()
        self._counters.skipped.outputs_off += len(waiting)
        self.discarded(waiting, Outcome.REFUSED, now_s)
        for active in self._active.values():
            self._end_commands(active, Outcome.REFUSED, now_s)
            active.end_trains()
        self._active = {owner: active for owner, active in self._active.items() if active.finger is not None}
        self.spots.restart(now_s)

    def change_scene(self, scene: Scene, now_s: FpgaTime) -> None:
        """Go on with another scene: fingers that are down feel it from their next move on."""
        waiting = list(self.due.values())
        self.due.clear()
        self._counters.skipped.scene_changed += len(waiting)
        self.discarded(waiting, Outcome.SKIPPED, now_s)
        self.scene = scene
        for active in self._active.values():
            active.change_scene(scene)
        self.spots = Spots(scene.spots, now_s)

    def _add(self, emissions: tuple[Emission, ...]) -> None:
        self._counters.due += len(emissions)
        for emission in emissions:
            finger = emission.finger
            if finger is not None:
                given = self._emission_counts.get(finger, 0) + 1
                if given > self._unconfirmed_most and not self._confirmed(finger):
                    self._counters.skipped.unconfirmed += 1
                    self.discarded([emission], Outcome.SKIPPED, emission.time_s)
                    continue
                self._emission_counts[finger] = given
            before = self.due.get(emission.owner)
            if before is not None:
                self._counters.skipped.merged += 1
                self.discarded([before], Outcome.MERGED, emission.time_s)
            self.due[emission.owner] = emission

    def _make_room(self, emissions: tuple[Emission, ...]) -> None:
        """A command at a point replaces one for the same place; of too many that wait the oldest is skipped."""
        for new in emissions:
            waiting = [e for owner, e in self.due.items() if isinstance(owner, str) and e.ticket]
            for old in waiting:
                if old.region == new.region and math.dist((old.x_m, old.y_m), (new.x_m, new.y_m)) < COMMAND_MERGE_RADIUS_M:
                    del self.due[old.owner]
                    self._counters.skipped.merged += 1
                    self.discarded([old], Outcome.MERGED, new.time_s)
                    break
            else:
                if len(waiting) >= MAX_WAITING_COMMANDS:
                    oldest = min(waiting, key=lambda e: e.time_s)
                    del self.due[oldest.owner]
                    self._counters.skipped.no_room += 1
                    self.discarded([oldest], Outcome.SKIPPED, new.time_s)

    def _drop_ended(self) -> None:
        for owner in [owner for owner, active in self._active.items() if active.finger is None and active.ended]:
            del self._active[owner]


def _has_no_beat(emission: Emission) -> bool:
    return emission.period_s == 0
