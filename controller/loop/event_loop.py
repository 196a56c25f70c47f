"""The device loop: touch reports and commands in, emissions out; one thread, and nothing but the selector blocks.

Each turn reads at most one touch report and a bounded number of commands, asks the scene what is due, and hands
it to the playback. The longest call that blocks while all is well is one message on the wire (`Playback.upload_s`).
"""

from __future__ import annotations

import contextlib
import selectors
import signal
import time
from collections.abc import Callable
from typing import Any

from controller.board.board import Board
from controller.clocks import NEVER, Clock
from controller.errors import ConfigError, ControllerError, FaultError, LinkError
from controller.fpga.clock_estimate import ClockEstimate
from controller.fpga.session import Session
from controller.loop.commands import CommandSource, Outcome
from controller.loop.outputs import Outputs
from controller.loop.playback import ENDLESS, Playback
from controller.loop.runtime import Wakeup, handled_signals, no_garbage_collection
from controller.loop.scene_source import PreparedScene, SceneChange
from controller.loop.scheduler import ROUNDING_S, Scheduler
from controller.metrics import Counters
from controller.scene.emission import Emission
from controller.touch.source import TouchSample, TrackedTouch

BEAT_LEAD_S = 0.7e-3  # beyond an upload's time on the wire: a beat of a train or a spot is handed over this early
PREFETCH_SLACK_S = 3e-3  # nothing may be due sooner when a waveform is sent ahead
RESIDENT_START_S = 0.1e-3  # from a report to the start of a waveform that is there


class EventLoop:
    """Drives one panel until its source ends or a signal comes.

    Parameters
    ----------
    board : Board
    clock, session, source, scheduler, playback, clock_estimate
        The parts; each may be simulated.
    counters : Counters
        Shared with scheduler and playback.
    commands : CommandSource, optional
        Gives commands, and is told what became of them.
    change : SceneChange, optional
        For SIGHUP, and for commands that load a scene.
    progress : callable, optional
        Called in each turn with the time: feeds the watchdog.
    emission_started : callable, optional
        Called whenever an emission starts, or a repetition by the FPGA.
    scene_changed : callable, optional
        Called with each scene that was prepared, taken over or refused.
    """

    def __init__(
        self,
        board: Board,
        clock: Clock,
        session: Session,
        source: TrackedTouch,
        scheduler: Scheduler,
        playback: Playback,
        clock_estimate: ClockEstimate,
        counters: Counters,
        *,
        commands: CommandSource | None = None,
        change: SceneChange | None = None,
        progress: Callable[[float], None] = lambda _: None,
        emission_started: Callable[[], None] = lambda: None,
        scene_changed: Callable[[PreparedScene], None] = lambda _: None,
    ) -> None:
        self._clock = clock
        self._session = session
        self._source = source
        self._scheduler = scheduler
        self._playback = playback
        self._clock_estimate = clock_estimate
        self._counters = counters
        self._commands = commands
        self._change = change
        self._progress = progress
        self._emission_started = emission_started
        self._scene_changed = scene_changed
        self._outputs = Outputs(session, board, clock, clock_estimate, counters)
        self._lead_s = playback.upload_s + BEAT_LEAD_S
        self._moving: int | None = None
        self._quiet_until_s = -NEVER  # no emission begins before
        self._listened = False  # and something waited for that
        self._report_ns = -1  # from the kernel's timestamp of the report just read to our read of it
        self._registered: dict[str, int] = {}
        self._wakeup: Wakeup | None = None
        self._reload = False
        self._stopped = False

    @property
    def outputs(self) -> Outputs:
        """Whether the outputs are on, and why not."""
        return self._outputs

    @property
    def repeating(self) -> bool:
        """Whether the FPGA plays something again and again by itself."""
        return self._playback.repeating

    @property
    def reloading(self) -> bool:
        """Whether another scene is being prepared."""
        return self._change is not None and self._change.fileno() is not None

    @property
    def stretch(self) -> Callable[[float], None]:
        """To be told by how much slower emissions are played than the bank says."""
        return self._playback.stretch

    def stop(self) -> None:
        """End after this turn: outputs off, `run` returns."""
        self._stopped = True

    def reload(self) -> None:
        """Read the scene again."""
        self._reload = True

    def run(self, ready: Callable[[], None] = lambda: None) -> None:
        """Arm, play until the source ends or `stop`, disarm; outputs are off when this returns or raises.

        Parameters
        ----------
        ready : callable
            Called once the outputs are on for the first time.

        Raises
        ------
        FaultError
            When the FPGA has switched off for a reason that the host may not clear by itself.
        """
        handlers = {signal.SIGINT: self.stop, signal.SIGTERM: self.stop}
        if self._change is not None:
            handlers[signal.SIGHUP] = self.reload
        with selectors.DefaultSelector() as selector, handled_signals(handlers, selector) as self._wakeup, no_garbage_collection():
            try:
                next_s: float | None = self._clock.now_s()
                while next_s is not None and not self._stopped:
                    self._watch(selector)
                    if self._clock.now_s() < next_s:
                        self._clock.wait(selector, next_s)
                    try:
                        if self._outputs.on and not self._outputs.wanted:
                            self._interrupted()
                            self._outputs.disarm()
                        if self._outputs.advance(self._clock.now_s()):
                            self._scheduler.reset(self._panel_s())  # what began while they were off, in another time
                            ready()
                            ready = _nothing
                        next_s = self._turn()
                    except (LinkError, FaultError) as error:
                        self._lost(error)
                        next_s = self._clock.now_s()
                self._rest(selector, self._outputs.disarm())
            finally:
                self._session.off()

    def play(self, ticket: int, effect: str, x_m: float, y_m: float, finger: int | None, amplitude: float, now_s: float) -> None:
        """Play an effect for a command; see `PanelControl`."""
        if not self._outputs.wanted:
            raise FaultError("the outputs are off: the panel is disarmed, until somebody with the right to operate it arms it")
        if not self._outputs.on:
            raise FaultError(f"the outputs are off: {self._outputs.cause or 'they are being armed'}")
        self._scheduler.play(ticket, effect, x_m, y_m, finger, amplitude, self._clock_estimate.fpga_s(now_s))

    def switch(self, on: bool) -> None:
        """Have the outputs armed or disarmed from now on; see `PanelControl`."""
        self._outputs.wanted = on

    def load_scene(self, ticket: int, name: str) -> None:
        """Take over another scene for a command; see `PanelControl`."""
        if self._change is None:
            raise ConfigError("scenes cannot be changed here")
        self._change.begin(name, ticket)

    def figures(self) -> dict[str, Any]:
        """Counters and latencies so far, ready for JSON; without histograms, which would keep the loop for too long."""
        return self._counters.export(histograms=False) | {"outputs": "on" if self._outputs.on else self._outputs.cause or "off"}

    def effects(self) -> tuple[str, ...]:
        """Names of the effects that `play` knows."""
        return tuple(self._scheduler.scene.effects)

    def outcome(self, ticket: int, outcome: Outcome, age_s: float) -> None:
        """Pass on what became of a command."""
        if self._commands is not None:
            self._commands.outcome(ticket, outcome, age_s)

    def _panel_s(self) -> float:
        return self._clock_estimate.fpga_s(self._clock.now_s())

    def _lost(self, error: ControllerError) -> None:
        """The outputs are off, unasked."""
        self._interrupted()
        self._outputs.failed(error, self._clock.now_s())

    def _interrupted(self) -> None:
        """Nothing that was under way is taken up again."""
        self._playback.forget()
        self._scheduler.reset(self._panel_s())
        now_s = self._clock.now_s()
        self._source.emitted(now_s, now_s)  # whatever sounded has ended

    def _watch(self, selector: selectors.BaseSelector) -> None:
        """Keep the selector on the files of today: a panel that was plugged in again has another one."""
        self._watch_one(selector, "touch", self._source.fileno())
        if self._commands is not None:
            self._watch_one(selector, "commands", self._commands.fileno())
        if self._change is not None:
            self._watch_one(selector, "change", self._change.fileno())

    def _watch_one(self, selector: selectors.BaseSelector, name: str, fileno: int | None) -> None:
        before = self._registered.get(name)
        if before == fileno:
            return
        if before is not None:
            with contextlib.suppress(KeyError, ValueError, OSError):  # closed files leave by themselves
                selector.unregister(before)
            del self._registered[name]
        if fileno is not None:
            selector.register(fileno, selectors.EVENT_READ)
            self._registered[name] = fileno

    def _rest(self, selector: selectors.BaseSelector, until_s: float) -> None:
        """Let the ramp to 0 V pass, with heartbeats."""
        while self._clock.now_s() < until_s:
            if self._clock.now_s() >= self._session.heartbeat_due_s:
                self._session.heartbeat()
                self._counters.heartbeats += 1
            self._clock.wait(selector, min(until_s, self._session.heartbeat_due_s))

    def _turn(self) -> float | None:
        """Do what is due now; the time of the next turn, or None when all is played."""
        started_ns = time.perf_counter_ns()
        now_s = self._clock.now_s()
        self._progress(now_s)
        if not self._outputs.on and self._session.ramp_end_s > now_s:  # the edges of a ramp make ghosts as well
            self._source.emitted(now_s, self._session.ramp_end_s)
        self._read(now_s)
        if self._commands is not None:
            self._commands.serve(now_s, self)
        if self._change is not None:
            self._change_scene(now_s)
        panel_s = self._clock_estimate.fpga_s(now_s)
        self._scheduler.advance(panel_s + self._lead_s + ROUNDING_S)
        self._quiet_until_s = -NEVER
        if self._outputs.on:
            if not self._playback.repeating:
                self._scheduler.add_spots(panel_s, panel_s + self._lead_s)
            self._listen(now_s)
            trigger_at_s = self._playback.trigger_at_s
            if trigger_at_s is not None and trigger_at_s <= now_s:
                self._playback.trigger()
                self._started()
            elif trigger_at_s is None and self._scheduler.due:
                if self._may_play(now_s) and self._open_s() <= now_s:
                    self._play(now_s, started_ns)
            elif trigger_at_s is None and self._moving is not None:
                self._prefetch(now_s)
        elif self._scheduler.due:
            self._scheduler.reset(panel_s)
        return self._next_s(now_s)

    def _read(self, now_s: float) -> None:
        samples = self._source.read(now_s)
        self._report_ns = -1
        if not samples:
            return
        offset_s = self._clock_estimate.offset_s
        self._report_ns = round((now_s - samples[0].time_s) * 1e9)
        self._moving = None
        for sample in samples:
            self._scheduler.touch(_at(sample, sample.time_s + offset_s))
            if sample.contact:
                self._moving = sample.finger
        if self._commands is not None:
            self._commands.touches(samples)

    def _change_scene(self, now_s: float) -> None:
        """Begin to prepare a scene that was asked for, or take over one that is prepared."""
        change = self._change
        assert change is not None
        if self._reload:
            self._reload = False
            if self._wakeup is not None:
                self._wakeup.clear()
            change.begin(None, 0)
        prepared = change.take()
        if prepared is None:
            return
        if prepared.scene is not None:
            if prepared.selection is not None:
                self._playback.reselect(prepared.selection)
            if self._playback.repeating:  # the spots of the scene before
                self._playback.stop()
                self._source.emitted(now_s, now_s)
            self._scheduler.change_scene(prepared.scene, self._clock_estimate.fpga_s(now_s))
            self._playback.pin([(spot.x_m, spot.y_m, spot.amplitude) for spot in prepared.scene.spots])
            self._counters.scenes_loaded += 1
        else:
            self._counters.scenes_refused += 1
            self._counters.scene_refused = prepared.reason
        if not prepared.ticket:
            self._counters.reloads += 1
            self._counters.reload_refused = prepared.reason
        self._scene_changed(prepared)
        if prepared.ticket and self._commands is not None:
            self._commands.loaded(prepared.ticket, prepared.reason)

    def _play(self, now_s: float, started_ns: int) -> None:
        """Prepare what comes next as one emission; spots alone are left to the FPGA to repeat."""
        scheduler, playback = self._scheduler, self._playback
        within_s = NEVER if self._listened else playback.duration_s  # what was held back has become due together
        emissions = scheduler.next_batch(within_s, self._clock_estimate.fpga_s(now_s))
        self._listened = False
        period_s = scheduler.common_period_s
        if period_s is not None and all(emission.owner == emission.region for emission in emissions):
            self._prepare(emissions, started_ns, count=ENDLESS, period_s=period_s, at_s=emissions[0].time_s)
            return
        if playback.repeating:  # the spots' repetition gives way, and takes part if it is due as well
            next_s = playback.next_repetition_s(now_s)
            panel_s = self._clock_estimate.fpga_s(next_s)
            if next_s < now_s + playback.duration_s and period_s is not None:
                emissions = scheduler.join_spots(emissions, panel_s + period_s)
            else:
                scheduler.restart_spots(panel_s)
        beats = [emission.time_s for emission in emissions if emission.period_s]
        self._prepare(emissions, started_ns, at_s=min(beats) if beats else None)

    def _open_s(self) -> float:
        """Since or until when the next emission may be handed over: the wire is free, and the one before has begun."""
        return max(self._session.wire_free_s(), self._playback.last_start_s)

    def _listen(self, now_s: float) -> None:
        """Let the panel have the silence that it asks for; what the FPGA repeats is stopped, and goes on in its beat."""
        playback = self._playback
        if not self._scheduler.due and not playback.repeating:
            return
        next_s = now_s if self._scheduler.due else playback.next_repetition_s(now_s)
        self._quiet_until_s = self._source.quiet_until_s(now_s, next_s)
        self._listened |= self._scheduler.due and self._quiet_until_s > now_s
        if not playback.repeating or playback.next_repetition_s(now_s) >= self._quiet_until_s:
            return
        next_s = playback.next_repetition_s(self._quiet_until_s)
        last_s = playback.stop_repeating(now_s)
        if last_s is not None:
            self._source.emitted(last_s, last_s + playback.duration_s)
            self._scheduler.restart_spots(self._clock_estimate.fpga_s(next_s))

    def _may_play(self, now_s: float) -> bool:
        """Whether something is due and held back neither for the panel nor for a beat."""
        return self._scheduler.due and self._quiet_until_s <= now_s and not self._held(now_s)

    def _held(self, now_s: float) -> bool:
        """Whether what is due is held back for a beat: the plate, or the wire, would not be free for it in time."""
        panel_s = self._clock_estimate.fpga_s(now_s)
        return self._scheduler.must_defer(panel_s, self._clock_estimate.fpga_s(self._playback.free_after_next_s(now_s)))

    def _prepare(self, emissions: list[Emission], started_ns: int, **how: Any) -> None:
        repeating = self._playback.repeating
        try:
            result = self._playback.prepare(emissions, started_ns, **how)
        except ControllerError:  # they wait no longer, and what is under way ends with the outputs
            self._counters.skipped.outputs_off += len(emissions)
            self._scheduler.discarded(emissions, Outcome.REFUSED, self._panel_s())
            raise
        if result.started:
            self._started()
        if result.outcome is Outcome.PLAYED:
            if self._report_ns >= 0:
                self._counters.report_latency.record(self._report_ns)
            sounds_s = self._clock_estimate.host_s(result.start_s)
            self._source.emitted(sounds_s, sounds_s + self._playback.duration_s, how.get("period_s", 0.0))
            self._scheduler.started(emissions, result.start_s)
            return
        if repeating and not self._playback.repeating:
            now_s = self._clock.now_s()
            self._source.emitted(now_s, now_s)
        self._scheduler.discarded(emissions, result.outcome, self._panel_s())

    def _started(self) -> None:
        """Something is played from now on."""
        self._outputs.emission_started()
        self._emission_started()

    def _prefetch(self, now_s: float) -> None:
        """Send ahead what the finger that moved last will ask for, if there is time for it."""
        finger, self._moving = self._moving, None
        assert finger is not None
        reported_s = now_s - max(self._report_ns, 0) * 1e-9
        wanted = self._scheduler.predict(
            finger, self._source.predict, reported_s, self._source.report_s, self._playback.duration_s + RESIDENT_START_S
        )
        if wanted is None or self._session.wire_free_s() > now_s:
            return
        soonest_s = min(
            self._clock_estimate.host_s(self._scheduler.next_s()), self._clock_estimate.host_s(self._scheduler.next_spot_s())
        )
        if soonest_s - self._lead_s > now_s + PREFETCH_SLACK_S:
            self._playback.prefetch(finger, *wanted)

    def _next_s(self, now_s: float) -> float | None:
        commands_s = NEVER if self._commands is None else self._commands.next_time_s()
        trigger_at_s = self._playback.trigger_at_s
        if self._outputs.on and not self._outputs.wanted:
            return now_s
        read_s = self._source.next_time_s()
        next_s = self._scheduler.next_s()
        times = [at_s for at_s in (read_s, trigger_at_s) if at_s is not None]
        if self._outputs.on and trigger_at_s is None and self._may_play(now_s):
            open_s = max(now_s, self._open_s())
            if open_s <= max(now_s, self._session.wire_free_s()):
                return min(open_s, self._outputs.next_s())
            times.append(open_s)
        if next_s != NEVER:
            times.append(self._clock_estimate.host_s(next_s) - self._lead_s)
        if not times and self._source.fileno() is None and self._commands is None:
            # a replay that has ended: let the last emission sound
            return self._playback.free_s if now_s < self._playback.free_s else None
        if not self._playback.repeating and self._outputs.on:
            times.append(self._clock_estimate.host_s(self._scheduler.next_spot_s()) - self._lead_s)
        if self._quiet_until_s > now_s:
            times.append(self._quiet_until_s)
            if self._playback.repeating:
                times.append(self._playback.next_repetition_s(now_s))
        times += [self._outputs.next_s(), commands_s]
        return min(times)


def _nothing() -> None:
    """What `ready` becomes after it was called."""


def _at(sample: TouchSample, time_s: float) -> TouchSample:
    return TouchSample(sample.finger, sample.x_m, sample.y_m, time_s, sample.contact, sample.size_m)
