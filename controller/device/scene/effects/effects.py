"""An effect as a table of a TOML file: when it is felt, how strong, how often in time or how densely in space.

Which keys go together is in `primitives`; what stands behind a name is in `library`.
"""

from __future__ import annotations

import math
from typing import Annotated, Literal, Self

import msgspec
from msgspec import Meta

from controller.device.board.devices import MIN_AMPLITUDE
from controller.device.board.records import NotNegative, Record

ROUNDING = 1e-9
LONGEST_MS = 3.6e6  # an hour: of a train, and so of its envelope

When = Literal["press", "release", "enter", "leave", "move", "always", "command"]
Amplitude = Annotated[float, Meta(ge=MIN_AMPLITUDE, le=1)]
Rate = Annotated[float, Meta(ge=0.1, le=1000)]  # the FPGA counts periods in 32 bits of its clock
RatePoint = tuple[Annotated[float, Meta(ge=0, le=LONGEST_MS)], Rate]
EnvelopePoint = tuple[Annotated[float, Meta(ge=0, le=LONGEST_MS)], Annotated[float, Meta(ge=0, le=1)]]
MOST_PULSES = 4000  # of a rhythm: 13 s of a clip have 2,000 at the highest rate that a duty of 0.3 allows


class EffectTable(Record, frozen=True):
    """An effect: when it is felt, how strong, and how often in time or how densely in space. A key that is not given is None.

    Attributes:
    effect: Name of the effect that this one builds on.
    when: When it is felt: one occasion or several.
    amplitude: Share of the full amplitude; left out: 1.
    rate_hz: Emissions a second of a train.
    count: Emissions of a train.
    duration_ms: Length of a train, instead of `count`.
    phase: Delay of a train in periods, or offset of grid lines in spacings.
    spacing_mm: From one emission to the next as the finger moves.
    along: "path" (if left out): the spacing is of the distance travelled; "x" or "y": of grid lines across that axis, from the
        region's lower end on.
    envelope: Points [ms, amplitude] over the train; linear in between, amplitude 0 is silence.
    rate_envelope: Points [ms, Hz] of a train of changing rate, instead of `rate_hz`; linear in between, constant beyond.
    pulses: Emissions of any rhythm, [ms, amplitude] each, from the occasion on; amplitude 0 is silence.
    x_mm, y_mm: Place of a fixed emitter (`when = "always"`); left out: the region's centre.
    """

    effect: str | None = None
    when: When | tuple[When, ...] | None = None
    amplitude: Amplitude | None = None
    rate_hz: Rate | None = None
    count: Annotated[int, Meta(ge=1, le=1_000_000)] | None = None
    duration_ms: Annotated[float, Meta(gt=0, le=LONGEST_MS)] | None = None
    phase: Annotated[float, Meta(ge=0, lt=1)] | None = None
    spacing_mm: Annotated[float, Meta(ge=0.1, le=1000)] | None = None
    along: Literal["path", "x", "y"] | None = None
    envelope: Annotated[tuple[EnvelopePoint, ...], Meta(min_length=1, max_length=1000)] | None = None
    rate_envelope: Annotated[tuple[RatePoint, ...], Meta(min_length=1, max_length=1000)] | None = None
    pulses: Annotated[tuple[EnvelopePoint, ...], Meta(min_length=1, max_length=MOST_PULSES)] | None = None
    x_mm: NotNegative | None = None
    y_mm: NotNegative | None = None

    @property
    def occasions(self) -> tuple[When, ...]:
        """Occasions on which it is felt."""
        return (self.when,) if isinstance(self.when, str) else self.when or ()

    @property
    def strength(self) -> float:
        """Its amplitude; 1 if none is given."""
        return 1.0 if self.amplitude is None else self.amplitude

    @property
    def first_s(self) -> float:
        """Time from the start of a train to its first emission."""
        return 0.0 if self.rate_hz is None else (self.phase or 0.0) / self.rate_hz

    @property
    def emissions(self) -> int:
        """Number of emissions of a train; 1 without a rate."""
        if self.pulses is not None:
            return len(self.pulses)
        if self.rate_hz is None or self.duration_ms is None:
            return self.count or 1
        return math.ceil((self.duration_ms * 1e-3 - self.first_s - ROUNDING) * self.rate_hz)

    @property
    def end_ms(self) -> float:
        """Time from the start of a train to where its next emission would be, or to its given duration."""
        if self.duration_ms is not None:
            return self.duration_ms
        return 0.0 if self.rate_hz is None else (self.first_s + self.emissions / self.rate_hz) * 1e3

    def over(self, base: Self) -> Self:
        """The effect `base`, with the keys that this one gives in place of those of `base`."""
        given = {name: value for name in self.__struct_fields__ if (value := getattr(self, name)) is not None}
        given.pop("effect", None)
        if "count" in given or "duration_ms" in given:  # both give the length of the train
            base = msgspec.structs.replace(base, count=None, duration_ms=None)
        return msgspec.structs.replace(base, **given)
