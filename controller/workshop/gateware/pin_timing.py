"""Timing that the pins of simulated gateware require: SPI, trigger and UART, in ticks.

Ticks are FPGA clocks since reset was released.
"""

from dataclasses import dataclass
from typing import Self

from controller.device.fpga.build_parameters import BuildParameters

READY_TICKS = 8  # from reset to the first frame and the first trigger: inputs pass through registers
SELECT_TO_SCK_TICKS = 5  # least time from the fall of chip select to the first edge of SCK
SCK_TICKS = 2  # shortest period of SCK
SCK_TO_RELEASE_TICKS = 3  # least time from the last rise of SCK to the rise of chip select
SELECT_HIGH_TICKS = 4  # least time for which chip select is high between frames
TRIGGER_HIGH_TICKS = 4  # length of a trigger pulse, unless set otherwise
TRIGGER_PERIOD_TICKS = 8  # between rises of the trigger: high for four clocks, low for four
BAUD = 1_000_000  # of the UART: the default of `haptic_core.v`


@dataclass(frozen=True)
class UartTiming:
    """Timing of the UART in ticks, as `uart_receiver.v` and `uart_transmitter.v` count them."""

    bit_256: int  # length of a bit, in 256ths of a tick

    @classmethod
    def of(cls, parameters: BuildParameters) -> Self:
        """Timing at the default baud rate, for the clock in `parameters`."""
        return cls((parameters.clock_hz * 512 // BAUD + 1) // 2)

    def bit_tick(self, tick: int, byte: int, bit: int) -> int:
        """Tick in which bit `bit` (0: start, 9: stop) of byte `byte` begins, of bytes sent back to back from `tick` on."""
        return tick + ((10 * byte + bit) * self.bit_256 >> 8)

    def received_tick(self, tick: int) -> int:
        """Tick in which a byte is received whose start bit begins at `tick`: in the middle of its stop bit."""
        return tick + 4 + (self.bit_256 // 2 - 256 + 9 * self.bit_256 >> 8)


def frame_ticks(size_bytes: int) -> int:
    """Least ticks from the fall of chip select to its rise, for a frame of `size_bytes`."""
    clocked = SCK_TICKS * (8 * size_bytes - 1) + SCK_TO_RELEASE_TICKS if size_bytes else 0
    return SELECT_TO_SCK_TICKS + clocked


def sck_rise_tick(select_tick: int, release_tick: int, size_bytes: int, bit: int) -> int:
    """Tick in which SCK rises for bit `bit`, from 0 on, of a frame of `size_bytes`.

    SCK is spread evenly between fall and rise of chip select.
    """
    room = release_tick - select_tick - SELECT_TO_SCK_TICKS - (SCK_TO_RELEASE_TICKS - SCK_TICKS)
    return select_tick + SELECT_TO_SCK_TICKS + bit * room // (8 * size_bytes)


class InputTiming:
    """Checks the timing of chip select and trigger; violations are ValueErrors."""

    def __init__(self) -> None:
        self._select_from = READY_TICKS
        self._trigger_from = READY_TICKS

    def frame(self, select_tick: int, release_tick: int, size_bytes: int) -> None:
        """Check a frame of `size_bytes`, with chip select low from `select_tick` to `release_tick`, and note it.

        Raises ValueError if it begins too early, or its bits are too fast for its length.
        """
        if select_tick < self._select_from:
            raise ValueError(f"chip select falls at tick {select_tick}, before tick {self._select_from}")
        shortest = frame_ticks(size_bytes)
        if release_tick - select_tick < shortest:
            raise ValueError(f"{size_bytes} bytes need {shortest} ticks, not {release_tick - select_tick}")
        self._select_from = release_tick + SELECT_HIGH_TICKS

    def trigger(self, tick: int, high_ticks: int) -> None:
        """Check a trigger pulse of `high_ticks` at `tick`, and note it.

        Raises ValueError if it comes too early, or is longer than 4 ticks.
        """
        if tick < self._trigger_from:
            raise ValueError(f"the trigger rises at tick {tick}, before tick {self._trigger_from}")
        if not 1 <= high_ticks <= TRIGGER_HIGH_TICKS:
            raise ValueError(f"the trigger is high for {high_ticks} ticks, not 1 to {TRIGGER_HIGH_TICKS}")
        self._trigger_from = tick + TRIGGER_PERIOD_TICKS
