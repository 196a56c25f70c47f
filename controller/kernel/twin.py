"""The kernel in Python and NumPy: the specification of the compiled one, and what serves where there is none.

Frames
------
The words of a waveform travel in LOAD frames, back to back (fpga_rtl/README.md, Frames): 500 bytes of words each, the rest in a
shorter last one, which is padded with zeros to 20 bytes. A page of *ready frames* holds them numbered from 0 on, as a bank keeps
them. CRC-32 is linear: for messages of one length `crc(a ^ b) = crc(a) ^ crc(b) ^ crc(zeros)`. So a frame whose sequence number
changes from s to t changes its CRC by a constant of its length and of `s ^ t`, and its payload is not read for that.
"""

from __future__ import annotations

import struct
import zlib
from functools import cache
from typing import Final

Readable = bytes | bytearray | memoryview
Writable = bytearray | memoryview

FRAME_SYNC: Final = 0xA55A
LOAD: Final = 3
CHUNK_BYTES: Final = 500  # words of a LOAD frame that is not the last
PADDED_BYTES: Final = 20  # shortest payload
CHUNKS: Final = 8
SHORT_FRAME_BYTES: Final = 36

HEADER: Final = struct.Struct("<HBBHH")  # sync word, type, sequence number, bytes of the payload, chunk
CRC: Final = struct.Struct("<I")
FULL_FRAME_BYTES: Final = HEADER.size + CHUNK_BYTES + CRC.size
NUMBER_AT: Final = 3  # byte of the header


def load_frames_bytes(words_bytes: int) -> int:
    """Bytes of the LOAD frames of a waveform.

    Parameters
    ----------
    words_bytes : int
        Of its drive words: 4 to 4,000, a multiple of 4.

    Raises
    ------
    ValueError
        If no waveform has this length.
    """
    if not 4 <= words_bytes <= CHUNKS * CHUNK_BYTES or words_bytes % 4:
        raise ValueError(f"a waveform has 4 to {CHUNKS * CHUNK_BYTES} bytes, a multiple of 4, not {words_bytes}")
    full, rest = divmod(words_bytes, CHUNK_BYTES)
    return full * FULL_FRAME_BYTES + (HEADER.size + max(rest, PADDED_BYTES) + CRC.size if rest else 0)


def pack_loads(out: Writable, sequence: int, words: Readable) -> int:
    """Pack drive words into LOAD frames.

    Parameters
    ----------
    out : writable buffer of bytes
        Its first `load_frames_bytes` are filled.
    sequence : int
        Sequence number of the first frame, taken modulo 256.
    words : buffer of bytes
        Drive words, 4 to 4,000 bytes.

    Returns
    -------
    int
        CRC-32 of the words, for their STORE.

    Raises
    ------
    ValueError
        If no waveform has this length, or `out` is too short.
    """
    given = memoryview(words)
    total = given.nbytes
    filled = _room(out, load_frames_bytes(total))
    start = 0
    for chunk in range(-(-total // CHUNK_BYTES)):
        piece = given[chunk * CHUNK_BYTES : (chunk + 1) * CHUNK_BYTES]
        payload, size = start + HEADER.size, piece.nbytes
        filled[payload : payload + size] = piece
        if size < PADDED_BYTES:
            filled[payload + size : payload + PADDED_BYTES] = bytes(PADDED_BYTES - size)
            size = PADDED_BYTES
        HEADER.pack_into(filled, start, FRAME_SYNC, LOAD, sequence + chunk & 0xFF, size, chunk)
        end = payload + size
        CRC.pack_into(filled, end, zlib.crc32(filled[start:end]))
        start = end + CRC.size
    return zlib.crc32(given)


def renumber_loads(out: Writable, sequence: int, ready: Readable) -> None:
    """Copy ready frames and number them anew.

    Headers are written, not copied, and payloads are not read: whatever the page holds, what goes out are LOAD frames of these
    chunks, and a page that has changed gives frames with a wrong CRC-32, which the FPGA refuses.

    Parameters
    ----------
    out : writable buffer of bytes
        As many as `ready` has are filled, from the first on. It must not overlap `ready`.
    sequence : int
        Sequence number of the first frame, taken modulo 256.
    ready : buffer of bytes
        LOAD frames numbered from 0 on, as `pack_loads` gives them.

    Raises
    ------
    ValueError
        If no waveform has frames of this length, or `out` is too short.
    """
    total = memoryview(ready).nbytes
    full, rest = _frames_of(total)
    filled = _room(out, total)
    filled[:] = ready
    changes = number_changes(FULL_FRAME_BYTES)
    for chunk in range(full + (rest > 0)):
        start, size = chunk * FULL_FRAME_BYTES, FULL_FRAME_BYTES
        if chunk == full:
            size, changes = rest, number_changes(rest)
        number = sequence + chunk & 0xFF
        HEADER.pack_into(filled, start, FRAME_SYNC, LOAD, number, size - HEADER.size - CRC.size, chunk)
        end = start + size - CRC.size
        CRC.pack_into(filled, end, CRC.unpack_from(filled, end)[0] ^ changes[number ^ chunk])


def unpack_loads(words: Writable, ready: Readable) -> int:
    """Take drive words out of ready frames, every byte of which is checked: the reverse of `pack_loads` with sequence number 0.

    Parameters
    ----------
    words : writable buffer of bytes
        Filled: 4 to 4,000 bytes.
    ready : buffer of bytes
        The `load_frames_bytes` of so many words.

    Returns
    -------
    int
        CRC-32 of the words.

    Raises
    ------
    ValueError
        If a frame is not as `pack_loads` makes it, with its number; or if the lengths do not go together.
    """
    filled, given = memoryview(words), memoryview(ready)
    total = filled.nbytes
    if given.nbytes != load_frames_bytes(total):
        raise ValueError(f"{given.nbytes} bytes are not the frames of {total} bytes of words")
    start = 0
    for chunk in range(-(-total // CHUNK_BYTES)):
        size = min(CHUNK_BYTES, total - chunk * CHUNK_BYTES)
        padded = max(size, PADDED_BYTES)
        payload = start + HEADER.size
        end = payload + padded
        header = HEADER.pack(FRAME_SYNC, LOAD, chunk, padded, chunk)
        padding = given[payload + size : end]
        if (
            given[start:payload] != header
            or padding != bytes(padded - size)
            or given[end : end + CRC.size] != CRC.pack(zlib.crc32(given[start:end]))
        ):
            raise ValueError(f"frame {chunk} is damaged")
        filled[chunk * CHUNK_BYTES : chunk * CHUNK_BYTES + size] = given[payload : payload + size]
        start = end + CRC.size
    return zlib.crc32(filled)


def seal_short_frames(out: Writable, start: int, count: int, sequence: int) -> None:
    """Write sequence numbers and CRCs into frames of 36 bytes that lie back to back.

    Parameters
    ----------
    out : writable buffer of bytes
    start : int
        Where the first frame begins.
    count : int
        Number of frames.
    sequence : int
        Sequence number of the first one, taken modulo 256.

    Raises
    ------
    ValueError
        If they are not all within `out`.
    """
    filled = memoryview(out)
    if start < 0 or count < 0 or start + count * SHORT_FRAME_BYTES > filled.nbytes:
        raise ValueError(f"{count} frames from byte {start} on do not fit into {filled.nbytes} bytes")
    for number in range(sequence, sequence + count):
        end = start + SHORT_FRAME_BYTES - CRC.size
        filled[start + NUMBER_AT] = number & 0xFF
        CRC.pack_into(filled, end, zlib.crc32(filled[start:end]))
        start = end + CRC.size


@cache
def number_changes(frame_bytes: int) -> tuple[int, ...]:
    """By what a frame's CRC changes, by exclusive or, when its sequence number does: for each value of the old number ^ the new.

    Parameters
    ----------
    frame_bytes : int
        Of the frame, CRC included.
    """
    covered = bytearray(frame_bytes - CRC.size)
    of_zeros = zlib.crc32(covered)
    changes = []
    for change in range(256):
        covered[NUMBER_AT] = change
        changes.append(zlib.crc32(covered) ^ of_zeros)
    return tuple(changes)


def _frames_of(total: int) -> tuple[int, int]:
    """Full frames in so many bytes, and bytes of the shorter one behind them."""
    full, rest = divmod(total, FULL_FRAME_BYTES)
    shortest = HEADER.size + PADDED_BYTES + CRC.size
    if total == 0 or full + (rest > 0) > CHUNKS or (rest and (rest < shortest or rest % 4)):
        raise ValueError(f"{total} bytes are not the LOAD frames of a waveform")
    return full, rest


def _room(out: Writable, total: int) -> memoryview:
    """The beginning of a buffer."""
    room = memoryview(out)
    if room.nbytes < total:
        raise ValueError(f"{total} bytes of frames do not fit into {room.nbytes}")
    return room[:total]
