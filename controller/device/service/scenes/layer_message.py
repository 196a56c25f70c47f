"""Messages between the event loop and the process that prepares layers, in the form of `message_frame`.

What many regions have in common is sent once, as a style: 200 regions with their effects have 12 kB, and the loop takes them over
in less than half a millisecond.
"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import msgspec
from msgspec import Meta, Raw, Struct

from controller import __version__
from controller.device.board.board import Board
from controller.device.loop.preparation import AcceptedLayer
from controller.device.scene.effects.trains import Train
from controller.device.scene.layer_tables import REFUSED_MOST
from controller.device.scene.layers import Placement, RefusedRegion
from controller.device.scene.scene import Region, SpatialIndex
from controller.device.scene.scene_file import Shape
from controller.device.scene.spacings import Spacing
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
    unfit,
)

Trains = tuple[Train, ...]
Count = Annotated[int, Meta(ge=0)]


class LayerSetup(Struct, frozen=True, forbid_unknown_fields=True):
    """What every layer is checked against: a board, its bank, and the cells of that which were checked (a byte each)."""

    software: str
    board: Raw
    bank: str
    checked: bytes


class LayerRequest(Struct, frozen=True, array_like=True, forbid_unknown_fields=True):
    """Prepare a layer: a client's line, and where the layer will lie."""

    line: bytes
    placement: Placement


class _Style(Struct, frozen=True, array_like=True, forbid_unknown_fields=True):
    press: Trains
    release: Trains
    enter: Trains
    leave: Trains
    spacings: tuple[Spacing, ...]
    alternate: bool
    nulled: bool


class _Place(Struct, frozen=True, array_like=True, forbid_unknown_fields=True):
    name: str
    shape: Shape
    style: Count


class _Reply(Struct, frozen=True, forbid_unknown_fields=True, omit_defaults=True):
    reason: Annotated[str, Meta(max_length=REASON_CHARACTERS)] = ""
    styles: tuple[_Style, ...] = ()
    places: tuple[_Place, ...] = ()
    index: SpatialIndex | None = None
    off_plate: Count = 0
    refused: Annotated[tuple[RefusedRegion, ...], Meta(max_length=REFUSED_MOST)] = ()
    refused_count: Count = 0


_setups = msgspec.msgpack.Decoder(LayerSetup)
_requests = msgspec.msgpack.Decoder(LayerRequest)
_replies = msgspec.msgpack.Decoder(_Reply)


def pack_setup(board: Board, bank: Path, checked_cells: bytes) -> bytes:
    """First message of the loop."""
    return framed(encoder.encode(LayerSetup(__version__, packed(board), str(bank), checked_cells)))


def unpack_setup(message: bytes) -> LayerSetup:
    """The loop's first message; raises MessageError if it does not fit."""
    setup = data_of(message, _setups)
    require_own(setup.software)
    return setup


def pack_request(line: bytes, placement: Placement) -> bytes:
    """Message that requests a layer."""
    return framed(encoder.encode(LayerRequest(line, placement)))


def unpack_request(message: bytes) -> LayerRequest:
    """The request in a message; raises MessageError if it does not fit."""
    return data_of(message, _requests)


def pack_layer(regions: tuple[Region, ...], index: SpatialIndex, off_plate: int, refused: tuple[RefusedRegion, ...]) -> bytes:
    """Message with a layer; of what was refused the first `REFUSED_MOST`; raises MessageError if it is too large."""
    numbers: dict[tuple[int, ...], int] = {}  # of styles, by what they are made of, which regions share
    styles: list[_Style] = []
    places = []
    for region in regions:
        style = region.press, region.release, region.enter, region.leave, region.spacings
        number = numbers.setdefault((*map(id, style), region.alternate, region.nulled), len(styles))
        if number == len(styles):
            styles.append(_Style(*style, region.alternate, region.nulled))
        places.append(_Place(region.name, region.shape, number))
    reply = _Reply(
        styles=tuple(styles),
        places=tuple(places),
        index=index,
        off_plate=off_plate,
        refused=refused[:REFUSED_MOST],
        refused_count=len(refused),
    )
    data = encoder.encode(reply)
    if len(data) > MOST_BYTES:
        raise MessageError(f"the regions are too large: {len(data):,} bytes with all their effects, of {MOST_BYTES:,}")
    return framed(data)


def pack_refusal(reason: str) -> bytes:
    """Message that refuses a layer as a whole; `reason` is shortened to one line."""
    return framed(encoder.encode(_Reply(reason=one_line(reason))))


def unpack_layer(message: bytes) -> AcceptedLayer | str:
    """The layer in a message, or why it was refused; raises MessageError if the message does not fit."""
    reply = data_of(message, _replies)
    if reply.index is None:
        return reply.reason or "no reason given"
    styles, places, index = reply.styles, reply.places, reply.index
    if max([place.style for place in places], default=-1) >= len(styles):
        raise unfit("a region has a style that it does not have")
    require_within(index, len(places))
    regions = tuple([_region(place, styles[place.style]) for place in places])
    return AcceptedLayer(regions, index.lookup(regions), reply.off_plate, reply.refused, reply.refused_count)


def _region(place: _Place, style: _Style) -> Region:
    return Region(
        place.name,
        place.shape,
        style.press,
        style.release,
        style.enter,
        style.leave,
        style.spacings,
        alternate=style.alternate,
        nulled=style.nulled,
    )
