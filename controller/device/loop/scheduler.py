"""Active effects of fingers, commands and fixed emitters, and the emissions of them that are due.

The scene decides what is felt; here it is kept while it is active, and in `DueEmissions` until it is played.
"""

from __future__ import annotations

from collections.abc import Sequence

from controller.clocks import FPGA_NEVER, NEVER, FpgaTime
from controller.device.loop.commands import Outcome
from controller.device.loop.fixed_emitters import FixedEmitters
from controller.device.loop.playing.batching import select_batch
from controller.device.loop.playing.due_emissions import MAX_DEFERRAL_S, Confirmed, DueEmissions, Outcomes, Owner
from controller.device.loop.skips import ALL, Skips
from controller.device.loop.train_phases import moved_s
from controller.device.scene.effects.clips import ClientEffect
from controller.device.scene.emission import Emission
from controller.device.scene.fingers import ActiveEffects
from controller.device.scene.region_lookup import OUTSIDE
from controller.device.scene.scene import Scene
from controller.device.touch.source import TouchSample
from controller.device.waveforms.composition import MAX_FOCI
from controller.errors import ConfigError
from controller.metrics import Counters


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
        self._outcomes = outcomes
        self.active_effects: dict[Owner, ActiveEffects] = {}  # fingers by number, commands at a point by their owner
        self.queue = DueEmissions(counters, confirmed, max_unconfirmed, outcomes, self._max_foci, wave_scale)
        self.due = self.queue.by_owner
        self.spaced: int | None = None  # the finger that was touched last, if what it feels depends on the way that it goes

    def fingers_down(self) -> int:
        """Fingers on the plate."""
        return len([owner for owner in self.active_effects if isinstance(owner, int)])

    def touch(self, sample: TouchSample, time_s: FpgaTime) -> None:
        """Take a touch sample of a finger that is put down, moves, or is lifted; `sample.time_s` is `time_s` in host time."""
        finger, x_m, y_m, _, contact, _ = sample
        active = self.active_effects.get(finger)
        if not contact:
            self._release(finger, active, time_s)
            return
        if active is None:
            active = self.active_effects[finger] = ActiveEffects(self.scene, finger, x_m, y_m)
            emissions = active.press(time_s)
        else:
            emissions = active.move(x_m, y_m, time_s)
        self.spaced = finger if active.progress else None
        if emissions:
            self.queue.add(emissions)
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
            if finger not in self.active_effects:
                raise ConfigError(f"finger {finger} is not on the panel")
            self.queue.add(self.active_effects[finger].start(effect, amplitude, now_s, ticket))
            return
        active = ActiveEffects(self.scene, f"command {ticket}", x_m, y_m)
        emissions = active.start(effect, amplitude, now_s, ticket)
        if not active.ended:
            self.active_effects[active.owner] = active
        self.queue.add_command(emissions)

    def test_channel(self, ticket: int, channel: int, x_m: float, y_m: float, now_s: FpgaTime) -> None:
        """Have a channel tested, for a command: as an emission at the place of its actuator."""
        name = f"channel {channel}"
        emission = Emission(now_s, x_m, y_m, None, name, owner=f"command {ticket}", ticket=ticket, alternate=True, channel=channel)
        self.queue.add_command((emission,))

    def fingers_in(self, owner: int, region: str) -> tuple[int, ...]:
        """Fingers in a region, by its name: of the layer of the client with this number, else of the scene.

        Raises ConfigError if neither has a region of this name.
        """
        index = self.scene.named(owner, region)
        return tuple([one.finger for one in self.active_effects.values() if one.finger is not None and one.region == index])

    def advance(self, now_s: FpgaTime, lead_s: float = 0.0) -> None:
        """Collect the pulses of trains that are due within `lead_s`, but none before the pulse before it is due."""
        advanced = False
        for active in self.active_effects.values():
            until_s = now_s + (lead_s if lead_s < active.period_s else active.period_s)
            if active.next_s <= until_s:
                self.queue.add(active.advance(until_s))
                advanced = True
        if advanced:
            self._drop_ended()

    def add_emitters(self, now_s: FpgaTime, until_s: FpgaTime) -> None:
        """Collect the emissions of fixed emitters that are due up to `until_s`; pulses that `now_s` has passed are left out."""
        for emission in self.emitters.due(now_s, until_s):
            self.queue.add((emission,))

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

    @property
    def active(self) -> bool:
        """Whether a finger is down, or anything is due or going on."""
        return bool(self.active_effects or self.due)

    def next_s(self) -> FpgaTime:
        """When the next pulse of a train is due; inf without a train."""
        next_s = FPGA_NEVER
        for active in self.active_effects.values():
            next_s = active.next_s if active.next_s < next_s else next_s
        return next_s

    def collect_s(self, lead_s: float) -> FpgaTime:
        """When `advance` next collects a pulse; inf without a train."""
        return min([active.next_s - min(lead_s, active.period_s) for active in self.active_effects.values()], default=FPGA_NEVER)

    def started(self, emissions: Sequence[Emission], start_s: FpgaTime, apart_s: float = 0.0) -> None:
        """Report emissions as played.

        Trains whose pulse 0 is among them are shifted so that it falls on `start_s`, or their next pulses where `moved_s` has
        them; `apart_s` is its.
        """
        for emission in emissions:
            if emission.ticket:
                self._outcomes(emission.ticket, Outcome.PLAYED, start_s - emission.time_s)
            if emission.period_s and emission.pulse == 0 and emission.owner in self.active_effects:
                first_s = self._first_s(emission, emissions, start_s, apart_s)
                self.active_effects[emission.owner].shift(emission.time_s, first_s)

    def _first_s(self, begun: Emission, emissions: Sequence[Emission], start_s: FpgaTime, apart_s: float) -> FpgaTime:
        """From when on the pulses of a train are counted that has begun at `start_s`, with others of the same emissions."""
        period_s, alone, regions = begun.period_s, begun.alternate, self.scene.regions
        if self.active_effects[begun.owner].has_rhythm:
            return start_s
        together = [emission.owner for emission in emissions if emission.period_s == period_s and emission.pulse == 0]
        others_s = []
        for owner, active in self.active_effects.items():
            if active.period_s == period_s and owner not in together and not active.has_rhythm:
                others_s.append(active.next_s)
                alone = alone or (active.region != OUTSIDE and regions[active.region].alternate)
        return start_s + moved_s(start_s, period_s, others_s, apart_s, alone=alone) if others_s else start_s

    def _release(self, finger: int, active: ActiveEffects | None, now_s: FpgaTime) -> None:
        """Take note that a finger was lifted."""
        last: tuple[Emission, ...] = ()
        if active is not None:
            last = active.release(now_s)
            self._end_commands(active, Outcome.SKIPPED, now_s)
            del self.active_effects[finger]
        self.queue.add(last)
        self.queue.lifted(finger, last, now_s)

    def _end_commands(self, active: ActiveEffects, outcome: Outcome, now_s: FpgaTime) -> None:
        """Report the commands that end before their first emission."""
        for ticket, given_s in active.unplayed_commands:
            self._outcomes(ticket, outcome, now_s - given_s)

    def reset(self, now_s: FpgaTime) -> None:
        """Discard what is due or active, since the outputs went off; fingers that are down stay known, fixed emitters restart."""
        self._counters.skipped.outputs_off += self.queue.clear(Outcome.REFUSED, now_s)
        for active in self.active_effects.values():
            self._end_commands(active, Outcome.REFUSED, now_s)
            active.end_trains()
        self.active_effects = {owner: active for owner, active in self.active_effects.items() if active.finger is not None}
        self.emitters.restart(now_s)

    def change_scene(self, scene: Scene, now_s: FpgaTime) -> None:
        """Go on with another scene; fingers that are down feel it from their next move on."""
        self._counters.skipped.scene_changed += self.queue.clear(Outcome.SKIPPED, now_s)
        self.scene = scene
        for active in self.active_effects.values():
            active.change_scene(scene)
        self.emitters = FixedEmitters(scene.emitters, now_s, self._wave_scale, repeats=self._skips.repeated)

    def change_layers(self, scene: Scene) -> None:
        """Go on with other layers over the same scene: what is due stays due."""
        self.scene = scene
        for active in self.active_effects.values():
            active.change_layers(scene)

    def _drop_ended(self) -> None:
        for owner in [owner for owner, active in self.active_effects.items() if active.finger is None and active.ended]:
            del self.active_effects[owner]
