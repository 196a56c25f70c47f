"""Protection of the stages in the gateware model: `stage_limits.v`, going from change to change.

What the pins will show is judged when it is planned, a whole waveform at once, and planned anew where
something cuts it short: from the plan and the state in which it begins follow its causes, the ticks
in which they are high, and the state in which it ends.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Ticks = NDArray[np.int64]
Words = NDArray[np.uint32]

SHORT_PULSE, CHANNEL_EDGES, TOTAL_EDGES, LONG_EMISSION, DUTY = (1 << bit for bit in range(5))  # of `cause_o`

CHANNELS = 32
EDGE_TICKS = 2  # from a change to what it causes: short pulse, edges of one channel
TOTAL_TICKS = 3  # the same for the edges of all
CHANNEL_EDGES_MAX = 2**24 - 1  # more counts as this
PARTS = 16  # in which edges are counted: the one that runs and those before it
_FETCH_TICKS = 3  # by which the parts of channel 0 begin later than those of all; each further channel is one later
_ALL = CHANNELS  # place of the edges of all channels, behind those of each
_PHASES: Ticks = np.array([*range(_FETCH_TICKS, _FETCH_TICKS + CHANNELS), 0])
_PLACES = np.arange(CHANNELS + 1)
FULL_FLOW = 1 << 16  # into the bucket in an active tick
BUCKET_MAX = 2**48 - 1


@dataclass
class LimitSettings:
    """What the registers say; written while the pins rest. After writing `duty_share`, call `activity` again."""

    pulse_ticks: int = 0
    channel_edges: int = 2**32 - 1
    total_edges: int = 2**32 - 1
    emission_ticks: int = 2**32 - 1
    duty_share: int = FULL_FLOW
    duty_ticks: int = 2**32 - 1


class _Counts(NamedTuple):
    """Edges of each channel and of all, in the parts that count."""

    part: Ticks  # (33,) number of the part that runs
    made: Ticks  # (PARTS, 33) edges in it and in the parts before it, by number modulo PARTS
    live: Ticks  # (33,) their sums
    until: int  # the tick in which the next part begins, whosever it is

    def at(self, tick: int, part_ticks: int) -> _Counts:
        """What counts from a later tick on."""
        if tick < self.until:
            return self
        part = (tick - _PHASES) // part_ticks
        made, live = self.made.copy(), self.live.copy()
        passed = part - self.part
        for step in range(1, min(int(passed.max()), PARTS) + 1):
            place = _PLACES[passed >= step]
            number = (self.part[place] + step) % PARTS
            live[place] -= made[number, place]
            made[number, place] = 0
        return _Counts(part, made, live, int((_PHASES + (part + 1) * part_ticks).min()))

    def after(self, edges: Ticks) -> _Counts:
        """With (33,) more edges in the parts that run."""
        made = self.made.copy()
        made[self.part % PARTS, _PLACES] += edges
        return self._replace(made=made, live=self.live + edges)


_NOTHING = np.zeros(CHANNELS + 1, np.int64)
_NO_EDGES = _Counts(_NOTHING - 1, np.zeros((PARTS, CHANNELS + 1), np.int64), _NOTHING, 0)


class _State(NamedTuple):
    """What is known of the pins before a plan."""

    word: int = 0
    last_change: int | None = None
    recent: int = 0  # channels that changed since the pins last rested
    counts: _Counts = _NO_EDGES


class _Sound(NamedTuple):
    start: int
    sounding: bool


class _Flow(NamedTuple):
    """The bucket from tick `start` on, where it holds `level`."""

    start: int
    active: bool
    level: int
    share: int

    @property
    def gain(self) -> int:
        return FULL_FLOW * self.active - self.share

    def at(self, tick: int) -> int:
        return min(max(self.level + (tick - self.start) * self.gain, 0), BUCKET_MAX)

    def above(self, limit: int) -> tuple[int, int | None]:
        """First tick and end of the stretch in which an active bucket holds more than `limit`, if nothing changes."""
        over = self.level - limit
        if self.gain > 0:
            return self.start + max(-over // self.gain + 1, 0), None
        if self.gain < 0:
            return self.start, self.start + max(-(over // self.gain), 0)
        return self.start, None if over > 0 else self.start


@dataclass
class _Plan:
    """`words[i]` on the pins from `ticks[i]` on, and what follows."""

    before: _State
    ticks: Ticks
    words: Words
    after: _State
    causes: dict[int, int] = field(default_factory=dict)  # by tick
    culprits: dict[int, int] = field(default_factory=dict)  # channels, by tick


class StageLimits:
    """`stage_limits.v`: what it sees and which causes it gives, without going through the ticks between."""

    def __init__(self, settings: LimitSettings, window_ticks: int) -> None:
        self._settings = settings
        self._part_ticks = part_ticks(window_ticks)
        self._plans: list[_Plan] = []
        self._settled = _State()
        self._culprits = 0  # of what was settled, since `clear`
        self._cleared = -1
        self._sounds = [_Sound(0, sounding=False)]
        self._flows = [_Flow(0, active=False, level=0, share=settings.duty_share)]

    def show(self, ticks: Ticks, words: Words) -> None:
        """The pins hold `words[i]` from `ticks[i]` on.

        Parameters
        ----------
        ticks : (n,) int64 array
            Strictly rising. Whatever was to be shown from `ticks[0]` on is replaced.
        words : (n,) uint32 array
            Not changed afterwards.
        """
        start = int(ticks[0])
        while self._plans and self._plans[-1].ticks[0] >= start:
            self._plans.pop()
        if self._plans and self._plans[-1].ticks[-1] >= start:
            cut = self._plans.pop()
            left = int(np.searchsorted(cut.ticks, start))
            self._plans.append(self._judge(cut.before, cut.ticks[:left], cut.words[:left]))
        before = self._plans[-1].after if self._plans else self._settled
        self._plans.append(self._judge(before, ticks, words))

    def emission(self, tick: int, *, sounding: bool) -> None:
        """From tick `tick` of the state on an emission sounds that begins there, or none."""
        while self._sounds and self._sounds[-1].start >= tick:
            self._sounds.pop()
        self._sounds.append(_Sound(tick, sounding))

    def activity(self, tick: int, *, active: bool) -> None:
        """From tick `tick` of the state on the bucket fills (playing or ramping), or only drains."""
        level = self._flow(tick).at(tick)
        while self._flows and self._flows[-1].start >= tick:
            self._flows.pop()
        self._flows.append(_Flow(tick, active, level, self._settings.duty_share))

    def next_change(self, now: int) -> int | None:
        """The first tick from `now` on in which a cause is high, if nothing else happens; None if there is none."""
        ticks = [tick for plan in self._plans for tick in plan.causes if tick >= now]
        for first, end in self._late() + self._overdrawn():
            tick = max(now, first + 1)
            if end is None or tick <= end:
                ticks.append(tick)
        return min(ticks, default=None)

    def cause(self, tick: int) -> int:
        """Bits of the causes that are high in a tick."""
        value = 0
        for plan in self._plans:
            value |= plan.causes.get(tick, 0)
        for cause, stretches in ((LONG_EMISSION, self._late()), (DUTY, self._overdrawn())):
            if any(first < tick and (end is None or tick <= end) for first, end in stretches):
                value |= cause
        return value

    def channels(self, tick: int) -> int:
        """The channels that made the first short pulse or edge too many since `clear`, as known in a tick."""
        if self._culprits:
            return self._culprits
        seen = [(at, word) for plan in self._plans for at, word in plan.culprits.items() if self._cleared < at <= tick]
        return min(seen)[1] if seen else 0

    def clear(self, tick: int) -> None:
        """Forget the channels known up to a tick."""
        self._cleared = tick
        self._culprits = 0

    def duty_level(self, tick: int) -> int:
        """Whole ticks of activity in the bucket in a tick."""
        return self._flow(tick).at(tick) >> 16

    def settle(self, tick: int) -> None:
        """Nothing will be replaced or asked any more before a tick: count it and forget it."""
        while len(self._plans) > 1 and self._plans[1].ticks[0] + TOTAL_TICKS < tick:
            self._culprits = self.channels(tick) if self._plans[0].culprits else self._culprits
            self._settled = self._plans.pop(0).after
        while len(self._sounds) > 1 and self._sounds[1].start < tick:
            self._sounds.pop(0)
        while len(self._flows) > 1 and self._flows[1].start < tick:
            self._flows.pop(0)

    def _flow(self, tick: int) -> _Flow:
        return next((flow for flow in reversed(self._flows) if flow.start <= tick), self._flows[0])

    def _late(self) -> list[tuple[int, int | None]]:
        """Stretches of ticks in which an emission has sounded too long; high one tick later."""
        ends = [sound.start for sound in self._sounds[1:]]
        stretches = [
            (sound.start + self._settings.emission_ticks, end)
            for sound, end in zip(self._sounds, [*ends, None], strict=True)
            if sound.sounding
        ]
        return [(first, end) for first, end in stretches if end is None or first < end]

    def _overdrawn(self) -> list[tuple[int, int | None]]:
        """Stretches of active ticks with more in the bucket than allowed; high one tick later."""
        stretches: list[tuple[int, int | None]] = []
        ends = [flow.start for flow in self._flows[1:]]
        for flow, last in zip(self._flows, [*ends, None], strict=True):
            first, end = flow.above(self._settings.duty_ticks << 16)
            end = last if end is None else end if last is None else min(end, last)
            if flow.active and (end is None or first < end):
                stretches.append((first, end))
        return stretches

    def _judge(self, before: _State, ticks: Ticks, words: Words) -> _Plan:
        """What follows from showing words."""
        changes = np.empty_like(words)
        changes[0] = words[0] ^ before.word
        np.bitwise_xor(words[1:], words[:-1], out=changes[1:])
        moved = changes.nonzero()[0]
        plan = _Plan(before, ticks, words, before)
        if not moved.size:
            return plan
        ticks, changes = ticks[moved], changes[moved]
        last_change, recent = self._judge_pulses(plan, ticks, changes)
        counts = before.counts
        while ticks.size:
            counts = counts.at(int(ticks[0]), self._part_ticks)
            inside = len(ticks) if ticks[-1] < counts.until else int(np.searchsorted(ticks, counts.until))
            counts = self._judge_edges(plan, ticks[:inside], changes[:inside], counts)
            ticks, changes = ticks[inside:], changes[inside:]
        plan.after = _State(int(words[-1]), last_change, recent, counts)
        return plan

    def _judge_pulses(self, plan: _Plan, ticks: Ticks, changes: Words) -> tuple[int, int]:
        """Note short pulses; the last change and the channels that changed since the pins rested."""
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
                _note(plan, tick, SHORT_PULSE, recent & change)
            recent |= change
        return last, recent

    def _judge_edges(self, plan: _Plan, ticks: Ticks, changes: Words, counts: _Counts) -> _Counts:
        """Note edges too many, while no part begins; the counts afterwards."""
        before, total = counts.live[:CHANNELS], int(counts.live[_ALL])
        limit = min(self._settings.channel_edges, CHANNEL_EDGES_MAX)
        bits = np.unpackbits(changes.astype("<u4", copy=False).view(np.uint8), bitorder="little").reshape(-1, CHANNELS)
        eights = np.add.reduceat(bits.view(np.uint64), np.arange(0, len(bits), 255))  # eight sums at once, ten times faster
        made = eights.view(np.uint8).sum(axis=0, dtype=np.int64)
        after = before + made
        edges = np.append(made, made.sum())
        if total + edges[_ALL] > self._settings.total_edges:
            totals = total + bits.sum(axis=1).cumsum()
            for tick in ticks[totals > self._settings.total_edges].tolist():
                plan.causes[tick + TOTAL_TICKS] = plan.causes.get(tick + TOTAL_TICKS, 0) | TOTAL_EDGES
        if (after > limit).any():
            too_many = bits.astype(bool) & (before + bits.cumsum(axis=0) > limit)
            words = np.packbits(too_many, axis=1, bitorder="little").view("<u4")[:, 0]
            for at in words.nonzero()[0].tolist():
                _note(plan, int(ticks[at]), CHANNEL_EDGES, int(words[at]))
            edges[:CHANNELS] = np.maximum(np.minimum(after, limit), before) - before  # what is too many is not counted
        return counts.after(edges)


def part_ticks(window_ticks: int) -> int:
    """Ticks of a part: whole rounds of a turn for each channel, so that all parts but the one that runs are a window at least."""
    return -(-window_ticks // (CHANNELS * (PARTS - 1))) * CHANNELS


def _note(plan: _Plan, tick: int, cause: int, channels: int) -> None:
    at = tick + EDGE_TICKS
    plan.causes[at] = plan.causes.get(at, 0) | cause
    plan.culprits[at] = plan.culprits.get(at, 0) | channels
