"""The event loop: touch reports and commands in, emissions out, in one thread that blocks only in its selector.

Each turn reads at most one touch report and a bounded number of commands, lets the scheduler collect what is due, and has
the dispatcher hand it to the FPGA. The longest blocking call without a fault is one message on the wire
(`HostTiming.upload`).
"""

from __future__ import annotations

import signal
import time
from collections.abc import Callable

from controller.clocks import FPGA_NEVER, NEVER, FpgaTime
from controller.device.loop.commands import CommandSource
from controller.device.loop.context import LoopContext, Watch
from controller.device.loop.control import PanelControl
from controller.device.loop.dispatcher import Dispatcher
from controller.device.loop.fixed_emitters import ROUNDING_S
from controller.device.loop.idling import Idling
from controller.device.loop.layers import Layers
from controller.device.loop.outputs import Outputs
from controller.device.loop.playing.playback import Playback
from controller.device.loop.playing.records import Turn
from controller.device.loop.preparation import SceneChange
from controller.device.loop.rings.trace_ring import LATE_S
from controller.device.loop.runtime import no_garbage_collection
from controller.device.loop.scene_takeover import SceneTakeover
from controller.device.loop.scheduler import Scheduler
from controller.device.loop.watched_files import NotingSelector, WatchedFiles
from controller.errors import ControllerError, FaultError, LinkError
from controller.signals import Wakeup, handled_signals

NOBODY = Watch()


class EventLoop:
    """Runs one panel until its source ends or a signal comes."""

    def __init__(
        self,
        context: LoopContext,
        scheduler: Scheduler,
        playback: Playback,
        dispatcher: Dispatcher,
        *,
        commands: CommandSource | None = None,  # where commands come from
        change: SceneChange | None = None,  # prepares another scene, for SIGHUP and for commands; None: the scene cannot be changed
        watch: Watch = NOBODY,
        idle_after_s: float = NEVER,  # the outputs are switched off after so long without a touch or command
    ) -> None:
        self._clock = context.clock
        self._session = context.session
        self._source = context.source
        self._silence = context.silence
        self._clock_estimate = context.clock_estimate
        self._trace = context.trace
        self._scheduler = scheduler
        self._playback = playback
        self._timing = playback.timing
        self._dispatcher = dispatcher
        self.pause_repetition = dispatcher.pause_repetition
        # To be called with the factor by which emissions last longer than the bank says
        self.stretch = playback.occupancy.set_time_scale
        self._commands = commands
        self._change = change
        self._no_command = False
        self._progress = watch.progress
        self._emission_started = watch.emission_started
        self._spare = watch.spare
        self.outputs = Outputs(context)
        self._layers = Layers(scheduler, context.layers, commands)
        self._takeover: SceneTakeover | None = None
        if change is not None:
            self._takeover = SceneTakeover(context, scheduler, playback, self._layers, change, commands, watch.scene_changed)
        # What commands may ask of this loop
        self.control = PanelControl(context, self.outputs, scheduler, playback.timing, self._layers, change)
        self._wakeup: Wakeup | None = None
        self._reload = False
        self._stopped = False
        self._slept_until_s = NEVER  # NEVER too if the loop did not sleep before this turn
        self._idling = Idling(self.outputs, scheduler, playback, idle_after_s)
        self._held = False  # the outputs have just come on for what waits

    @property
    def repeating(self) -> bool:
        """Whether the FPGA repeats an emission by itself."""
        return self._playback.occupancy.repeating

    @property
    def reloading(self) -> bool:
        """Whether another scene is being prepared."""
        return self._change is not None and self._change.fileno() is not None

    def stop(self) -> None:
        """Have `run` switch the outputs off and return after this turn."""
        self._stopped = True

    def reload(self) -> None:
        """Have the scene read again in the next turn."""
        self._reload = True

    def run(self, ready: Callable[[], None] = lambda: None) -> None:
        """Arm, play until the source ends or `stop` is called, disarm.

        However this returns or raises, the outputs are off then: a status of the FPGA has said so, or, where none arrives, the
        FPGA's heartbeat timeout has passed.

        `ready` is called once the outputs are on for the first time. Raises FaultError if the FPGA has switched off for a reason
        that the host may not clear by itself; IncompatibleFpga if it is another FPGA, or does not take the board's settings.
        """
        handlers = {signal.SIGINT: self.stop, signal.SIGTERM: self.stop, signal.SIGUSR1: self._explain}
        if self._change is not None:
            handlers[signal.SIGHUP] = self.reload
        with NotingSelector() as selector, handled_signals(handlers, selector) as self._wakeup, no_garbage_collection():
            files = WatchedFiles(selector)
            try:
                next_s: float | None = self._clock.now_s()
                while next_s is not None and not self._stopped:
                    self._watch(files)
                    selector.ready = None
                    self._slept_until_s = NEVER
                    if self._clock.now_s() < next_s:
                        self._clock.wait(selector, next_s)
                        self._slept_until_s = next_s
                    self._silence.known, self._no_command = files.silent("touch"), files.silent("commands")
                    try:
                        if self.outputs.unwanted:
                            self._abandon()
                            self.outputs.disarm()
                        waited = self.outputs.waking
                        if self.outputs.advance(self._clock.now_s()):
                            self._idling.active_s = self._clock.now_s()
                            if waited:
                                self._held = True
                            else:
                                self._scheduler.reset(self._fpga_now_s())  # FPGA time may have started again
                            ready()
                            ready = _nothing
                        next_s = self._turn()
                    except (LinkError, FaultError) as error:
                        self._recover(error)
                        next_s = self._clock.now_s()
                        if self._progress is not None:  # the next turn may arm already
                            self._progress(next_s)
            finally:
                self.outputs.switch_off()

    def _explain(self) -> None:
        """Have the trace written."""
        self._trace.asked("it was asked for (SIGUSR1)", by_hand=True)
        if self._wakeup is not None:
            self._wakeup.clear()

    def _fpga_now_s(self) -> FpgaTime:
        return self._clock_estimate.fpga_s(self._clock.now_s())

    def _recover(self, error: ControllerError) -> None:
        """Recover from an error of the link or the FPGA: the outputs are off."""
        if self.outputs.on:
            self._trace.asked(str(error))
        self._abandon()
        self.outputs.failed(error, self._clock.now_s())

    def _abandon(self) -> None:
        """Forget what was due, accepted or playing: none of it is resumed."""
        self._playback.reset()
        self._scheduler.reset(self._fpga_now_s())
        now_s = self._clock.now_s()
        self._source.emitted(now_s, now_s)  # what sounded has ended

    def _watch(self, files: WatchedFiles) -> None:
        """Wake for the present files of the touch panel, of commands and of the scene that is prepared."""
        files.watch("touch", self._source.fileno())
        if self._commands is not None:
            files.watch("commands", self._commands.fileno())
        if self._change is not None:
            files.watch("change", self._change.fileno())
        files.watch("layers", self._layers.fileno())

    def _turn(self) -> float | None:
        """Do what is due now; host time of the next turn, or None when all of a replay is played."""
        started_ns = time.perf_counter_ns()
        now_s = self._clock.now_s()
        if self._progress is not None:
            self._progress(now_s)
        if not self.outputs.on and self._session.ramp_end_s > now_s:  # the edges of a ramp cause ghost touches, too
            self._source.emitted(now_s, self._session.ramp_end_s)
        report_ns, finger = self._read(now_s)
        if self._commands is not None and not (self._no_command and self._commands.next_time_s() > now_s):
            self._commands.serve(now_s, self.control)
        if self._takeover is not None:
            if self._reload:
                self._begin_reload()
            self._takeover.turn(now_s)
        if self._layers.pending:
            self._layers.turn(now_s)
        fpga_s = now_s + self._clock_estimate.offset_s
        if self._idling.after_s != NEVER and self._idling.begins(now_s, touched=report_ns >= 0):
            self._abandon()
            self.outputs.begin_idle()
            return now_s  # that the outputs ramp is informed at once
        if self.outputs.waking:  # what is due is played once the outputs are on
            read_s = self._source.next_time_s()
            next_s = min(self.outputs.next_s(), NEVER if read_s is None else read_s)
            return next_s if self._commands is None else min(next_s, self._commands.next_time_s())
        self._held = self._held and bool(self._scheduler.due)  # what waited for the outputs is played first: trains begin with it
        if not self._held:
            self._scheduler.advance(fpga_s + ROUNDING_S, self._timing.lead_s)
        due = len(self._scheduler.due)
        starts = self._dispatcher.turn(Turn(started_ns, now_s, fpga_s, report_ns, finger), on=self.outputs.on)
        self._trace.turn(now_s, self._clock.now_s(), report_ns, due, started=starts)
        if due and now_s - self._slept_until_s > LATE_S:
            self._trace.asked(f"the loop woke {(now_s - self._slept_until_s) * 1e3:.1f} ms late, and something was due")
        if starts:
            self.outputs.emission_started()
            if self._emission_started is not None:
                self._emission_started()
        then_s = self._next_s(now_s)
        for spare in self._spare:
            if spare.due_s <= now_s and then_s is not None:
                spare.use(self._clock.now_s(), then_s)
                break
        return then_s

    def _begin_reload(self) -> None:
        """Have the scene read again, as a signal asked for it."""
        assert self._change is not None
        self._reload = False
        if self._wakeup is not None:
            self._wakeup.clear()
        self._change.begin(None, 0)

    def _read(self, now_s: float) -> tuple[int, int | None]:
        """Read at most one touch report: its age in ns, -1 without one, and the finger that it moved."""
        samples = self._source.read(now_s)
        if not samples:
            return -1, None
        if self.outputs.idle:
            self.outputs.wake()
        finger, offset_s = None, self._clock_estimate.offset_s
        for sample in samples:
            self._scheduler.touch(sample, sample.time_s + offset_s)
            if sample.contact:
                finger = sample.finger
        if self._commands is not None:
            self._commands.touches(samples)
        return round((now_s - samples[0].time_s) * 1e9), finger

    def _next_s(self, now_s: float) -> float | None:
        """Host time of the next turn; None at the end of a replay."""
        outputs, playback, dispatcher = self.outputs, self._playback, self._dispatcher
        if outputs.unwanted:
            return now_s
        read_s = self._source.next_time_s()
        times = [] if read_s is None else [read_s]
        if playback.accepted is not None:
            times.append(playback.accepted.start_s)
        handover_s = dispatcher.handover_s(now_s) if outputs.on else None
        if handover_s is not None:
            if handover_s <= max(now_s, self._session.wire_free_s()):  # before anything else is read
                return min(handover_s, outputs.next_s())
            times.append(handover_s)
        collect_s = FPGA_NEVER if self._held else self._scheduler.collect_s(self._timing.lead_s)
        if collect_s != FPGA_NEVER:
            times.append(self._clock_estimate.host_s(collect_s))
        if not times and self._source.fileno() is None and self._commands is None:
            free_s = playback.occupancy.free_s  # end of a replay: the last emission sounds to its end
            return free_s if now_s < free_s else None
        times += [dispatcher.next_s(now_s, on=outputs.on), outputs.next_s()]
        if self._commands is not None:
            times.append(self._commands.next_time_s())
        return min(times)


def _nothing() -> None:
    """In place of `ready`, once that was called."""
