"""Interface of simulated gateware: the model, or the compiled Verilog.

Ticks are FPGA clocks since reset was released: an input that changes at tick t is sampled by the clock edge that ends tick t.
"""

from collections.abc import Callable
from enum import IntEnum
from typing import Protocol

from controller.device.fpga.build_parameters import BuildParameters
from controller.device.fpga.capture import Capture
from controller.workshop.gateware.pin_timing import TRIGGER_HIGH_TICKS


class Port(IntEnum):
    """The FPGA's links to hosts."""

    SPI = 0
    UART = 1


class Permit(IntEnum):
    """Inputs that must be high for the outputs to be on."""

    RUN = 0
    TEMPERATURE = 1


class Gateware(Protocol):
    """`haptic_core.v` with its pins, computed by the model or by the Verilog itself.

    Give inputs in the order of their ticks; those that change during a frame before that frame. An input in the past, or closer
    to the one before than the pins allow, is a ValueError.
    """

    @property
    def now(self) -> int:
        """The current tick."""

    @property
    def fault(self) -> bool:
        """Whether `fault_o` is high now."""

    def next_change(self) -> int | None:
        """Next tick in which something may happen without further input; None if nothing will."""

    def advance(self, tick: int) -> None:
        """Advance to `tick`; does nothing if that has passed."""

    def permit(self, tick: int, *, level: bool, which: Permit = Permit.RUN) -> None:
        """Set the permit pin `which` to `level` at `tick`; both are low at tick 0."""

    def trigger(self, tick: int, high_ticks: int = TRIGGER_HIGH_TICKS) -> None:
        """Raise the trigger pin at `tick` for `high_ticks` (fewer than 3 are a glitch); the next rise is at least 8 ticks later."""

    def exchange(self, select_tick: int, release_tick: int, mosi: bytes | bytearray | memoryview, miso: memoryview) -> None:
        """Exchange one frame (`mosi`) between the fall and the rise of chip select.

        `miso`, which is as long, receives the status at the fall of chip select, then zeros or the echo of a TEST.
        """

    def take_capture(self) -> Capture:
        """Changes of the output pins since the last capture, up to now."""


GatewareFactory = Callable[[BuildParameters], Gateware]
"""Makes gateware that was just reset."""
