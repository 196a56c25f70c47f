"""Pulse trains: rate, phase, length and envelope of an effect, or pulses of any rhythm, and the position of each active train."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Annotated, Final, NamedTuple

from msgspec import Meta

from controller.clocks import FpgaTime
from controller.device.board.devices import MIN_AMPLITUDE
from controller.device.scene.effects.effects import MOST_PULSES, EffectTable
from controller.device.scene.effects.rhythms import SILENCE, between, rhythm_of

NO_PULSE: Final = -1
MAX_PULSES: Final = 3_600_000  # an hour at the highest rate
EffectiveAmplitude = Annotated[float, Meta(ge=SILENCE, le=1)]  # of an effect in its region; played at MIN_AMPLITUDE at least
Seconds = Annotated[float, Meta(ge=0, le=3600)]


Point = tuple[Seconds, Annotated[float, Meta(ge=0, le=1)]]
RARE_S: Final = 3600.0  # in place of a period, of one pulse that has a time of its own


class Train(NamedTuple):
    """Emissions as an effect defines them: of equal spacing in time, or of a rhythm; a single emission is a train of one pulse."""

    amplitude: EffectiveAmplitude = 1.0  # before envelope and gain
    pulses: Annotated[int, Meta(ge=1, le=MAX_PULSES)] = 1
    period_s: Seconds = 0.0  # from pulse to pulse, of a rhythm the least; 0 for a single emission
    first_s: Seconds = 0.0  # from the start to pulse 0
    # Points (s from the start, amplitude), linear between, constant beyond; empty: no envelope
    envelope: Annotated[tuple[Point, ...], Meta(max_length=1000)] = ()
    # Each pulse (s from the start, amplitude), in order of time; empty: they are of equal spacing
    rhythm: Annotated[tuple[Point, ...], Meta(max_length=MOST_PULSES)] = ()

    @property
    def rate_hz(self) -> float:
        """Pulses a second while it lasts; 0 for one pulse."""
        if self.rhythm:
            return (self.pulses - 1) / self.after_s(self.pulses - 1) if self.pulses > 1 else 0.0
        return 1 / self.period_s if self.period_s else 0.0

    def after_s(self, pulse: int) -> float:
        """Time of a pulse after pulse 0."""
        if self.rhythm:
            return self.rhythm[min(pulse, self.pulses - 1)][0] - self.first_s
        return pulse * self.period_s

    def amplitude_of(self, pulse: int, gain: float) -> float:
        """Amplitude of a pulse: 0, or MIN_AMPLITUDE to 1, whichever is nearest to the product of train, envelope and gain."""
        factor = 1.0
        if self.envelope:
            factor = between(self.envelope, self.first_s + pulse * self.period_s)
        elif self.rhythm:
            factor = self.rhythm[pulse][1]
        if factor < SILENCE:
            return 0.0
        return min(max(self.amplitude * gain * factor, MIN_AMPLITUDE), 1.0)


class ActiveTrain:
    """A train that has begun; `take` moves it on."""

    __slots__ = ("effect", "ends_on_leave", "first_s", "gain", "pulse", "region", "ticket", "train")

    def __init__(
        self,
        train: Train,
        start_s: FpgaTime,  # when it begins; pulse 0 is the train's `first_s` later
        region: int,  # index of the region whose effect it is; below 0 for a command
        *,
        ends_on_leave: bool,  # whether it ends when the finger leaves that region
        gain: float = 1.0,  # factor of its amplitude, `MIN_AMPLITUDE` to 1
        effect: str = "",  # name of the effect, for a command
        ticket: int = 0,  # of a command, until its first emission; else 0
    ) -> None:
        self.train = train
        self.first_s = start_s + train.first_s  # time of pulse 0
        self.pulse = 0  # number of the next pulse
        self.gain = gain
        self.region = region
        self.ends_on_leave = ends_on_leave
        self.effect = effect
        self.ticket = ticket

    @property
    def over(self) -> bool:
        """Whether all pulses are taken."""
        return self.pulse >= self.train.pulses

    @property
    def next_s(self) -> FpgaTime:
        """When the next pulse is due."""
        return self.first_s + self.train.after_s(self.pulse)

    def take(self, until_s: FpgaTime) -> tuple[int, float]:
        """Take all pulses that are due up to `until_s`.

        Returns the number of the last of them that is not silent, NO_PULSE if there is none, and its amplitude, 0 if there is none.
        """
        if self.over or until_s < self.next_s:
            return NO_PULSE, 0.0
        train, earliest, last = self.train, self.pulse, self.pulse
        if train.rhythm:
            while last + 1 < train.pulses and self.first_s + train.after_s(last + 1) <= until_s:
                last += 1
        elif train.pulses > last + 1 and until_s >= self.first_s + (last + 1) * train.period_s:
            last = min(math.floor((until_s - self.first_s) / train.period_s) + 1, train.pulses - 1)
            while self.first_s + last * train.period_s > until_s:  # the division may round up or down
                last -= 1
        self.pulse = last + 1
        for pulse in range(last, earliest - 1, -1):
            amplitude = train.amplitude_of(pulse, self.gain)
            if amplitude:
                return pulse, amplitude
        return NO_PULSE, 0.0


def train_of(effect: EffectTable, amplitude: float = 1.0) -> Train:
    """Train of an effect, in a region of some amplitude."""
    if rhythm := tuple((at_ms * 1e-3, level) for at_ms, level in rhythm_of(effect) if level >= SILENCE):
        least_s = min([after[0] - before[0] for before, after in pairwise(rhythm)], default=RARE_S)
        return Train(effect.strength * amplitude, len(rhythm), least_s, rhythm[0][0], (), rhythm)
    return Train(
        effect.strength * amplitude,
        effect.emissions,
        0.0 if effect.rate_hz is None else 1 / effect.rate_hz,
        effect.first_s,
        tuple((at_ms * 1e-3, level) for at_ms, level in effect.envelope or ()),
    )


def silent(train: Train) -> bool:
    """Whether all pulses of a train are silent."""
    pulses = {0, train.pulses - 1} if not train.rhythm else set(range(train.pulses))
    if train.period_s:  # between two points of the envelope the loudest pulses are the first and the last one there
        for at_s, _ in train.envelope:
            pulse = math.floor((at_s - train.first_s) / train.period_s)
            pulses |= {pulse - 1, pulse, pulse + 1}  # the division may round up or down
    return not any(train.amplitude_of(pulse, 1.0) for pulse in pulses if 0 <= pulse < train.pulses)
