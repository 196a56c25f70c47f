"""Events of the gateware model that are known ahead: what happens in which tick."""

from bisect import insort
from collections.abc import Callable
from enum import Enum
from typing import NamedTuple

from controller.device.fpga.registers import Result
from controller.workshop.gateware.gateware import Permit, Port
from controller.workshop.gateware.model.decoder import Frame


class EventKind(Enum):
    """What happens."""

    PERMIT = 0
    PERMIT_NOTED = 1  # the time of a change of a permit is recorded
    TRIGGER = 2
    EMISSION_END = 3
    FRAME = 4  # a frame is executed
    UNDERRUN = 5
    LANDING = 6  # the first word of a LOAD is written
    UART_BYTE = 7
    UART_FRAME = 8  # a frame of the UART has been decoded
    UART_BEGIN = 9  # delivery of the UART's frame begins


class GatewareEvent(NamedTuple):
    """One event; which of the further fields matter depends on its kind."""

    tick: int
    kind: EventKind
    permit: Permit = Permit.RUN
    level: bool = False  # of the permit
    frame: Frame = Frame(Result.OK)
    ticks: int = 0  # for which the frame was on the wire
    landing_busy: bool = False  # when the frame began
    landing_live: bool = False
    queue_full: bool = False
    port: Port = Port.SPI
    byte: int = 0


class Events:
    """Future events in the order of their ticks."""

    def __init__(self) -> None:
        self.now = 0  # current tick of the model
        self._events: list[GatewareEvent] = []

    @property
    def next_tick(self) -> int | None:
        """Tick of the next event; None if there is none."""
        return self._events[0].tick if self._events else None

    def add(self, event: GatewareEvent) -> None:
        """Add an event; raises ValueError if its tick has passed."""
        if event.tick < self.now:
            raise ValueError(f"{event.kind.name} for tick {event.tick} is in the past: the model is at tick {self.now}")
        insort(self._events, event, key=lambda entry: entry.tick)

    def pop(self, tick: int) -> GatewareEvent | None:
        """Remove and return the next event if it happens in `tick`; else None."""
        return self._events.pop(0) if self._events and self._events[0].tick == tick else None

    def remove(self, unwanted: Callable[[GatewareEvent], bool]) -> None:
        """Remove all events for which `unwanted` is true."""
        self._events = [event for event in self._events if not unwanted(event)]
