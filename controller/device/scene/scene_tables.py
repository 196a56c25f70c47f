"""scene.toml as typed tables: regions with their shapes, and effects by name."""

from __future__ import annotations

from typing import Annotated, Literal

import msgspec
from msgspec import Meta

from controller.device.board.records import PlaceMm, Record, SizeMm
from controller.device.scene.effects.effects import Amplitude, EffectTable
from controller.device.scene.effects.library import Tables
from controller.device.scene.shapes import Polygon


class RegionTable(Record, frozen=True, kw_only=True, tag_field="shape"):
    """A region of the plate and what is felt there; without effects, nothing. A finger is in the first region that contains it.

    Attributes:
    name: Name of the region; no two have the same.
    effects: Names of effects of the library or of the scene's own [effects.NAME], or tables with the keys of [effects.NAME].
    amplitude: Factor of the amplitudes of its effects.
    policy: `compose`: what it plays is composed with what is due elsewhere; `alternate`: it is played alone, at full amplitude.
    nulled: `others`: while its effects play for a finger, up to four other fingers on the glass, 9 mm away or more, are kept still,
        for some percent of the amplitude. Not for fixed emitters.
    keep_armed: The first touch in it is felt at once: the board's `idle_disarm_s` has no effect on this scene.
    """

    name: Annotated[str, Meta(min_length=1)]
    effects: tuple[str | EffectTable, ...]
    amplitude: Amplitude = 1.0
    policy: Literal["compose", "alternate"] = "compose"
    nulled: Literal["nobody", "others"] = "nobody"
    keep_armed: bool = False


class RectangleTable(RegionTable, frozen=True, kw_only=True, tag="rectangle"):
    """A rectangle.

    Attributes:
    x_mm, y_mm: Corner with the smallest x and y.
    width_mm: Extent along x.
    height_mm: Extent along y.
    """

    x_mm: PlaceMm
    y_mm: PlaceMm
    width_mm: SizeMm
    height_mm: SizeMm


class CircleTable(RegionTable, frozen=True, kw_only=True, tag="circle"):
    """A circle.

    Attributes:
    x_mm, y_mm: Centre.
    radius_mm: Radius.
    """

    x_mm: PlaceMm
    y_mm: PlaceMm
    radius_mm: SizeMm


class PolygonTable(RegionTable, frozen=True, kw_only=True, tag="polygon"):
    """A polygon.

    Attributes:
    corners_mm: Corners [x, y] in order; edges do not cross.
    """

    corners_mm: Annotated[tuple[tuple[PlaceMm, PlaceMm], ...], Meta(min_length=3, max_length=1000)]

    def __post_init__(self) -> None:
        crossing = Polygon(self.corners_mm).crossing()
        if crossing:
            first, second = (list(self.corners_mm[edge]) for edge in crossing)
            raise ValueError(f"corners_mm: the edges from {first} and from {second} cross or touch")


class PlateTable(RegionTable, frozen=True, kw_only=True, tag="plate"):
    """The whole plate."""


AnyRegionTable = RectangleTable | CircleTable | PolygonTable | PlateTable


class SceneTable(Record, frozen=True):
    """A scene: regions of the plate and the effects that are felt in them.

    Attributes:
    regions: The regions; of those that contain a finger the first counts.
    effects: Effects of the scene by name, in addition to those of the library.
    """

    regions: Annotated[tuple[AnyRegionTable, ...], Meta(min_length=1)]
    effects: Tables = msgspec.field(default_factory=dict)
