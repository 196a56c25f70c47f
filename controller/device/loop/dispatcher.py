"""Hands due emissions to the playback, one batch at a time, when plate, wire and touch panel allow it.

What is due waits while the touch panel needs silence to tell a finger from a ghost, and while it would delay the next pulse of
a train. FixedEmitters of one common period are handed to the FPGA as one endless repetition. While nothing is due, the waveform
that a moving finger will ask for next is sent ahead.
"""

from __future__ import annotations

from typing import Final

from controller.clocks import FPGA_NEVER, NEVER, FpgaTime
from controller.device.loop.commands import Outcome
from controller.device.loop.context import LoopContext
from controller.device.loop.playing.next_focus import next_focus
from controller.device.loop.playing.playback import Playback
from controller.device.loop.playing.records import ENDLESS, Accepted, Batch, Turn
from controller.device.loop.scheduler import Scheduler
from controller.errors import ControllerError

PREFETCH_SLACK_S: Final = 3e-3  # nothing may be due sooner when a waveform is sent ahead
RESIDENT_START_S: Final = 0.1e-3  # from a report to the start of a waveform that is resident


class Dispatcher:
    """From due emissions to plays."""

    def __init__(self, context: LoopContext, scheduler: Scheduler, playback: Playback) -> None:
        self.quiet_until_s = -NEVER  # host time before which no emission begins, for the touch panel's sake
        self._clock = context.clock
        self._session = context.session
        self._source = context.source
        self._clock_estimate = context.clock_estimate
        self._counters = context.counters
        self._scheduler = scheduler
        self._playback = playback
        self._sender = playback.sender
        self._occupancy = playback.occupancy
        self._timing = playback.timing
        self._delayed = False  # something waited for the panel's silence
        self._moving: int | None = None  # finger that moved in the newest report, until what it will ask for was sent ahead
        self._moved_s = 0.0  # host time of that report

    def turn(self, turn: Turn, *, on: bool) -> bool:
        """Start, hand over or send ahead what this turn has time for.

        Unless the outputs are `on`, what is due is discarded. Returns whether an emission, or a repetition, started. Raises
        LinkError or FaultError as the session says.
        """
        self.quiet_until_s = -NEVER
        scheduler, playback, now_s = self._scheduler, self._playback, turn.now_s
        if turn.report_ns >= 0:
            self._moving = turn.finger if turn.finger == scheduler.spaced else None
            self._moved_s = now_s - turn.report_ns * 1e-9
        if not on:
            self._moving = None
            if scheduler.due:
                scheduler.reset(turn.fpga_s)
            return False
        repeating = self._occupancy.repeating
        if not repeating and scheduler.scene.emitters:
            scheduler.add_emitters(turn.fpga_s, turn.fpga_s + self._timing.lead_s)
        due = bool(scheduler.due)
        if due or repeating:
            self._listen(now_s, due=due, repeating=repeating)
        accepted = playback.accepted
        if accepted is not None:
            if accepted.start_s > now_s:
                return False
            playback.trigger()
            return True
        if due:
            return self._may_play(now_s, turn.fpga_s) and self._open_s() <= now_s and self._play(turn)
        if self._moving is not None:
            self._send_ahead(turn)
        return False

    def handover_s(self, now_s: float) -> float | None:
        """Host time at which what is due can be handed over; None if nothing is due, or it has to wait for something else."""
        if self._playback.accepted is None and self._scheduler.due and self._may_play(now_s, now_s + self._clock_estimate.offset_s):
            return max(now_s, self._open_s())
        return None

    def next_s(self, now_s: float, *, on: bool) -> float:
        """Host time of a fixed emitter, the end of a silence or a waveform sent ahead; `on`: whether the outputs are on."""
        repeating = self._occupancy.repeating
        next_s = self.quiet_until_s if self.quiet_until_s > now_s else NEVER
        if repeating and next_s != NEVER:
            next_s = min(next_s, self._occupancy.next_repetition_s(now_s))
        if on and not repeating and self._scheduler.scene.emitters:
            next_s = min(next_s, self._clock_estimate.host_s(self._scheduler.emitters.next_s()) - self._timing.lead_s)
        if on and self._moving is not None and not self._scheduler.due and self._playback.accepted is None:
            next_s = min(next_s, max(now_s, self._session.wire_free_s()))  # the wire had to be free
        return next_s

    def pause_repetition(self, now_s: float) -> None:
        """End a repetition for the FPGA to take a setting once its last emission has sounded; it goes on in its pulse."""
        occupancy = self._occupancy
        if occupancy.repetition is None:
            return
        pulse_s = occupancy.next_repetition_s(now_s) + occupancy.duration_s + self._timing.lead_s
        self._stop_repeating(now_s, occupancy.next_repetition_s(pulse_s))

    def _stop_repeating(self, now_s: float, next_s: float) -> None:
        """End a repetition, which goes on with the pulse at `next_s`."""
        last_s = self._playback.stop_repeating(now_s)
        if last_s is not None:
            self._source.emitted(last_s, last_s + self._occupancy.duration_s)
            self._scheduler.emitters.restart(self._clock_estimate.fpga_s(next_s))

    def _open_s(self) -> float:
        """Host time from which the next batch may be handed over: the wire is free, and the play before has begun."""
        free_s, last_start_s = self._session.link.wire_free_s(), self._occupancy.last_start_s
        return free_s if free_s > last_start_s else last_start_s

    def _listen(self, now_s: float, *, due: bool, repeating: bool) -> None:
        """Give the panel the silence that it asks for; a repetition is stopped for it, and goes on in its pulse afterwards."""
        occupancy = self._occupancy
        next_s = now_s if due else occupancy.next_repetition_s(now_s)
        self.quiet_until_s = self._source.quiet_until_s(now_s, next_s)
        self._delayed |= due and self.quiet_until_s > now_s
        if not repeating or occupancy.next_repetition_s(now_s) >= self.quiet_until_s:
            return
        self._stop_repeating(now_s, occupancy.next_repetition_s(self.quiet_until_s))

    def _may_play(self, now_s: float, fpga_s: FpgaTime) -> bool:
        """Whether what is due may be played: not if the panel listens, nor if plate or wire would be busy at the next pulse."""
        if self.quiet_until_s > now_s:
            return False
        if self._scheduler.next_s() == FPGA_NEVER:
            return True
        upload = self._timing.upload
        free_s = self._occupancy.free_after_next_s(now_s, upload.expected_s, upload.promised_s)
        return not self._scheduler.must_defer(fpga_s, self._clock_estimate.fpga_s(free_s))

    def _play(self, turn: Turn) -> bool:
        """Play what comes next as one batch; fixed emitters alone are left to the FPGA to repeat. Whether it started."""
        scheduler, occupancy = self._scheduler, self._occupancy
        waited = self._delayed
        within_s = NEVER if waited else occupancy.duration_s  # what waited for silence is due at the same time
        emissions = scheduler.queue.next_batch(within_s, turn.fpga_s)
        self._delayed = False
        period_s = scheduler.emitters.common_period_s
        if period_s is not None and all(emission.owner == emission.region for emission in emissions):
            return self._prepare(Batch(emissions, ENDLESS, period_s, emissions[0].time_s), turn)
        if self._occupancy.repeating:  # the repetition is replaced: fixed emitters take part if they are due as well
            next_s = occupancy.next_repetition_s(turn.now_s)
            fpga_s = self._clock_estimate.fpga_s(next_s)
            if next_s < turn.now_s + occupancy.duration_s and period_s is not None:
                emissions = scheduler.join_emitters(emissions, fpga_s + period_s)
            else:
                scheduler.emitters.restart(fpga_s)
        decided_s = self._clock.now_s()
        self._timing.decided_s = decided_s - turn.now_s
        at_s, has_begun, period_s = None, False, 0.0
        for emission in emissions:
            if emission.period_s and (at_s is None or emission.time_s < at_s):
                at_s, has_begun, period_s = emission.time_s, emission.pulse > 0, emission.period_s
        if at_s is not None and has_begun and not waited:
            lead_s = min(self._timing.lead_s, period_s)
            self._timing.woken(decided_s - max(self._clock_estimate.host_s(at_s) - lead_s, self._open_s()))
        return self._prepare(Batch(emissions, at_s=at_s, has_begun=has_begun), turn)

    def _prepare(self, batch: Batch, turn: Turn) -> bool:
        """Hand a batch over, and tell everyone concerned what became of it. Whether it started."""
        emissions, playback = batch.emissions, self._playback
        repeating = self._occupancy.repeating
        try:
            became = playback.prepare(batch, turn.started_ns)
        except ControllerError:  # these emissions are lost; what sounds ends with the outputs
            self._counters.skipped.outputs_off += len(emissions)
            self._scheduler.queue.discarded(emissions, Outcome.REFUSED, self._clock_estimate.fpga_s(self._clock.now_s()))
            raise
        if isinstance(became, Accepted):
            if turn.report_ns >= 0:
                self._counters.report_latency.record(turn.report_ns)
            self._source.emitted(became.start_s, became.start_s + self._occupancy.duration_s, batch.period_s)
            self._scheduler.started(emissions, became.fpga_s, self._timing.lead_s)
            return playback.accepted is None
        if repeating and not self._occupancy.repeating:
            now_s = self._clock.now_s()
            self._source.emitted(now_s, now_s)
        self._scheduler.queue.discarded(emissions, became, self._clock_estimate.fpga_s(self._clock.now_s()))
        return False

    def _send_ahead(self, turn: Turn) -> None:
        """Send ahead what the finger that moved last will ask for, if there is time for it, once the wire is free."""
        finger = self._moving
        assert finger is not None
        focus_after_s = self._occupancy.duration_s + RESIDENT_START_S
        effects, scene, source = self._scheduler.active_effects, self._scheduler.scene, self._source
        wanted = next_focus(effects, scene, finger, source.predict, self._moved_s, source.report_s, focus_after_s)
        if wanted is not None and self._session.wire_free_s() > turn.now_s:
            return
        self._moving = None
        if wanted is None:
            return
        next_s = self._clock_estimate.host_s(min(self._scheduler.next_s(), self._scheduler.emitters.next_s()))
        timing = self._timing
        if next_s - timing.lead_s > turn.now_s + max(PREFETCH_SLACK_S, timing.upload.promised_s):
            steady = self._source.missed_m(finger) <= self._sender.selection.reuse_m
            self._sender.prefetch(finger, *wanted, steady=steady, fingers=self._scheduler.fingers_down())
