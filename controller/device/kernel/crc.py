"""Messages that end with their own CRC-32 (zlib), little-endian: frames, statuses, headers and records of files."""

from __future__ import annotations

import zlib

from controller.device.kernel.twin import CRC, CRC_OF_INTACT, Readable, Writable


def seal(buffer: Writable, start: int, end: int) -> int:
    """Write the CRC of `buffer[start:end]` at `end`, without copying a byte of it; where the message ends."""
    CRC.pack_into(buffer, end, zlib.crc32(memoryview(buffer)[start:end]))
    return end + CRC.size


def sealed(body: bytes) -> bytes:
    """A message with its CRC behind it."""
    return body + CRC.pack(zlib.crc32(body))


def intact(message: Readable) -> bool:
    """Whether the last four bytes of a message, which has more than these, are the CRC of all before."""
    return zlib.crc32(message) == CRC_OF_INTACT
