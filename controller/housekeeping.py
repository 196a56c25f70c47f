"""What the service does beside playing, a little in each turn of the loop: watchdog, status, log, temperature."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Protocol

from controller.board import Board
from controller.fpga.session import Session
from controller.latency import Counters
from controller.service import Notifier, Watchdog, tell


class Thermometer(Protocol):
    """The plate's temperature, as far as it is known."""

    @property
    def cause(self) -> str:
        """Why the last reading gave nothing; empty if it did."""

    def scale(self, now_s: float) -> float:
        """What the bit clock is to be multiplied by."""


class Panel(Protocol):
    """A touch panel, as far as it can be lost."""

    @property
    def present(self) -> bool:
        """Whether it is there."""


class Watched(Protocol):
    """What is told about: the loop."""

    @property
    def state(self) -> str:
        """Empty while the outputs are on, else why not."""

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
        Told of the state of the outputs when it changes.
    watchdog : Watchdog
    thermometer : Thermometer or None
        None: the plate is taken to be as warm as the bank says.

    Attributes
    ----------
    scale : float
        Of the bit clock, as the FPGA plays it now.
    """

    def __init__(
        self, board: Board, session: Session, notifier: Notifier, watchdog: Watchdog, thermometer: Thermometer | None
    ) -> None:
        self.scale = 1.0
        self._session = session
        self._notifier = notifier
        self._watchdog = watchdog
        self._thermometer = thermometer
        self._read_s = math.inf if thermometer is None else -math.inf
        self._period_s = board.temperature.period_s if board.temperature else math.inf
        self._loop: Watched | None = None
        self._panel: Panel | None = None
        self._board_name = board.name
        self._cause = ""
        self._reloading = False
        self._state = ""
        self._present = True
        self._counters: Counters | None = None
        self._loaded = self._refused = 0

    def watch(self, loop: Watched, counters: Counters, panel: Panel | None) -> None:
        """The loop, the counters and the panel that are told about; no panel where a recording is replayed."""
        self._loop = loop
        self._counters = counters
        self._panel = panel

    def progress(self, now_s: float) -> None:
        """One turn of the loop."""
        self._watchdog.progress(now_s)
        loop, counters = self._loop, self._counters
        if loop is None or counters is None:
            return
        if loop.state != self._state:
            self._state = loop.state
            self._say(f"outputs off: {self._state.removeprefix('outputs off: ')}" if self._state else "the outputs are on")
        if self._panel is not None and self._panel.present != self._present:
            self._present = self._panel.present
            self._say("the touch panel is back" if self._present else "the touch panel is lost; it is looked for twice a second")
        if loop.reloading != self._reloading:
            self._reloading = loop.reloading
            if self._reloading:
                self._notifier.reloading("preparing another scene")
            else:
                self._notifier.ready(f"playing on board {self._board_name!r}")
        if counters.scenes_loaded != self._loaded:
            self._loaded = counters.scenes_loaded
            self._say("another scene is played, or the same read again")
        if counters.scenes_refused != self._refused:
            self._refused = counters.scenes_refused
            self._say(f"the scene stays as it was: {counters.scene_refused}")
        if self._read_s <= now_s and not loop.state:  # an FPGA that is lost takes no other bit clock
            self._follow_temperature(loop, now_s)

    def _follow_temperature(self, loop: Watched, now_s: float) -> None:
        assert self._thermometer is not None
        scale = self._thermometer.scale(now_s)
        self._read_s = now_s + self._period_s
        if self._thermometer.cause != self._cause:
            self._cause = self._thermometer.cause
            self._say(self._cause or "the temperature sensor is read again")
        if scale == self.scale:
            return
        if self._session.set_bit_period(scale):  # else something plays: the next turn but one
            self.scale = scale
            loop.stretch(1 / scale)
        else:
            self._read_s = now_s

    def _say(self, sentence: str) -> None:
        tell(sentence)
        self._notifier.status(sentence)
