"""Emissions in time: trains with their rate, phase, end and envelope, and where each one under way has come to. Pure."""

from __future__ import annotations

import math
from typing import Annotated, NamedTuple

from msgspec import Meta

from controller.scene.effects import WEAKEST, EffectTable

SILENT = WEAKEST / 2  # an envelope below it is nearer to silence than to the weakest emission
NO_BEAT = -1
MOST_BEATS = 3_600_000  # an hour at the highest rate
Loudness = Annotated[float, Meta(ge=SILENT, le=1)]
Seconds = Annotated[float, Meta(ge=0, le=3600)]


class Train(NamedTuple):
    """Emissions of equal spacing; a lone emission is a train of one. `envelope`: (s from the start, amplitude)."""

    amplitude: Loudness = 1.0
    beats: Annotated[int, Meta(ge=1, le=MOST_BEATS)] = 1
    period_s: Seconds = 0.0
    first_s: Seconds = 0.0
    envelope: Annotated[tuple[tuple[Seconds, Annotated[float, Meta(ge=0, le=1)]], ...], Meta(max_length=1000)] = ()

    def loudness(self, beat: int, share: float) -> float:
        """Amplitude of a beat: 0, or WEAKEST to 1, whichever is nearest to the product of train, envelope and share."""
        factor = 1.0
        if self.envelope:
            factor = _between(self.envelope, self.first_s + beat * self.period_s)
            if factor < SILENT:
                return 0.0
        return min(max(self.amplitude * share * factor, WEAKEST), 1.0)


class Running:
    """A train under way. It moves on as its beats are taken.

    Attributes
    ----------
    first_s : float
        Time of beat 0.
    beat : int
        The next one.
    share : float
        What its amplitude is multiplied by.
    area : int
        Region whose effect it is; below 0 for a command's.
    bound : bool
        Whether it ends when the finger leaves that region.
    effect : str
        Its name, for a command.
    ticket : int
        Of a command that has not been felt yet, else 0.
    """

    __slots__ = ("area", "beat", "bound", "effect", "first_s", "share", "ticket", "train")

    def __init__(
        self, train: Train, start_s: float, area: int, *, bound: bool, share: float = 1.0, effect: str = "", ticket: int = 0
    ) -> None:
        self.train = train
        self.first_s = start_s + train.first_s
        self.beat = 0
        self.share = share
        self.area = area
        self.bound = bound
        self.effect = effect
        self.ticket = ticket

    @property
    def over(self) -> bool:
        """Whether all beats are taken."""
        return self.beat >= self.train.beats

    @property
    def next_s(self) -> float:
        """When the next beat is due."""
        return self.first_s + self.beat * self.train.period_s

    def take(self, until_s: float) -> tuple[int, float]:
        """Take all beats due up to a time.

        Returns
        -------
        beat : int
            The last of them that is not silent; NO_BEAT if there is none.
        amplitude : float
            Its amplitude.
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
            amplitude = train.loudness(beat, self.share)
            if amplitude:
                return beat, amplitude
        return NO_BEAT, 0.0


def train_of(effect: EffectTable, amplitude: float = 1.0) -> Train:
    """What an effect plays when its time has come, in a region of some amplitude."""
    return Train(
        effect.strength * amplitude,
        effect.emissions,
        0.0 if effect.rate_hz is None else 1 / effect.rate_hz,
        effect.first_s,
        tuple((at_ms * 1e-3, level) for at_ms, level in effect.envelope or ()),
    )


def silent(train: Train) -> bool:
    """Whether all beats of a train are silent."""
    return not any(train.loudness(beat, 1.0) for beat in range(train.beats))


def _between(envelope: tuple[tuple[float, float], ...], at_s: float) -> float:
    """Linear between the points of an envelope, level before the first and after the last."""
    before_s, before = envelope[0]
    if at_s <= before_s:
        return before
    for after_s, after in envelope:
        if at_s < after_s:
            return before + (after - before) * (at_s - before_s) / (after_s - before_s)
        before_s, before = after_s, after
    return before
