"""From due emissions to an accepted play command and its trigger.

The plate plays one thing at a time: T of emission, then silence for as long as the duty limit asks.
A play command is prepared (uploaded, or found resident) while the emission before still sounds,
and triggered when the plate is free.
"""

from __future__ import annotations

import math
import time
from collections import OrderedDict
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from controller.bank.selection import Key, Selection
from controller.errors import BankError
from controller.fpga.exchange import Refused
from controller.fpga.session import Session
from controller.latency import Counters
from controller.scene import Emission

NEVER = math.inf
MARGIN_S = 10e-6  # between the end of one emission and the trigger of the next: pin, synchroniser, rounding
ENDLESS = 0


@dataclass(frozen=True, slots=True)
class Played:
    """One trigger: when it rose, where its foci are, and its repetition (count 0: until replaced)."""

    trigger_s: float
    emissions: tuple[Emission, ...]
    count: int
    period_s: float
    resident: bool

    def last_start_s(self, at_s: float) -> float:
        """When the emission of a repetition began that sounds, or sounded last, at a time after the trigger."""
        return self.trigger_s + math.floor((at_s - self.trigger_s) / self.period_s) * self.period_s


@dataclass(frozen=True, slots=True)
class _Prepared:
    """An accepted play command that waits for the plate to be free."""

    emissions: tuple[Emission, ...]
    count: int
    period_s: float
    resident: bool
    ready_s: float
    trigger_at_s: float
    host_ns: int
    wire_ns: int


class Playback:
    """The FPGA's slots and what plays from them.

    Parameters
    ----------
    session : Session
        An armed FPGA.
    selection : Selection
        Drive words for points.
    slots : int
        Waveforms that the FPGA keeps.
    duration_s, max_duty : float
        T, and the share of the time that may be emission.
    counters : Counters
        Where emissions, latencies and skipped work are counted.
    played : callable or None
        Told of every trigger; for simulations. None on the device.
    """

    def __init__(
        self,
        session: Session,
        selection: Selection,
        *,
        slots: int,
        duration_s: float,
        max_duty: float,
        counters: Counters,
        played: Callable[[Played], None] | None = None,
    ) -> None:
        self.free_s = -NEVER  # when the plate may play again
        self._session = session
        self._selection = selection
        self.duration_s = duration_s
        self._busy_s = duration_s / max_duty
        self._counters = counters
        self._played = played
        self._slots = slots
        self._slot_of: OrderedDict[Key | str, int] = OrderedDict()  # least recently played first
        self._prepared: _Prepared | None = None
        self._running: Played | None = None  # an endless repetition
        self.forget_slots()

    @property
    def trigger_at_s(self) -> float | None:
        """When `trigger` is due; None while nothing is prepared."""
        return None if self._prepared is None else self._prepared.trigger_at_s

    @property
    def repeating(self) -> bool:
        """Whether the FPGA repeats an emission by itself, or is about to."""
        return self._running is not None or (self._prepared is not None and self._prepared.count == ENDLESS)

    def next_repetition_s(self, at_s: float) -> float:
        """When the endless repetition next starts an emission, after a time; never without one."""
        return NEVER if self._running is None else self._running.last_start_s(at_s) + self._running.period_s

    def prepare(
        self, emissions: Sequence[Emission], started_ns: int, *, count: int = 1, period_s: float = 0.0, not_before_s: float = -NEVER
    ) -> bool:
        """Bring one emission, of one or several foci, to an accepted play command; False if it had to be left out.

        Parameters
        ----------
        emissions : sequence of Emission
            What is due now; several are composed into one waveform.
        started_ns : int
            When the work for it began (perf_counter_ns).
        count, period_s
            Repetitions by the FPGA, start to start; count 0 repeats until replaced.
        not_before_s
            Earliest time of the trigger.
        """
        away_ns, wire_ns = self._session.away_ns, self._session.wire_ns
        key = self._selection.key([(e.x_m, e.y_m, e.amplitude) for e in emissions])
        resident = key in self._slot_of
        running = self._running
        try:
            if resident:
                self._session.play(self._slot_of[key], count, period_s, stop=running is not None)
                self._slot_of.move_to_end(key)
            else:
                self._upload(key, count, period_s)
        except BankError as error:
            self._counters.skipped.bad_entries += 1
            self._counters.bad_entry = self._counters.bad_entry or str(error)
            return False
        except Refused:
            self._counters.skipped.refused += 1
            return False
        ready_s = self._session.ready_s()
        if running is not None:  # stopped at the latest after the emission that sounds now
            self.free_s = max(self.free_s, running.last_start_s(ready_s) + self._busy_s)
            self._running = None
        host_ns = time.perf_counter_ns() - started_ns - (self._session.away_ns - away_ns)
        trigger_at_s = max(ready_s, self.free_s + MARGIN_S, not_before_s)
        self._prepared = _Prepared(
            tuple(emissions), count, period_s, resident, ready_s, trigger_at_s, host_ns, self._session.wire_ns - wire_ns
        )
        if trigger_at_s <= ready_s:
            self.trigger(time.perf_counter_ns())
        return True

    def _upload(self, key: Key, count: int, period_s: float) -> None:
        """Put a waveform into the slot that was played longest ago, and have it accepted for playing."""
        words = self._selection.words(key)
        if isinstance(key, int):
            self._counters.skipped.compositions += 1
        _, slot = self._slot_of.popitem(last=False)
        try:
            self._session.upload_and_play(slot, words, count, period_s, stop=self._running is not None)
        except Refused:
            self._slot_of[_empty(slot)] = slot
            self._slot_of.move_to_end(_empty(slot), last=False)
            raise
        self._slot_of[key] = slot

    def trigger(self, started_ns: int) -> None:
        """Play what is prepared, now."""
        prepared = self._prepared
        if prepared is None:
            return
        self._prepared = None
        host_ns = prepared.host_ns + time.perf_counter_ns() - started_ns
        trigger_s = self._session.trigger()
        self.free_s = trigger_s + self._busy_s
        counters = self._counters
        counters.emissions += 1
        stages = counters.resident_latency if prepared.resident else counters.upload_latency
        stages.record(host_ns, round((trigger_s - prepared.ready_s) * 1e9), prepared.wire_ns)
        if prepared.resident:
            counters.resident += 1
            counters.skipped.uploads += 1
        else:
            counters.uploads += 1
        played = Played(trigger_s, prepared.emissions, prepared.count, prepared.period_s, prepared.resident)
        if prepared.count == ENDLESS:
            self._running = played
        if self._played is not None:
            self._played(played)

    def forget_slots(self) -> None:
        """Take it that the FPGA holds and plays nothing: at the start, and after a fault."""
        self._slot_of.clear()
        self._slot_of.update((_empty(slot), slot) for slot in range(self._slots))
        self._prepared = None
        self._running = None


def _empty(slot: int) -> str:
    return f"empty {slot}"
