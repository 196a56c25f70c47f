"""A scene that is ready to play: regions, spots, and the effects that commands can play.

The types also say what may be in a scene that comes from another process (`service/scene_message.py`).
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import InitVar, dataclass, field
from pathlib import Path
from typing import Annotated, Final, NamedTuple

import numpy as np
from msgspec import Meta, Struct

from controller.board.board import Board
from controller.scene.effects import EffectTable
from controller.scene.region_lookup import TILES, RegionLookup
from controller.scene.scene_file import CheckedRegion, Shape, read_scene, spot_at
from controller.scene.shapes import Boxes, Coordinate
from controller.scene.spacings import Spacing, spacing_of
from controller.scene.trains import EffectiveAmplitude, Train, train_of

MIN_SIDE_M: Final = 1e-9  # of all tiles together: a region may be so thin that it has no width in floating point
TilesPerM = Annotated[float, Meta(gt=0, le=TILES / MIN_SIDE_M)]


class Spot(NamedTuple):
    """A point that is played all the time, without a finger.

    Attributes
    ----------
    x_m, y_m : float
    rate_hz : float
    region : str
        Name of its region.
    amplitude : float
    phase : float
        By how much of a period its beats are delayed.
    alternate : bool
        As in `Emission`.
    """

    x_m: Coordinate
    y_m: Coordinate
    rate_hz: Annotated[float, Meta(ge=0.1, le=1000)]
    region: str
    amplitude: EffectiveAmplitude = 1.0
    phase: Annotated[float, Meta(ge=0, lt=1)] = 0.0
    alternate: bool = False


class Region(Struct, frozen=True, array_like=True, forbid_unknown_fields=True):
    """One region: its shape, the trains that begin on each occasion, and the spacings of a finger that moves in it."""

    name: str
    shape: Shape
    press: tuple[Train, ...] = ()
    release: tuple[Train, ...] = ()
    enter: tuple[Train, ...] = ()
    leave: tuple[Train, ...] = ()
    spacings: tuple[Spacing, ...] = ()
    spot: Spot | None = None
    alternate: bool = False
    keep_armed: bool = False
    quiet: bool = False

    @property
    def felt(self) -> bool:
        """Whether it has effects for a finger, not only a spot."""
        return bool(self.press or self.release or self.enter or self.leave or self.spacings)

    @property
    def train_rate_hz(self) -> float:
        """Highest rate of emissions of the trains that begin together."""
        return max(sum(1 / t.period_s for t in trains if t.period_s) for trains in (self.press, self.enter, self.leave))


class SpatialIndex(Struct, frozen=True, array_like=True, forbid_unknown_fields=True):
    """Tiles over the bounds of all regions, each with the regions that a point in it can be in.

    Attributes
    ----------
    low_x_m, low_y_m : float
        Corner of smallest coordinates.
    tiles_per_m_x, tiles_per_m_y : float
    candidates : tuple of tuples of int
        For tile `column * TILES + row` the indices of its regions, in the order of the scene.
    """

    low_x_m: Coordinate
    low_y_m: Coordinate
    tiles_per_m_x: TilesPerM
    tiles_per_m_y: TilesPerM
    candidates: Annotated[tuple[tuple[int, ...], ...], Meta(min_length=TILES * TILES, max_length=TILES * TILES)]

    @classmethod
    def of(cls, regions: tuple[Region, ...]) -> SpatialIndex:
        """Index of some regions."""
        bounds = [region.shape.bounds for region in regions] or [(0.0, 0.0, 1.0, 1.0)]
        low_x, low_y, high_x, high_y = (f(side) for f, side in zip((min, min, max, max), zip(*bounds, strict=True), strict=True))
        # A little wider, so that a point on the far border has a tile too.
        sides = (max((high - low) * (1 + 1e-9), MIN_SIDE_M) for low, high in ((low_x, high_x), (low_y, high_y)))
        tile_x, tile_y = (side / TILES for side in sides)
        column, row = (part.ravel() for part in np.meshgrid(np.arange(TILES), np.arange(TILES), indexing="ij"))
        margin = 1e-6 * max(tile_x, tile_y)
        boxes = Boxes(
            low_x + column * tile_x - margin,
            low_x + (column + 1) * tile_x + margin,
            low_y + row * tile_y - margin,
            low_y + (row + 1) * tile_y + margin,
        )
        met = np.zeros((TILES * TILES, len(regions)), bool)
        for index, region in enumerate(regions):
            met[:, index] = region.shape.meets(boxes)
        known: dict[tuple[int, ...], tuple[int, ...]] = {}  # equal tuples are kept once
        tiles = []
        for regions_of_tile in met:
            candidates = tuple(regions_of_tile.nonzero()[0].tolist())
            tiles.append(known.setdefault(candidates, candidates))
        return cls(low_x, low_y, 1 / tile_x, 1 / tile_y, tuple(tiles))


@dataclass(frozen=True, slots=True)
class Scene:
    """Regions, spots, and the effects that commands can play.

    Parameters
    ----------
    regions : tuple of Region
        In the order in which they are asked for a point.
    effects : mapping of str to Train
        What a command can play, by name.
    known_index : SpatialIndex, optional
        Of these regions; computed if it is not given.
    """

    regions: tuple[Region, ...]
    effects: Mapping[str, Train] = field(default_factory=dict)
    known_index: InitVar[SpatialIndex | None] = None
    spots: tuple[Spot, ...] = field(init=False)
    index: SpatialIndex = field(init=False, repr=False)
    lookup: RegionLookup = field(init=False, repr=False, compare=False)

    def __post_init__(self, known_index: SpatialIndex | None) -> None:
        object.__setattr__(self, "spots", tuple([region.spot for region in self.regions if region.spot]))
        object.__setattr__(self, "index", SpatialIndex.of(self.regions) if known_index is None else known_index)
        index, shapes = self.index, [region.shape for region in self.regions]
        tiles = index.low_x_m, index.low_y_m, index.tiles_per_m_x, index.tiles_per_m_y
        object.__setattr__(self, "lookup", RegionLookup(shapes, *tiles, index.candidates))

    @property
    def may_idle(self) -> bool:
        """Whether nothing is played without a touch, and the first touch may be felt late."""
        return not self.spots and not any(region.keep_armed for region in self.regions)

    def region_at(self, x_m: float, y_m: float) -> int:
        """Index of the first region that contains the point (x_m, y_m), or OUTSIDE."""
        return self.lookup.at(x_m, y_m)


def load_scene(file: Path, board: Board) -> Scene:
    """Read a scene.toml, checked against the board on which it is played.

    Raises
    ------
    ConfigError
        Naming file, key and value.
    """
    checked = read_scene(file, board)
    return Scene(tuple(map(_region, checked.regions)), {name: train_of(effect) for name, effect in checked.playable.items()})


def _region(region: CheckedRegion) -> Region:
    table, shape, effects = region
    always = next((effect for effect in effects if "always" in effect.occasions), None)
    alternate = table.policy == "alternate"
    spot = None
    if always is not None:
        rate_hz = always.rate_hz or 0.0
        amplitude = always.strength * table.amplitude
        spot = Spot(*spot_at(always, shape), rate_hz, table.name, amplitude, always.phase or 0.0, alternate)
    return Region(
        name=table.name,
        shape=shape,
        press=_trains("press", effects, table.amplitude),
        release=_trains("release", effects, table.amplitude),
        enter=_trains("enter", effects, table.amplitude),
        leave=_trains("leave", effects, table.amplitude),
        spacings=tuple(spacing_of(effect, shape, table.amplitude) for effect in effects if "move" in effect.occasions),
        spot=spot,
        alternate=alternate,
        keep_armed=table.keep_armed,
        quiet=table.quiet_for == "others",
    )


def _trains(occasion: str, effects: Iterable[EffectTable], amplitude: float) -> tuple[Train, ...]:
    return tuple(train_of(effect, amplitude) for effect in effects if occasion in effect.occasions)
