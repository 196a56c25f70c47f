"""Arguments of spidev's SPI_IOC_MESSAGE ioctl: frames in two fixed buffers, each under its own chip select.

Linux, include/uapi/linux/spi/spidev.h and drivers/spi/spidev.c. The kernel copies a message through a buffer of `bufsiz` bytes,
in which each transfer begins at a multiple of ARCH_DMA_MINALIGN, and refuses a message that does not fit (errno 90).
"""

from __future__ import annotations

import ctypes
import struct
from collections.abc import Sequence

from controller.errors import LinkError

TRANSFER = struct.Struct("=QQIIHBBBBBB")  # tx, rx, length, speed, delay, bits, cs_change, tx_nbits, rx_nbits, word delay, pad
TRANSFERS_MAX = 28  # in one message: fcntl.ioctl copies at most 1,024 bytes of argument in place
DMA_ALIGN_BYTES = 128  # ARCH_DMA_MINALIGN of arm64; 64 of most 32-bit ARM, 8 of x86
PATTERNS_MAX = 64  # patterns of frame lengths that are remembered


def message_request(transfers: int) -> int:
    """Request number SPI_IOC_MESSAGE(n) for n transfers."""
    return 1 << 30 | transfers * TRANSFER.size << 16 | ord("k") << 8


def split(lengths: Sequence[int], bufsiz: int) -> list[int]:
    """Distribute frames over messages that each fit the kernel's buffer, all in bytes; returns the frames in each message.

    Raises LinkError if one frame alone does not fit.
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


class SpiMessages:
    """ioctl arguments for two buffers, made once for each pattern of frame lengths.

    Both buffers are writable, and kept alive, because the arguments hold their addresses; `bufsiz` is spidev's buffer in bytes.
    """

    def __init__(self, sent: memoryview, received: memoryview, bufsiz: int) -> None:
        self.sent = sent
        self.received = received
        self._tx = ctypes.addressof(ctypes.c_char.from_buffer(sent))
        self._rx = ctypes.addressof(ctypes.c_char.from_buffer(received))
        self._bytes = min(sent.nbytes, received.nbytes)
        self._bufsiz = bufsiz
        self._known: dict[tuple[int, ...], tuple[tuple[int, bytearray, int], ...]] = {}

    def for_lengths(self, lengths: Sequence[int]) -> tuple[tuple[int, bytearray, int], ...]:
        """Messages for frames that lie back to back from 0 on.

        Lengths are in bytes. Each message has a request number, the transfers as bytes, and the bytes on the wire. Raises LinkError
        if a frame does not fit spidev's buffer; ValueError if the frames reach beyond the buffers.
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
                more = number < count - 1  # chip select rises after every frame; with cs_change on the last one it would stay low
                at = number * TRANSFER.size
                TRANSFER.pack_into(array, at, self._tx + offset, self._rx + offset, length, 0, 0, 0, more, 0, 0, 0, 0)
                offset += length
            first += count
            messages.append((message_request(count), array, offset - begin))
        return tuple(messages)
