"""The links of several FPGAs on one clock and one trigger line, each with a chip select of its own."""

from __future__ import annotations

from collections.abc import Sequence

from controller.device.fpga.links.link import Link


class LinkGroup:
    """`Link` to the first FPGA, with the trigger line of all; bytes and times are those of all of them."""

    def __init__(self, links: Sequence[Link]) -> None:
        self.links = tuple(links)  # the first one's trigger line leads to all
        self._first = self.links[0]

    @property
    def bytes_sent(self) -> int:
        """Bytes of frames sent to all FPGAs since the links were opened."""
        return sum([link.bytes_sent for link in self.links])

    @property
    def wire_ns(self) -> int:
        """Time in ns that those bytes took on the wire."""
        return sum([link.wire_ns for link in self.links])

    @property
    def blocked_ns(self) -> int:
        """Time in ns spent inside the links that is not the host's own work."""
        return sum([link.blocked_ns for link in self.links])

    def exchange(self, sent: memoryview, lengths: Sequence[int], received: memoryview) -> None:
        """Send frames to the first FPGA, as in `Link`."""
        self._first.exchange(sent, lengths, received)

    def trigger(self) -> float:
        """Pulse the trigger line, which is that of all FPGAs; returns the time of its edge in s, on the loop's clock."""
        return self._first.trigger()

    def wire_free_s(self) -> float:
        """When everything sent so far to any FPGA has left the wire, on the loop's clock."""
        return max([link.wire_free_s() for link in self.links])

    def close(self) -> None:
        """Release the devices."""
        for link in self.links:
            link.close()
