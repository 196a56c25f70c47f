"""From a batch of emissions to an accepted play command and its start.

A play command is prepared (its waveform uploaded, or found resident) while the emission before still sounds. It is
started by the trigger pin as soon as the plate is free, or by the FPGA itself at a time of its clock.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence

from controller.clocks import FpgaTime
from controller.errors import BankError
from controller.fpga.clock_estimate import ClockEstimate
from controller.fpga.exchange import DAMAGED, Refused
from controller.fpga.frames import ReadyFrames
from controller.fpga.registers import Result, Start
from controller.fpga.session import Session
from controller.log import Event, log
from controller.loop.commands import Outcome
from controller.loop.host_timing import DeliveryTime, HostTiming
from controller.loop.occupancy import MARGIN_S, Occupancy, Repetition
from controller.loop.prefetch import PrefetchRecord
from controller.loop.records import ENDLESS, Accepted, Attempt, Batch, Plan, Played
from controller.loop.skips import ALL, Skips
from controller.loop.slot_cache import SlotCache
from controller.metrics import Counters
from controller.scene.emission import Emission
from controller.waveforms.composition import Point
from controller.waveforms.selection import QUIET, Key, Selection

Locate = Callable[[int, float], tuple[float, float] | None]
"""Where a finger will be at a time of the host, (x_m, y_m); None if it is not down."""

Down = Callable[[], Sequence[int]]
"""Numbers of the fingers that are down."""


def _nobody() -> tuple[int, ...]:
    return ()


class Playback:
    """The slots of an armed FPGA, and what plays from them.

    Parameters
    ----------
    session : Session
        An armed FPGA.
    selection : Selection
        Drive words for points.
    clock_estimate : ClockEstimate
        The FPGA's clock on the host's.
    occupancy : Occupancy
        When the plate is free.
    locate : callable
        Where a finger will be: an emission is focused where its finger is when the focus forms.
    down : callable, optional
        Which fingers are down: others than those that are played for may be kept still.
    slots : int
        Waveforms that the FPGA keeps.
    timing : HostTiming
        How long uploads and play commands take on this host; told of each.
    counters : Counters
        Counts emissions, latencies and skipped work.
    played : callable, optional
        Called with every start.
    skips : Skips
        What of the work may be left out.

    Attributes
    ----------
    occupancy : Occupancy
    timing : HostTiming
    accepted : Accepted or None
        What `trigger` is to start.
    repeating : bool
        Whether the FPGA repeats an emission by itself, or will once it is started.
    """

    def __init__(
        self,
        session: Session,
        selection: Selection,
        clock_estimate: ClockEstimate,
        occupancy: Occupancy,
        locate: Locate,
        *,
        down: Down = _nobody,
        slots: int,
        timing: HostTiming,
        counters: Counters,
        played: Callable[[Played], None] | None = None,
        skips: Skips = ALL,
    ) -> None:
        self._skips = skips
        self.occupancy = occupancy
        self.accepted: Accepted | None = None
        self.repeating = False
        self.timing = timing
        self._session = session
        self._selection = selection
        self._clock_estimate = clock_estimate
        self._locate = locate
        self._down = down
        self._counters = counters
        self._played = played
        self._slots = self._new_slots(slots)
        self._prefetch = PrefetchRecord(counters)
        self._last_slot: int | None = None  # of the newest play
        self._lost = 0  # times that an emission was found not to have begun
        session.never_began = self._never_began

    @property
    def reuse_m(self) -> float:
        """As `Selection.reuse_m`."""
        return self._selection.reuse_m

    def stop_repeating(self, now_s: float) -> float | None:
        """End the endless repetition; host time at which its last emission began, or None if its first one has yet to."""
        repetition = self.occupancy.repetition
        if repetition is None or now_s < self.occupancy.last_start_s:
            return None
        self.stop()
        return self._clock_estimate.host_s(repetition.last_s(self._clock_estimate.fpga_s(self._session.earliest_trigger_s())))

    def prepare(self, batch: Batch, started_ns: int, *, predicted: bool = True, points: list[Point] | None = None) -> Attempt:
        """Have a batch accepted for playing, and start it if the plate is free.

        Parameters
        ----------
        batch : Batch
        started_ns : int
            When the work for it began (perf_counter_ns).
        predicted : bool
            Meet fingers where they will be. Where the bank has nothing there, they are met where they were.
        points : list of Point, optional
            Where to focus, if that has been decided.

        Raises
        ------
        LinkError, FaultError
            As the session says; nothing is left to play then.
        """
        decided_ns = time.perf_counter_ns()
        session, wire_before_ns, blocked_before_ns = self._session, self._session.link.wire_ns, self._session.link.blocked_ns
        emissions, repetitions, period_s, at_s = batch.emissions, batch.repetitions, batch.period_s, batch.at_s
        begun_s = session.earliest_trigger_s()
        plan = self._plan(batch, begun_s, predicted, points)
        if self._prefetch.predicted is not None:
            self._prefetch.compare(emissions, plan.key, self._selection)
        start, start_ticks = Start.TRIGGER, 0
        if plan.missed:
            self._counters.late += 1
            at_s = None
        elif at_s is not None:
            start, start_ticks = Start.TIME, self._clock_estimate.ticks(plan.start_s)
        try:
            if plan.resident is None:
                self._upload(plan.key, repetitions, period_s, start, start_ticks)
            else:
                self._play(plan.resident, repetitions, period_s, start, start_ticks)
                self._counters.near += plan.resident != plan.key
        except BankError as error:
            if predicted and any(emission.finger is not None for emission in emissions):
                return self.prepare(batch, started_ns, predicted=False)
            self._counters.skipped.bad_entries += len(emissions)
            self._counters.bad_entry = self._counters.bad_entry or str(error)
            return Attempt(Outcome.SKIPPED)
        except Refused as refusal:
            if at_s is not None and refusal.result is Result.TOO_LATE:
                self._counters.late += 1
                self._arrived(begun_s, plan)
                arriving = Batch(emissions, repetitions, period_s, None, batch.has_begun)
                return self.prepare(arriving, started_ns, points=plan.points)  # its waveform is resident now
            if plan.resident is not None and refusal.result is Result.SLOT_DAMAGED:  # its slot was dropped: uploaded again
                return self.prepare(batch, started_ns, predicted=predicted)
            self._counters.skipped.refused += len(emissions)
            return Attempt(Outcome.REFUSED)
        ready_s = self._arrived(begun_s, plan)
        blocked_ns = session.link.blocked_ns - blocked_before_ns
        accepted = Accepted(
            batch,
            plan,
            ready_s,
            max(ready_s, self.occupancy.free_s + MARGIN_S) if at_s is None else plan.start_s - self._clock_estimate.offset_s,
            None if at_s is None else start_ticks,
            decided_ns - started_ns,
            time.perf_counter_ns() - decided_ns - blocked_ns,
            session.link.wire_ns - wire_before_ns,
        )
        self.repeating = repetitions == ENDLESS
        if at_s is not None:
            self._counters.scheduled += 1
            self._started(accepted, accepted.start_s, 0)
            return Attempt(Outcome.PLAYED, accepted.start_s, self._clock_estimate.fpga_s_of(start_ticks), True)
        self.accepted = accepted
        at_once = accepted.start_s <= ready_s
        attempt = Attempt(Outcome.PLAYED, accepted.start_s, accepted.start_s + self._clock_estimate.offset_s, at_once)
        if at_once:
            self.trigger()
        return attempt

    def prefetch(self, finger: int, x_m: float, y_m: float, amplitude: float, *, steady: bool = True, fingers: int = 1) -> bool:
        """Upload the waveform of a predicted emission without playing it, if predictions have come true of late.

        Parameters
        ----------
        finger : int
        x_m, y_m, amplitude : float
            Predicted focus.
        steady : bool
            The finger's last report was where it had been predicted: it has not turned or stopped.
        fingers : int
            Fingers that are down: what one asks for may be composed with what another does.

        Returns
        -------
        bool
            Whether it was sent: not if it is resident already, or the bank or the FPGA cannot serve it.

        Raises
        ------
        LinkError, FaultError
            As the session says.
        """
        key = self._selection.key(((x_m, y_m, amplitude),))
        if not (self._skips.ahead and self._skips.resident):
            return False
        likely = self._prefetch.predict(finger, key, self._selection, fingers)
        if not likely or not steady or self._slots.slots == 1 or self._slots.find(key) is not None:
            return False
        try:
            waveform = self._selection.waveform(key)
            slot = self._take()
            try:
                self._session.upload(slot, waveform)
            except Refused as refusal:
                self._recheck(key, refusal)
                raise
        except (BankError, Refused):
            return False
        self._slots.keep(key, slot)
        self._prefetch.sent(slot)
        return True

    def pin(self, points: Sequence[Point]) -> None:
        """Keep the waveforms of these points (x_m, y_m, amplitude) in their slots once they are there."""
        self._slots.pin(self._selection.key((point,)) for point in points)

    def change_bank(self, selection: Selection) -> None:
        """Play from another bank: nothing that is resident serves any more."""
        self._selection = selection
        self._slots = self._new_slots(self._slots.slots)
        self._prefetch.unplayed.clear()

    def stop(self) -> None:
        """End an endless repetition with the emission that sounds, or before its first one.

        Raises
        ------
        LinkError, FaultError
            As the session says.
        """
        if self.occupancy.repetition is not None:
            self._session.stop()
            self._stopped()

    def trigger(self) -> None:
        """Start what was accepted, now.

        Raises
        ------
        LinkError
            If the trigger line cannot be driven.
        """
        accepted = self.accepted
        if accepted is None:
            return
        self.accepted = None
        called_ns, blocked_ns = time.perf_counter_ns(), self._session.link.blocked_ns
        trigger_s = self._session.trigger()
        self._started(accepted, trigger_s, time.perf_counter_ns() - called_ns - (self._session.link.blocked_ns - blocked_ns))

    def reset(self) -> None:
        """The FPGA holds and plays nothing: after a fault."""
        self._slots.clear()
        self._prefetch.unplayed.clear()
        if self.accepted is not None:
            self._counters.skipped.outputs_off += len(self.accepted.batch.emissions)
        self.accepted = None
        self.repeating = False
        self.occupancy.reset()

    def _never_began(self, repeats: bool) -> None:
        """What was started last has not begun in the FPGA, which repeats an emission or not: spots begin anew."""
        if self.occupancy.repetition is not None and not repeats:
            self.occupancy.repetition = None
            self.repeating = False
        self._lost += 1
        if not self._lost & (self._lost - 1):  # at powers of two
            link = self._counters.link
            log(
                f"{self._lost} emissions so far never began: triggers that the FPGA did not see {link.triggers_lost}, that started "
                f"nothing {link.triggers_ignored}, not of this host {link.triggers_stray}, times missed {link.plays_missed}",
                Event.EMISSIONS_LOST,
            )

    def _plan(self, batch: Batch, begun_s: float, predicted: bool, points: list[Point] | None) -> Plan:
        """Where and when a batch can be played: as a play command alone if that is enough, else with an upload before it.

        An upload starts later, and so meets a moving finger elsewhere: there another waveform may be resident.
        """
        start_s, missed = self._start(batch, begun_s, self.timing.command)
        aimed = self._aim(batch.emissions, start_s, predicted) if points is None else points
        quiet = False
        for emission in batch.emissions:
            quiet = quiet or emission.quiet
        key = self._quiet_key(aimed, batch.emissions, start_s) if quiet else self._selection.key(aimed)
        resident = self._slots.find(key)
        if resident is None:
            start_s, missed = self._start(batch, begun_s, self.timing.upload)
            later = self._aim(batch.emissions, start_s, predicted) if points is None else points
            if later != aimed or quiet:
                aimed = later
                key = self._quiet_key(aimed, batch.emissions, start_s) if quiet else self._selection.key(aimed)
                resident = self._slots.find(key)
        return Plan(aimed, key, resident, start_s, missed)

    def _start(self, batch: Batch, begun_s: float, delivery: DeliveryTime) -> tuple[FpgaTime, bool]:
        """Earliest start of what begins to go out now; whether that misses a beat, which is played on arrival then."""
        at_s = batch.at_s
        if at_s is None or not batch.has_begun:
            arrived_s = begun_s + (delivery.expected_s if at_s is None else delivery.promised_s) + self._clock_estimate.offset_s
            return self.occupancy.earliest_start_s(arrived_s, at_s), False
        arrived_s = begun_s + delivery.expected_s + self._clock_estimate.offset_s
        start_s = max(self.occupancy.free_from_s(arrived_s), at_s)
        return (arrived_s, True) if arrived_s > start_s else (start_s, False)

    def _arrived(self, begun_s: float, plan: Plan) -> float:
        """Take note that what was sent has arrived, and how long that took; host time."""
        ready_s = self._session.earliest_trigger_s()
        if plan.resident is None:
            self.timing.uploaded(ready_s - begun_s)
        else:
            self.timing.command.record(ready_s - begun_s)
        return ready_s

    def _aim(self, emissions: Sequence[Emission], start_s: FpgaTime, predicted: bool) -> list[Point]:
        """Where the focus of each emission is to be, and its amplitude."""
        focus_s = start_s - self._clock_estimate.offset_s + self.occupancy.duration_s
        points = []
        for emission in emissions:
            place = self._locate(emission.finger, focus_s) if emission.finger is not None and predicted else None
            x_m, y_m = (emission.x_m, emission.y_m) if place is None else place
            points.append((x_m, y_m, emission.amplitude))
        return points

    def _quiet_key(self, points: list[Point], emissions: Sequence[Emission], start_s: FpgaTime) -> Key:
        """Key of a waveform that keeps all other fingers still where they will be."""
        focus_s = start_s - self._clock_estimate.offset_s + self.occupancy.duration_s
        felt_by = [emission.finger for emission in emissions]
        places = [self._locate(finger, focus_s) for finger in self._down() if finger not in felt_by]
        return self._selection.quiet_key(points, [place for place in places if place is not None])

    def _play(self, resident: Key, count: int, period_s: float, start: Start, start_ticks: int) -> None:
        """Have a resident waveform accepted for playing."""
        slot = self._slots.use(resident)
        stop = self.occupancy.repetition is not None
        try:
            self._session.play(slot, count, period_s, stop=stop, start=start, when_ticks=start_ticks)
        except Refused as refusal:
            if refusal.result is Result.SLOT_DAMAGED:
                self._slots.drop(slot)
            raise
        finally:
            if self.repeating:
                self._stopped()
        self._last_slot = slot
        if slot in self._prefetch.unplayed:
            self._prefetch.played(slot)

    def _upload(self, key: Key, count: int, period_s: float, start: Start, start_ticks: int) -> None:
        """Put a waveform into the slot that was played longest ago, and have it accepted for playing."""
        waveform = self._selection.waveform(key)
        if isinstance(waveform, ReadyFrames):
            self._counters.skipped.compositions += 1
            self._counters.composed_beforehand += not isinstance(key, int)
        elif not isinstance(key, int) and key[-1][2] == QUIET:
            self._counters.kept_still += 1
        slot = self._take()
        stop = self.occupancy.repetition is not None
        try:
            self._session.upload_and_play(slot, waveform, count, period_s, stop=stop, start=start, when_ticks=start_ticks)
        except Refused as refusal:
            self._recheck(key, refusal)
            if refusal.result is Result.TOO_LATE:  # stored, not played
                self._slots.keep(key, slot)
            raise
        finally:
            if self.repeating:
                self._stopped()
        self._last_slot = slot
        self._slots.keep(key, slot)

    def _recheck(self, key: Key, refusal: Refused) -> None:
        """Ask the bank about an upload that the FPGA found damaged, frame by frame or as a whole: it may come from the file."""
        if refusal.result in DAMAGED or refusal.result is Result.SLOT_DAMAGED:
            self._selection.recheck(key)

    def _new_slots(self, slots: int) -> SlotCache:
        near_m = self.reuse_m if self._skips.near else -1.0
        return SlotCache(slots, self._selection.single_focus, near_m, self._skips.resident)

    def _take(self) -> int:
        """A slot to upload to: not that of the newest play, which sounds, waits or is repeated, while there is another."""
        slot = self._slots.take(self._last_slot)
        self._prefetch.unplayed.discard(slot)
        return slot

    def _stopped(self) -> None:
        """The FPGA was told to end its repetition, whatever became of the play behind."""
        if self.occupancy.repetition is not None:
            self.occupancy.stop_repetition(self._session.earliest_trigger_s())
        self.repeating = False

    def _started(self, accepted: Accepted, start_s: float, trigger_ns: int) -> None:
        """Count a start, and what it took."""
        batch, plan = accepted.batch, accepted.plan
        emissions, count, period_s = batch.emissions, batch.repetitions, batch.period_s
        ticks, resident = accepted.start_ticks, plan.resident is not None
        fpga_s = start_s + self._clock_estimate.offset_s if ticks is None else self._clock_estimate.fpga_s_of(ticks)
        self.occupancy.started(start_s, fpga_s, by_clock=ticks is not None)
        counters = self._counters
        counters.emissions += 1
        counters.foci += len(emissions)
        stages = counters.resident_latency if resident else counters.upload_latency
        wait_ns = round((start_s - accepted.ready_s) * 1e9)
        stages.record(accepted.decide_ns, accepted.frame_ns, accepted.wire_ns, wait_ns, trigger_ns)
        if resident:
            counters.resident += 1
            counters.skipped.uploads += 1
        else:
            counters.uploads += 1
        if count == ENDLESS:
            self.occupancy.repetition = Repetition(fpga_s, self._session.timing.actual_period_s(period_s))
        if self._played is not None:
            aimed = [e._replace(x_m=x_m, y_m=y_m) for e, (x_m, y_m, _) in zip(emissions, plan.points, strict=True)]
            self._played(Played(start_s, tuple(aimed), count, period_s, resident, ticks))
