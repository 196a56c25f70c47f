"""Emissions that are due and not yet played. Every command that plays an effect gets exactly one outcome."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Final

from controller.clocks import FpgaTime
from controller.device.loop.commands import Outcome
from controller.device.loop.playing.batching import select_batch
from controller.device.scene.emission import Emission
from controller.metrics import Counters

MAX_WAITING_COMMANDS: Final = 32  # if more wait, the oldest is skipped
MAX_DEFERRAL_S: Final = 10e-3  # a single emission waits this long for the pulses of trains
COMMAND_MERGE_RADIUS_M: Final = 1e-3  # of commands for one effect nearer to each other than this, the newer replaces the older

Owner = int | str
Confirmed = Callable[[int], bool]
Outcomes = Callable[[int, Outcome, float], None]
"""Called with a ticket, what became of it, and the age of the command in s."""


class DueEmissions:
    """Emissions to be played: the newest of each owner."""

    def __init__(
        self,
        counters: Counters,
        confirmed: Confirmed,  # whether the panel has confirmed the finger of this number
        max_unconfirmed: int,  # emissions that a finger gets before it is confirmed
        outcomes: Outcomes,  # called with what became of each command
        max_foci: int,  # of one waveform
        wave_scale: float,
    ) -> None:
        self.by_owner: dict[Owner, Emission] = {}  # in the order in which the owners began to wait
        self._counters = counters
        self._confirmed = confirmed
        self._max_unconfirmed = max_unconfirmed
        self._outcomes = outcomes
        self._max_foci = max_foci
        self._wave_scale = wave_scale
        self._unlimited: set[int] = set()  # fingers known to be confirmed
        self._emission_counts: dict[int, int] = {}  # emissions so far of each of the others

    def add(self, emissions: tuple[Emission, ...]) -> None:
        """Have emissions wait; one takes the place of what waits of its owner."""
        self._counters.due += len(emissions)
        for emission in emissions:
            finger = emission.finger
            if finger is not None and finger not in self._unlimited and not self._may_have_another(finger):
                self._counters.skipped.unconfirmed += 1
                self.discarded([emission], Outcome.SKIPPED, emission.time_s)
                continue
            before = self.by_owner.get(emission.owner)
            if before is not None:
                self._counters.skipped.merged += 1
                self.discarded([before], Outcome.MERGED, emission.time_s)
            self.by_owner[emission.owner] = emission

    def add_command(self, emissions: tuple[Emission, ...]) -> None:
        """Have emissions of a command at a point wait; one for the place of another replaces it."""
        self._make_room(emissions)
        self.add(emissions)

    def next_batch(self, duration_s: float, now_s: FpgaTime) -> list[Emission]:
        """Take what is played next, as one waveform; the rest stays due. A pulse of a train goes before a single emission.

        Emissions that are due within `duration_s` of the first are played with it.
        """
        if len(self.by_owner) == 1:
            chosen = list(self.by_owner.values())
            self.by_owner.clear()
        else:
            due = tuple(self.by_owner.values())
            if not due[0].period_s and now_s - due[0].time_s < MAX_DEFERRAL_S and not all(map(_has_no_pulse, due)):
                due = tuple(sorted(due, key=_has_no_pulse))
            first, rest = select_batch(due, duration_s, self._max_foci, self._wave_scale)
            chosen = list(first)
            self.by_owner.clear()
            for emission in rest:
                self.by_owner[emission.owner] = emission
        return chosen

    def lifted(self, finger: int, last: tuple[Emission, ...], now_s: FpgaTime) -> None:
        """Discard what is due for a finger that was lifted, but for the emissions of its release."""
        waiting = self.by_owner.get(finger)
        if waiting is not None and waiting not in last:
            del self.by_owner[finger]
            self._counters.skipped.lifted += 1
            self.discarded([waiting], Outcome.SKIPPED, now_s)
        self._emission_counts.pop(finger, None)  # after the emissions of its release were counted
        self._unlimited.discard(finger)

    def clear(self, outcome: Outcome, now_s: FpgaTime) -> int:
        """Discard all; returns how many there were."""
        waiting = list(self.by_owner.values())
        self.by_owner.clear()
        self.discarded(waiting, outcome, now_s)
        return len(waiting)

    def discarded(self, emissions: Sequence[Emission], outcome: Outcome, now_s: FpgaTime) -> None:
        """Report emissions that will not be played; `outcome` says why."""
        for emission in emissions:
            if emission.ticket:
                self._outcomes(emission.ticket, outcome, now_s - emission.time_s)

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
            waiting = [e for owner, e in self.by_owner.items() if isinstance(owner, str) and e.ticket]
            for old in waiting:
                if old.region == new.region and math.dist((old.x_m, old.y_m), (new.x_m, new.y_m)) < COMMAND_MERGE_RADIUS_M:
                    del self.by_owner[old.owner]
                    self._counters.skipped.merged += 1
                    self.discarded([old], Outcome.MERGED, new.time_s)
                    break
            else:
                if len(waiting) >= MAX_WAITING_COMMANDS:
                    oldest = min(waiting, key=lambda e: e.time_s)
                    del self.by_owner[oldest.owner]
                    self._counters.skipped.no_room += 1
                    self.discarded([oldest], Outcome.SKIPPED, new.time_s)


def _has_no_pulse(emission: Emission) -> bool:
    return emission.period_s == 0
