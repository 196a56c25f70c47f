"""What the service does in each turn of the loop beside playing: watchdog, status and log, reloads, temperature."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from controller.device.board.board import Board
from controller.device.board.panel_state import Condition, PanelState
from controller.device.fpga.session import Session
from controller.device.loop.event_loop import EventLoop
from controller.device.loop.preparation import PreparedScene
from controller.device.service.bit_clock import BitClock
from controller.device.service.reloading import ReloadFile
from controller.device.service.systemd import Notifier, Watchdog
from controller.device.service.touch_faults import TouchFaults
from controller.device.touch.drivers.awaited_reader import AwaitedReader
from controller.device.touch.drivers.panel_process import PanelProcess
from controller.device.touch.reports import off_plate_warning
from controller.device.touch.source import Counts
from controller.log import Event, log

if TYPE_CHECKING:
    from controller.device.service.temperature import Thermometer

OFF_PLATE_REPORTED = 50  # positions off the plate, at most half a second of a finger
PLAYING_S = 1.0  # after an emission, for which the state is PLAYING
WORKING = frozenset({PanelState.ARMED, PanelState.PLAYING})
OFF = {
    PanelState.FAULTED: Event.FAULTED,
    PanelState.NO_PERMIT: Event.NO_PERMIT,
    PanelState.WAITING_FOR_FPGA: Event.WAITING_FOR_FPGA,
    PanelState.WAITING_FOR_PANEL: Event.WAITING_FOR_PANEL,
}  # of outputs that nobody asked to be off


class Housekeeping:
    """Reports the panel's state and follows the plate's temperature; `progress` is called in each turn of the loop."""

    def __init__(
        self,
        board: Board,
        session: Session,  # its bit clock follows the plate's temperature
        # Reports the panel's state to the service manager when it changes. The service is ready with the first known state,
        # whether or not FPGA and touch panel are connected: programs that start after it, such as a user interface, do not
        # wait for a cable to be plugged in, and show the state themselves
        notifier: Notifier,
        watchdog: Watchdog,
        thermometer: Thermometer | None,  # None: the bit clock is not scaled
        reload_file: ReloadFile | None = None,  # where the result of each reload is written
    ) -> None:
        self.condition = Condition()  # state of the panel, as last reported
        self._notifier = notifier
        self._watchdog = watchdog
        self._reload_file = reload_file or ReloadFile(None)
        self._bit_clock = None
        if thermometer is not None and board.temperature is not None:
            self._bit_clock = BitClock(session, thermometer, board.temperature.period_s)
        self._loop: EventLoop | None = None
        self._panel: AwaitedReader | PanelProcess | None = None
        self._touch_faults: TouchFaults | None = None
        self._counts: Counts | None = None  # None also once it was said
        self._reported: Sequence[Callable[[Condition], None]] = ()
        self._board_name = board.name
        self._reloading = False
        self._known = False  # a condition was reported
        self._ready = False  # to the service manager
        self._armed = False
        self._scene_stays = ""
        self._played_s = -math.inf
        self._emission_started = False  # since the last turn
        self._scene: PreparedScene | None = None  # taken over or refused since the last turn
        self._reloads = self._reloads_reported = 0
        self._reload_refused = ""

    @property
    def scale(self) -> float:
        """Factor of the bit clock that the FPGA uses now."""
        return 1.0 if self._bit_clock is None else self._bit_clock.scale

    def watch(
        self,
        loop: EventLoop,
        panel: AwaitedReader | PanelProcess | None,  # None: a recording is replayed
        reported: Sequence[Callable[[Condition], None]] = (),  # each is called with each new condition, the first included
        counts: Counts | None = None,  # of the touch panel: said once if most positions lie off the plate
    ) -> None:
        """Set what is reported."""
        self._counts = counts
        self._loop = loop
        self._panel = panel
        self._touch_faults = None if panel is None else TouchFaults(panel)
        self._reported = reported

    def emission_started(self) -> None:
        """Note that an emission was started."""
        self._emission_started = True

    def scene_changed(self, prepared: PreparedScene) -> None:
        """Note that a scene is in force, or was refused; reported in the next turn."""
        self._scene = prepared

    def progress(self, now_s: float) -> None:
        """Do what is due in this turn of the loop."""
        self._watchdog.progress(now_s)
        loop = self._loop
        if loop is None:
            return
        self._look(loop, now_s)
        if self._touch_faults is not None:
            self._touch_faults.look(now_s)
        counts = self._counts
        if counts is not None and counts.off_plate >= OFF_PLATE_REPORTED and counts.off_plate * 2 > counts.points:
            self._counts = None
            log(off_plate_warning(counts.points, counts.off_plate), Event.OFF_PLATE)
        if loop.reloading != self._reloading:
            self._reloading = loop.reloading
            if self._reloading:
                self._notifier.reloading("preparing another scene")
            else:
                self._notifier.ready(self._status)
        if self._scene is not None:
            self._tell_scene(self._scene)
            self._scene = None
        # While another one is being prepared, the caller waits for its result too
        if self._reloads != self._reloads_reported and not loop.reloading:
            self._reloads_reported = self._reloads
            self._reload_file.write(self._reloads, self._reload_refused)
        if self._bit_clock is not None and loop.outputs.on:  # skip while the FPGA is unreachable: it cannot accept a new bit clock
            self._bit_clock.follow(loop, now_s)

    def _tell_scene(self, prepared: PreparedScene) -> None:
        """Report a scene that is in force, or why it was refused."""
        self._scene_stays = f"the scene stays as it was: {prepared.reason}" if prepared.scene is None else ""
        if self._scene_stays:
            log(self._scene_stays, Event.SCENE_REFUSED)
        else:
            log("another scene is played, or the same read again", Event.SCENE_LOADED)
        self._notifier.status(self._status)
        if not prepared.ticket:
            self._reloads += 1
            self._reload_refused = prepared.reason

    def _look(self, loop: EventLoop, now_s: float) -> None:
        """Determine the panel's condition, and report it if it has changed."""
        outputs, panel = loop.outputs, self._panel
        on, state, cause = outputs.may_be_on, outputs.state, outputs.cause
        present = panel is None or panel.present
        temperature_c = None if self._bit_clock is None else self._bit_clock.temperature_c
        if self._emission_started or loop.repeating:
            self._emission_started = False
            self._played_s = now_s
        if state in {PanelState.ARMED, PanelState.IDLE} and panel is not None and not present:
            state, cause = PanelState.WAITING_FOR_PANEL, panel.cause
        elif state is PanelState.ARMED and now_s - self._played_s < PLAYING_S:
            state = PanelState.PLAYING
        before = self.condition
        if (
            self._known
            and state is before.state
            and on == before.outputs_on
            and present == before.panel_present
            and temperature_c == before.temperature_c
            and cause == before.cause
        ):
            return
        if not cause and state not in WORKING:
            return  # nothing is known yet
        self.condition = Condition(state, cause, on, present, temperature_c)
        self._known = True
        self._log(before, armed=outputs.on)
        if not self._ready:
            if state is not PanelState.RAMPING:  # what comes of the first ramp is known at its end
                self._ready = True
                self._notifier.ready(self._status)
        elif (state, cause) != (before.state, before.cause):
            self._notifier.status(self._status)
        for reported in self._reported:
            reported(self.condition)

    def _log(self, before: Condition, *, armed: bool) -> None:
        """Log what changed, except whether something is being played; `armed`: the outputs have ended their ramp up."""
        now = self.condition
        if armed and not self._armed:
            log("the outputs are on", Event.OUTPUTS_ON)
        self._armed = armed
        changed = (now.state, now.cause, now.outputs_on) != (before.state, before.cause, before.outputs_on)
        if not armed and now.state is not PanelState.RAMPING and changed:
            said = f"{now.state.value}: {now.cause.removeprefix('outputs off: ')}"
            log(said if now.outputs_on else f"outputs off: {said}", OFF.get(now.state, Event.OUTPUTS_OFF))
        if now.panel_present and not before.panel_present:
            log("the touch panel is back", Event.PANEL_BACK)
        elif now.state is PanelState.WAITING_FOR_PANEL and (now.state, now.cause) != (before.state, before.cause):
            log(f"{now.state.value}: {now.cause}", Event.WAITING_FOR_PANEL)

    @property
    def _status(self) -> str:
        """State of the panel as one line for `systemctl status`."""
        now = self.condition
        said = f"{now.state.value} on board {self._board_name!r}" if now.state in WORKING else f"{now.state.value}: {now.cause}"
        return f"{said}; {self._scene_stays}" if self._scene_stays else said
