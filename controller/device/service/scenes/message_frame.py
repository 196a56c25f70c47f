"""The form of the messages between the event loop and the processes that prepare something for it, and what is refused in them.

A message is a header (magic, version, length, CRC-32; little-endian) and that many bytes of MessagePack. One that does not fit is
refused as a whole.
"""

from __future__ import annotations

import struct
import zlib
from itertools import chain
from pathlib import Path
from typing import Any, TypeVar

import msgspec
from msgspec import Raw

from controller import __version__
from controller.device.board.board import Board, as_board
from controller.device.scene.scene import SpatialIndex
from controller.errors import ConfigError, ControllerError

T = TypeVar("T")

VERSION = 4  # of the layout: raise it when a type in a message changes
MAGIC = b"HPsc"
HEADER = struct.Struct("<4sIII")
MOST_BYTES = 1 << 18  # behind the header: 2,000 regions, which the loop checks and takes over in 2 ms
REASON_CHARACTERS = 1000


class MessageError(ControllerError):
    """A message of the other process is invalid."""


encoder = msgspec.msgpack.Encoder(enc_hook=str)  # of a Path


def length(header: bytes | bytearray) -> int:
    """Length of a message after its header, in bytes.

    Raises MessageError if the header is invalid, of another version, or of a message that is too large.
    """
    if len(header) < HEADER.size:
        raise MessageError("the message is cut off")
    magic, version, count, _ = HEADER.unpack_from(header)
    if magic != MAGIC:
        raise MessageError("that is no message about a scene")
    if version != VERSION:
        raise MessageError(f"the message has version {version}, this program speaks {VERSION}: restart the service")
    if count > MOST_BYTES:
        raise MessageError(f"the message is too large: {count:,} bytes, of {MOST_BYTES:,}")
    return int(count)


def data_of(message: bytes, decoder: msgspec.msgpack.Decoder[T]) -> T:
    """What is in a message; raises MessageError if it is not whole, damaged, or something else."""
    try:
        return decoder.decode(_checked(message))
    except (msgspec.MsgspecError, UnicodeDecodeError, RecursionError) as error:
        raise unfit(error) from error


def unfit(problem: Exception | str) -> MessageError:
    """That a message does not fit, and why."""
    return MessageError(one_line(f"the message does not fit: {problem}"))


def require_within(index: SpatialIndex, regions: int) -> None:
    """Refuse an index of more regions than there are; raises MessageError if it is one."""
    if max(chain.from_iterable(index.candidates), default=-1) >= regions:
        raise unfit("its spatial index names a region that it does not have")


def packed(board: Board) -> Raw:
    """A board for a message; which record its touch panel has, its kind says."""
    return Raw(encoder.encode(board))


def board_of(packed: Raw) -> Board:
    """The board in a message; raises MessageError if it is none."""
    try:
        tables = msgspec.msgpack.decode(packed, type=dict[str, Any])
        folder = Path(str(tables.pop("folder", "")))
        return msgspec.structs.replace(as_board("", tables), folder=folder)
    except (msgspec.MsgspecError, ConfigError) as error:
        raise unfit(error) from error


def one_line(text: str) -> str:
    """A reason, shortened to one line."""
    return " ".join(text.split())[:REASON_CHARACTERS] or "no reason given"


def framed(data: bytes) -> bytes:
    """A message: the header and the data."""
    return HEADER.pack(MAGIC, VERSION, len(data), zlib.crc32(data)) + data


def _checked(message: bytes) -> memoryview:
    """The data of a message; raises MessageError if it is not whole, or damaged."""
    data = memoryview(message)[HEADER.size :]
    if len(data) != length(message):
        raise MessageError("the message is cut off, or has more than it says")
    if zlib.crc32(data) != HEADER.unpack_from(message)[3]:
        raise MessageError("the message is damaged: its CRC is wrong")
    return data


def require_own(software: str) -> None:
    """Refuse a message of another version of the software; raises MessageError if it is one."""
    if software != __version__:
        raise MessageError(f"the message is of version {software!r} of the software, this is {__version__!r}: restart the service")
