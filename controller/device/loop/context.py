"""What the parts of a loop share, and who watches it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from controller.clocks import NEVER, Clock
from controller.device.board.board import Board
from controller.device.fpga.clock_estimate import ClockEstimate
from controller.device.fpga.session import Session
from controller.device.loop.emission_ring import EmissionRing
from controller.device.loop.layer_source import LayerPreparation
from controller.device.loop.scene_source import PreparedScene
from controller.device.loop.trace_ring import TraceRing
from controller.device.touch.source import Silence, TrackedTouch
from controller.metrics import Counters


class LoopContext:
    """The panel that a loop drives, its clocks and its counters.

    Parameters
    ----------
    session : Session
        Of an FPGA that may still be absent; it counts in `counters.link`.
    silence : Silence, optional
        Of the touch panel's source: set in each turn to whether something has come from the panel.
    layers : LayerPreparation, optional
        Checks clients' layers of regions; without it there are none.
    """

    def __init__(
        self,
        board: Board,
        clock: Clock,
        session: Session,
        source: TrackedTouch,
        *,
        silence: Silence | None = None,
        layers: LayerPreparation | None = None,
    ) -> None:
        self.layers = layers
        self.board = board
        self.clock = clock
        self.session = session
        self.source = source
        self.silence = silence or Silence()
        self.clock_estimate = ClockEstimate(board.link.clock_hz)
        self.counters = Counters()
        self.trace = TraceRing()
        self.emissions = EmissionRing()
        session.counters = self.counters.link


class SpareTime:
    """What is done between two turns of the loop; this one does nothing.

    Attributes
    ----------
    due_s : float
        Host time from which `use` is called after each turn.
    """

    def __init__(self) -> None:
        self.due_s = NEVER

    def use(self, now_s: float, next_s: float) -> None:
        """Do it, or not yet.

        Parameters
        ----------
        now_s, next_s : float
            Host time, and that of the next turn; a touch or a command may begin it before.
        """


@dataclass(frozen=True, slots=True)
class Watch:
    """Who is called by a loop; None: nobody.

    Attributes
    ----------
    progress : callable
        In each turn, with the host time.
    emission_started : callable
        Whenever an emission starts, or a repetition by the FPGA.
    scene_changed : callable
        With each scene that was prepared, taken over or refused.
    spare : tuple of SpareTime
        Between turns; of those that are due, the first one.
    """

    progress: Callable[[float], None] | None = None
    emission_started: Callable[[], None] | None = None
    scene_changed: Callable[[PreparedScene], None] | None = None
    spare: tuple[SpareTime, ...] = ()
