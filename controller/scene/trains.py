"""Pulse trains: rate, phase, length and envelope of an effect, and the position of each active train."""

from __future__ import annotations

import math
from typing import Annotated, Final, NamedTuple

from msgspec import Meta

from controller.clocks import FpgaTime
from controller.scene.effects import MIN_AMPLITUDE, EffectTable

SILENCE = MIN_AMPLITUDE / 2  # an envelope below it is nearer to silence than to the weakest emission
NO_BEAT: Final = -1
MAX_BEATS: Final = 3_600_000  # an hour at the highest rate
EffectiveAmplitude = Annotated[float, Meta(ge=SILENCE, le=1)]  # of an effect in its region; played at MIN_AMPLITUDE at least
Seconds = Annotated[float, Meta(ge=0, le=3600)]


class Train(NamedTuple):
    """Emissions of equal spacing in time, as an effect defines them; a single emission is a train of one beat.

    Attributes
    ----------
    amplitude : float
        Before envelope and gain.
    beats : int
    period_s : float
        From beat to beat; 0 for a single emission.
    first_s : float
        From the start to beat 0.
    envelope : tuple of (float, float)
        Points (s from the start, amplitude), linear between, constant beyond; empty: no envelope.
    """

    amplitude: EffectiveAmplitude = 1.0
    beats: Annotated[int, Meta(ge=1, le=MAX_BEATS)] = 1
    period_s: Seconds = 0.0
    first_s: Seconds = 0.0
    envelope: Annotated[tuple[tuple[Seconds, Annotated[float, Meta(ge=0, le=1)]], ...], Meta(max_length=1000)] = ()

    def amplitude_of(self, beat: int, gain: float) -> float:
        """Amplitude of a beat: 0, or MIN_AMPLITUDE to 1, whichever is nearest to the product of train, envelope and gain."""
        factor = 1.0
        if self.envelope:
            factor = _between(self.envelope, self.first_s + beat * self.period_s)
            if factor < SILENCE:
                return 0.0
        return min(max(self.amplitude * gain * factor, MIN_AMPLITUDE), 1.0)


class ActiveTrain:
    """A train that has begun; `take` moves it on.

    Parameters
    ----------
    train : Train
    start_s : float
        When it begins; beat 0 is the train's `first_s` later.
    region : int
        Index of the region whose effect it is; below 0 for a command.
    ends_on_leave : bool
        Whether it ends when the finger leaves that region.
    gain : float
        Factor of its amplitude, 0.25 to 1.
    effect : str
        Name of the effect, for a command.
    ticket : int
        Of a command, until its first emission; else 0.

    Attributes
    ----------
    first_s : float
        Time of beat 0.
    beat : int
        Number of the next beat.
    """

    __slots__ = ("beat", "effect", "ends_on_leave", "first_s", "gain", "region", "ticket", "train")

    def __init__(
        self,
        train: Train,
        start_s: FpgaTime,
        region: int,
        *,
        ends_on_leave: bool,
        gain: float = 1.0,
        effect: str = "",
        ticket: int = 0,
    ) -> None:
        self.train = train
        self.first_s = start_s + train.first_s
        self.beat = 0
        self.gain = gain
        self.region = region
        self.ends_on_leave = ends_on_leave
        self.effect = effect
        self.ticket = ticket

    @property
    def over(self) -> bool:
        """Whether all beats are taken."""
        return self.beat >= self.train.beats

    @property
    def next_s(self) -> FpgaTime:
        """When the next beat is due."""
        return self.first_s + self.beat * self.train.period_s

    def take(self, until_s: FpgaTime) -> tuple[int, float]:
        """Take all beats that are due up to `until_s`.

        Returns
        -------
        beat : int
            Number of the last of them that is not silent; NO_BEAT if there is none.
        amplitude : float
            Its amplitude; 0 if there is none.
        """
        if self.over or until_s < self.next_s:
            return NO_BEAT, 0.0
        train, earliest, last = self.train, self.beat, self.beat
        if train.beats > last + 1 and until_s >= self.first_s + (last + 1) * train.period_s:
            last = min(math.floor((until_s - self.first_s) / train.period_s) + 1, train.beats - 1)
            while self.first_s + last * train.period_s > until_s:  # the division may round up or down
                last -= 1
        self.beat = last + 1
        for beat in range(last, earliest - 1, -1):
            amplitude = train.amplitude_of(beat, self.gain)
            if amplitude:
                return beat, amplitude
        return NO_BEAT, 0.0


def train_of(effect: EffectTable, amplitude: float = 1.0) -> Train:
    """Train of an effect, in a region of some amplitude."""
    return Train(
        effect.strength * amplitude,
        effect.emissions,
        0.0 if effect.rate_hz is None else 1 / effect.rate_hz,
        effect.first_s,
        tuple((at_ms * 1e-3, level) for at_ms, level in effect.envelope or ()),
    )


def silent(train: Train) -> bool:
    """Whether all beats of a train are silent."""
    beats = {0, train.beats - 1}
    if train.period_s:  # between two points of the envelope the loudest beats are the first and the last one there
        for at_s, _ in train.envelope:
            beat = math.floor((at_s - train.first_s) / train.period_s)
            beats |= {beat - 1, beat, beat + 1}  # the division may round up or down
    return not any(train.amplitude_of(beat, 1.0) for beat in beats if 0 <= beat < train.beats)


def _between(envelope: tuple[tuple[float, float], ...], at_s: float) -> float:
    """Amplitude of an envelope at a time: linear between its points, constant before the first and after the last."""
    before_s, before = envelope[0]
    if at_s <= before_s:
        return before
    for after_s, after in envelope:
        if at_s < after_s:
            return before + (after - before) * (at_s - before_s) / (after_s - before_s)
        before_s, before = after_s, after
    return before
