"""Links whose device may be absent when the service starts: the first message that finds the device opens it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial

from controller.device.fpga.links.link import Link
from controller.device.fpga.links.link_group import LinkGroup
from controller.errors import LinkError


class LazyLink:
    """`Link` that is opened by the first exchange for which the device is there.

    `open_link` returns the open link, or raises LinkError.
    """

    def __init__(self, open_link: Callable[[], Link], now_s: Callable[[], float]) -> None:
        self._open = open_link
        self._now_s = now_s
        self._link: Link | None = None

    @property
    def bytes_sent(self) -> int:
        """Bytes of frames sent since the link was opened."""
        return self._link.bytes_sent if self._link is not None else 0

    @property
    def wire_ns(self) -> int:
        """Time in ns that those bytes took on the wire."""
        return self._link.wire_ns if self._link is not None else 0

    @property
    def blocked_ns(self) -> int:
        """Time in ns spent inside the link."""
        return self._link.blocked_ns if self._link is not None else 0

    def exchange(self, sent: memoryview, lengths: Sequence[int], received: memoryview) -> None:
        """Send frames and store the answers; opens the link first if necessary. Parameters as in `Link.exchange`.

        Raises LinkError if the device is not there yet, or fails.
        """
        if self._link is None:
            self._link = self._open()
        self._link.exchange(sent, lengths, received)

    def trigger(self) -> float:
        """Pulse the trigger pin; returns the time of its edge in s, on the loop's clock.

        Raises LinkError if the link is not open yet.
        """
        if self._link is None:
            raise LinkError("the link to the FPGA is not open yet")
        return self._link.trigger()

    def wire_free_s(self) -> float:
        """When everything sent so far has left the wire, on the loop's clock; now, before the link is open."""
        return self._link.wire_free_s() if self._link is not None else self._now_s()

    def close(self) -> None:
        """Release the device, if it was opened."""
        if self._link is not None:
            self._link.close()


class LazyGroup(LinkGroup):
    """`LinkGroup` to a number of FPGAs, which are opened together by the first exchange for which all are there.

    `open_links` returns the open links, or raises LinkError.
    """

    def __init__(self, open_links: Callable[[], Link], fpgas: int, now_s: Callable[[], float]) -> None:
        self._open = open_links
        self._group: LinkGroup | None = None
        super().__init__([LazyLink(partial(self._opened, number), now_s) for number in range(fpgas)])

    def close(self) -> None:
        """Release the devices, if they were opened."""
        if self._group is not None:
            self._group.close()

    def _opened(self, number: int) -> Link:
        if self._group is None:
            group = self._open()
            assert isinstance(group, LinkGroup)
            self._group = group
        return self._group.links[number]
