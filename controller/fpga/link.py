"""The one interface to an FPGA: frames there and back, and the trigger pin.

`SimulatedLink` (the gateware model) and the device's SPI link are the same to everything above.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol


class Link(Protocol):
    """Frames to and from the FPGA, and its trigger pin."""

    @property
    def bytes_sent(self) -> int:
        """Frame bytes since the link was opened."""

    @property
    def wire_ns(self) -> int:
        """Time those bytes took on the wire."""

    @property
    def blocked_ns(self) -> int:
        """Time spent inside this link that is not the host's own work: waiting for the wire, computing the far end."""

    def exchange(self, sent: memoryview, lengths: Sequence[int], received: memoryview) -> None:
        """Send frames that lie back to back, each under its own chip select, and store what comes back.

        Raises
        ------
        LinkError
            If the device fails.
        """

    def trigger(self) -> float:
        """Pulse the trigger pin; the time of its edge in s on the loop's clock."""

    def wire_free_s(self) -> float:
        """Since or until when, on the loop's clock, the wire is free: what is sent or triggered before waits until then."""

    def close(self) -> None:
        """Let go of the device."""
