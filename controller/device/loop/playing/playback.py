"""From a batch of emissions to an accepted play command and its start: planned, sent, accounted for.

A play command is prepared (its waveform uploaded, or found resident) while the emission before still sounds. It is
started by the trigger pin as soon as the plate is free, or by the FPGA itself at a time of its clock.
"""

from __future__ import annotations

import time
from collections.abc import Callable

from controller.clocks import FpgaTime
from controller.device.fpga.exchange import Refused
from controller.device.fpga.registers import Result
from controller.device.loop.commands import Outcome
from controller.device.loop.context import LoopContext
from controller.device.loop.playing.host_timing import HostTiming
from controller.device.loop.playing.occupancy import MARGIN_S, Occupancy, Repetition
from controller.device.loop.playing.planning import Planner
from controller.device.loop.playing.records import ENDLESS, Accepted, Batch, Plan, Played
from controller.device.loop.playing.sending import Sender
from controller.device.waveforms.composition import Point
from controller.errors import BankError
from controller.log import Event, log


class Playback:
    """What plays on an armed FPGA."""

    def __init__(
        self,
        context: LoopContext,
        sender: Sender,  # its slots
        occupancy: Occupancy,  # when the plate is free
        timing: HostTiming,  # how long uploads and play commands take on this host; each is recorded
        played: Callable[[Played], None] | None = None,  # called with every start
    ) -> None:
        self.sender = sender
        self.occupancy = occupancy
        self.accepted: Accepted | None = None  # what `trigger` is to start
        self.timing = timing
        self._session = context.session
        self._clock_estimate = context.clock_estimate
        self._counters = context.counters
        self._trace = context.trace
        self._emissions = context.emissions
        self._played = played
        self._planner = Planner(context, sender, occupancy, timing)
        self._lost = 0  # times that an emission was found not to have begun
        context.session.never_began = self._never_began

    def stop_repeating(self, now_s: float) -> float | None:
        """End the endless repetition; host time at which its last emission began, or None if its first one has yet to."""
        repetition = self.occupancy.repetition
        if repetition is None or now_s < self.occupancy.last_start_s:
            return None
        self.stop()
        return self._clock_estimate.host_s(repetition.last_s(self._clock_estimate.fpga_s(self._session.earliest_trigger_s())))

    def prepare(self, batch: Batch, started_ns: int) -> Accepted | Outcome:
        """Have a batch accepted for playing, and start it if the plate is free.

        Fingers are met where they will be; where the bank has nothing there, where they were. A pulse that comes too late is played
        on arrival, and what a slot has lost is uploaded again.

        The work for it began at `started_ns` (perf_counter_ns). What was accepted has started, or is started by the FPGA, unless it
        is `accepted`. SKIPPED: the bank lacks what it needs. REFUSED: by the FPGA. Raises LinkError or FaultError as the session
        says; nothing is left to play then.
        """
        link, predicted = self._session.link, True
        points: list[Point] | None = None
        while True:
            decided_ns, wire_ns, blocked_ns = time.perf_counter_ns(), link.wire_ns, link.blocked_ns
            begun_s = self._session.earliest_trigger_s()
            plan = self._planner.plan(batch, begun_s, predicted=predicted, points=points)
            try:
                self.sender.send(plan)
            except BankError as error:
                if not (predicted and any(emission.finger is not None for emission in batch.emissions)):
                    self._counters.skipped.bad_entries += len(batch.emissions)
                    self._counters.bad_entry = self._counters.bad_entry or str(error)
                    return Outcome.SKIPPED
                predicted, points = False, None
            except Refused as refusal:
                if plan.start_ticks is not None and refusal.result is Result.TOO_LATE:  # its waveform is resident now
                    self._counters.late += 1
                    self.timing.arrived(self._session.earliest_trigger_s() - begun_s, uploaded=plan.resident is None)
                    batch, predicted, points = batch.on_arrival(), True, plan.points
                elif plan.resident is not None and refusal.result is Result.SLOT_DAMAGED:  # its slot was dropped
                    points = None
                else:
                    self._counters.skipped.refused += len(batch.emissions)
                    return Outcome.REFUSED
            else:
                ready_s = self._session.earliest_trigger_s()
                self.timing.arrived(ready_s - begun_s, uploaded=plan.resident is None)
                frame_ns = time.perf_counter_ns() - decided_ns - (link.blocked_ns - blocked_ns)
                return self._account(plan, ready_s, decided_ns - started_ns, frame_ns, link.wire_ns - wire_ns)

    def stop(self) -> None:
        """End an endless repetition with the emission that sounds, or before its first one.

        Raises LinkError or FaultError as the session says.
        """
        if self.occupancy.repetition is not None:
            self._session.stop()
            self.occupancy.stop_repetition(self._session.earliest_trigger_s())

    def trigger(self) -> None:
        """Start what was accepted, now; raises LinkError if the trigger line cannot be driven."""
        accepted = self.accepted
        if accepted is None:
            return
        self.accepted = None
        called_ns, blocked_ns = time.perf_counter_ns(), self._session.link.blocked_ns
        trigger_s = self._session.trigger()
        trigger_ns = time.perf_counter_ns() - called_ns - (self._session.link.blocked_ns - blocked_ns)
        self._started(accepted, trigger_s, trigger_s + self._clock_estimate.offset_s, trigger_ns)

    def reset(self) -> None:
        """The FPGA holds and plays nothing: after a fault."""
        self.sender.reset()
        if self.accepted is not None:
            self._counters.skipped.outputs_off += len(self.accepted.plan.batch.emissions)
        self.accepted = None
        self.occupancy.reset()

    def _never_began(self, *, repeats: bool) -> None:
        """What was started last has not begun in the FPGA, which repeats an emission or not: fixed emitters start again."""
        if self.occupancy.repetition is not None and not repeats:
            self.occupancy.repetition = None
            self.occupancy.repeating = False
        self._lost += 1
        if not self._lost & (self._lost - 1):  # at powers of two
            link = self._counters.link
            log(
                f"{self._lost} emissions so far never began: triggers that the FPGA did not see {link.triggers_lost}, that started "
                f"nothing {link.triggers_ignored}, not of this host {link.triggers_stray}, times missed {link.plays_missed}",
                Event.EMISSIONS_LOST,
            )

    def _account(self, plan: Plan, ready_s: float, decide_ns: int, frame_ns: int, wire_ns: int) -> Accepted:
        """Take note of what the FPGA has accepted, and start it if it is due and not started by the FPGA."""
        clock_estimate, ticks = self._clock_estimate, plan.start_ticks
        self.occupancy.repeating = plan.batch.repetitions == ENDLESS
        if ticks is not None:
            self._counters.scheduled += 1
            start_s = plan.start_s - clock_estimate.offset_s
            accepted = Accepted(plan, ready_s, start_s, clock_estimate.fpga_s_of(ticks), decide_ns, frame_ns, wire_ns)
            self._started(accepted, start_s, accepted.fpga_s, 0)
            return accepted
        start_s = max(ready_s, self.occupancy.free_s + MARGIN_S)
        accepted = Accepted(plan, ready_s, start_s, start_s + clock_estimate.offset_s, decide_ns, frame_ns, wire_ns)
        self.accepted = accepted
        if start_s <= ready_s:
            self.trigger()
        return accepted

    def _started(self, accepted: Accepted, start_s: float, fpga_s: FpgaTime, trigger_ns: int) -> None:
        """Count a start, and what it took."""
        plan = accepted.plan
        batch, ticks, resident = plan.batch, plan.start_ticks, plan.resident is not None
        self.occupancy.started(start_s, fpga_s, by_clock=ticks is not None)
        counters = self._counters
        counters.emissions += 1
        counters.foci += len(batch.emissions)
        stages = counters.resident_latency if resident else counters.upload_latency
        wait_ns = round((start_s - accepted.ready_s) * 1e9)
        self._trace.started(accepted, start_s, self._clock_estimate.offset_s)
        if self._emissions.wanted:
            self._emissions.started(start_s, plan)
        stages.record(accepted.decide_ns, accepted.frame_ns, accepted.wire_ns, wait_ns, trigger_ns)
        if resident:
            counters.resident += 1
            counters.skipped.uploads += 1
        else:
            counters.uploads += 1
        if batch.repetitions == ENDLESS:
            self.occupancy.repetition = Repetition(fpga_s, self._session.timing.actual_period_s(batch.period_s))
        if self._played is not None:
            aimed = [e._replace(x_m=x_m, y_m=y_m) for e, (x_m, y_m, _) in zip(batch.emissions, plan.points, strict=True)]
            self._played(Played(start_s, tuple(aimed), batch.repetitions, batch.period_s, resident, ticks))
