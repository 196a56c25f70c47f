"""Messages between the event loop and the process that prepares scenes, in the form of `message_frame`.

The scene in them is what `scene`, `trains`, `spacings` and `shapes` declare, within the ranges that their types give; the board is
`board.Board`.
"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import msgspec
from msgspec import Meta, Raw, Struct

from controller import __version__
from controller.device.board.board import Board
from controller.device.scene.effects.trains import Train
from controller.device.scene.scene import Region, Scene, SpatialIndex
from controller.device.service.scenes.message_frame import (
    MOST_BYTES,
    REASON_CHARACTERS,
    MessageError,
    data_of,
    encoder,
    framed,
    one_line,
    packed,
    require_own,
    require_within,
)


class SceneRequest(Struct, frozen=True, forbid_unknown_fields=True):
    """Prepare a scene, given by its name or path, of a board, for a bank; with `toml`, save that under the name instead."""

    software: str
    board: Raw
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


_requests = msgspec.msgpack.Decoder(SceneRequest)
_replies = msgspec.msgpack.Decoder(_Reply)


def pack_request(board: Board, scene: str, bank: Path, toml: str | None = None) -> bytes:
    """Message that requests a scene, by name or path, to be played from a bank, or that one (`toml`) is saved."""
    return framed(encoder.encode(SceneRequest(__version__, packed(board), scene, str(bank), toml)))


def pack_scene(scene: Scene) -> bytes:
    """Message with a scene; raises MessageError if it is too large."""
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


def unpack_request(message: bytes) -> SceneRequest:
    """The request in a message; raises MessageError if the message does not fit."""
    request = data_of(message, _requests)
    require_own(request.software)
    return request


def unpack_scene(message: bytes) -> Scene | str:
    """The scene in a message, or why it was refused; empty if it was saved; raises MessageError if the message does not fit."""
    reply = data_of(message, _replies)
    require_own(reply.software)
    if reply.scene is None:
        return "" if reply.saved else one_line(reply.reason)
    regions, index = reply.scene.regions, reply.scene.index
    require_within(index, len(regions))
    return Scene(regions, reply.scene.effects, index)
