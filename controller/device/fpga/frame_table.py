"""Every field of every frame: what the host and the FPGA have to agree on beside the numbers of `registers`.

Fields are little-endian and lie back to back. From this table come the packings of `frames` and `status`, and by
`python -m controller.generate` the constants of the compiled kernel and of its twin, the places of fields
in `fpga_rtl/registers.vh` and the table of frames in `fpga_rtl/README.md`.
"""

from __future__ import annotations

import struct
from collections.abc import Iterable
from itertools import takewhile
from typing import Final, NamedTuple

from controller.device.fpga.registers import (
    CHUNK_WORDS,
    FRAME_SYNC,
    LOAD_PAYLOAD_MAX_BYTES,
    LOAD_PAYLOAD_MIN_BYTES,
    PLAY_LANDING,
    READ_MEMORY,
    READ_QUEUE,
    READ_SLOT_CRC,
    SHORT_PAYLOAD_BYTES,
    STATUS_SYNC,
    FrameType,
)


class FrameField(NamedTuple):
    """A field: its name, its length in bytes, and what it is, with its unit."""

    name: str
    size: int
    text: str


class Payload(NamedTuple):
    """What a type of frame carries: the meaning of its argument, and its fields; what is not named is zero."""

    argument: str
    fields: tuple[FrameField, ...] = ()


HEADER_FIELDS: Final = (
    FrameField("sync", 2, f"0x{FRAME_SYNC:X}"),
    FrameField("type", 1, ", ".join(f"{int(kind)} {kind.name}" for kind in FrameType)),
    FrameField("sequence", 1, "sequence number"),
    FrameField(
        "length",
        2,
        f"payload bytes: {SHORT_PAYLOAD_BYTES}; LOAD and TEST {LOAD_PAYLOAD_MIN_BYTES}–{LOAD_PAYLOAD_MAX_BYTES}, multiple of 4",
    ),
    FrameField("argument", 2, "address, chunk or slot"),
)
PAYLOADS: Final = {
    FrameType.NOP: Payload(""),
    FrameType.READ: Payload(
        f"register; 0x{READ_SLOT_CRC:X} + slot: its CRC; 0x{READ_QUEUE:X} + 8 × play + word: the queue;"
        f" 0x{READ_MEMORY:X} + 1024 × slot + word: memory"
    ),
    FrameType.WRITE: Payload(
        "register",
        (
            FrameField("value", 4, "value; for CONTROL a command"),
            FrameField("identity", 4, "behind UNLOCK: IDENTITY"),
            FrameField("protocol", 4, "behind UNLOCK: PROTOCOL"),
            FrameField("build_hash", 4, "behind UNLOCK: BUILD_HASH"),
        ),
    ),
    FrameType.LOAD: Payload(f"chunk, {CHUNK_WORDS} words each; the payload is its words"),
    FrameType.STORE: Payload(
        "slot",
        (
            FrameField("length_words", 4, "length in words"),
            FrameField("crc", 4, "CRC-32 of those words"),
        ),
    ),
    FrameType.PLAY: Payload(
        f"slot; 0x{PLAY_LANDING:X}: the upload that is still arriving",
        (
            FrameField("first", 2, "first word"),
            FrameField("length", 2, "words; 0: to the end"),
            FrameField("emissions", 2, "0: endless"),
            FrameField("start", 1, "0 at a trigger, 1 as soon as nothing plays, 2 at a time"),
            FrameField("inverted", 1, "1: every bit inverted"),
            FrameField("period_ticks", 4, "ticks from the start of an emission to the start of the next"),
            FrameField("mask", 4, "bit q: channel q plays, the others keep their idle level"),
            FrameField("when_ticks", 8, "ticks since reset of the first word on the pins; without a time a delay, 32 bits"),
        ),
    ),
    FrameType.TEST: Payload("any; from byte 36 on, MISO repeats MOSI two bytes late"),
}
STATUS_FIELDS: Final = (
    FrameField("sync", 2, f"0x{STATUS_SYNC:X}"),
    FrameField("result", 1, "result of the frame before"),
    FrameField("sequence", 1, "sequence number of the last accepted frame"),
    FrameField("state", 2, "state bits"),
    FrameField("faults", 2, "fault bits"),
    FrameField("data", 4, "value of the last READ"),
    FrameField("trigger_count", 4, "triggers"),
    FrameField("timestamp_ticks", 8, "ticks since reset"),
    FrameField("emissions", 4, "emissions that ran to their end"),
    FrameField("queued", 1, "plays in the queue"),
    FrameField("chunks", 1, "chunks of the upload so far"),
    FrameField("ignored", 2, "triggers ignored"),
)
CRC_FIELD: Final = FrameField("crc", 4, "CRC-32 (zlib) of all before")

_CODES: Final = {1: "B", 2: "H", 4: "I", 8: "Q"}


def packing(fields: Iterable[FrameField]) -> struct.Struct:
    """Packing of fields that lie back to back."""
    return struct.Struct("<" + "".join(_CODES[field.size] for field in fields))


def offset_of(name: str, fields: Iterable[FrameField]) -> int:
    """Byte at which a field begins."""
    return sum(field.size for field in takewhile(lambda field: field.name != name, fields))
