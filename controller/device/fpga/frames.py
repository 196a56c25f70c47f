"""Frames from the host to the FPGA, packed into buffers that the caller owns.

A frame is one chip-select assertion: a header, a payload and a CRC-32 of all bytes before it; their fields are those of
`frame_table`.

Every frame is 36 bytes, except LOAD and TEST; the status that comes back meanwhile (`status`) is 36 bytes too. Header, payload
and CRC take one C call each, and drive words are copied once.

All `pack_*` functions take the writable buffer, the byte offset at which the frame begins and its sequence number (taken
modulo 256), and return the offset of its end.
"""

from __future__ import annotations

import struct
import zlib
from collections.abc import Callable, Sequence
from functools import partial
from typing import Final, NamedTuple

from controller.device.fpga.frame_table import CRC_FIELD, HEADER_FIELDS, PAYLOADS, offset_of, packing
from controller.device.fpga.registers import (
    CHANNELS,
    CHUNK_WORDS,
    CHUNKS,
    FRAME_SYNC,
    IDENTITY_MAGIC,
    LOAD_PAYLOAD_MAX_BYTES,
    LOAD_PAYLOAD_MIN_BYTES,
    PROTOCOL_VERSION,
    SHORT_PAYLOAD_BYTES,
    WAVEFORM_WORDS,
    Control,
    FrameType,
    Register,
    Start,
)
from controller.device.kernel.crc import seal

ARGUMENT: Final = HEADER_FIELDS[-1:]
HEADER: Final = packing(HEADER_FIELDS)
SHORT: Final = struct.Struct(f"{HEADER.format}{SHORT_PAYLOAD_BYTES // 4}I")  # a short frame without its CRC
PLAY: Final = packing(HEADER_FIELDS + PAYLOADS[FrameType.PLAY].fields)
CRC: Final = packing([CRC_FIELD])
STORE_FIELDS: Final = packing(ARGUMENT + PAYLOADS[FrameType.STORE].fields)
PLAY_FIELDS: Final = packing(ARGUMENT + PAYLOADS[FrameType.PLAY].fields)
SHORT_FIELDS_AT: Final = offset_of("argument", HEADER_FIELDS)  # where they begin in their frames

FRAME_BYTES: Final = SHORT.size + CRC.size  # of a status and of every frame but LOAD and TEST
ALL_CHANNELS: Final = (1 << CHANNELS) - 1
ECHO_DELAY_BYTES: Final = 2  # after the status, the answer to a TEST repeats its payload, delayed by this
LOAD_FRAME_BYTES: Final = HEADER.size + LOAD_PAYLOAD_MAX_BYTES + CRC.size  # with a full chunk
UPLOAD_BYTES: Final = CHUNKS * LOAD_FRAME_BYTES  # of the longest waveform

WritableBuffer = bytearray | memoryview
ReadableBuffer = bytes | bytearray | memoryview


class Play(NamedTuple):
    """What a PLAY asks for, in the order of its fields."""

    slot: int  # slot number; or PLAY_LANDING: the waveform that is still being uploaded, from its first word
    first: int = 0  # first, length: first word and number of words to play; length 0: to the end of the waveform
    length: int = 0
    emissions: int = 1  # at most 65535; 0: endless
    start: Start = Start.TRIGGER  # at the next trigger, as soon as nothing plays, or at a time
    inverted: bool = False  # invert every drive bit
    period_ticks: int = 0  # FPGA clocks from the start of an emission to the start of the next
    mask: int = ALL_CHANNELS  # bit q set: channel q plays; the others keep their idle level
    # For Start.TIME: FPGA time at which the first word is on the pins; otherwise a delay after the start, in FPGA clocks
    when_ticks: int = 0


_PlayFields = tuple[int, int, int, int, Start, bool, int, int, int]
new_play: Final[Callable[[_PlayFields], Play]] = partial(tuple.__new__, Play)
"""A `Play` of a tuple of all its fields, as `touch.source.touch_sample` makes a sample."""


class ReadyFrames(NamedTuple):
    """A waveform as a bank holds it."""

    frames: memoryview  # its LOAD frames, numbered from 0 on
    crc: int  # CRC-32 that its words must have; of several FPGAs the next one's 32 bits above


Waveform = memoryview | ReadyFrames
"""Drive words, 4 bytes for each sample; or the frames that carry them. Of several FPGAs theirs, one behind the other."""


def crc_of(waveform: Waveform) -> int:
    """CRC-32 of the drive words of a waveform."""
    return waveform.crc if isinstance(waveform, ReadyFrames) else zlib.crc32(waveform)


def joined(waveforms: Sequence[Waveform]) -> Waveform:
    """One waveform of those of several FPGAs, all of which are words, or all frames."""
    ready = [waveform for waveform in waveforms if isinstance(waveform, ReadyFrames)]
    if not ready:
        return memoryview(b"".join([waveform for waveform in waveforms if isinstance(waveform, memoryview)]))
    if len(ready) < len(waveforms):
        raise ValueError("words of one FPGA, frames of another: they have no common layout")
    crc = sum(one.crc << 32 * number for number, one in enumerate(ready))
    return ReadyFrames(memoryview(b"".join([one.frames for one in ready])), crc)


def parted(waveform: Waveform, fpgas: int) -> list[Waveform]:
    """The waveforms that `joined` made one of."""
    whole = waveform.frames if isinstance(waveform, ReadyFrames) else waveform
    size = whole.nbytes // fpgas
    parts = [whole[number * size : (number + 1) * size] for number in range(fpgas)]
    if not isinstance(waveform, ReadyFrames):
        return [*parts]
    return [ReadyFrames(part, waveform.crc >> 32 * number & 0xFFFFFFFF) for number, part in enumerate(parts)]


def upload_slices(length_words: int) -> tuple[slice, ...]:
    """Byte ranges of the LOAD frames of a waveform that lie back to back from 0 on; each is one chip-select assertion.

    Raises ValueError if no waveform has this length.
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


def pack_short(buffer: WritableBuffer, offset: int, kind: FrameType, sequence: int, argument: int, *words: int) -> int:
    """Pack a short frame of up to 6 payload words of 32 bits, the others 0; what `argument` (u16) means depends on `kind`."""
    SHORT.pack_into(buffer, offset, FRAME_SYNC, kind, sequence & 0xFF, SHORT_PAYLOAD_BYTES, argument, *words, *_ZEROS[len(words)])
    return seal(buffer, offset, offset + SHORT.size)


def pack_nop(buffer: WritableBuffer, offset: int, sequence: int) -> int:
    """Pack a NOP: it counts as a heartbeat and fetches a status, nothing else."""
    end = offset + FRAME_BYTES
    buffer[offset:end] = _NOPS[sequence & 0xFF]
    return end


def pack_read(buffer: WritableBuffer, offset: int, sequence: int, address: int) -> int:
    """Pack a READ of a register or of another address; its value is in the status that comes with the next frame."""
    return pack_short(buffer, offset, FrameType.READ, sequence, address)


def pack_write(buffer: WritableBuffer, offset: int, sequence: int, register: int, value: int) -> int:
    """Pack a WRITE of `value` (u32) to a register."""
    return pack_short(buffer, offset, FrameType.WRITE, sequence, register, value)


def pack_unlock(buffer: WritableBuffer, offset: int, sequence: int, build_hash: int) -> int:
    """Pack UNLOCK, which must come directly before ARM; `build_hash` (u32) is that of the gateware the host expects."""
    words = (Control.UNLOCK, IDENTITY_MAGIC, PROTOCOL_VERSION, build_hash)
    return pack_short(buffer, offset, FrameType.WRITE, sequence, Register.CONTROL, *words)


def pack_control(buffer: WritableBuffer, offset: int, sequence: int, command: Control) -> int:
    """Pack ARM, DISARM, CLEAR, STOP or TRIGGER."""
    return pack_short(buffer, offset, FrameType.WRITE, sequence, Register.CONTROL, command)


def pack_store(buffer: WritableBuffer, offset: int, sequence: int, slot: int, length_words: int, crc: int) -> int:
    """Pack a STORE: the chunks loaded before become the waveform of a slot.

    `crc` is the CRC-32 of their bytes; a slot whose content has another one cannot be played.
    """
    return pack_short(buffer, offset, FrameType.STORE, sequence, slot, length_words, crc)


def pack_play(buffer: WritableBuffer, offset: int, sequence: int, play: Play) -> int:
    """Pack a PLAY of a slot's waveform."""
    PLAY.pack_into(buffer, offset, FRAME_SYNC, FrameType.PLAY, sequence & 0xFF, SHORT_PAYLOAD_BYTES, *play)
    return seal(buffer, offset, offset + PLAY.size)


def pack_test(buffer: WritableBuffer, offset: int, sequence: int, payload: ReadableBuffer) -> int:
    """Pack a TEST: its payload (20 to 500 bytes, a multiple of 4) comes back after the status."""
    start = offset + HEADER.size
    end = start + len(payload)
    buffer[start:end] = payload
    HEADER.pack_into(buffer, offset, FRAME_SYNC, FrameType.TEST, sequence & 0xFF, len(payload), 0)
    return seal(buffer, offset, end)


def pack_load(buffer: WritableBuffer, offset: int, sequence: int, chunk: int, words: memoryview) -> int:
    """Pack a LOAD: one chunk of a waveform, padded with zeros to the shortest payload allowed.

    `chunk` is 0 to 7; `words` are at most 500 bytes.
    """
    payload = offset + HEADER.size
    end = payload + words.nbytes
    buffer[payload:end] = words
    if words.nbytes < LOAD_PAYLOAD_MIN_BYTES:
        padded = payload + LOAD_PAYLOAD_MIN_BYTES
        buffer[end:padded] = bytes(padded - end)
        end = padded
    HEADER.pack_into(buffer, offset, FRAME_SYNC, FrameType.LOAD, sequence & 0xFF, end - payload, chunk)
    return seal(buffer, offset, end)


def _nop(sequence: int) -> bytes:
    buffer = bytearray(FRAME_BYTES)
    pack_short(buffer, 0, FrameType.NOP, sequence, 0)
    return bytes(buffer)


_ZEROS = tuple((0,) * (6 - given) for given in range(7))
_NOPS = tuple(_nop(sequence) for sequence in range(256))
