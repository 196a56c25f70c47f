"""What the service does beside playing, a little in each turn of the loop: watchdog, status, log, temperature."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Protocol

from controller.board.board import Board
from controller.board.panel_state import Condition, PanelState
from controller.fpga.session import Session
from controller.log import Priority, log
from controller.loop.scene_source import PreparedScene
from controller.service.reloading import ReloadFile
from controller.service.systemd import Notifier, Watchdog

PLAYING_S = 1.0  # since the last emission, for which the panel is said to be playing
FIRST_S = 0.1  # between looks for the first temperature
WORKING = frozenset({PanelState.ARMED, PanelState.PLAYING})


class Thermometer(Protocol):
    """The plate's temperature, as far as it is known."""

    @property
    def temperature_c(self) -> float:
        """In °C; NaN while it is not."""

    @property
    def cause(self) -> str:
        """Why the last reading gave nothing; empty if it did."""

    def scale(self, now_s: float) -> float:
        """What the bit clock is to be multiplied by."""


class Panel(Protocol):
    """A touch panel, as far as it can be absent."""

    @property
    def present(self) -> bool:
        """Whether it is there."""

    @property
    def cause(self) -> str:
        """Why it is not there; empty while that is not known yet."""


class OutputsSeen(Protocol):
    """Whether the outputs are on."""

    @property
    def on(self) -> bool:
        """Whether plays are taken."""

    @property
    def state(self) -> PanelState:
        """ARMED, or why not."""

    @property
    def cause(self) -> str:
        """Why not, in words."""


class Watched(Protocol):
    """What is told about: the loop."""

    @property
    def outputs(self) -> OutputsSeen:
        """The outputs of its FPGA."""

    @property
    def repeating(self) -> bool:
        """Whether the FPGA plays something again and again by itself."""

    @property
    def reloading(self) -> bool:
        """Whether another scene is being prepared."""

    @property
    def stretch(self) -> Callable[[float], None]:
        """Told by how much slower emissions are played than the bank says."""


class Housekeeping:
    """Called in each turn.

    Parameters
    ----------
    board : Board
    session : Session
        Whose bit clock follows the plate's temperature.
    notifier : Notifier
        Told of the state of the panel when it changes, and that the service is ready once there is one: it serves then,
        whether or not the FPGA and the touch panel are there. Who starts after it, such as a user interface, shall not
        wait for somebody to plug in a cable, and is told of the state itself.
    watchdog : Watchdog
    thermometer : Thermometer or None
        None: the plate is taken to be as warm as the bank says.
    reload_file : ReloadFile, optional
        Told what became of each reload.

    Attributes
    ----------
    scale : float
        Of the bit clock, as the FPGA plays it now.
    condition : Condition
        How the panel is.
    """

    def __init__(
        self,
        board: Board,
        session: Session,
        notifier: Notifier,
        watchdog: Watchdog,
        thermometer: Thermometer | None,
        reload_file: ReloadFile | None = None,
    ) -> None:
        self.scale = 1.0
        self.condition = Condition()
        self._session = session
        self._notifier = notifier
        self._watchdog = watchdog
        self._thermometer = thermometer
        self._reload_file = reload_file or ReloadFile(None)
        self._read_s = math.inf if thermometer is None else -math.inf
        self._period_s = board.temperature.period_s if board.temperature else math.inf
        self._loop: Watched | None = None
        self._panel: Panel | None = None
        self._told: Callable[[Condition], None] = _nobody
        self._board_name = board.name
        self._temperature_cause = ""
        self._temperature_c: float | None = None
        self._reloading = False
        self._ready = False  # said so
        self._scene_stays = ""
        self._played_s = -math.inf
        self._emission_started = False  # since the last turn
        self._scene: PreparedScene | None = None  # taken over or refused since the last turn
        self._reloads = self._reloads_told = 0
        self._reload_refused = ""

    def watch(self, loop: Watched, panel: Panel | None, told: Callable[[Condition], None] | None = None) -> None:
        """The loop and the panel that are told about; no panel where a recording is replayed.

        Parameters
        ----------
        told : callable, optional
            Called with each new condition, the first one included.
        """
        self._loop = loop
        self._panel = panel
        if told is not None:
            self._told = told

    def emission_started(self) -> None:
        """Take note that an emission was played."""
        self._emission_started = True

    def scene_changed(self, prepared: PreparedScene) -> None:
        """Take note of a scene that was taken over, or refused; it is told in the next turn."""
        self._scene = prepared

    def progress(self, now_s: float) -> None:
        """One turn of the loop."""
        self._watchdog.progress(now_s)
        loop = self._loop
        if loop is None:
            return
        self._look(loop, now_s)
        if loop.reloading != self._reloading:
            self._reloading = loop.reloading
            if self._reloading:
                self._notifier.reloading("preparing another scene")
            else:
                self._notifier.ready(self._status)
        if self._scene is not None:
            self._tell_scene(self._scene)
            self._scene = None
        if self._reloads != self._reloads_told and not loop.reloading:  # else another is on its way, and waited for too
            self._reloads_told = self._reloads
            self._reload_file.write(self._reloads, self._reload_refused)
        if self._read_s <= now_s and loop.outputs.on:  # an FPGA that is lost takes no other bit clock
            self._follow_temperature(loop, now_s)

    def _tell_scene(self, prepared: PreparedScene) -> None:
        """Tell that a scene was taken over, or why not."""
        self._scene_stays = f"the scene stays as it was: {prepared.reason}" if prepared.scene is None else ""
        if self._scene_stays:
            log(self._scene_stays, Priority.WARNING)
        else:
            log("another scene is played, or the same read again")
        self._notifier.status(self._status)
        if not prepared.ticket:
            self._reloads += 1
            self._reload_refused = prepared.reason

    def _look(self, loop: Watched, now_s: float) -> None:
        """Tell of the panel's condition if it has changed."""
        outputs, panel = loop.outputs, self._panel
        on, state, cause = outputs.on, outputs.state, outputs.cause
        present = panel is None or panel.present
        if self._emission_started or loop.repeating:
            self._emission_started = False
            self._played_s = now_s
        if on and panel is not None and not present:
            state, cause = PanelState.WAITING_FOR_PANEL, panel.cause
        elif on and now_s - self._played_s < PLAYING_S:
            state = PanelState.PLAYING
        before = self.condition
        if (
            self._ready
            and state is before.state
            and on == before.outputs_on
            and present == before.panel_present
            and self._temperature_c == before.temperature_c
            and cause == before.cause
        ):
            return
        if not cause and state not in WORKING:
            return  # on its way: nothing is known yet
        self.condition = Condition(state, cause, on, present, self._temperature_c)
        self._log(before)
        if not self._ready:
            self._ready = True
            self._notifier.ready(self._status)
        elif (state, cause) != (before.state, before.cause):
            self._notifier.status(self._status)
        self._told(self.condition)

    def _log(self, before: Condition) -> None:
        """What of a new condition is for the log: not whether something is being played."""
        now = self.condition
        if now.outputs_on != before.outputs_on and now.outputs_on:
            log("the outputs are on")
        if not now.outputs_on and (now.state, now.cause) != (before.state, before.cause):
            asked = now.state is PanelState.DISARMED
            said = f"outputs off: {now.state.value}: {now.cause.removeprefix('outputs off: ')}"
            log(said, Priority.INFO if asked else Priority.WARNING)
        if now.panel_present and not before.panel_present:
            log("the touch panel is back")
        elif now.state is PanelState.WAITING_FOR_PANEL and (now.state, now.cause) != (before.state, before.cause):
            log(f"{now.state.value}: {now.cause}", Priority.WARNING)

    @property
    def _status(self) -> str:
        """One line for `systemctl status`."""
        now = self.condition
        said = f"{now.state.value} on board {self._board_name!r}" if now.state in WORKING else f"{now.state.value}: {now.cause}"
        return f"{said}; {self._scene_stays}" if self._scene_stays else said

    def _follow_temperature(self, loop: Watched, now_s: float) -> None:
        assert self._thermometer is not None
        scale = self._thermometer.scale(now_s)
        temperature_c = self._thermometer.temperature_c
        unknown = math.isnan(temperature_c) and not self._thermometer.cause  # it was not answered yet
        self._read_s = now_s + (min(FIRST_S, self._period_s) if unknown else self._period_s)
        self._temperature_c = None if math.isnan(temperature_c) else temperature_c
        if self._thermometer.cause != self._temperature_cause:
            self._temperature_cause = self._thermometer.cause
            if self._temperature_cause:
                log(self._temperature_cause, Priority.WARNING)
            else:
                log("the temperature sensor is read again")
        if scale == self.scale:
            return
        if self._session.set_bit_period(scale):  # else something plays: the next turn but one
            self.scale = scale
            loop.stretch(1 / scale)
        else:
            self._read_s = now_s


def _nobody(_: Condition) -> None:
    """Who is told where nobody is."""
