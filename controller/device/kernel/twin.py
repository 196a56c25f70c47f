"""The kernel in Python and NumPy: the specification of the compiled one, and what serves where there is none.

Frames
------
The words of a waveform travel in LOAD frames, back to back (fpga_rtl/README.md, Frames): 500 bytes of words each, the rest in a
shorter last one, which is padded with zeros to 20 bytes. A page of *ready frames* holds them numbered from 0 on, as a bank keeps
them. CRC-32 is linear: for messages of one length `crc(a ^ b) = crc(a) ^ crc(b) ^ crc(zeros)`. So a frame whose sequence number
changes from s to t changes its CRC by a constant of its length and of `s ^ t`, and its payload is not read for that.
"""

from __future__ import annotations

import os
import struct
import zlib
from functools import cache
from typing import Final, NamedTuple

Readable = bytes | bytearray | memoryview
Writable = bytearray | memoryview

# generated: frames
FRAME_SYNC: Final = 0xA55A
LOAD: Final = 3  # type of frame
CHUNK_BYTES: Final = 500  # words of a LOAD frame that is not the last
PADDED_BYTES: Final = 20  # shortest payload of a LOAD
CHUNKS: Final = 8
SHORT_FRAME_BYTES: Final = 36  # of a status, too
NUMBER_AT: Final = 3  # byte of the header
FAULTS_AT: Final = 6  # byte of a status
CRC_OF_INTACT: Final = 0x2144DF1C  # of any message with its own CRC behind it
HEADER: Final = struct.Struct("<HBBHH")  # sync, type, sequence, length, argument
CRC: Final = struct.Struct("<I")
# end of frames
FULL_FRAME_BYTES: Final = HEADER.size + CHUNK_BYTES + CRC.size
STATUS_HEAD: Final = struct.Struct(f"<I{FAULTS_AT - 4}xH")  # sync word, result and sequence number as one; faults


def load_frames_bytes(words_bytes: int) -> int:
    """Bytes of the LOAD frames of a waveform, whose drive words are 4 to 4,000 bytes.

    Raises ValueError if no waveform has this length.
    """
    if not 4 <= words_bytes <= CHUNKS * CHUNK_BYTES or words_bytes % 4:
        raise ValueError(f"a waveform has 4 to {CHUNKS * CHUNK_BYTES} bytes, a multiple of 4, not {words_bytes}")
    full, rest = divmod(words_bytes, CHUNK_BYTES)
    return full * FULL_FRAME_BYTES + (HEADER.size + max(rest, PADDED_BYTES) + CRC.size if rest else 0)


def pack_loads(out: Writable, sequence: int, words: Readable) -> int:
    """Pack drive words (4 to 4,000 bytes) into LOAD frames; returns the words' CRC-32, for their STORE.

    The first `load_frames_bytes` of `out` are filled; the first frame's sequence number is taken modulo 256. Raises ValueError if
    no waveform has this length, or `out` is too short.
    """
    given = memoryview(words)
    layout = _layout(given.nbytes)
    filled = _room(out, layout.total)
    filled[layout.padding] = bytes(layout.padding.stop - layout.padding.start)
    for part, payload, head, covered, end, headers, _ in layout.frames:
        filled[payload] = given[part]
        filled[head] = headers[sequence & 0xFF]
        CRC.pack_into(filled, end, zlib.crc32(filled[covered]))
        sequence += 1
    return zlib.crc32(given)


def renumber_loads(out: Writable, sequence: int, ready: Readable) -> None:
    """Copy ready frames and number them again.

    Headers are written, not copied, and payloads are not read: whatever the page holds, what goes out are LOAD frames of these
    chunks, and a page that has changed gives frames with a wrong CRC-32, which the FPGA refuses.

    `ready` are LOAD frames numbered from 0 on, as `pack_loads` gives them; as many bytes of `out`, which must not overlap it, are
    filled. The first frame's sequence number is taken modulo 256. Raises ValueError if no waveform has frames of this length, or
    `out` is too short.
    """
    layout = _layout_of_frames(memoryview(ready).nbytes)
    filled = _room(out, layout.total)
    filled[:] = ready
    for chunk, (frame, crc) in enumerate(zip(layout.frames, layout.crcs.unpack_from(ready), strict=True)):
        number = sequence + chunk & 0xFF
        filled[frame.head] = frame.headers[number]
        CRC.pack_into(filled, frame.end, crc ^ frame.changes[number ^ chunk])


def unpack_loads(words: Writable, ready: Readable) -> int:
    """Take drive words out of ready frames, every byte of which is checked: the reverse of `pack_loads` with sequence number 0.

    4 to 4,000 bytes of `words` are filled from their `load_frames_bytes`. Returns the CRC-32 of the words. Raises ValueError if a
    frame is not as `pack_loads` makes it, with its number; or if the lengths do not go together.
    """
    filled, given = memoryview(words), memoryview(ready)
    layout = _layout(filled.nbytes)
    if given.nbytes != layout.total:
        raise ValueError(f"{given.nbytes} bytes are not the frames of {filled.nbytes} bytes of words")
    for chunk, (part, payload, head, covered, end, headers, _) in enumerate(layout.frames):
        sound = given[head] == headers[chunk] and CRC.unpack_from(given, end)[0] == zlib.crc32(given[covered])
        if not sound or any(given[payload.stop : end]):
            raise ValueError(f"frame {chunk} is damaged")
        filled[part] = given[payload]
    return zlib.crc32(filled)


def seal_short_frames(out: Writable, start: int, count: int, sequence: int) -> None:
    """Write sequence numbers and CRCs into `count` frames of 36 bytes that lie back to back from `start` on.

    The first one's sequence number is taken modulo 256. Raises ValueError if they are not all within `out`.
    """
    filled = memoryview(out)
    if start < 0 or count < 0 or start + count * SHORT_FRAME_BYTES > filled.nbytes:
        raise ValueError(f"{count} frames from byte {start} on do not fit into {filled.nbytes} bytes")
    for number in range(sequence, sequence + count):
        end = start + SHORT_FRAME_BYTES - CRC.size
        filled[start + NUMBER_AT] = number & 0xFF
        CRC.pack_into(filled, end, zlib.crc32(filled[start:end]))
        start = end + CRC.size


def statuses_good(answers: Readable, start: int, count: int, head: int, sequence: int) -> bool:
    """Whether statuses that lie back to back are intact, say the same result, name one frame after the other, and no fault.

    `head` is sync word and result, as the first three bytes of a status have them. The first status names `sequence`, taken modulo
    256; each further one the next. Raises ValueError if they are not all within `answers`.
    """
    given = memoryview(answers)
    if start < 0 or count < 0 or start + count * SHORT_FRAME_BYTES > given.nbytes:
        raise ValueError(f"{count} statuses from byte {start} on are not within {given.nbytes} bytes")
    for number in range(sequence, sequence + count):
        first, faults = STATUS_HEAD.unpack_from(given, start)
        end = start + SHORT_FRAME_BYTES
        if first != head | (number & 0xFF) << 24 or faults or zlib.crc32(given[start:end]) != CRC_OF_INTACT:
            return False
        start = end
    return True


class LoadFrame(NamedTuple):
    """Where a LOAD frame lies: its words among those of the waveform; of its own bytes payload, header, what its CRC covers, CRC.

    `headers` has its header for every sequence number, `changes` by what another number changes its CRC.
    """

    part: slice
    payload: slice
    head: slice
    covered: slice
    end: int
    headers: tuple[bytes, ...]
    changes: tuple[int, ...]


class UploadLayout(NamedTuple):
    """The LOAD frames of a waveform, all their CRCs, the zeros behind the words of the last one, and the bytes of it all."""

    frames: tuple[LoadFrame, ...]
    crcs: struct.Struct
    padding: slice
    total: int


@cache
def _headers(chunk: int, payload_bytes: int) -> tuple[bytes, ...]:
    """Header of a LOAD frame for every sequence number."""
    return tuple(HEADER.pack(FRAME_SYNC, LOAD, number, payload_bytes, chunk) for number in range(256))


@cache
def _layout(words_bytes: int) -> UploadLayout:
    """Frames of a waveform of this length; ValueError as `load_frames_bytes`."""
    total = load_frames_bytes(words_bytes)
    frames, padding, start = [], slice(0, 0), 0
    for chunk in range(-(-words_bytes // CHUNK_BYTES)):
        size = min(CHUNK_BYTES, words_bytes - chunk * CHUNK_BYTES)
        padded = max(size, PADDED_BYTES)
        payload = start + HEADER.size
        end = payload + padded
        frames.append(
            LoadFrame(
                slice(chunk * CHUNK_BYTES, chunk * CHUNK_BYTES + size),
                slice(payload, payload + size),
                slice(start, payload),
                slice(start, end),
                end,
                _headers(chunk, padded),
                number_changes(end + CRC.size - start),
            )
        )
        padding = slice(payload + size, end)
        start = end + CRC.size
    crcs = struct.Struct("<" + "".join(f"{frame.covered.stop - frame.covered.start}xI" for frame in frames))
    return UploadLayout(tuple(frames), crcs, padding, total)


@cache
def _layout_of_frames(total: int) -> UploadLayout:
    """The same from the bytes of the frames; ValueError if no waveform has this many."""
    full, rest = divmod(total, FULL_FRAME_BYTES)
    shortest = HEADER.size + PADDED_BYTES + CRC.size
    if total == 0 or full + (rest > 0) > CHUNKS or (rest and (rest < shortest or rest % 4)):
        raise ValueError(f"{total} bytes are not the LOAD frames of a waveform")
    return _layout(full * CHUNK_BYTES + (rest - HEADER.size - CRC.size if rest else 0))


@cache
def number_changes(frame_bytes: int) -> tuple[int, ...]:
    """By what a frame's CRC changes, by exclusive or, when its sequence number does: for each value of the old number ^ the new.

    `frame_bytes` counts the CRC too.
    """
    covered = bytearray(frame_bytes - CRC.size)
    of_zeros = zlib.crc32(covered)
    changes = []
    for change in range(256):
        covered[NUMBER_AT] = change
        changes.append(zlib.crc32(covered) ^ of_zeros)
    return tuple(changes)


def _room(out: Writable, total: int) -> memoryview:
    """The beginning of a buffer."""
    room = memoryview(out)
    if room.nbytes < total:
        raise ValueError(f"{total} bytes of frames do not fit into {room.nbytes}")
    return room[:total]


def start_program(command: tuple[bytes, ...], environment: tuple[bytes, ...], standard_input: int) -> int:
    """Start a program with this file as its standard input, /dev/null as its output; its process id, or -1 if there can be none.

    `environment` has names, "=" and values. The compiled one, unlike this, does not wait until the new process was scheduled, which
    can take long for one of ordinary priority; a program that cannot be run ends there with 127, and is -1 here.
    """
    files = [(os.POSIX_SPAWN_DUP2, standard_input, 0), (os.POSIX_SPAWN_OPEN, 1, os.devnull, os.O_WRONLY, 0)]
    values = dict(line.split(b"=", 1) for line in environment)
    try:
        return os.posix_spawn(command[0], command, values, file_actions=files)
    except OSError:
        return -1
