"""An FPGA without a configuration, as it is delivered: its pins float, which pull-ups make ones."""

import numpy as np

from controller.device.fpga.capture import Capture
from controller.workshop.gateware.gateware import Permit
from controller.workshop.gateware.pin_timing import TRIGGER_HIGH_TICKS


class EmptyFpga:
    """`Gateware` that is none: it answers ones, and no output ever moves."""

    def __init__(self) -> None:
        self.now = 0

    @property
    def fault(self) -> bool:
        """The pin floats, and is pulled to what stops the others."""
        return True

    def next_change(self) -> int | None:
        """Nothing ever happens."""
        return None

    def advance(self, tick: int) -> None:
        """As in `Gateware`."""
        self.now = max(self.now, tick)

    def permit(self, tick: int, *, level: bool, which: Permit = Permit.RUN) -> None:  # noqa: ARG002
        """Nothing listens."""
        self.advance(tick)

    def trigger(self, tick: int, high_ticks: int = TRIGGER_HIGH_TICKS) -> None:  # noqa: ARG002
        """Nothing listens."""
        self.advance(tick)

    def exchange(
        self,
        select_tick: int,  # noqa: ARG002
        release_tick: int,
        mosi: bytes | bytearray | memoryview,  # noqa: ARG002
        miso: memoryview,
    ) -> None:
        """All bits are ones, whatever is sent."""
        miso[:] = b"\xff" * len(miso)
        self.advance(release_tick)

    def take_capture(self) -> Capture:
        """No change of any pin."""
        none = np.zeros(0, np.uint64)
        return Capture(none, np.zeros(0, np.uint32), np.zeros(0, np.uint8), none)
