"""Protection of the stages in the gateware model: `stage_limits.v`, going from change to change.

The words that the pins will show are checked as a whole waveform when they are planned, and again when a later event cuts the
plan short. From a plan and the state before it follow the causes, the ticks in which they are high, and the state after it.
"""

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from controller.arrays import Words
from controller.device.fpga.registers import CHANNELS
from controller.workshop.gateware.model.activity_limits import (
    CHANNEL_EDGES,
    SHORT_PULSE,
    TOTAL_EDGES,
    ActivityLimits,
    LimitSettings,
)
from controller.workshop.gateware.model.edge_counts import ALL, COUNTED_TICKS, NO_EDGES, EdgeCounts, Ticks, part_ticks, turn

PULSE_TICKS = 2  # from a change to its cause: short pulse
TOTAL_TICKS = 3  # the same for the edges of all channels
TURN_TICKS = 3  # from the turn of a channel to its cause: edges of one channel
LATEST_TICKS = COUNTED_TICKS + CHANNELS - 1 + TURN_TICKS  # from a change to its last cause


class _State(NamedTuple):
    """State of the pins before a plan."""

    word: int = 0
    last_change: int | None = None
    recent: int = 0  # channels that changed since the last pause of `pulse_ticks`
    counts: EdgeCounts = NO_EDGES


@dataclass
class _Plan:
    """`words[i]` on the pins from `ticks[i]` on, with the causes that follow."""

    before: _State
    ticks: Ticks
    words: Words
    after: _State
    causes: dict[int, int] = field(default_factory=dict)  # by tick
    channels: dict[int, int] = field(default_factory=dict)  # channels, by tick


class StageLimits:
    """`stage_limits.v`: the causes it reports for what the pins show, without stepping through the ticks between changes.

    Edges are counted over `window_ticks`.
    """

    def __init__(self, settings: LimitSettings, window_ticks: int) -> None:
        self._settings = settings
        self._part_ticks = part_ticks(window_ticks)
        self._plans: list[_Plan] = []
        self._settled = _State()
        self._channels = 0  # of settled plans, since `clear`
        self._cleared = -1
        self._activity = ActivityLimits(settings)

    def show(self, ticks: Ticks, words: Words) -> None:
        """Plan that the pins hold `words[i]` from `ticks[i]` on.

        Ticks (n,) are strictly increasing; what was planned from the first on is replaced. Words (n,) must not be changed
        afterwards.
        """
        start = int(ticks[0])
        while self._plans and self._plans[-1].ticks[0] >= start:
            self._plans.pop()
        if self._plans and self._plans[-1].ticks[-1] >= start:
            cut = self._plans.pop()
            left = int(np.searchsorted(cut.ticks, start))
            self._plans.append(self._check(cut.before, cut.ticks[:left], cut.words[:left]))
        before = self._plans[-1].after if self._plans else self._settled
        self._plans.append(self._check(before, ticks, words))

    def emission(self, tick: int, *, playing: bool) -> None:
        """Note that an emission begins in `tick` (`playing`), or that none plays from then on."""
        self._activity.emission(tick, playing=playing)

    def activity(self, tick: int, *, active: bool) -> None:
        """Note whether the duty bucket fills from `tick` on (`active`: playing or ramping), or only drains."""
        self._activity.activity(tick, active=active)

    def next_change(self, now: int) -> int | None:
        """First tick from `now` on in which a cause is high, if nothing else changes; None if there is none."""
        ticks = [tick for plan in self._plans for tick in plan.causes if tick >= now]
        activity = self._activity.next_change(now)
        return min(ticks if activity is None else [*ticks, activity], default=None)

    def next_excess_edge(self, now: int) -> int | None:
        """First tick from `now` on in which an edge made before is found to be one too many; None if there is none."""
        edges = CHANNEL_EDGES | TOTAL_EDGES
        return min(
            (tick for plan in self._plans for tick, cause in plan.causes.items() if tick >= now and cause & edges), default=None
        )

    def cause(self, tick: int) -> int:
        """Bits of the causes that are high in `tick`."""
        value = self._activity.cause(tick)
        for plan in self._plans:
            value |= plan.causes.get(tick, 0)
        return value

    def channels(self, tick: int) -> int:
        """Channels of the first short pulse or excess edge since `clear`, as known in `tick`."""
        if self._channels:
            return self._channels
        first = min((at for plan in self._plans for at in plan.channels if self._cleared < at <= tick), default=None)
        word = 0
        if first is not None:
            for plan in self._plans:
                word |= plan.channels.get(first, 0)
        return word

    def clear(self, tick: int) -> None:
        """Clear the channels known up to `tick`."""
        self._cleared = tick
        self._channels = 0

    def duty_level(self, tick: int) -> int:
        """Content of the duty bucket in `tick`, in whole ticks of activity."""
        return self._activity.duty_level(tick)

    def settle(self, tick: int) -> None:
        """Drop plans before `tick`, which will not be replaced or asked for any more."""
        while len(self._plans) > 1 and self._plans[1].ticks[0] + LATEST_TICKS < tick:
            self._channels = self.channels(tick) if self._plans[0].channels else self._channels
            self._settled = self._plans.pop(0).after
        self._activity.settle(tick)

    def _check(self, before: _State, ticks: Ticks, words: Words) -> _Plan:
        """The plan of showing words after the state `before`."""
        changes = np.empty_like(words)
        changes[0] = words[0] ^ before.word
        np.bitwise_xor(words[1:], words[:-1], out=changes[1:])
        moved = changes.nonzero()[0]
        plan = _Plan(before, ticks, words, before)
        if not moved.size:
            return plan
        ticks, changes = ticks[moved], changes[moved]
        last_change, recent = self._check_pulses(plan, ticks, changes)
        counts = before.counts
        while ticks.size:
            counts = counts.at(int(ticks[0]), self._part_ticks)
            inside = len(ticks) if ticks[-1] < counts.until else int(np.searchsorted(ticks, counts.until))
            counts = self._check_edges(plan, ticks[:inside], changes[:inside], counts)
            ticks, changes = ticks[inside:], changes[inside:]
        plan.after = _State(int(words[-1]), last_change, recent, counts)
        return plan

    def _check_pulses(self, plan: _Plan, ticks: Ticks, changes: Words) -> tuple[int, int]:
        """Record short pulses; the last change and the channels that changed since the last pause."""
        last, pulse_ticks = int(ticks[-1]), self._settings.pulse_ticks
        close = np.empty(len(ticks), bool)
        close[0] = plan.before.last_change is not None and ticks[0] - plan.before.last_change < pulse_ticks
        np.less(ticks[1:] - ticks[:-1], pulse_ticks, out=close[1:])
        if not close.any():
            return last, int(changes[-1])
        recent = plan.before.recent
        for tick, change, too_close in zip(ticks.tolist(), changes.tolist(), close.tolist(), strict=True):
            recent = recent if too_close else 0
            if recent & change:
                _note(plan, tick + PULSE_TICKS, SHORT_PULSE, recent & change)
            recent |= change
        return last, recent

    def _check_edges(self, plan: _Plan, ticks: Ticks, changes: Words, counts: EdgeCounts) -> EdgeCounts:
        """Record excess edges, within which no part begins; the counts afterwards."""
        before, total = counts.live[:CHANNELS], int(counts.live[ALL])
        limit = self._settings.channel_edges
        bits = np.unpackbits(changes.astype("<u4", copy=False).view(np.uint8), bitorder="little").reshape(-1, CHANNELS)
        eights = np.add.reduceat(bits.view(np.uint64), np.arange(0, len(bits), 255))  # eight byte sums at once: ten times faster
        made = eights.view(np.uint8).sum(axis=0, dtype=np.int64)
        after = before + made
        edges = np.append(made, made.sum())
        if total + edges[ALL] > self._settings.total_edges:
            totals = total + bits.sum(axis=1).cumsum()
            for tick in ticks[totals > self._settings.total_edges].tolist():
                plan.causes[tick + TOTAL_TICKS] = plan.causes.get(tick + TOTAL_TICKS, 0) | TOTAL_EDGES
        if (after > limit).any():
            too_many = bits.astype(bool) & (before + bits.cumsum(axis=0) > limit)
            for at, channel in np.argwhere(too_many).tolist():
                _note(plan, turn(int(ticks[at]), channel) + TURN_TICKS, CHANNEL_EDGES, 1 << channel)
        return counts.after(edges)


def _note(plan: _Plan, at: int, cause: int, channels: int) -> None:
    plan.causes[at] = plan.causes.get(at, 0) | cause
    plan.channels[at] = plan.channels.get(at, 0) | channels
