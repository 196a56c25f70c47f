"""Frames: the self-delimiting messages between host and FPGA, packed into buffers the caller keeps.

Every frame is one chip-select assertion, little-endian, its CRC that of `zlib.crc32` over all
bytes before it:

    u16 sync | u8 type | u8 sequence | u16 payload bytes | u16 argument | payload | u32 CRC-32

Every frame but LOAD and TEST is 36 bytes, as is the status that comes back meanwhile. Nothing here works
byte by byte: header, payload and CRC are one C call each, and a waveform is copied once.
"""

from __future__ import annotations

import struct
import zlib
from typing import NamedTuple

from controller.errors import LinkError
from controller.fpga.registers import (
    CHANNELS,
    CHUNK_WORDS,
    CHUNKS,
    FRAME_SYNC,
    IDENTITY_MAGIC,
    LOAD_PAYLOAD_MAX_BYTES,
    LOAD_PAYLOAD_MIN_BYTES,
    PROTOCOL_VERSION,
    SHORT_PAYLOAD_BYTES,
    STATUS_SYNC,
    WAVEFORM_WORDS,
    Control,
    Fault,
    FrameType,
    Register,
    Result,
    Start,
    State,
)

HEADER = struct.Struct("<HBBHH")
SHORT = struct.Struct("<HBBHH6I")  # a short frame but for its CRC
PLAY = struct.Struct("<HBBHHHHHBBIIQ")
STATUS = struct.Struct("<HBBHHIIQIBBHI")
CRC = struct.Struct("<I")

FRAME_BYTES = 36  # of a status and of every frame but LOAD and TEST
ALL_CHANNELS = (1 << CHANNELS) - 1
ECHO_DELAY_BYTES = 2  # behind the status, the answer to a TEST is what it brought, so much later
LOAD_FRAME_BYTES = HEADER.size + LOAD_PAYLOAD_MAX_BYTES + CRC.size  # of a full chunk
UPLOAD_BYTES = CHUNKS * LOAD_FRAME_BYTES  # of the longest waveform


class DamagedStatus(LinkError):
    """What came back is no status: nothing is known of the FPGA, nor of what it was sent."""


WritableBuffer = bytearray | memoryview
ReadableBuffer = bytes | bytearray | memoryview


class Status(NamedTuple):
    """What the FPGA answers: about the frame before, and as of the fall of chip select."""

    result: Result
    sequence: int  # of the last accepted frame
    state: State
    faults: Fault
    data: int  # value of the last READ
    trigger_count: int  # all rising edges seen, modulo 2**32
    timestamp_ticks: int  # clocks since reset
    emissions: int  # that ran to their end, modulo 2**32
    queued: int = 0  # plays accepted and not yet begun
    chunks: int = 0  # bit k: chunk k of the upload under way was accepted
    ignored: int = 0  # triggers that found nothing to start, modulo 2**16


def pack_short(buffer: WritableBuffer, offset: int, kind: FrameType, sequence: int, argument: int, *words: int) -> int:
    """Pack a short frame at `offset`; payload words not given are 0.

    Returns
    -------
    int
        The offset of its end.
    """
    SHORT.pack_into(buffer, offset, FRAME_SYNC, kind, sequence & 0xFF, SHORT_PAYLOAD_BYTES, argument, *words, *_ZEROS[len(words)])
    return _seal(buffer, offset, offset + SHORT.size)


def pack_nop(buffer: WritableBuffer, offset: int, sequence: int) -> int:
    """Pack a frame that only feeds the heartbeat and fetches a status; returns its end."""
    end = offset + FRAME_BYTES
    buffer[offset:end] = _NOPS[sequence & 0xFF]
    return end


def pack_read(buffer: WritableBuffer, offset: int, sequence: int, register: int) -> int:
    """Pack a READ, whose value lies in the status that comes with the next frame; returns its end."""
    return pack_short(buffer, offset, FrameType.READ, sequence, register)


def pack_write(buffer: WritableBuffer, offset: int, sequence: int, register: int, value: int) -> int:
    """Pack a WRITE of one register; returns its end."""
    return pack_short(buffer, offset, FrameType.WRITE, sequence, register, value)


def pack_unlock(buffer: WritableBuffer, offset: int, sequence: int, build_hash: int) -> int:
    """Pack the command that has to come directly before ARM, sent once identity and build are known; returns its end."""
    words = (Control.UNLOCK, IDENTITY_MAGIC, PROTOCOL_VERSION, build_hash)
    return pack_short(buffer, offset, FrameType.WRITE, sequence, Register.CONTROL, *words)


def pack_control(buffer: WritableBuffer, offset: int, sequence: int, command: Control) -> int:
    """Pack ARM, DISARM, CLEAR, STOP or TRIGGER; returns its end."""
    return pack_short(buffer, offset, FrameType.WRITE, sequence, Register.CONTROL, command)


def pack_store(buffer: WritableBuffer, offset: int, sequence: int, slot: int, length_words: int, crc: int) -> int:
    """Pack the command that makes the chunks loaded before the waveform of a slot, if its bytes have this CRC; returns its end."""
    return pack_short(buffer, offset, FrameType.STORE, sequence, slot, length_words, crc)


def pack_play(
    buffer: WritableBuffer,
    offset: int,
    sequence: int,
    slot: int,
    *,
    first: int = 0,
    length: int = 0,
    count: int = 1,
    period_ticks: int = 0,
    start: Start = Start.TRIGGER,
    when_ticks: int = 0,
    mask: int = ALL_CHANNELS,
    inverted: bool = False,
) -> int:
    """Pack a play of a slot's waveform; returns its end.

    Parameters
    ----------
    slot : int
        Or PLAY_LANDING: what is still arriving, from its first word.
    first, length : int
        Words of the waveform; length 0: to its end.
    count, period_ticks : int
        Emissions (0: endless, at most 65535) and ticks from start to start.
    start : Start
        By the next trigger, as soon as nothing sounds, or at a time.
    when_ticks : int
        The time at which the first word is on the pins; for the other starts the delay behind them.
    mask : int
        Bit q: channel q plays; the others keep their idle level.
    inverted : bool
        Play ones as zeros.
    """
    PLAY.pack_into(
        buffer,
        offset,
        FRAME_SYNC,
        FrameType.PLAY,
        sequence & 0xFF,
        SHORT_PAYLOAD_BYTES,
        slot,
        first,
        length,
        count,
        start,
        inverted,
        period_ticks,
        mask,
        when_ticks,
    )
    return _seal(buffer, offset, offset + PLAY.size)


def pack_test(buffer: WritableBuffer, offset: int, sequence: int, payload: ReadableBuffer) -> int:
    """Pack 20 to 500 bytes, a multiple of 4, that come back behind the status; returns its end."""
    start = offset + HEADER.size
    end = start + len(payload)
    buffer[start:end] = payload
    HEADER.pack_into(buffer, offset, FRAME_SYNC, FrameType.TEST, sequence & 0xFF, len(payload), 0)
    return _seal(buffer, offset, end)


def pack_load(buffer: WritableBuffer, offset: int, sequence: int, chunk: int, words: memoryview) -> int:
    """Pack up to 500 bytes of drive words as one LOAD, filled with zeros to the shortest length allowed; returns its end."""
    payload = offset + HEADER.size
    end = payload + words.nbytes
    buffer[payload:end] = words
    if words.nbytes < LOAD_PAYLOAD_MIN_BYTES:
        filled = payload + LOAD_PAYLOAD_MIN_BYTES
        buffer[end:filled] = bytes(filled - end)
        end = filled
    HEADER.pack_into(buffer, offset, FRAME_SYNC, FrameType.LOAD, sequence & 0xFF, end - payload, chunk)
    return _seal(buffer, offset, end)


def pack_upload(buffer: WritableBuffer, offset: int, sequence: int, words: memoryview) -> int:
    """Pack a waveform as LOAD frames one behind the other; `upload_slices` says where each lies. Returns the end.

    Parameters
    ----------
    words : memoryview of bytes
        1 to 1000 drive words of 4 bytes.
    """
    step = 4 * CHUNK_WORDS
    for chunk in range(-(-words.nbytes // step)):
        offset = pack_load(buffer, offset, sequence + chunk, chunk, words[chunk * step : (chunk + 1) * step])
    return offset


def upload_slices(length_words: int) -> tuple[slice, ...]:
    """Where `pack_upload` puts each frame (each one chip-select assertion), relative to its offset.

    Raises
    ------
    ValueError
        If no waveform has this length.
    """
    if not 1 <= length_words <= WAVEFORM_WORDS:
        raise ValueError(f"a waveform has 1 to {WAVEFORM_WORDS} words, not {length_words}")
    slices = []
    start = 0
    for first in range(0, length_words, CHUNK_WORDS):
        payload = max(4 * min(CHUNK_WORDS, length_words - first), LOAD_PAYLOAD_MIN_BYTES)
        slices.append(slice(start, start + HEADER.size + payload + CRC.size))
        start = slices[-1].stop
    return tuple(slices)


def pack_status(buffer: WritableBuffer, offset: int, status: Status) -> int:
    """Pack what the FPGA answers; returns its end."""
    STATUS.pack_into(buffer, offset, STATUS_SYNC, *status, 0)
    return _seal(buffer, offset, offset + FRAME_BYTES - CRC.size)


def parse_status(buffer: ReadableBuffer, offset: int = 0) -> Status:
    """Read the status that came back with a frame.

    Raises
    ------
    DamagedStatus
        If it has no sync word or a wrong CRC.
    LinkError
        If it has a code this version does not know.
    """
    result, sequence, state, faults, *counters = _checked(buffer, offset)
    code = _RESULTS.get(result)
    if code is None:
        raise LinkError(f"status has result code {result}, which this version does not know")
    if state not in _STATES:
        _STATES[state] = State(state)
    return Status(code, sequence, _STATES[state], Fault(faults) if faults else _NO_FAULT, *counters)


def status_ok(answer: ReadableBuffer, sequence: int) -> bool:
    """Whether a status is sound, and says that the frame of this sequence number was accepted and done and no fault is latched.

    The short form of `parse_status` for the hot path; that one says why not.

    Parameters
    ----------
    answer : memoryview
        The status and nothing more. The CRC-32 over all of it, its own CRC included, is the same for each that is sound.
    sequence : int
        0 to 255.
    """
    head, faults = _ANSWER.unpack_from(answer)
    return head == _DONE | sequence << 24 and not faults and zlib.crc32(answer) == _SOUND


def _checked(buffer: ReadableBuffer, offset: int) -> tuple[int, ...]:
    """Fields of a status between sync word and CRC, both of which have to be right."""
    sync, *fields, crc = STATUS.unpack_from(buffer, offset)
    if sync != STATUS_SYNC:
        raise DamagedStatus(f"status begins with 0x{sync:04X} and not 0x{STATUS_SYNC:04X}: is the FPGA configured, is MISO wired?")
    wanted = zlib.crc32(memoryview(buffer)[offset : offset + FRAME_BYTES - CRC.size])
    if crc != wanted:
        raise DamagedStatus(f"status has CRC 0x{crc:08X} and not 0x{wanted:08X}: damaged on its way; try a lower SPI clock")
    return tuple(fields)


_RESULTS = {int(result): result for result in Result}
_STATES: dict[int, State] = {}  # those met so far: making a flag takes longer than all the rest of a status
_NO_FAULT = Fault(0)
_ANSWER = struct.Struct("<I2xH")  # sync, result and sequence as one number; faults
_DONE = STATUS_SYNC | Result.OK << 16
_SOUND = 0x2144DF1C
_ZEROS = tuple((0,) * (6 - given) for given in range(7))


def _seal(buffer: WritableBuffer, start: int, end: int) -> int:
    """Append the CRC of `buffer[start:end]`; memoryview, so that nothing is copied."""
    CRC.pack_into(buffer, end, zlib.crc32(memoryview(buffer)[start:end]))
    return end + CRC.size


def _nop(sequence: int) -> bytes:
    buffer = bytearray(FRAME_BYTES)
    pack_short(buffer, 0, FrameType.NOP, sequence, 0)
    return bytes(buffer)


_NOPS = tuple(_nop(sequence) for sequence in range(256))
