"""spidev's ioctl: frames of two fixed buffers as messages, each frame under its own chip select.

Linux, include/uapi/linux/spi/spidev.h and drivers/spi/spidev.c. The kernel copies a message through a buffer of
`bufsiz` bytes, in which each transfer begins at a multiple of ARCH_DMA_MINALIGN, and refuses what does not fit (errno 90).
"""

from __future__ import annotations

import ctypes
import struct
from collections.abc import Sequence

from controller.errors import LinkError

TRANSFER = struct.Struct("=QQIIHBBBBBB")  # tx, rx, length, speed, delay, bits, cs_change, tx_nbits, rx_nbits, word delay, pad
TRANSFERS_MAX = 28  # in one message: fcntl.ioctl passes a request on by itself up to 1,024 bytes
DMA_ALIGN_BYTES = 128  # ARCH_DMA_MINALIGN of arm64; 64 of most 32-bit ARM, 8 of x86
PATTERNS_MAX = 64  # of lengths that are remembered


def message_request(transfers: int) -> int:
    """SPI_IOC_MESSAGE(n): the ioctl's number for so many transfers."""
    return 1 << 30 | transfers * TRANSFER.size << 16 | ord("k") << 8


def split(lengths: Sequence[int], bufsiz: int) -> list[int]:
    """How many frames go into each message, so that each fits the kernel's buffer.

    Raises
    ------
    LinkError
        If one frame alone does not fit.
    """
    counts = [0]
    used = 0
    for length in lengths:
        taken = -(-length // DMA_ALIGN_BYTES) * DMA_ALIGN_BYTES
        if taken > bufsiz:
            raise LinkError(
                f"a frame of {length} bytes does not fit spidev's buffer of {bufsiz}: put 'options spidev bufsiz=8192' into"
                " /etc/modprobe.d/spidev.conf, or spidev.bufsiz=8192 on the kernel's command line where spidev is built in"
            )
        if counts[-1] and (used + taken > bufsiz or counts[-1] == TRANSFERS_MAX):
            counts.append(0)
            used = 0
        counts[-1] += 1
        used += taken
    return counts


class Messages:
    """The ioctl arguments for two buffers, made once for each pattern of lengths.

    Parameters
    ----------
    sent, received : memoryview
        Of writable memory that stays where it is; they are kept alive.
    bufsiz : int
        Of spidev, in bytes.
    """

    def __init__(self, sent: memoryview, received: memoryview, bufsiz: int) -> None:
        self.sent = sent
        self.received = received
        self._tx = ctypes.addressof(ctypes.c_char.from_buffer(sent))
        self._rx = ctypes.addressof(ctypes.c_char.from_buffer(received))
        self._bytes = min(sent.nbytes, received.nbytes)
        self._bufsiz = bufsiz
        self._known: dict[tuple[int, ...], tuple[tuple[int, bytearray, int], ...]] = {}

    def of(self, lengths: Sequence[int]) -> tuple[tuple[int, bytearray, int], ...]:
        """(ioctl number, its transfers, bytes on the wire) of each message for frames back to back.

        Raises
        ------
        LinkError
            If a frame does not fit spidev's buffer.
        ValueError
            If the frames reach beyond the buffers.
        """
        pattern = tuple(lengths)
        known = self._known.get(pattern)
        if known is None:
            if len(self._known) >= PATTERNS_MAX:
                self._known.clear()
            known = self._known[pattern] = self._made(pattern)
        return known

    def _made(self, lengths: tuple[int, ...]) -> tuple[tuple[int, bytearray, int], ...]:
        if sum(lengths) > self._bytes:
            raise ValueError(f"frames of {sum(lengths)} bytes in buffers of {self._bytes}")
        messages = []
        offset = first = 0
        for count in split(lengths, self._bufsiz):
            array = bytearray(count * TRANSFER.size)
            begin = offset
            for number, length in enumerate(lengths[first : first + count]):
                more = number < count - 1  # chip select rises behind every frame; with cs_change on the last it would stay low
                at = number * TRANSFER.size
                TRANSFER.pack_into(array, at, self._tx + offset, self._rx + offset, length, 0, 0, 0, more, 0, 0, 0, 0)
                offset += length
            first += count
            messages.append((message_request(count), array, offset - begin))
        return tuple(messages)
