"""Limits of activity in the gateware model: settings of all limits, length of an emission, and duty by a leaky bucket.

The bucket gains a full flow in every active tick (playing or ramping) and loses the allowed share in every tick.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final, NamedTuple

BUCKET_MAX = 2**48 - 1
SHORT_PULSE, CHANNEL_EDGES, TOTAL_EDGES, LONG_EMISSION, DUTY = (1 << bit for bit in range(5))  # of `cause_o`
DUTY_FULL_FLOW: Final = 1 << 16  # into the duty bucket in an active tick


class _Emission(NamedTuple):
    start: int
    playing: bool


class _Flow(NamedTuple):
    """The bucket from tick `start` on, at which it holds `level`."""

    start: int
    active: bool
    level: int
    share: int

    @property
    def gain(self) -> int:
        return DUTY_FULL_FLOW * self.active - self.share

    def at(self, tick: int) -> int:
        return min(max(self.level + (tick - self.start) * self.gain, 0), BUCKET_MAX)

    def above(self, limit: int) -> tuple[int, int | None]:
        """First tick and end of the interval in which an active bucket holds more than `limit`, if nothing changes."""
        over = self.level - limit
        if self.gain > 0:
            return self.start + max(-over // self.gain + 1, 0), None
        if self.gain < 0:
            return self.start, self.start + max(-(over // self.gain), 0)
        return self.start, None if over > 0 else self.start


class ActivityLimits:
    """When an emission is too long or the duty too high, computed from the ticks at which activity changes."""

    def __init__(self, settings: LimitSettings) -> None:
        self._settings = settings
        self._emissions = [_Emission(0, playing=False)]
        self._flows = [_Flow(0, active=False, level=0, share=settings.duty_share)]

    def emission(self, tick: int, *, playing: bool) -> None:
        """Note that an emission begins in `tick` (`playing`), or that none plays from then on; replaces later notes."""
        while self._emissions and self._emissions[-1].start >= tick:
            self._emissions.pop()
        self._emissions.append(_Emission(tick, playing))

    def activity(self, tick: int, *, active: bool) -> None:
        """Note whether the bucket fills from `tick` on (`active`: playing or ramping); replaces later notes."""
        level = self._flow(tick).at(tick)
        while self._flows and self._flows[-1].start >= tick:
            self._flows.pop()
        self._flows.append(_Flow(tick, active, level, self._settings.duty_share))

    def next_change(self, now: int) -> int | None:
        """First tick from `now` on in which a cause is high, if nothing else changes; None if there is none."""
        ticks = []
        for first, end in self._too_long() + self._over_duty():
            tick = max(now, first + 1)
            if end is None or tick <= end:
                ticks.append(tick)
        return min(ticks, default=None)

    def cause(self, tick: int) -> int:
        """LONG_EMISSION and DUTY, as far as they are high in `tick`."""
        value = 0
        for cause, intervals in ((LONG_EMISSION, self._too_long()), (DUTY, self._over_duty())):
            if any(first < tick and (end is None or tick <= end) for first, end in intervals):
                value |= cause
        return value

    def duty_level(self, tick: int) -> int:
        """Content of the bucket in `tick`, in whole ticks of activity."""
        return self._flow(tick).at(tick) >> 16

    def settle(self, tick: int) -> None:
        """Drop what only concerns ticks before `tick`, which will not be asked for any more."""
        while len(self._emissions) > 1 and self._emissions[1].start < tick:
            self._emissions.pop(0)
        while len(self._flows) > 1 and self._flows[1].start < tick:
            self._flows.pop(0)

    def _flow(self, tick: int) -> _Flow:
        return next((flow for flow in reversed(self._flows) if flow.start <= tick), self._flows[0])

    def _too_long(self) -> list[tuple[int, int | None]]:
        """Intervals in which an emission has played too long; the cause is high one tick later."""
        ends = [emission.start for emission in self._emissions[1:]]
        intervals = [
            (emission.start + self._settings.emission_ticks, end)
            for emission, end in zip(self._emissions, [*ends, None], strict=True)
            if emission.playing
        ]
        return [(first, end) for first, end in intervals if end is None or first < end]

    def _over_duty(self) -> list[tuple[int, int | None]]:
        """Intervals in which an active bucket holds more than allowed; the cause is high one tick later."""
        intervals: list[tuple[int, int | None]] = []
        ends = [flow.start for flow in self._flows[1:]]
        for flow, last in zip(self._flows, [*ends, None], strict=True):
            first, end = flow.above(self._settings.duty_ticks << 16)
            end = last if end is None else end if last is None else min(end, last)
            if flow.active and (end is None or first < end):
                intervals.append((first, end))
        return intervals


@dataclass
class LimitSettings:
    """Values of the limit registers, written while nothing plays. After writing `duty_share`, call `StageLimits.activity`."""

    pulse_ticks: int = 0
    channel_edges: int = 2**32 - 1
    total_edges: int = 2**32 - 1
    emission_ticks: int = 2**32 - 1
    duty_share: int = DUTY_FULL_FLOW
    duty_ticks: int = 2**32 - 1
