"""The device's link: SPI by spidev with one system call for each message; trigger and run permit by GPIO lines.

Between the frames of a message chip select is high for 10 µs: the kernel's default (spi.c, cs_change_delay), which spidev cannot
change.
"""

from __future__ import annotations

import contextlib
import errno
import fcntl
import os
import time
from collections.abc import Callable, Sequence
from typing import Final

import spidev

from controller.device.board.devices import LinkSettings, divided_hz
from controller.device.fpga.links.gpio_lines import GpioLines
from controller.device.fpga.links.link_group import LinkGroup
from controller.device.fpga.links.spi_device import open_device, read_bufsiz, set_speed
from controller.device.fpga.links.spi_messages import SpiMessages
from controller.errors import LinkError

REMOVED: Final = frozenset({errno.ESHUTDOWN, errno.ENODEV, errno.ENXIO, errno.ENOENT, errno.EBADF})  # the device was removed


class SpiLink:
    """`Link` to an FPGA on SPI, with its trigger and permit lines.

    `settings` is of kind "spi". One of several FPGAs, not `alone`, is given the `lines` that they share before it is used. Raises
    LinkError if the device or a line is absent, in use or unsuitable, or the FPGA is not configured.
    """

    lines: GpioLines

    def __init__(self, settings: LinkSettings, now_s: Callable[[], float], *, alone: bool = True) -> None:
        self.bytes_sent = 0
        self.wire_ns = 0  # wire_ns, blocked_ns: both are the time spent in the kernel, which returns after the last bit
        self.blocked_ns = 0
        self.sck_hz = 0.0  # actual SCK, computed from `settings.spi_source_hz` where that is given; otherwise what spidev says
        self.bufsiz = read_bufsiz()
        self._settings = settings
        self._asked_hz = settings.sck_hz
        self._now_s = now_s
        self._free_s = now_s()
        self._messages: SpiMessages | None = None
        self._spi: spidev.SpiDev | None = self._opened()
        self._failed = False
        if not alone:
            return
        try:
            self.lines = GpioLines(settings, now_s)
        except LinkError:
            self.release()
            raise
        try:
            self.lines.begin()
        except LinkError:
            self.close()
            raise

    def exchange(self, sent: memoryview, lengths: Sequence[int], received: memoryview) -> None:
        """Send frames and store the answers; parameters as in `Link.exchange`.

        Raises LinkError if the bus fails, or the device was removed; the next call opens it again. The run permit, that of all
        FPGAs, is withdrawn until a message succeeds, since nothing else may reach the FPGA.
        """
        messages = self._messages
        if messages is None or messages.sent is not sent or messages.received is not received:
            messages = self._messages = SpiMessages(sent, received, self.bufsiz)
        if self._spi is None:
            self._spi = self._opened_again()
        fd = self._spi.fileno()
        pieces = messages.for_lengths(lengths)
        started_ns = time.perf_counter_ns()
        try:
            for request, transfers, size in pieces:
                fcntl.ioctl(fd, request, transfers)
                self.bytes_sent += size
            if self._failed:
                self.lines.works(self._settings.device)
                self._failed = False
        except OSError as error:
            raise self._failure(error) from error
        finally:
            elapsed_ns = time.perf_counter_ns() - started_ns
            self.wire_ns += elapsed_ns
            self.blocked_ns += elapsed_ns
            self._free_s = self._now_s()

    def trigger(self) -> float:
        """Pulse the trigger line; returns the time of its edge in s, on the loop's clock."""
        return self.lines.pulse()

    def wire_free_s(self) -> float:
        """When the last message ended, on the loop's clock."""
        return self._free_s

    @property
    def effective_hz(self) -> float:
        """Mean bit rate in bit/s, including the kernel's time and the pauses between frames; 0 before the first message."""
        return 8e9 * self.bytes_sent / self.wire_ns if self.wire_ns else 0.0

    def set_sck_hz(self, sck_hz: int) -> float:
        """Set SCK, at most the board's; returns the actual SCK in Hz.

        Raises ValueError if it is outside 1 to the board's; LinkError if the controller refuses it.
        """
        if not 0 < sck_hz <= self._settings.sck_hz:
            raise ValueError(f"sck_hz = {sck_hz} is not 1 to the board's {self._settings.sck_hz}")
        if self._spi is None:
            self._spi = self._opened_again()
        self._asked_hz = sck_hz
        try:
            self._take_speed(set_speed(self._spi, sck_hz))
        except OSError as error:
            raise self._failure(error) from error
        return self.sck_hz

    def close(self) -> None:
        """Withdraw the run permit and release the device."""
        self.lines.close()
        self.release()

    def release(self) -> None:
        """Release the device alone."""
        if self._spi is not None:
            self._spi.close()
            self._spi = None

    def _opened(self) -> spidev.SpiDev:
        spi, said_hz = open_device(self._settings.device, self._asked_hz)
        self._take_speed(said_hz)
        return spi

    def _opened_again(self) -> spidev.SpiDev:
        """Open the device after it was removed."""
        try:
            return self._opened()
        except LinkError as error:
            if isinstance(error.__cause__, OSError) and error.__cause__.errno in REMOVED:
                raise LinkError(self._removed) from error
            raise

    @property
    def _removed(self) -> str:
        device = self._settings.device
        return f"{device} was removed: its driver was unbound, or its adapter unplugged; it is opened again when it is back"

    def _take_speed(self, said_hz: int) -> None:
        source_hz = self._settings.spi_source_hz
        self.sck_hz = divided_hz(source_hz, said_hz) if source_hz else float(said_hz)

    def _failure(self, error: OSError) -> LinkError:
        """The error to raise for a failed system call; releases a device that was removed."""
        device = self._settings.device
        self.lines.failed(self._settings.device)
        self._failed = True
        if error.errno in REMOVED:
            if self._spi is not None:
                with contextlib.suppress(OSError):
                    self._spi.close()
            self._spi = None
            return LinkError(self._removed)
        if error.errno == errno.ETIMEDOUT:
            return LinkError(
                f"{device}: the SPI controller did not finish a transfer: its bus is stuck; restart the machine if it stays"
            )
        if error.errno == errno.EMSGSIZE:
            return LinkError(
                f"{device}: a message does not fit spidev's buffer: was bufsiz changed? It was {self.bufsiz} when opened"
            )
        return LinkError(f"{device} failed ({error.strerror}): look into the kernel's log (dmesg)")


def open_spi_links(settings: LinkSettings, of_each: Sequence[LinkSettings], now_s: Callable[[], float]) -> LinkGroup:
    """Links to several FPGAs on shared lines, all of them or none: the permit is given when each is open and configured.

    `settings` are those of all, `of_each` those of each by itself. Raises LinkError as `SpiLink`, or if two are one device.
    """
    links: dict[str, SpiLink] = {}
    with contextlib.ExitStack() as opened:
        for one in of_each:
            path = os.path.realpath(one.device)
            if path in links:
                raise LinkError(f"{one.device} is {path}, as is that of another FPGA: each needs a chip select of its own")
            links[path] = SpiLink(one, now_s, alone=False)
            opened.callback(links[path].release)
        lines = GpioLines(settings, now_s)
        opened.callback(lines.close)
        for link in links.values():
            link.lines = lines
        lines.begin()
        opened.pop_all()
    return LinkGroup(list(links.values()))
