"""The kernel in NumPy: what each function computes, to the bit. kernel.c is compared with it."""

from __future__ import annotations

import zlib


def crc32(data: bytes | bytearray | memoryview) -> int:
    """CRC-32 of a buffer, as zlib's."""
    return zlib.crc32(data)
