"""Messages between the event loop and the process that prepares scenes: with version, size limit and CRC.

A message is a header (magic, version, length, CRC-32; little-endian) and that many bytes of MessagePack. The scene
in it is what `scene`, `trains`, `spacings` and `shapes` declare, within the ranges that their types give; the board is
`board.Board`. A message that does not fit is refused as a whole.
"""

from __future__ import annotations

import struct
import zlib
from itertools import chain
from pathlib import Path
from typing import Annotated, Any

import msgspec
from msgspec import Meta, Raw, Struct

from controller import __version__
from controller.device.board.board import Board, as_board
from controller.device.scene.scene import Region, Scene, SpatialIndex
from controller.device.scene.trains import Train
from controller.errors import ConfigError, ControllerError

VERSION = 3  # of the layout: raise it when a type in a message changes
MAGIC = b"HPsc"
HEADER = struct.Struct("<4sIII")
MOST_BYTES = 1 << 18  # behind the header: 2,000 regions, which the loop checks and takes over in 2 ms
REASON_CHARACTERS = 1000


class MessageError(ControllerError):
    """A message of the other process is invalid."""


class SceneRequest(Struct, frozen=True):
    """Prepare a scene, given by its name or path, of a board, for a bank; with `toml`, save that under the name instead."""

    software: str
    board: Board
    scene: str
    bank: str
    toml: str | None = None


class _Request(Struct, frozen=True, forbid_unknown_fields=True):
    software: str
    board: Raw  # a Board; which record its touch panel has, its kind says
    scene: str
    bank: str
    toml: str | None = None


class _Scene(Struct, frozen=True, array_like=True, forbid_unknown_fields=True):
    regions: tuple[Region, ...]
    effects: dict[Annotated[str, Meta(min_length=1, max_length=64)], Train]
    index: SpatialIndex


class _Reply(Struct, frozen=True, forbid_unknown_fields=True):
    software: str
    reason: Annotated[str, Meta(max_length=REASON_CHARACTERS)] = ""
    scene: _Scene | None = None
    saved: bool = False


encoder = msgspec.msgpack.Encoder(enc_hook=str)  # of a Path
_requests = msgspec.msgpack.Decoder(_Request)
_replies = msgspec.msgpack.Decoder(_Reply)


def pack_request(board: Board, scene: str, bank: Path, toml: str | None = None) -> bytes:
    """Message that requests a scene, or that one is saved.

    Parameters
    ----------
    scene : str
        Name or path.
    bank : Path
        Bank that it will be played from.
    toml : str, optional
        What is to be saved.
    """
    return framed(encoder.encode(SceneRequest(__version__, board, scene, str(bank), toml)))


def pack_scene(scene: Scene) -> bytes:
    """Message with a scene.

    Raises
    ------
    MessageError
        If it is too large.
    """
    data = encoder.encode(_Reply(__version__, scene=_Scene(scene.regions, dict(scene.effects), scene.index)))
    if len(data) > MOST_BYTES:
        raise MessageError(f"the scene is too large: {len(data):,} bytes with its {len(scene.regions)} regions, of {MOST_BYTES:,}")
    return framed(data)


def pack_saved() -> bytes:
    """Message that a scene is saved."""
    return framed(encoder.encode(_Reply(__version__, saved=True)))


def pack_refusal(reason: str) -> bytes:
    """Message that refuses a request; `reason` is shortened to one line."""
    return framed(encoder.encode(_Reply(__version__, reason=one_line(reason))))


def length(header: bytes | bytearray) -> int:
    """Length of a message after its header, in bytes.

    Raises
    ------
    MessageError
        If the header is invalid, of another version, or of a message that is too large.
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


def unpack_request(message: bytes) -> SceneRequest:
    """The request in a message.

    Raises
    ------
    MessageError
        If the message does not fit.
    """
    try:
        request = _requests.decode(checked(message))
        require_own(request.software)
        board = board_of(request.board)
    except (msgspec.MsgspecError, ConfigError) as error:
        raise MessageError(f"the message does not fit: {error}") from error
    return SceneRequest(request.software, board, request.scene, request.bank, request.toml)


def unpack_scene(message: bytes) -> Scene | str:
    """The scene in a message, or why it was refused; empty if it was saved.

    Raises
    ------
    MessageError
        If the message does not fit.
    """
    try:
        reply = _replies.decode(checked(message))
    except (msgspec.MsgspecError, UnicodeDecodeError, RecursionError) as error:
        raise MessageError(one_line(f"the message does not fit: {error}")) from error
    require_own(reply.software)
    if reply.scene is None:
        return "" if reply.saved else one_line(reply.reason)
    regions, index = reply.scene.regions, reply.scene.index
    if max(chain.from_iterable(index.candidates), default=-1) >= len(regions):
        raise MessageError("the message does not fit: its spatial index names a region that it does not have")
    return Scene(regions, reply.scene.effects, index)


def board_of(packed: Raw) -> Board:
    """The board in a message.

    Raises
    ------
    ConfigError, msgspec.MsgspecError
        If it is none.
    """
    tables = msgspec.msgpack.decode(packed, type=dict[str, Any])
    folder = Path(str(tables.pop("folder", "")))
    return msgspec.structs.replace(as_board("", tables), folder=folder)


def one_line(text: str) -> str:
    """A reason, shortened to one line."""
    return " ".join(text.split())[:REASON_CHARACTERS] or "no reason given"


def framed(data: bytes) -> bytes:
    """A message: the header and the data."""
    return HEADER.pack(MAGIC, VERSION, len(data), zlib.crc32(data)) + data


def checked(message: bytes) -> memoryview:
    """The data of a message.

    Raises
    ------
    MessageError
        If it is not whole, or damaged.
    """
    data = memoryview(message)[HEADER.size :]
    if len(data) != length(message):
        raise MessageError("the message is cut off, or has more than it says")
    if zlib.crc32(data) != HEADER.unpack_from(message)[3]:
        raise MessageError("the message is damaged: its CRC is wrong")
    return data


def require_own(software: str) -> None:
    """Refuse a message of another version of the software.

    Raises
    ------
    MessageError
        If it is one.
    """
    if software != __version__:
        raise MessageError(f"the message is of version {software!r} of the software, this is {__version__!r}: restart the service")
