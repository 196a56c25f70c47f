"""A scene that is ready to play: regions, fixed emitters, and the effects that commands can play.

The types also say what may be in a scene that comes from another process (`device/service/scenes/scene_message.py`).
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from copy import copy
from dataclasses import InitVar, dataclass, field
from itertools import chain
from pathlib import Path
from typing import Annotated, Final, NamedTuple, Self

import numpy as np
from msgspec import Meta, Struct

from controller.arrays import Bools, Floats
from controller.device.board.board import Board
from controller.device.board.records import PlaceM
from controller.device.scene.effects.effects import EffectTable
from controller.device.scene.effects.trains import EffectiveAmplitude, Train, train_of
from controller.device.scene.layers import Layer
from controller.device.scene.region_lookup import OUTSIDE, TILES, RegionLookup, StackedLookup
from controller.device.scene.scene_file import CheckedRegion, CheckedScene, Shape, emitter_at, read_scene
from controller.device.scene.shapes import Boxes, Rectangle
from controller.device.scene.spacings import Spacing, spacing_of
from controller.errors import ConfigError

MIN_SIDE_M: Final = 1e-9  # of all tiles together: a region may be so thin that it has no width in floating point
TilesPerM = Annotated[float, Meta(gt=0, le=TILES / MIN_SIDE_M)]


class FixedEmitter(NamedTuple):
    """A point that is played all the time, without a finger."""

    x_m: PlaceM
    y_m: PlaceM
    rate_hz: Annotated[float, Meta(ge=0.1, le=1000)]
    region: str  # name of its region
    amplitude: EffectiveAmplitude = 1.0
    phase: Annotated[float, Meta(ge=0, lt=1)] = 0.0  # by how much of a period its pulses are delayed
    alternate: bool = False  # as in `Emission`


class Region(Struct, frozen=True, array_like=True, forbid_unknown_fields=True):
    """One region: its shape, the trains that begin on each occasion, and the spacings of a finger that moves in it."""

    name: str
    shape: Shape
    press: tuple[Train, ...] = ()
    release: tuple[Train, ...] = ()
    enter: tuple[Train, ...] = ()
    leave: tuple[Train, ...] = ()
    spacings: tuple[Spacing, ...] = ()
    emitter: FixedEmitter | None = None
    alternate: bool = False
    keep_armed: bool = False
    nulled: bool = False

    @property
    def felt(self) -> bool:
        """Whether it has effects for a finger, not only a fixed emitter."""
        return bool(self.press or self.release or self.enter or self.leave or self.spacings)

    @property
    def train_rate_hz(self) -> float:
        """Highest rate of emissions of the trains that begin together."""
        return max(sum(train.rate_hz for train in trains) for trains in (self.press, self.enter, self.leave))


class SpatialIndex(Struct, frozen=True, array_like=True, forbid_unknown_fields=True):
    """Tiles over the bounds of all regions, each with the regions that a point in it can be in."""

    low_x_m: PlaceM  # low_x_m, low_y_m: corner of smallest coordinates
    low_y_m: PlaceM
    tiles_per_m_x: TilesPerM
    tiles_per_m_y: TilesPerM
    # For tile `column * TILES + row` the indices of its regions, in the order of the scene
    candidates: Annotated[
        tuple[tuple[Annotated[int, Meta(ge=0)], ...], ...], Meta(min_length=TILES * TILES, max_length=TILES * TILES)
    ]

    def lookup(self, regions: Sequence[Region]) -> RegionLookup:
        """Lookup in these regions, of which this is the index."""
        shapes = [region.shape for region in regions]
        return RegionLookup(shapes, self.low_x_m, self.low_y_m, self.tiles_per_m_x, self.tiles_per_m_y, self.candidates)

    @classmethod
    def of(cls, regions: tuple[Region, ...]) -> Self:
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
        met = _bounds_meet(np.array(bounds[: len(regions)]).reshape(-1, 4), boxes)
        for index, region in enumerate(regions):
            if not isinstance(region.shape, Rectangle):
                met[:, index] &= region.shape.meets(boxes)
        found, ends = met.nonzero()[1].tolist(), np.cumsum(met.sum(axis=1)).tolist()
        known: dict[tuple[int, ...], tuple[int, ...]] = {}  # equal tuples are kept once
        tiles = []
        start = 0
        for end in ends:
            candidates = tuple(found[start:end])
            tiles.append(known.setdefault(candidates, candidates))
            start = end
        return cls(low_x, low_y, 1 / tile_x, 1 / tile_y, tuple(tiles))


def _bounds_meet(bounds: Floats, boxes: Boxes) -> Bools:
    """Which boxes of the whole grid of tiles meet which bounds, (region, 4): (box, region)."""
    columns = (boxes.x_low[::TILES, None] <= bounds[:, 2]) & (boxes.x_high[::TILES, None] >= bounds[:, 0])
    rows = (boxes.y_low[:TILES, None] <= bounds[:, 3]) & (boxes.y_high[:TILES, None] >= bounds[:, 1])
    met: Bools = (columns[:, None] & rows[None]).reshape(TILES * TILES, -1)
    return met


@dataclass(frozen=True, slots=True)
class Scene:
    """Regions, fixed emitters, and the effects that commands can play."""

    regions: tuple[Region, ...]  # in the order in which they are asked for a point
    effects: Mapping[str, Train] = field(default_factory=dict)  # what a command can play, by name
    known_index: InitVar[SpatialIndex | None] = None  # of these regions; computed if it is not given
    emitters: tuple[FixedEmitter, ...] = field(init=False)
    index: SpatialIndex = field(init=False, repr=False)
    lookup: RegionLookup | StackedLookup = field(init=False, repr=False, compare=False)
    # Whether nothing is played without a touch, and the first touch may be felt late
    may_idle: bool = field(init=False, repr=False, compare=False)
    layers: tuple[Layer, ...] = ()  # what lies on top, the topmost first: `regions` begins with theirs (`under`)

    def __post_init__(self, known_index: SpatialIndex | None) -> None:
        object.__setattr__(self, "emitters", tuple([region.emitter for region in self.regions if region.emitter]))
        object.__setattr__(self, "index", SpatialIndex.of(self.regions) if known_index is None else known_index)
        object.__setattr__(self, "lookup", self.index.lookup(self.regions))
        keep_armed = any(region.keep_armed for region in self.regions)
        object.__setattr__(self, "may_idle", not self.emitters and not keep_armed)

    def under(self, layers: tuple[Layer, ...]) -> Self:
        """This scene, which has no layers yet, with layers on top, the topmost first."""
        if not layers:
            return self
        assert isinstance(self.lookup, RegionLookup)
        whole = copy(self)
        object.__setattr__(whole, "layers", layers)
        object.__setattr__(whole, "regions", (*chain.from_iterable(layer.regions for layer in layers), *self.regions))
        lookups = [(layer.lookup, *layer.placement, len(layer.regions)) for layer in layers]
        object.__setattr__(whole, "lookup", StackedLookup(lookups, self.lookup))
        return whole

    def place_of(self, region: int) -> tuple[Layer | None, int]:
        """Layer of a region, None for the scene itself, and the region's index there."""
        for layer in self.layers:
            if region < len(layer.regions):
                return layer, region
            region -= len(layer.regions)
        return None, region

    def same_region(self, before: Self, index: int) -> int:
        """Index here of a region that has `index` in another stack over the same scene, or OUTSIDE: known by its owner and name."""
        layer, number = before.place_of(index)
        first = 0
        for other in self.layers:
            if layer is not None and other.owner == layer.owner:
                name = layer.regions[number].name
                return next((first + at for at, region in enumerate(other.regions) if region.name == name), OUTSIDE)
            first += len(other.regions)
        return first + number if layer is None else OUTSIDE

    def moved_m(self, before: Self, was: int, now: int) -> tuple[float, float] | None:
        """By how much a region has moved from another stack to this one; None: it is another region, or its spacings are others."""
        if self.same_region(before, was) != now or before.regions[was].spacings != self.regions[now].spacings:
            return None
        (old, _), (new, _) = before.place_of(was), self.place_of(now)
        if old is None or new is None:
            return 0.0, 0.0
        if old.placement.scale != new.placement.scale:
            return None
        return new.placement.x_m - old.placement.x_m, new.placement.y_m - old.placement.y_m

    def named(self, owner: int, name: str) -> int:
        """Index of the region of a name: of the layer of this owner, else of the scene without layers.

        Raises ConfigError if neither has one.
        """
        first = 0
        for layer in self.layers:
            if layer.owner == owner:
                for at, region in enumerate(layer.regions, first):
                    if region.name == name:
                        return at
            first += len(layer.regions)
        for at in range(first, len(self.regions)):
            if self.regions[at].name == name:
                return at
        raise ConfigError(f"no region {name!r}: neither of this client nor of the scene")


def load_scene(file: Path, board: Board) -> Scene:
    """Read a scene.toml, checked against the board on which it is played; raises ConfigError, naming file, key and value."""
    return scene_of(read_scene(file, board))


def scene_of(checked: CheckedScene) -> Scene:
    """A scene that was checked, ready to play."""
    return Scene(tuple(map(region_of, checked.regions)), {name: train_of(effect) for name, effect in checked.playable.items()})


def region_of(region: CheckedRegion) -> Region:
    """A region that was checked, ready to play."""
    table, shape, effects = region
    always = next((effect for effect in effects if "always" in effect.occasions), None)
    alternate = table.policy == "alternate"
    emitter = None
    if always is not None:
        rate_hz = always.rate_hz or 0.0
        amplitude = always.strength * table.amplitude
        emitter = FixedEmitter(*emitter_at(always, shape), rate_hz, table.name, amplitude, always.phase or 0.0, alternate)
    return Region(
        name=table.name,
        shape=shape,
        press=_trains("press", effects, table.amplitude),
        release=_trains("release", effects, table.amplitude),
        enter=_trains("enter", effects, table.amplitude),
        leave=_trains("leave", effects, table.amplitude),
        spacings=tuple(spacing_of(effect, shape, table.amplitude) for effect in effects if "move" in effect.occasions),
        emitter=emitter,
        alternate=alternate,
        keep_armed=table.keep_armed,
        nulled=table.nulled == "others",
    )


def _trains(occasion: str, effects: Iterable[EffectTable], amplitude: float) -> tuple[Train, ...]:
    return tuple(train_of(effect, amplitude) for effect in effects if occasion in effect.occasions)
