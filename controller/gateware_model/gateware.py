"""What stands behind a simulated link: the gateware's pins, by whatever computes them, and what their timing asks.

Ticks are clocks since reset was released: an input that changes at tick t is sampled by the clock edge that
ends tick t.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Callable
from dataclasses import asdict, dataclass
from enum import IntEnum
from pathlib import Path
from typing import Protocol, Self

from controller.board.board import Board, load_board
from controller.errors import ConfigError
from controller.fpga.build_hash import build_hash
from controller.fpga.capture import Capture
from controller.fpga.registers import DUTY_FULL

READY_TICKS = 8  # from reset to the first frame and the first trigger: inputs pass through registers
SELECT_TO_SCK_TICKS = 5  # chip select falls at least this long before the first SCK edge
SCK_TICKS = 2  # shortest period of SCK
SCK_TO_RELEASE_TICKS = 3  # from its last rise to the rise of chip select at least
SELECT_HIGH_TICKS = 4  # chip select stays high at least this long between frames
TRIGGER_HIGH_TICKS = 4  # of a trigger, as it is given here
TRIGGER_PERIOD_TICKS = 8  # between rises of the trigger: high for four clocks, low for four
EDGE_WINDOW_S = 0.25  # over which the edges of a stage are counted


BAUD = 1_000_000  # of the UART, what `haptic_core.v` has by itself


class Port(IntEnum):
    """The links that frames come by."""

    SPI = 0
    UART = 1


class Permit(IntEnum):
    """Inputs that have to be high for the outputs to be on."""

    RUN = 0
    TEMPERATURE = 1


@dataclass(frozen=True)
class Parameters:
    """What is fixed when the gateware is built; names are those of `haptic_core.v` in lower case.

    The limits are hard: whatever the host writes, or does not, none of them is exceeded.
    """

    clock_hz: int
    slots: int
    build_hash: int
    board: int
    bit_period_reset: int
    ramp_samples_reset: int
    channel_mask_max: int
    hv_settle_ticks: int
    heartbeat_ticks_max: int
    edge_window_ticks: int
    pulse_ticks_min: int
    channel_edges_max: int
    total_edges_max: int
    emission_ticks_max: int
    duty_share_max: int
    duty_ticks_max: int

    @classmethod
    def of(cls, board: Board, build_hash: int) -> Self:
        """Those of a board: what its bitstream is built with, what simulates it, and what bring-up asks for.

        Parameters
        ----------
        board : Board
        build_hash : int
            Of the Verilog.
        """
        limits, clock_hz = board.limits, board.link.clock_hz
        return cls(
            clock_hz=clock_hz,
            slots=board.link.slots,
            build_hash=build_hash,
            board=int.from_bytes(b"SIM ", "little"),  # a bitstream has the letters of its own top.v
            bit_period_reset=board.bit_period,
            ramp_samples_reset=max(1, round(limits.ramp_ms * 1e-3 * board.waveform.bit_clock_hz)),
            channel_mask_max=board.channel_mask,
            hv_settle_ticks=math.ceil(limits.hv_settle_us * 1e-6 * clock_hz),
            heartbeat_ticks_max=round(limits.heartbeat_timeout_ms * 1e-3 * clock_hz),
            edge_window_ticks=round(clock_hz * EDGE_WINDOW_S),
            pulse_ticks_min=math.floor(limits.min_pulse_us * 1e-6 * clock_hz),
            channel_edges_max=math.floor(limits.max_channel_edge_rate_hz * EDGE_WINDOW_S),
            total_edges_max=math.floor(limits.max_total_edge_rate_hz * EDGE_WINDOW_S),
            emission_ticks_max=round(limits.longest_emission_ms * 1e-3 * clock_hz),
            duty_share_max=round(limits.max_duty * DUTY_FULL),
            duty_ticks_max=round(limits.duty_budget_ms * 1e-3 * clock_hz),
        )

    def verilog(self) -> dict[str, int]:
        """Parameters of the Verilog module."""
        return {name.upper(): value for name, value in asdict(self).items()}


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


def main(board_toml: str, folder: str) -> None:
    """Print the parameters of a board's bitstream, `NAME=32'dVALUE`: what its Makefile passes on."""
    try:
        parameters = Parameters.of(load_board(Path(board_toml)), build_hash(Path(folder)))
    except (ConfigError, OSError) as error:
        sys.exit(str(error))
    built_in = parameters.verilog().items() - {("BOARD", parameters.board)}  # its letters are top.v's
    sys.stdout.write(" ".join(f"{name}=32'd{value}" for name, value in sorted(built_in)) + "\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
