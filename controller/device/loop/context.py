"""What the parts of a loop share, and who watches it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from controller.clocks import NEVER, Clock
from controller.device.board.board import Board
from controller.device.fpga.clock_estimate import ClockEstimate
from controller.device.fpga.session import Session
from controller.device.loop.preparation import LayerPreparation, PreparedScene
from controller.device.loop.rings.emission_ring import EmissionRing
from controller.device.loop.rings.trace_ring import TraceRing
from controller.device.touch.source import Silence, TrackedTouch
from controller.metrics import Counters


class LoopContext:
    """The panel that a loop drives, its clocks and its counters."""

    def __init__(
        self,
        board: Board,
        clock: Clock,
        session: Session,  # of an FPGA that may still be absent; it counts in `counters.link`
        source: TrackedTouch,
        *,
        # Of the touch panel's source: set in each turn to whether something has come from the panel
        silence: Silence | None = None,
        layers: LayerPreparation | None = None,  # checks clients' layers of regions; without it there are none
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
    """What is done between two turns of the loop; this one does nothing."""

    def __init__(self) -> None:
        self.due_s = NEVER  # host time from which `use` is called after each turn

    def use(self, now_s: float, next_s: float) -> None:
        """Do it, or not yet. `now_s` is host time, `next_s` that of the next turn; a touch or a command may begin it before."""


@dataclass(frozen=True, slots=True)
class Watch:
    """Who is called by a loop; None: nobody."""

    progress: Callable[[float], None] | None = None  # in each turn, with the host time
    emission_started: Callable[[], None] | None = None  # whenever an emission starts, or a repetition by the FPGA
    scene_changed: Callable[[PreparedScene], None] | None = None  # with each scene that was prepared, taken over or refused
    spare: tuple[SpareTime, ...] = ()  # between turns; of those that are due, the first one
