"""Active effects of fingers, commands and fixed emitters, and the emissions of them that are due.

The scene decides what is felt; here it is kept until it is played. Every command that plays an effect gets exactly one
outcome.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Final

from controller.clocks import FPGA_NEVER, NEVER, FpgaTime
from controller.device.loop.commands import Outcome
from controller.device.loop.fixed_emitters import FixedEmitters
from controller.device.loop.playing.batching import select_batch
from controller.device.loop.skips import ALL, Skips
from controller.device.loop.train_phases import moved_s
from controller.device.scene.clips import ClientEffect
from controller.device.scene.emission import Emission
from controller.device.scene.fingers import ActiveEffects
from controller.device.scene.region_lookup import OUTSIDE
from controller.device.scene.scene import Scene
from controller.device.touch.source import TouchSample
from controller.device.waveforms.composition import MAX_FOCI
from controller.errors import ConfigError
from controller.metrics import Counters

MAX_WAITING_COMMANDS: Final = 32  # if more wait, the oldest is skipped
PREFETCH_DISTANCE_M: Final = 0.75e-3  # an emission this near is predicted, even if it takes more than one report to get there
MIN_STEP_M: Final = 0.1e-3  # from report to report; a finger that moves less is at rest
# What is completed later in the time between two reports may be found complete one report later: of a lone finger, and of several,
# of which one may have what was sent for it composed with another's
LATEST_IN_REPORT: Final = (0.95, 0.9)
MAX_DEFERRAL_S: Final = 10e-3  # a single emission waits this long for the pulses of trains
COMMAND_MERGE_RADIUS_M: Final = 1e-3  # of commands for one effect nearer to each other than this, the newer replaces the older

Owner = int | str
Confirmed = Callable[[int], bool]
Outcomes = Callable[[int, Outcome, float], None]
"""Called with a ticket, what became of it, and the age of the command in s."""


class Scheduler:
    """Active effects and pending emissions of all fingers, commands and fixed emitters."""

    def __init__(
        self,
        scene: Scene,
        counters: Counters,  # counts emissions that are due, and those that are skipped
        confirmed: Confirmed,  # whether the panel has confirmed the finger of this number
        max_unconfirmed: int,  # emissions that a finger gets before it is confirmed
        outcomes: Outcomes,  # called with what became of each command
        skips: Skips = ALL,  # what of the work may be left out
        wave_scale: float = 1.0,
    ) -> None:
        self.scene = scene
        self._skips = skips
        self._max_foci = MAX_FOCI if skips.together else 1
        self._wave_scale = wave_scale
        self.emitters = FixedEmitters(scene.emitters, FpgaTime(0.0), wave_scale, repeats=skips.repeated)
        self._counters = counters
        self._confirmed = confirmed
        self._max_unconfirmed = max_unconfirmed
        self._outcomes = outcomes
        self._active: dict[Owner, ActiveEffects] = {}  # fingers by number, commands at a point by their owner
        self._unlimited: set[int] = set()  # fingers known to be confirmed
        self._emission_counts: dict[int, int] = {}  # emissions so far of each of the others
        # Emissions to be played, the newest of each owner, in the order in which the owners began to wait
        self.due: dict[Owner, Emission] = {}
        self.spaced: int | None = None  # the finger that was touched last, if what it feels depends on the way that it goes

    def fingers_down(self) -> int:
        """Fingers on the plate."""
        return len([owner for owner in self._active if isinstance(owner, int)])

    def touch(self, sample: TouchSample, time_s: FpgaTime) -> None:
        """Take a touch sample of a finger that is put down, moves, or is lifted; `sample.time_s` is `time_s` in host time."""
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
        self.spaced = finger if active.progress else None
        if emissions:
            self._add(emissions)
        elif active.region == OUTSIDE:
            self._counters.skipped.outside_region += 1
        else:
            self._counters.skipped.between_emissions += 1

    def play(
        self, ticket: int, effect: str | ClientEffect, x_m: float, y_m: float, finger: int | None, amplitude: float, now_s: FpgaTime
    ) -> None:
        """Start an effect for a command, at a point or at a finger.

        The outcome is reported with `ticket`; 0: nobody waits for it. The place is unused with a finger, which the effect follows.
        `amplitude` is `MIN_AMPLITUDE` to 1, times the effect's own. Raises ConfigError if there is no such effect, or no such
        finger.
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

    def test_channel(self, ticket: int, channel: int, x_m: float, y_m: float, now_s: FpgaTime) -> None:
        """Have a channel tested, for a command: as an emission at the place of its actuator."""
        name = f"channel {channel}"
        emission = Emission(now_s, x_m, y_m, None, name, owner=f"command {ticket}", ticket=ticket, alternate=True, channel=channel)
        self._make_room((emission,))
        self._add((emission,))

    def fingers_in(self, owner: int, region: str) -> tuple[int, ...]:
        """Fingers in a region, by its name: of the layer of the client with this number, else of the scene.

        Raises ConfigError if neither has a region of this name.
        """
        index = self.scene.named(owner, region)
        return tuple([active.finger for active in self._active.values() if active.finger is not None and active.region == index])

    def advance(self, now_s: FpgaTime, lead_s: float = 0.0) -> None:
        """Collect the pulses of trains that are due within `lead_s`, but none before the pulse before it is due."""
        advanced = False
        for active in self._active.values():
            until_s = now_s + (lead_s if lead_s < active.period_s else active.period_s)
            if active.next_s <= until_s:
                self._add(active.advance(until_s))
                advanced = True
        if advanced:
            self._drop_ended()

    def add_emitters(self, now_s: FpgaTime, until_s: FpgaTime) -> None:
        """Collect the emissions of fixed emitters that are due up to `until_s`; pulses that `now_s` has passed are left out."""
        for emission in self.emitters.due(now_s, until_s):
            self._add((emission,))

    def join_emitters(self, emissions: list[Emission], next_s: FpgaTime) -> list[Emission]:
        """Emissions with those of the fixed emitters that may be played as one waveform with them.

        Their pulse goes on at `next_s`, after the one that is played now.
        """
        self.emitters.restart(next_s)
        played = list(select_batch([*emissions, *self.emitters.before_start()], NEVER, self._max_foci, self._wave_scale)[0])
        self._counters.due += len(played) - len(emissions)
        return played

    def must_defer(self, now_s: FpgaTime, until_s: FpgaTime) -> bool:
        """Whether what is due has to wait for the pulse of a train, which it would delay; it is played with that pulse.

        What has waited for `MAX_DEFERRAL_S` is played in any case: a train may be so fast that nothing fits between its pulses,
        one of which is late then.

        Plate and wire would be free for a pulse again at `until_s`, if what is due, and something has to be, were played now.
        """
        if self.next_s() > until_s:
            return False
        oldest = next(iter(self.due.values()))
        return now_s - oldest.time_s < MAX_DEFERRAL_S and not any(emission.period_s for emission in self.due.values())

    def next_batch(self, duration_s: float, now_s: FpgaTime) -> list[Emission]:
        """Take what is played next, as one waveform; the rest stays due. A pulse of a train goes before a single emission.

        Emissions that are due within `duration_s` of the first are played with it.
        """
        if len(self.due) == 1:
            chosen = list(self.due.values())
            self.due.clear()
        else:
            due = tuple(self.due.values())
            if not due[0].period_s and now_s - due[0].time_s < MAX_DEFERRAL_S:
                due = tuple(sorted(due, key=_has_no_pulse))
            first, rest = select_batch(due, duration_s, self._max_foci, self._wave_scale)
            chosen = list(first)
            self.due = {emission.owner: emission for emission in rest}
        return chosen

    @property
    def active(self) -> bool:
        """Whether a finger is down, or anything is due or going on."""
        return bool(self._active or self.due)

    @property
    def fingers(self) -> int:
        """Fingers that are down."""
        return sum([active.finger is not None for active in self._active.values()])

    def next_s(self) -> FpgaTime:
        """When the next pulse of a train is due; inf without a train."""
        next_s = FPGA_NEVER
        for active in self._active.values():
            next_s = active.next_s if active.next_s < next_s else next_s
        return next_s

    def collect_s(self, lead_s: float) -> FpgaTime:
        """When `advance` next collects a pulse; inf without a train."""
        return min([active.next_s - min(lead_s, active.period_s) for active in self._active.values()], default=FPGA_NEVER)

    def predict(
        self, finger: int, locate: Callable[[int, float], tuple[float, float] | None], now_s: float, report_s: float, after_s: float
    ) -> tuple[float, float, float] | None:
        """Predict the focus of a finger's next emission, if one of its next reports will complete a spacing, and no other finger's.

        An emission follows the first report after a spacing is completed. Where that is follows from the finger's motion,
        where the focus is from when the panel reports.

        `locate` gives the place (x_m, y_m) of a finger at a host time, None if it is not down. The finger's last report was at the
        host time `now_s`; from report to report it takes `report_s`, from a report to the focus `after_s`. Returns x_m, y_m and
        amplitude.
        """
        crossing = self._next_crossing(finger, locate, now_s, report_s)
        if crossing is None or crossing[0] % 1 > LATEST_IN_REPORT[len(self._active) > 1]:
            return None
        reports, amplitude = math.ceil(crossing[0]), crossing[1]
        for other in self._active.values():
            if other.finger is not None and other.finger != finger:
                near = self._next_crossing(other.finger, locate, now_s, report_s)
                if near is not None and math.ceil(near[0]) == reports:
                    return None
        focus = locate(finger, now_s + reports * report_s + after_s)
        return None if focus is None else (*focus, amplitude)

    def _next_crossing(
        self, finger: int, locate: Callable[[int, float], tuple[float, float] | None], now_s: float, report_s: float
    ) -> tuple[float, float] | None:
        """Reports until a finger completes a spacing, and its amplitude; None if that is too far away to be known."""
        active = self._active.get(finger)
        here, then = locate(finger, now_s), locate(finger, now_s + report_s)
        if active is None or here is None or then is None:
            return None
        if len(self._active) > 1 and active.region != OUTSIDE and self.scene.regions[active.region].nulled:
            return None  # where the others will be kept still is not known
        step_m = math.dist(here, then)
        if step_m < MIN_STEP_M:
            return None
        distance_m, amplitude = active.next_crossing((then[0] - here[0]) / step_m, (then[1] - here[1]) / step_m)
        return None if distance_m > max(step_m, PREFETCH_DISTANCE_M) else (distance_m / step_m, amplitude)

    def started(self, emissions: Sequence[Emission], start_s: FpgaTime, apart_s: float = 0.0) -> None:
        """Report emissions as played.

        Trains whose pulse 0 is among them are shifted so that it falls on `start_s`, or their next pulses where `moved_s` has
        them; `apart_s` is its.
        """
        for emission in emissions:
            if emission.ticket:
                self._outcomes(emission.ticket, Outcome.PLAYED, start_s - emission.time_s)
            if emission.period_s and emission.pulse == 0 and emission.owner in self._active:
                first_s = self._first_s(emission, emissions, start_s, apart_s)
                self._active[emission.owner].shift(emission.time_s, first_s)

    def _first_s(self, begun: Emission, emissions: Sequence[Emission], start_s: FpgaTime, apart_s: float) -> FpgaTime:
        """From when on the pulses of a train are counted that has begun at `start_s`, with others of the same emissions."""
        period_s, alone, regions = begun.period_s, begun.alternate, self.scene.regions
        if self._active[begun.owner].has_rhythm:
            return start_s
        together = [emission.owner for emission in emissions if emission.period_s == period_s and emission.pulse == 0]
        others_s = []
        for owner, active in self._active.items():
            if active.period_s == period_s and owner not in together and not active.has_rhythm:
                others_s.append(active.next_s)
                alone = alone or (active.region != OUTSIDE and regions[active.region].alternate)
        return start_s + moved_s(start_s, period_s, others_s, apart_s, alone=alone) if others_s else start_s

    def discarded(self, emissions: Sequence[Emission], outcome: Outcome, now_s: FpgaTime) -> None:
        """Report emissions that will not be played; `outcome` says why."""
        for emission in emissions:
            if emission.ticket:
                self._outcomes(emission.ticket, outcome, now_s - emission.time_s)

    def _release(self, finger: int, active: ActiveEffects | None, now_s: FpgaTime) -> None:
        """Take note that a finger was lifted."""
        last: tuple[Emission, ...] = ()
        if active is not None:
            last = active.release(now_s)
            self._end_commands(active, Outcome.SKIPPED, now_s)
            del self._active[finger]
        self._add(last)
        self._discard_waiting_of(finger, last, now_s)
        self._emission_counts.pop(finger, None)  # after the emissions of its release were counted
        self._unlimited.discard(finger)

    def _discard_waiting_of(self, finger: int, last: tuple[Emission, ...], now_s: FpgaTime) -> None:
        """Discard what is due for a finger that was lifted, but for the emissions of its release."""
        waiting = self.due.get(finger)
        if waiting is not None and waiting not in last:
            del self.due[finger]
            self._counters.skipped.lifted += 1
            self.discarded([waiting], Outcome.SKIPPED, now_s)

    def _end_commands(self, active: ActiveEffects, outcome: Outcome, now_s: FpgaTime) -> None:
        """Report the commands that end before their first emission."""
        for ticket, given_s in active.unplayed_commands:
            self._outcomes(ticket, outcome, now_s - given_s)

    def reset(self, now_s: FpgaTime) -> None:
        """Discard what is due or active, since the outputs went off; fingers that are down stay known, fixed emitters restart."""
        waiting = list(self.due.values())
        self.due.clear()
        self._counters.skipped.outputs_off += len(waiting)
        self.discarded(waiting, Outcome.REFUSED, now_s)
        for active in self._active.values():
            self._end_commands(active, Outcome.REFUSED, now_s)
            active.end_trains()
        self._active = {owner: active for owner, active in self._active.items() if active.finger is not None}
        self.emitters.restart(now_s)

    def change_scene(self, scene: Scene, now_s: FpgaTime) -> None:
        """Go on with another scene; fingers that are down feel it from their next move on."""
        waiting = list(self.due.values())
        self.due.clear()
        self._counters.skipped.scene_changed += len(waiting)
        self.discarded(waiting, Outcome.SKIPPED, now_s)
        self.scene = scene
        for active in self._active.values():
            active.change_scene(scene)
        self.emitters = FixedEmitters(scene.emitters, now_s, self._wave_scale, repeats=self._skips.repeated)

    def change_layers(self, scene: Scene) -> None:
        """Go on with other layers over the same scene: what is due stays due."""
        self.scene = scene
        for active in self._active.values():
            active.change_layers(scene)

    def _add(self, emissions: tuple[Emission, ...]) -> None:
        self._counters.due += len(emissions)
        for emission in emissions:
            finger = emission.finger
            if finger is not None and finger not in self._unlimited and not self._may_have_another(finger):
                self._counters.skipped.unconfirmed += 1
                self.discarded([emission], Outcome.SKIPPED, emission.time_s)
                continue
            before = self.due.get(emission.owner)
            if before is not None:
                self._counters.skipped.merged += 1
                self.discarded([before], Outcome.MERGED, emission.time_s)
            self.due[emission.owner] = emission

    def _may_have_another(self, finger: int) -> bool:
        """Whether a finger may have one more emission: only this many before it is confirmed."""
        if self._confirmed(finger):
            self._unlimited.add(finger)
            return True
        given = self._emission_counts.get(finger, 0)
        self._emission_counts[finger] = given + 1
        return given < self._max_unconfirmed

    def _make_room(self, emissions: tuple[Emission, ...]) -> None:
        """Let a command at a point replace one for the same place; if too many wait, skip the oldest."""
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


def _has_no_pulse(emission: Emission) -> bool:
    return emission.period_s == 0
