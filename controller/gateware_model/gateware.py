"""What stands behind a simulated link: the gateware's pins, by whatever computes them, and what their timing asks.

Ticks are clocks since reset was released: an input that changes at tick t is sampled by the clock edge that
ends tick t.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import IntEnum
from typing import Protocol, Self

from controller.fpga.build_parameters import Parameters
from controller.fpga.capture import Capture

READY_TICKS = 8  # from reset to the first frame and the first trigger: inputs pass through registers
SELECT_TO_SCK_TICKS = 5  # chip select falls at least this long before the first SCK edge
SCK_TICKS = 2  # shortest period of SCK
SCK_TO_RELEASE_TICKS = 3  # from its last rise to the rise of chip select at least
SELECT_HIGH_TICKS = 4  # chip select stays high at least this long between frames
TRIGGER_HIGH_TICKS = 4  # of a trigger, as it is given here
TRIGGER_PERIOD_TICKS = 8  # between rises of the trigger: high for four clocks, low for four


BAUD = 1_000_000  # of the UART, what `haptic_core.v` has by itself


class Port(IntEnum):
    """The links that frames come by."""

    SPI = 0
    UART = 1


class Permit(IntEnum):
    """Inputs that have to be high for the outputs to be on."""

    RUN = 0
    TEMPERATURE = 1


class Gateware(Protocol):
    """`haptic_core.v` with its pins, computed: by the model, or by the Verilog itself.

    Inputs are given in the order of their ticks; what changes while a frame is on the wire is given before
    that frame. What lies in the past, or closer to what was before than the pins allow, is a ValueError.
    """

    @property
    def now(self) -> int:
        """The tick it has come to."""

    def advance(self, tick: int) -> None:
        """Go to `tick`; a tick already passed changes nothing."""

    def permit(self, tick: int, level: bool, which: Permit = Permit.RUN) -> None:
        """Drive a permit pin to `level` at `tick`; both are low at tick 0."""

    def trigger(self, tick: int, high_ticks: int = TRIGGER_HIGH_TICKS) -> None:
        """Raise the trigger pin at `tick`; less than 3 clocks are a glitch. The next rise comes 8 clocks later or after."""

    def exchange(self, select_tick: int, release_tick: int, mosi: bytes | bytearray | memoryview, miso: memoryview) -> None:
        """One chip-select assertion: the pin falls at `select_tick` and rises at `release_tick`.

        Parameters
        ----------
        mosi : bytes-like
            What the host sends.
        miso : writable memoryview of as many bytes
            What comes back meanwhile: the status as of the fall, then zeros, or the echo of a TEST.
        """

    def take_capture(self) -> Capture:
        """Everything that happened on the output pins since the last capture, up to now."""


GatewareFactory = Callable[[Parameters], Gateware]
"""Gateware just out of reset."""


@dataclass(frozen=True)
class UartTiming:
    """Bits and bytes of the UART in ticks, as `uart_receiver.v` and `uart_transmitter.v` count them.

    Attributes
    ----------
    bit_256 : int
        Length of a bit, in 256ths of a tick.
    """

    bit_256: int

    @classmethod
    def of(cls, parameters: Parameters) -> Self:
        """At the rate that the gateware has by itself."""
        return cls((parameters.clock_hz * 512 // BAUD + 1) // 2)

    def bit_tick(self, tick: int, byte: int, bit: int) -> int:
        """When a bit begins (0: start, 9: stop) of bytes sent back to back from `tick` on."""
        return tick + ((10 * byte + bit) * self.bit_256 >> 8)

    def heard_tick(self, tick: int) -> int:
        """The tick in which a byte is there whose start bit falls at `tick`: in the middle of its stop bit."""
        return tick + 4 + (self.bit_256 // 2 - 256 + 9 * self.bit_256 >> 8)


def frame_ticks(size_bytes: int) -> int:
    """The least from the fall of chip select to its rise."""
    clocked = SCK_TICKS * (8 * size_bytes - 1) + SCK_TO_RELEASE_TICKS if size_bytes else 0
    return SELECT_TO_SCK_TICKS + clocked


def sck_rise_tick(select_tick: int, release_tick: int, size_bytes: int, bit: int) -> int:
    """When SCK rises for a bit of a frame, its rises spread evenly between the edges of chip select."""
    room = release_tick - select_tick - SELECT_TO_SCK_TICKS - (SCK_TO_RELEASE_TICKS - SCK_TICKS)
    return select_tick + SELECT_TO_SCK_TICKS + bit * room // (8 * size_bytes)


class InputTiming:
    """When chip select may fall and rise, and when the trigger may rise; all errors are ValueErrors."""

    def __init__(self) -> None:
        self._select_from = READY_TICKS
        self._trigger_from = READY_TICKS

    def frame(self, select_tick: int, release_tick: int, size_bytes: int) -> None:
        """Take note of a frame; one that begins too early, or whose bits come too fast, could not be read."""
        if select_tick < self._select_from:
            raise ValueError(f"chip select falls at tick {select_tick}, before tick {self._select_from}")
        shortest = frame_ticks(size_bytes)
        if release_tick - select_tick < shortest:
            raise ValueError(f"{size_bytes} bytes need {shortest} ticks, not {release_tick - select_tick}")
        self._select_from = release_tick + SELECT_HIGH_TICKS

    def trigger(self, tick: int, high_ticks: int) -> None:
        """Take note of a rise of the trigger; one that comes too early could not be seen."""
        if tick < self._trigger_from:
            raise ValueError(f"the trigger rises at tick {tick}, before tick {self._trigger_from}")
        if not 1 <= high_ticks <= TRIGGER_HIGH_TICKS:
            raise ValueError(f"the trigger is high for {high_ticks} ticks, not 1 to {TRIGGER_HIGH_TICKS}")
        self._trigger_from = tick + TRIGGER_PERIOD_TICKS
