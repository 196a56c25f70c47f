"""Layers of regions that clients lay over a scene, each at a place of its own on the plate."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, NamedTuple

from msgspec import Meta, Struct

if TYPE_CHECKING:  # a client needs msgspec alone
    from controller.device.scene.region_lookup import RegionLookup
    from controller.device.scene.scene import Region


MOST_SHIFT_MM = 10_000  # a layer may be longer than any plate, and scroll
Scale = Annotated[float, Meta(ge=0.05, le=20)]


class Placement(NamedTuple):
    """Where a layer lies: its point (x, y) is at (x_m + scale x, y_m + scale y) on the plate."""

    x_m: Annotated[float, Meta(ge=-1e-3 * MOST_SHIFT_MM, le=1e-3 * MOST_SHIFT_MM)] = 0.0
    y_m: Annotated[float, Meta(ge=-1e-3 * MOST_SHIFT_MM, le=1e-3 * MOST_SHIFT_MM)] = 0.0
    scale: Scale = 1.0


UNMOVED = Placement()


class Layer(NamedTuple):
    """Regions of one client, in its order."""

    owner: int  # number of the client; a client that connects later has a higher one
    regions: tuple[Region, ...]  # at the layer's own places
    lookup: RegionLookup  # of these regions
    placement: Placement = UNMOVED


class RefusedRegion(Struct, frozen=True):
    """A region that is not in force: its index in the client's line, its name as far as it has one, and why."""

    index: int
    name: str
    reason: str
