"""What stands behind a simulated link: the gateware's pins, by whatever computes them, and what their timing asks.

Ticks are clocks since reset was released: an input that changes at tick t is sampled by the clock edge that
ends tick t.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from controller.fpga.capture import Capture

READY_TICKS = 4  # from reset to the first frame and the first trigger: inputs pass through registers
SELECT_TO_SCK_TICKS = 5  # chip select falls at least this long before the first SCK edge
SCK_TICKS = 6  # shortest period of SCK, whose pins are oversampled
SELECT_HIGH_TICKS = 4  # chip select stays high at least this long between frames
TRIGGER_PERIOD_TICKS = 4  # between rises of the trigger: high for two clocks, low for two
HEARTBEAT_LIMIT_S = 0.25  # the longest heartbeat timeout, fixed when the gateware is built


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

    def permit(self, tick: int, level: bool) -> None:
        """Drive the run permit pin to `level` at `tick`; it is low at tick 0."""

    def trigger(self, tick: int) -> None:
        """Raise the trigger pin at `tick`, for two clocks; the next rise comes 4 clocks later or after."""

    def exchange(self, select_tick: int, release_tick: int, mosi: bytes | bytearray | memoryview, miso: memoryview) -> None:
        """One chip-select assertion: the pin falls at `select_tick` and rises at `release_tick`.

        Parameters
        ----------
        mosi : bytes-like
            What the host sends.
        miso : writable memoryview of as many bytes
            What comes back meanwhile: the status as of the fall, then zeros.
        """

    def take_capture(self) -> Capture:
        """Everything that happened on the output pins since the last capture, up to now."""


GatewareFactory = Callable[[int, int, int, int], Gateware]
"""Gateware just out of reset, of: clock in Hz, slots, build hash, longest heartbeat timeout in ticks."""


class InputTiming:
    """When chip select may fall and rise, and when the trigger may rise; all errors are ValueErrors."""

    def __init__(self) -> None:
        self._select_from = READY_TICKS
        self._trigger_from = READY_TICKS

    def frame(self, select_tick: int, release_tick: int, size_bytes: int) -> None:
        """Take note of a frame; one that begins too early, or whose bits come too fast, could not be read."""
        if select_tick < self._select_from:
            raise ValueError(f"chip select falls at tick {select_tick}, before tick {self._select_from}")
        shortest = SELECT_TO_SCK_TICKS + SCK_TICKS * 8 * size_bytes
        if release_tick - select_tick < shortest:
            raise ValueError(f"{size_bytes} bytes need {shortest} ticks, not {release_tick - select_tick}")
        self._select_from = release_tick + SELECT_HIGH_TICKS

    def trigger(self, tick: int) -> None:
        """Take note of a rise of the trigger; one that comes too early could not be seen."""
        if tick < self._trigger_from:
            raise ValueError(f"the trigger rises at tick {tick}, before tick {self._trigger_from}")
        self._trigger_from = tick + TRIGGER_PERIOD_TICKS
