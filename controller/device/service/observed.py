"""What housekeeping observes: thermometer, touch panel, outputs and event loop, as interfaces."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from typing import Protocol

from controller.device.board.panel_state import PanelState
from controller.device.touch.event_reader import DeviceDescription


class TemperatureSource(Protocol):
    """Temperature of the plate, and the bit clock that follows from it."""

    @property
    def temperature_c(self) -> float:
        """Temperature in °C; NaN if unknown."""

    @property
    def cause(self) -> str:
        """Why the last reading failed; empty if it did not."""

    def scale(self, now_s: float) -> float:
        """Read the sensor if due; returns the factor of the bit clock."""


class Panel(Protocol):
    """A touch panel that may be disconnected."""

    warnings: Counter[str]  # anomalies found by its driver, by kind (`reports.WARNINGS`)

    @property
    def description(self) -> DeviceDescription:
        """Description of the device as it was opened last."""

    @property
    def present(self) -> bool:
        """Whether it is connected."""

    @property
    def cause(self) -> str:
        """Why it is not connected; empty while unknown."""


class OutputsSeen(Protocol):
    """The outputs of the FPGA, as the event loop knows them."""

    @property
    def on(self) -> bool:
        """Whether plays are accepted."""

    @property
    def may_be_on(self) -> bool:
        """Whether there may be voltage at the actuators."""

    @property
    def state(self) -> PanelState:
        """ARMED, RAMPING, or the state that keeps them off."""

    @property
    def cause(self) -> str:
        """Why they are off, or ramp."""


class Playing(Protocol):
    """What of the event loop the bit clock concerns."""

    @property
    def stretch(self) -> Callable[[float], None]:
        """Callable that takes the factor by which emissions are longer than in the bank."""

    def pause_repetition(self, now_s: float) -> None:
        """End the repetition by the FPGA, if there is one, for as long as a setting of it takes."""


class Watched(Playing, Protocol):
    """State of the event loop that the service reports."""

    @property
    def outputs(self) -> OutputsSeen:
        """The outputs of the FPGA."""

    @property
    def repeating(self) -> bool:
        """Whether the FPGA repeats an emission by itself."""

    @property
    def reloading(self) -> bool:
        """Whether another scene is being prepared."""
