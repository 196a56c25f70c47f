"""From due emissions to an accepted play command and its start.

The plate plays one thing at a time: T of emission, then silence for as long as the duty limit asks.
A play command is prepared (uploaded, or found resident) while the emission before still sounds. It is
started by the trigger pin as soon as the plate is free, or by the FPGA itself at a time of its clock.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from controller.clocks import NEVER
from controller.errors import BankError
from controller.fpga.clock_estimate import ClockEstimate
from controller.fpga.exchange import Refused
from controller.fpga.registers import Result, Start
from controller.fpga.session import Session
from controller.loop.commands import Outcome
from controller.loop.slot_cache import SlotCache
from controller.metrics import Counters
from controller.scene.emission import Emission
from controller.waveforms.composition import Point
from controller.waveforms.selection import Key, Selection

MARGIN_S = 10e-6  # between the end of one emission and the start of the next: pin, synchroniser, rounding
HANDOVER_S = 0.2e-3  # from the end of a play command on the wire to the earliest time it may name
ENDLESS = 0
PREFETCH_AFTER_HITS = 2  # so many times in a row must have come true what was expected, before a waveform is sent ahead

Where = Callable[[int, float], tuple[float, float] | None]
"""Where a finger will be at a time of the host."""


@dataclass(frozen=True, slots=True)
class Played:
    """One start: when, where its foci are, and its repetition (count 0: until replaced).

    `at_ticks` is the clock of the FPGA at which it starts, where the FPGA was given one; else the trigger pin rose.
    """

    trigger_s: float
    emissions: tuple[Emission, ...]
    count: int
    period_s: float
    resident: bool
    at_ticks: int | None = None


class Attempt(NamedTuple):
    """What became of a batch of emissions.

    Attributes
    ----------
    outcome : Outcome
        PLAYED: the FPGA has accepted it. SKIPPED: the bank lacks what it needs. REFUSED: by the FPGA.
    start_s : float
        FPGA time at which it starts: to the clock if the FPGA starts it, else as expected. NaN if it was not accepted.
    started : bool
        Whether it has started, or is started by the FPGA; otherwise `Playback.trigger` starts it.
    """

    outcome: Outcome
    start_s: float = math.nan
    started: bool = False


@dataclass(frozen=True, slots=True)
class _Repetition:
    """An endless repetition, in FPGA time, in which it keeps its period for hours."""

    first_s: float
    period_s: float

    def last_s(self, at_s: float) -> float:
        """When the emission began that sounds, or sounded last, at a time after the first."""
        return self.first_s + math.floor((at_s - self.first_s) / self.period_s) * self.period_s


@dataclass(slots=True)
class _Prepared:
    """An accepted play command, and what it took."""

    emissions: Sequence[Emission]
    points: Sequence[Point]
    count: int
    period_s: float
    resident: bool
    ready_s: float
    start_s: float  # in host time
    at_ticks: int | None
    decide_ns: int
    frame_ns: int
    wire_ns: int


class Playback:
    """The FPGA's slots and what plays from them.

    Parameters
    ----------
    session : Session
        An armed FPGA.
    selection : Selection
        Drive words for points.
    clock_estimate : ClockEstimate
        The FPGA's clock.
    where : callable
        Place of a finger at a time: an emission meets it where it will be at T.
    slots : int
        Waveforms that the FPGA keeps.
    duration_s, max_duty : float
        T, and the share of the time that may be emission.
    upload_s, command_s : float
        Time on the wire of an upload with its play command, and of a play command alone.
    counters : Counters
        Where emissions, latencies and skipped work are counted.
    played : callable or None
        Told of every start.
    """

    def __init__(
        self,
        session: Session,
        selection: Selection,
        clock_estimate: ClockEstimate,
        where: Where,
        *,
        slots: int,
        duration_s: float,
        max_duty: float,
        upload_s: float,
        command_s: float,
        counters: Counters,
        played: Callable[[Played], None] | None = None,
    ) -> None:
        self.free_s = -NEVER  # when the plate may play again
        self.last_start_s = -NEVER  # of the newest play; until then no other is handed over, or plays would pile up
        self.duration_s = duration_s
        self.upload_s = upload_s
        self._session = session
        self._selection = selection
        self._clock_estimate = clock_estimate
        self._where = where
        self._command_s = command_s
        self._nominal_s = duration_s
        self._max_duty = max_duty
        self._busy_s = duration_s / max_duty
        self._counters = counters
        self._played = played
        self._slots = SlotCache(slots, selection.single_focus)
        self._latest: int | None = None  # slot of the last play
        self._expected: tuple[int, Key] | None = None  # who is to be played next, and what
        self._prefetch_hits = 0  # of what was expected, in a row
        self._ahead: set[int] = set()  # slots whose waveform was sent ahead, and not played so far
        self._prepared: _Prepared | None = None
        self._running: _Repetition | None = None
        self._free_fpga_s = -NEVER  # `free_s` in the FPGA's time; what was started there is known there to the clock

    @property
    def trigger_at_s(self) -> float | None:
        """When `trigger` is due; None while nothing waits for it."""
        return None if self._prepared is None else self._prepared.start_s

    @property
    def repeating(self) -> bool:
        """Whether the FPGA repeats an emission by itself, or is about to."""
        return self._running is not None or (self._prepared is not None and self._prepared.count == ENDLESS)

    def free_after_next_s(self, now_s: float) -> float:
        """When the plate and the wire are free for a beat, if something else is uploaded now and played before it."""
        start_s = max(now_s + self.upload_s, self.free_s + MARGIN_S)
        return start_s + max(self._busy_s, self.upload_s + HANDOVER_S) + 2 * MARGIN_S

    def next_repetition_s(self, at_s: float) -> float:
        """When the endless repetition next starts an emission, after a time; never without one."""
        if self._running is None:
            return NEVER
        next_s = self._clock_estimate.host_s(self._running.last_s(self._clock_estimate.fpga_s(at_s)) + self._running.period_s)
        return max(next_s, self.last_start_s)  # before the first it is that, whatever was rounded on the way

    def stop_repeating(self, now_s: float) -> float | None:
        """End the endless repetition; when its last emission began, or None if its first one has yet to."""
        running = self._running
        if running is None or now_s < self.last_start_s:
            return None
        self.stop()
        return self._clock_estimate.host_s(running.last_s(self._clock_estimate.fpga_s(self._session.earliest_trigger_s())))

    def prepare(
        self,
        emissions: Sequence[Emission],
        started_ns: int,
        *,
        count: int = 1,
        period_s: float = 0.0,
        at_s: float | None = None,
        ahead: bool = True,
    ) -> Attempt:
        """Bring one emission, of one or several foci, to an accepted play command.

        Parameters
        ----------
        emissions : sequence of Emission
            What is due; several are composed into one waveform. Those of a finger are moved to where it will be at T.
        started_ns : int
            When the work for it began (perf_counter_ns).
        count, period_s
            Repetitions by the FPGA, start to start; count 0 repeats until replaced.
        at_s : float, optional
            FPGA time at which the FPGA shall start it by itself, or as soon after as can be.
        ahead : bool
            Meet fingers where they will be. Where the bank has nothing there, they are met where they were.

        Returns
        -------
        Attempt
        """
        decided_ns = time.perf_counter_ns()
        session, wire_before_ns, blocked_before_ns = self._session, self._session.wire_ns, self._session.blocked_ns
        for wire_s in (self._command_s, self.upload_s):  # an upload starts later, and so meets a finger elsewhere
            start_s = self._start_s(wire_s, at_s)
            points = self._aim(emissions, start_s, ahead)
            key = self._selection.key(points)
            resident = self._slots.find(key)
            if resident is not None:  # there, too, something may be resident: never is a key looked up but not this one
                break
        if self._expected is not None and any(emission.finger == self._expected[0] for emission in emissions):
            self._prefetch_hits = self._prefetch_hits + 1 if self._foreseen(emissions[0].finger, key) else 0
            self._expected = None
        start = Start.TRIGGER if at_s is None else Start.TIME
        when_ticks = 0 if at_s is None else self._clock_estimate.ticks(start_s)
        try:
            if resident is None:
                self._upload(key, count, period_s, start, when_ticks)
            else:
                self._play(resident, count, period_s, start, when_ticks)
                self._counters.near += resident != key
        except BankError as error:
            if ahead and any(emission.finger is not None for emission in emissions):
                return self.prepare(emissions, started_ns, count=count, period_s=period_s, at_s=at_s, ahead=False)
            self._counters.skipped.bad_entries += len(emissions)
            self._counters.bad_entry = self._counters.bad_entry or str(error)
            return Attempt(Outcome.SKIPPED)
        except Refused as refusal:
            if at_s is not None and refusal.result is Result.TOO_LATE:
                self._counters.late += 1
                return self.prepare(emissions, started_ns, count=count, period_s=period_s)
            if resident is not None and refusal.result is Result.SLOT_DAMAGED:  # its slot is dropped: sent anew
                return self.prepare(emissions, started_ns, count=count, period_s=period_s, at_s=at_s, ahead=ahead)
            self._counters.skipped.refused += len(emissions)
            return Attempt(Outcome.REFUSED)
        ready_s = session.earliest_trigger_s()
        blocked_ns = session.blocked_ns - blocked_before_ns
        prepared = _Prepared(
            emissions,
            points,
            count,
            period_s,
            resident is not None,
            ready_s,
            max(ready_s, self.free_s + MARGIN_S) if at_s is None else self._clock_estimate.host_s(start_s),
            None if at_s is None else when_ticks,
            decided_ns - started_ns,
            time.perf_counter_ns() - decided_ns - blocked_ns,
            session.wire_ns - wire_before_ns,
        )
        if at_s is not None:
            self._counters.scheduled += 1
            self._account(prepared, prepared.start_s, 0)
            return Attempt(Outcome.PLAYED, when_ticks / self._clock_estimate.clock_hz, True)
        self._prepared = prepared
        at_once = prepared.start_s <= ready_s
        if at_once:
            self.trigger()
        return Attempt(Outcome.PLAYED, self._clock_estimate.fpga_s(prepared.start_s), at_once)

    def prefetch(self, finger: int, x_m: float, y_m: float, amplitude: float) -> bool:
        """Send ahead the waveform of a point at which a finger is expected to be played next, if that is certain enough.

        How certain is told by the record of what was expected before, sent or not: PREFETCH_AFTER_HITS in a row have come true.

        Returns
        -------
        bool
            Whether it was sent; not if it is there already, or cannot be had.
        """
        key = self._selection.key(((x_m, y_m, amplitude),))
        if self._expected is not None and not self._foreseen(finger, key):
            self._prefetch_hits = 0
        self._expected = finger, key
        if self._prefetch_hits < PREFETCH_AFTER_HITS or self._slots.slots == 1 or self._slots.find(key) is not None:
            return False
        try:
            words = self._selection.words(key)
            slot = self._take()
            self._session.upload(slot, words, self._selection.crc(key, words))
        except (BankError, Refused):
            return False
        self._slots.keep(key, slot)
        self._ahead.add(slot)
        self._counters.prefetched += 1
        self._counters.prefetch_wasted += 1  # until it is played
        return True

    def _foreseen(self, finger: int | None, key: Key) -> bool:
        """Whether this is what was expected last: a waveform sent for that serves for this."""
        assert self._expected is not None
        expected_of, expected = self._expected
        return finger == expected_of and (key == expected or self._selection.reusable(key, expected))

    def pin(self, points: Sequence[tuple[float, float, float]]) -> None:
        """Keep the waveforms of these points (x_m, y_m, amplitude) in their slots once they are there."""
        self._slots.pin(self._selection.key((point,)) for point in points)

    def stretch(self, factor: float) -> None:
        """Emissions last this much longer than the board says: the bit clock follows the plate's temperature."""
        self.duration_s = self._nominal_s * factor
        self._busy_s = self.duration_s / self._max_duty

    def reselect(self, selection: Selection) -> None:
        """Play from another bank: nothing that is resident serves any more."""
        self._selection = selection
        self._slots = SlotCache(self._slots.slots, selection.single_focus)
        self._ahead.clear()

    def stop(self) -> None:
        """End an endless repetition with the emission that sounds, or before its first one.

        Raises
        ------
        LinkError, FaultError
            As the session says.
        """
        if self._running is not None:
            self._session.stop()
            self._stopped()

    def trigger(self) -> None:
        """Play what is prepared, now."""
        prepared = self._prepared
        if prepared is None:
            return
        self._prepared = None
        called_ns, blocked_ns = time.perf_counter_ns(), self._session.blocked_ns
        trigger_s = self._session.trigger()
        self._account(prepared, trigger_s, time.perf_counter_ns() - called_ns - (self._session.blocked_ns - blocked_ns))

    def forget(self) -> None:
        """Take it that the FPGA holds and plays nothing: after a fault."""
        self._slots.forget()
        self._ahead.clear()
        if self._prepared is not None:
            self._counters.skipped.outputs_off += len(self._prepared.emissions)
        self._prepared = None
        self._running = None
        self.free_s = self.last_start_s = self._free_fpga_s = -NEVER

    def _start_s(self, wire_s: float, at_s: float | None) -> float:
        """When, in FPGA time, an emission can start whose command begins to go out now."""
        arrived_s = self._clock_estimate.fpga_s(self._session.earliest_trigger_s() + wire_s)
        if at_s is not None:
            arrived_s += HANDOVER_S
        free_s = self._free_fpga_s
        if self._running is not None:  # it is stopped by the command: what it has begun by then sounds to its end
            free_s = max(free_s, self._running.last_s(arrived_s) + self._busy_s)
        start_s = max(arrived_s, free_s + MARGIN_S)
        return start_s if at_s is None else max(start_s, at_s)

    def _aim(self, emissions: Sequence[Emission], start_s: float, ahead: bool) -> list[Point]:
        """Where each emission meets its finger, at T or where it was, and how strong it is."""
        focus_s = self._clock_estimate.host_s(start_s) + self.duration_s
        points = []
        for emission in emissions:
            place = None if emission.finger is None or not ahead else self._where(emission.finger, focus_s)
            x_m, y_m = (emission.x_m, emission.y_m) if place is None else place
            points.append((x_m, y_m, emission.amplitude))
        return points

    def _play(self, resident: Key, count: int, period_s: float, start: Start, when_ticks: int) -> None:
        """Have a resident waveform accepted for playing."""
        slot = self._slots.use(resident)
        stop = self._running is not None
        try:
            self._session.play(slot, count, period_s, stop=stop, start=start, when_ticks=when_ticks)
        except Refused as refusal:
            if refusal.result is Result.SLOT_DAMAGED:
                self._slots.drop(slot)
            raise
        finally:
            self._stopped()
        self._latest = slot
        if slot in self._ahead:
            self._ahead.remove(slot)
            self._counters.prefetch_wasted -= 1

    def _upload(self, key: Key, count: int, period_s: float, start: Start, when_ticks: int) -> None:
        """Put a waveform into the slot that was played longest ago, and have it accepted for playing."""
        words = self._selection.words(key)
        if isinstance(key, int):
            self._counters.skipped.compositions += 1
        slot, crc = self._take(), self._selection.crc(key, words)
        stop = self._running is not None
        try:
            self._session.upload_and_play(slot, words, count, period_s, stop=stop, start=start, when_ticks=when_ticks, crc=crc)
        except Refused as refusal:
            if refusal.result is Result.SLOT_DAMAGED:
                self._selection.recheck(key)
            raise
        finally:
            self._stopped()
        self._latest = slot
        self._slots.keep(key, slot)

    def _take(self) -> int:
        """A slot to send a waveform to; not that of the play before, which sounds, waits or is repeated, while there is another."""
        slot = self._slots.take(self._latest)
        self._ahead.discard(slot)
        return slot

    def _stopped(self) -> None:
        """A repetition was told to stop, whatever became of the play behind: it ends with the emission that sounds now."""
        if self._running is not None:
            clock_estimate = self._clock_estimate
            last_s = self._running.last_s(clock_estimate.fpga_s(self._session.earliest_trigger_s()))
            self._free_fpga_s = max(self._free_fpga_s, last_s + self._busy_s)
            self.free_s = max(self.free_s, clock_estimate.host_s(last_s) + clock_estimate.error_s + self._busy_s)
            self._running = None

    def _account(self, prepared: _Prepared, start_s: float, trigger_ns: int) -> None:
        """Something starts: the plate is busy, and it is counted."""
        clock_estimate = self._clock_estimate
        self.last_start_s = start_s
        if prepared.at_ticks is None:
            fpga_s = clock_estimate.fpga_s(start_s)
            self.free_s = start_s + self._busy_s
            self._free_fpga_s = fpga_s + self._busy_s + clock_estimate.error_s
        else:
            fpga_s = prepared.at_ticks / clock_estimate.clock_hz
            self.free_s = start_s + self._busy_s + clock_estimate.error_s
            self._free_fpga_s = fpga_s + self._busy_s
        counters = self._counters
        counters.emissions += 1
        counters.foci += len(prepared.emissions)
        stages = counters.resident_latency if prepared.resident else counters.upload_latency
        wait_ns = round((start_s - prepared.ready_s) * 1e9)
        stages.record(prepared.decide_ns, prepared.frame_ns, prepared.wire_ns, wait_ns, trigger_ns)
        if prepared.resident:
            counters.resident += 1
            counters.skipped.uploads += 1
        else:
            counters.uploads += 1
        if prepared.count == ENDLESS:
            self._running = _Repetition(fpga_s, self._session.timing.actual_period_s(prepared.period_s))
        if self._played is not None:
            aimed = tuple(
                [e._replace(x_m=x_m, y_m=y_m) for e, (x_m, y_m, _) in zip(prepared.emissions, prepared.points, strict=True)]
            )
            self._played(Played(start_s, aimed, prepared.count, prepared.period_s, prepared.resident, prepared.at_ticks))
