"""What a finger feels: touch samples, time and commands in, emissions out.

A finger belongs to the first region of the file that contains it. Its effects begin on these occasions (`when`):

- `press`, `release`: the finger is put down in the region, or lifted there. A finger that slides in was not pressed there.
- `enter`, `leave`: a finger that is down slides over the region's border.
- `move`: the finger has travelled `spacing_mm` inside the region, or crosses a grid line. Both count from the first report
  inside. A report that completes several gives one emission: the time between has passed.
- `always`: a `FixedEmitter`, without any finger; the loop plays it.
- `command`: `ActiveEffects.start`, for a finger or at a point.

A train begins on its occasion and follows its finger. It ends after its last pulse, when the finger is lifted and, unless it
began on `leave` or by a command, when the finger leaves the region. What one finger feels at one report is one emission, of
the largest amplitude.
"""

from __future__ import annotations

import math
from typing import Final

from controller.clocks import FPGA_NEVER, FpgaTime
from controller.device.scene.effects.clips import ClientEffect
from controller.device.scene.effects.trains import NO_PULSE, ActiveTrain, Train
from controller.device.scene.emission import Emission, new_emission, stronger
from controller.device.scene.progress import DistanceProgress, GridProgress
from controller.device.scene.region_lookup import OUTSIDE
from controller.device.scene.scene import Scene
from controller.errors import ConfigError

NO_CROSSING = (math.inf, 0.0)
COMMAND: Final = -1  # in place of a region, for a train that a command started


class ActiveEffects:
    """Effects that one finger, or one command at a point, has active; every method changes it in place.

    Each finger has one from its first sample to its last: a new object for each sample would cost as much as all the rest.
    """

    __slots__ = ("_scene", "_trains", "finger", "next_s", "owner", "period_s", "progress", "region", "x_m", "y_m")

    def __init__(self, scene: Scene, owner: int | str, x_m: float, y_m: float) -> None:
        self._scene = scene
        self.owner = owner  # number of the finger, or name of the command
        self.finger = owner if isinstance(owner, int) else None  # none for a command at a point
        self.x_m, self.y_m = x_m, y_m
        self.region = OUTSIDE  # index in the scene, or OUTSIDE
        self.next_s = FPGA_NEVER  # when the next pulse of a train is due; inf: no train is active
        self.period_s = math.inf  # least time from pulse to pulse of its trains; inf: none has several
        self._trains: list[ActiveTrain] = []
        self.progress: tuple[DistanceProgress | GridProgress, ...] = ()  # to the next emission of each spacing

    @property
    def ended(self) -> bool:
        """Whether no train is active: the effects of a command are over then."""
        return self.next_s == FPGA_NEVER

    @property
    def unplayed_commands(self) -> tuple[tuple[int, FpgaTime], ...]:
        """Commands without an emission so far: ticket, and time of the command in s."""
        return tuple([(train.ticket, train.first_s - train.train.first_s) for train in self._trains if train.ticket])

    @property
    def has_rhythm(self) -> bool:
        """Whether a train that is active has pulses of unequal spacing, which no other train can avoid."""
        return not all(train.train.rhythm == () for train in self._trains)

    def press(self, time_s: FpgaTime) -> tuple[Emission, ...]:
        """The finger is put down at its place; returns what is due now, at most one, as for every touch sample."""
        index = self._scene.lookup.at(self.x_m, self.y_m)
        if index == OUTSIDE:
            return ()
        self._enter(index)
        trains = self._scene.regions[index].press
        return _at_most_one(self._begin(trains, index, time_s, ends_on_leave=True)) if trains else ()

    def move(self, x_m: float, y_m: float, time_s: FpgaTime) -> tuple[Emission, ...]:
        """The finger that is down moves to (x_m, y_m) at `time_s`; at most one emission is due, as in `press`."""
        scene = self._scene
        index = scene.lookup.at(x_m, y_m)
        self.x_m, self.y_m = x_m, y_m
        left = self.region
        if index == left:
            amplitude = 0.0  # of the strongest spacing that is completed here
            for progress in self.progress:
                if progress.crossed(x_m, y_m) and progress.amplitude > amplitude:
                    amplitude = progress.amplitude
            if not amplitude:
                return ()
            inside = scene.regions[index]
            at = time_s, x_m, y_m, self.finger, inside.name, amplitude, self.owner, 0, 0, 0.0, inside.alternate, inside.nulled, -1
            return (new_emission(at),)
        self._enter(index)
        emission = None
        if left != OUTSIDE:
            emission = self._begin(scene.regions[left].leave, left, time_s, ends_on_leave=False)
        if index != OUTSIDE:
            emission = self._begin(scene.regions[index].enter, index, time_s, ends_on_leave=True, strongest=emission)
        return _at_most_one(emission)

    def release(self, time_s: FpgaTime) -> tuple[Emission, ...]:
        """The finger is lifted at `time_s`; at most one emission is due, as in `press`. This object is not used any more."""
        if self.region == OUTSIDE:
            return ()
        trains = self._scene.regions[self.region].release
        return _at_most_one(self._begin(trains, self.region, time_s, ends_on_leave=True)) if trains else ()

    def start(self, effect: str | ClientEffect, amplitude: float, time_s: FpgaTime, ticket: int) -> tuple[Emission, ...]:
        """A command plays an effect of the scene, by its name, or one that a client has sent; returns what is due now.

        `amplitude` is `MIN_AMPLITUDE` to 1, times the effect's own; a product below `MIN_AMPLITUDE` is played at that. `ticket` is
        returned on the first emission. Raises ConfigError if there is no effect of this name, or only a moving finger or a fixed
        emitter can have it.
        """
        if isinstance(effect, str):
            if effect not in self._scene.effects:
                playable = ", ".join(sorted(self._scene.effects))
                raise ConfigError(f"no effect {effect!r} that a command can play; there are: {playable}")
            name, train = effect, self._scene.effects[effect]
        else:
            name, train = effect
        self._add(ActiveTrain(train, time_s, COMMAND, ends_on_leave=False, gain=amplitude, effect=name, ticket=ticket))
        return self.advance(time_s)

    def advance(self, until_s: FpgaTime) -> tuple[Emission, ...]:
        """Take the pulses of trains that are due up to `until_s`.

        In order of time. Of several missed pulses of one train only the last, with its own time: the others cannot be played any
        more, and the train keeps its pulse.
        """
        if self.next_s > until_s:
            return ()
        emissions: list[Emission] = []
        for train in self._trains:
            emission = self._pulse(train, until_s)
            if emission is not None:
                emissions.append(emission)
        self._set_trains([train for train in self._trains if not train.over])
        if len(emissions) > 1:
            emissions.sort(key=lambda emission: emission.time_s)
        return tuple(emissions)

    def shift(self, first_s: FpgaTime, start_s: FpgaTime) -> None:
        """Shift trains whose pulse 0 was due at `first_s` so that it falls on the actual start `start_s`."""
        for train in self._trains:
            if train.first_s == first_s:
                train.first_s = start_s
        self._set_trains(self._trains)

    def end_trains(self) -> None:
        """End all trains, since the outputs went off; the finger's progress to its next spacing stays."""
        self._set_trains([])

    def change_scene(self, scene: Scene) -> None:
        """Go on in another scene: trains of regions end, those of commands go on."""
        self._scene = scene
        self._set_trains([train for train in self._trains if train.region == COMMAND])
        self._enter(OUTSIDE if self.finger is None else scene.lookup.at(self.x_m, self.y_m))

    def change_layers(self, scene: Scene) -> None:
        """Go on under other layers over the same scene, or layers at other places; nothing is felt of that itself.

        What a finger feels in a region goes on if it is in the region of the same owner and name afterwards.
        """
        before, left = self._scene, self.region
        self._scene = scene
        index = OUTSIDE if self.finger is None else scene.lookup.at(self.x_m, self.y_m)
        if self._trains:
            self._set_trains([train for train in self._trains if _goes_on(train, before, scene, index)])
        moved_m = scene.moved_m(before, left, index) if OUTSIDE not in (left, index) and self.progress else None
        if moved_m is None:
            self._begin_spacings(index)
            return
        self.region = index
        for progress in self.progress:
            progress.shift(*moved_m)

    def next_crossing(self, x: float, y: float) -> tuple[float, float]:
        """Distance in m to the next emission of a spacing, and its amplitude, if the finger moves along the unit vector (x, y)."""
        return min(
            [(progress.remaining_m(self.x_m, self.y_m, x, y), progress.amplitude) for progress in self.progress],
            default=NO_CROSSING,
        )

    def _enter(self, region: int) -> None:
        """Be in another region: trains that were bound to the one before end, spacings start again."""
        self._begin_spacings(region)
        if self._trains:
            self._set_trains([train for train in self._trains if not train.ends_on_leave])

    def _begin_spacings(self, region: int) -> None:
        """Be in a region, whose spacings start here."""
        self.region = region
        spacings = self._scene.regions[region].spacings if region != OUTSIDE else ()
        if spacings and self._scene.layers:
            layer, _ = self._scene.place_of(region)
            if layer is not None:
                spacings = tuple([spacing.placed(layer.placement) for spacing in spacings])
        self.progress = tuple([spacing.begin(self.x_m, self.y_m) for spacing in spacings])

    def _begin(
        self, trains: tuple[Train, ...], region: int, time_s: FpgaTime, *, ends_on_leave: bool, strongest: Emission | None = None
    ) -> Emission | None:
        """Begin trains of a region; return the strongest of the emissions that are due at once and of one found before."""
        for train in trains:
            active = ActiveTrain(train, time_s, region, ends_on_leave=ends_on_leave)
            first = self._pulse(active, time_s)
            if active.pulse < train.pulses:  # not over
                self._add(active)
            if first is not None:
                strongest = first if strongest is None else stronger(strongest, first)
        return strongest

    def _pulse(self, train: ActiveTrain, until_s: FpgaTime) -> Emission | None:
        """Last pulse of one train that is due up to a time and not silent."""
        pulse, amplitude = train.take(until_s)
        if pulse == NO_PULSE:
            return None
        name, alternate, nulled = train.effect, False, False
        if train.region != COMMAND:
            region = self._scene.regions[train.region]
            name, alternate, nulled = region.name, region.alternate, region.nulled
        period_s, ticket = train.train.period_s, train.ticket
        train.ticket = 0
        time_s = train.first_s + train.train.after_s(pulse)
        at = time_s, self.x_m, self.y_m, self.finger, name, amplitude, self.owner, ticket, pulse, period_s, alternate, nulled, -1
        return new_emission(at)

    def _add(self, train: ActiveTrain) -> None:
        self._trains.append(train)
        self.next_s = min(self.next_s, train.next_s)
        self.period_s = min(self.period_s, train.train.period_s or math.inf)

    def _set_trains(self, trains: list[ActiveTrain]) -> None:
        self._trains = trains
        self.next_s = min([train.next_s for train in trains], default=FPGA_NEVER)
        self.period_s = min([train.train.period_s or math.inf for train in trains], default=math.inf)


def _goes_on(train: ActiveTrain, before: Scene, scene: Scene, index: int) -> bool:
    """Whether a train goes on under other layers, where its finger is in the region `index`; it learns its region's new index."""
    if train.region == COMMAND:
        return True
    train.region = scene.same_region(before, train.region)
    return train.region != OUTSIDE and (train.region == index or not train.ends_on_leave)


def _at_most_one(emission: Emission | None) -> tuple[Emission, ...]:
    return () if emission is None else (emission,)
