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
from controller.clocks import FPGA_NEVER, Clock, FpgaTime
from controller.errors import ConfigError, ControllerError, FaultError, LinkError
from controller.fpga.clock_estimate import ClockEstimate
from controller.fpga.session import Session
from controller.loop.commands import CommandSource, Outcome
from controller.loop.dispatcher import Dispatcher
from controller.loop.outputs import Outputs
from controller.loop.playback import Playback
from controller.loop.records import Turn
from controller.loop.runtime import Wakeup, handled_signals, no_garbage_collection
from controller.loop.scene_source import PreparedScene, SceneChange
from controller.loop.scheduler import Scheduler
from controller.loop.spots import ROUNDING_S
from controller.metrics import Counters
from controller.touch.source import TrackedTouch


class EventLoop:
    """Drives one panel until its source ends or a signal comes.

    Parameters
    ----------
    board : Board
    clock, session, source, scheduler, playback, dispatcher, clock_estimate
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
        dispatcher: Dispatcher,
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
        self._dispatcher = dispatcher
        self._clock_estimate = clock_estimate
        self._counters = counters
        self._commands = commands
        self._change = change
        self._progress = progress
        self._emission_started = emission_started
        self._scene_changed = scene_changed
        self._outputs = Outputs(session, board, clock, clock_estimate, counters)
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
        return self._playback.occupancy.set_time_scale

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
                            self._scheduler.reset(self._fpga_now_s())  # what began while they were off, in another time
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

    def _fpga_now_s(self) -> FpgaTime:
        return self._clock_estimate.fpga_s(self._clock.now_s())

    def _lost(self, error: ControllerError) -> None:
        """The outputs are off, unasked."""
        self._interrupted()
        self._outputs.failed(error, self._clock.now_s())

    def _interrupted(self) -> None:
        """Nothing that was under way is taken up again."""
        self._playback.forget()
        self._scheduler.reset(self._fpga_now_s())
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
        report_ns, finger = self._read(now_s)
        if self._commands is not None:
            self._commands.serve(now_s, self)
        if self._change is not None:
            self._change_scene(now_s)
        fpga_s = self._clock_estimate.fpga_s(now_s)
        self._scheduler.advance(fpga_s + self._dispatcher.lead_s + ROUNDING_S)
        if self._dispatcher.turn(Turn(started_ns, now_s, fpga_s, report_ns, finger), self._outputs.on):
            self._outputs.emission_started()
            self._emission_started()
        return self._next_s(now_s)

    def _read(self, now_s: float) -> tuple[int, int | None]:
        """Read at most one touch report: its age in ns, -1 without one, and the finger that it moved."""
        samples = self._source.read(now_s)
        if not samples:
            return -1, None
        finger = None
        for sample in samples:
            self._scheduler.touch(sample, self._clock_estimate.fpga_s(sample.time_s))
            if sample.contact:
                finger = sample.finger
        if self._commands is not None:
            self._commands.touches(samples)
        return round((now_s - samples[0].time_s) * 1e9), finger

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

    def _next_s(self, now_s: float) -> float | None:
        """Host time of the next turn; None at the end of a replay."""
        outputs, playback, dispatcher = self._outputs, self._playback, self._dispatcher
        if outputs.on and not outputs.wanted:
            return now_s
        read_s = self._source.next_time_s()
        times = [] if read_s is None else [read_s]
        if playback.accepted is not None:
            times.append(playback.accepted.start_s)
        handover_s = dispatcher.handover_s(now_s) if outputs.on else None
        if handover_s is not None:
            if handover_s <= max(now_s, self._session.wire_free_s()):  # nothing else is read before
                return min(handover_s, outputs.next_s())
            times.append(handover_s)
        next_s = self._scheduler.next_s()
        if next_s != FPGA_NEVER:
            times.append(self._clock_estimate.host_s(next_s) - dispatcher.lead_s)
        if not times and self._source.fileno() is None and self._commands is None:
            free_s = playback.occupancy.free_s  # a replay has ended: the last emission sounds to its end
            return free_s if now_s < free_s else None
        times += [dispatcher.next_s(now_s, outputs.on), outputs.next_s()]
        if self._commands is not None:
            times.append(self._commands.next_time_s())
        return min(times)


def _nothing() -> None:
    """What `ready` becomes after it was called."""
