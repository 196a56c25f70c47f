"""The interface of every link to an FPGA: SPI, UART, or simulated gateware."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol


class Link(Protocol):
    """Exchanges frames with the FPGA and drives its trigger."""

    @property
    def bytes_sent(self) -> int:
        """Bytes of frames sent since the link was opened."""

    @property
    def wire_ns(self) -> int:
        """Time in ns that those bytes took on the wire."""

    @property
    def blocked_ns(self) -> int:
        """Time in ns spent inside the link that is not the host's own work: waiting for the wire, simulating the FPGA."""

    def exchange(self, sent: memoryview, lengths: Sequence[int], received: memoryview) -> None:
        """Send frames, each under its own chip select, and store the answers.

        The frames, of these lengths in bytes, lie back to back in `sent` from 0 on; the answer to each is stored in `received`,
        which is as large, at the frame's offset. Raises LinkError if the device fails.
        """

    def trigger(self) -> float:
        """Pulse the trigger pin; returns the time of its edge in s, on the loop's clock."""

    def wire_free_s(self) -> float:
        """When everything sent so far has left the wire, on the loop's clock; a trigger requested earlier waits until then."""

    def close(self) -> None:
        """Release the device."""
