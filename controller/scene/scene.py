"""What a scene is: regions ready to be asked, spots, effects that commands can play; what it reaches and asks for. Pure.

Types say what may be in a scene that comes from another process (`scene_message`).
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import InitVar, dataclass, field
from pathlib import Path
from typing import Annotated, NamedTuple

import numpy as np
from msgspec import Meta, Struct
from numpy.typing import NDArray

from controller.board.board import Board
from controller.scene.effects import EffectTable
from controller.scene.scene_file import RegionRead, Shape, read_scene, spot_at
from controller.scene.shapes import Boxes, Place
from controller.scene.spacings import Spacing, spacing_of
from controller.scene.trains import EffectiveAmplitude, Train, train_of

OUTSIDE = -1
SLACK_M = 0.25e-3  # points may be rounded by this much before their cells are asked for (waveforms/selection.py)
LEAST_SIDE_M = 1e-9  # of all meshes together: a region may be so thin that it has no width in floating point
MESHES = 32  # each way: in each mesh the regions that a finger there can be in


class Spot(NamedTuple):
    """A point that is played all the time; its beats are `phase` of a period late."""

    x_m: Place
    y_m: Place
    rate_hz: Annotated[float, Meta(ge=0.1, le=1000)]
    region: str
    amplitude: EffectiveAmplitude = 1.0
    phase: Annotated[float, Meta(ge=0, lt=1)] = 0.0
    alternate: bool = False


class Area(Struct, frozen=True, array_like=True, forbid_unknown_fields=True):
    """One region, ready to be asked: what begins on each occasion, and what happens as a finger moves."""

    name: str
    shape: Shape
    press: tuple[Train, ...] = ()
    release: tuple[Train, ...] = ()
    enter: tuple[Train, ...] = ()
    leave: tuple[Train, ...] = ()
    spacings: tuple[Spacing, ...] = ()
    spot: Spot | None = None
    alternate: bool = False

    @property
    def felt(self) -> bool:
        """Whether a finger in it, or on its way out, can feel anything."""
        return bool(self.press or self.release or self.enter or self.leave or self.spacings)

    @property
    def trains_hz(self) -> float:
        """Most emissions a second of trains that begin together."""
        return max(sum(1 / t.period_s for t in trains if t.period_s) for trains in (self.press, self.enter, self.leave))


class Meshes(Struct, frozen=True, array_like=True, forbid_unknown_fields=True):
    """A grid over all regions: its lower left corner, meshes per m, and the regions that a finger in each can be in."""

    low_x: Place
    low_y: Place
    per_x: Annotated[float, Meta(gt=0, le=MESHES / LEAST_SIDE_M)]
    per_y: Annotated[float, Meta(gt=0, le=MESHES / LEAST_SIDE_M)]
    regions: Annotated[tuple[tuple[int, ...], ...], Meta(min_length=MESHES * MESHES, max_length=MESHES * MESHES)]

    @classmethod
    def of(cls, areas: tuple[Area, ...]) -> Meshes:
        """The grid of some regions."""
        bounds = [area.shape.bounds for area in areas] or [(0.0, 0.0, 1.0, 1.0)]
        low_x, low_y, high_x, high_y = (f(side) for f, side in zip((min, min, max, max), zip(*bounds, strict=True), strict=True))
        # A hair wider, so that what lies on the far rim has a mesh too.
        sides = (max((high - low) * (1 + 1e-9), LEAST_SIDE_M) for low, high in ((low_x, high_x), (low_y, high_y)))
        mesh_x, mesh_y = (side / MESHES for side in sides)
        column, row = (part.ravel() for part in np.meshgrid(np.arange(MESHES), np.arange(MESHES), indexing="ij"))
        hair = 1e-6 * max(mesh_x, mesh_y)
        boxes = Boxes(
            low_x + column * mesh_x - hair,
            low_x + (column + 1) * mesh_x + hair,
            low_y + row * mesh_y - hair,
            low_y + (row + 1) * mesh_y + hair,
        )
        met = np.zeros((MESHES * MESHES, len(areas)), bool)
        for index, area in enumerate(areas):
            met[:, index] = area.shape.meets(boxes)
        known: dict[tuple[int, ...], tuple[int, ...]] = {}
        meshes = []
        for regions in met:
            candidates = tuple(regions.nonzero()[0].tolist())
            meshes.append(known.setdefault(candidates, candidates))
        return cls(low_x, low_y, 1 / mesh_x, 1 / mesh_y, tuple(meshes))


@dataclass(frozen=True, slots=True)
class Scene:
    """Regions in the order in which they are asked, and what a command can play, by name; `meshes` if they are known."""

    areas: tuple[Area, ...]
    effects: Mapping[str, Train] = field(default_factory=dict)
    given: InitVar[Meshes | None] = None
    spots: tuple[Spot, ...] = field(init=False)
    meshes: Meshes = field(init=False, repr=False)

    def __post_init__(self, given: Meshes | None) -> None:
        object.__setattr__(self, "spots", tuple([area.spot for area in self.areas if area.spot]))
        object.__setattr__(self, "meshes", Meshes.of(self.areas) if given is None else given)

    def region_at(self, x_m: float, y_m: float) -> int:
        """Index of the first region that contains a point, or OUTSIDE."""
        meshes = self.meshes
        column, row = int((x_m - meshes.low_x) * meshes.per_x), int((y_m - meshes.low_y) * meshes.per_y)
        if 0 <= column < MESHES and 0 <= row < MESHES:
            for index in meshes.regions[column * MESHES + row]:
                if self.areas[index].shape.contains(x_m, y_m):
                    return index
        return OUTSIDE


def load_scene(file: Path, board: Board) -> Scene:
    """Read and check a scene.toml against the board it is to be felt on.

    Raises
    ------
    ConfigError
        Naming file, key and value.
    """
    read = read_scene(file, board)
    return Scene(tuple(map(_area, read.regions)), {name: train_of(effect) for name, effect in read.playable.items()})


def edge_warnings(scene: Scene, board: Board, channel_edges: int, all_edges: int) -> list[str]:
    """What the FPGA's edge limits would end: one line for each limit that the scene's repetitions exceed.

    Parameters
    ----------
    channel_edges, all_edges : int
        In an emission, of its busiest channel and of all channels together: the worst of a bank.
    """
    spots_hz = sum({spot.rate_hz for spot in scene.spots})  # those of one rate are one emission
    trains_hz = max((area.trains_hz for area in scene.areas), default=0.0)
    rate_hz = min(spots_hz + trains_hz, board.limits.max_duty / board.waveform.duration_s)
    limits = board.limits
    return [
        f"up to {rate_hz:g} emissions a second make {rate_hz * edges:.4g} edges a second {whose}, above"
        f" limits.{name} = {limit:g} of board {board.name!r}: the FPGA will switch off"
        for name, limit, edges, whose in (
            ("max_channel_edge_rate_hz", limits.max_channel_edge_rate_hz, channel_edges, "on one channel"),
            ("max_total_edge_rate_hz", limits.max_total_edge_rate_hz, all_edges, "on all channels"),
        )
        if rate_hz * edges > limit * (1 + 1e-9)
    ]


def reach(scene: Scene, points_m: NDArray[np.float64], pitch_m: float, margin_m: float = 0.0) -> NDArray[np.bool_]:
    """Which cells a scene can ask for: for every point where it may emit, the four cells around.

    Beyond the outermost cells a point takes those nearest to it. What begins as a finger leaves its region
    may be felt anywhere.

    Parameters
    ----------
    points_m : (cell, 2) array
        Cells of a whole regular grid, in any order.
    pitch_m : float
        Distance of neighbouring cells.
    margin_m : float
        How far beyond its region's border an emission for a finger may be: by prediction.

    Returns
    -------
    (cell,) bool array
    """
    x, y = points_m[:, 0], points_m[:, 1]
    near, wide = (
        Boxes(*_influence(x, half_m, pitch_m), *_influence(y, half_m, pitch_m))
        for half_m in (pitch_m + SLACK_M, pitch_m + SLACK_M + margin_m)
    )
    reached = np.zeros(len(points_m), bool)
    for area in scene.areas:
        if area.leave:
            reached[:] = True
        elif area.felt:
            reached |= area.shape.meets(wide)
        if area.spot:
            reached |= near.contain(area.spot.x_m, area.spot.y_m)
    return reached


def _influence(at: NDArray[np.float64], half_m: float, pitch_m: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Along one axis, from where to where a point takes a cell: a pitch either way.

    For the two outermost rows it goes on without end: a point beyond the outermost is taken to lie on
    it, and there the inner one still has its part (of weight 0).
    """
    far_m = 1e3
    rim_m = 1.5 * pitch_m
    low = np.where(at < at.min() + rim_m, at - far_m, at - half_m)
    high = np.where(at > at.max() - rim_m, at + far_m, at + half_m)
    return low, high


def _area(region: RegionRead) -> Area:
    table, shape, effects = region
    always = next((effect for effect in effects if "always" in effect.occasions), None)
    alternate = table.policy == "alternate"
    spot = None
    if always is not None:
        rate_hz = always.rate_hz or 0.0
        amplitude = always.strength * table.amplitude
        spot = Spot(*spot_at(always, shape), rate_hz, table.name, amplitude, always.phase or 0.0, alternate)
    return Area(
        name=table.name,
        shape=shape,
        press=_trains("press", effects, table.amplitude),
        release=_trains("release", effects, table.amplitude),
        enter=_trains("enter", effects, table.amplitude),
        leave=_trains("leave", effects, table.amplitude),
        spacings=tuple(spacing_of(effect, shape, table.amplitude) for effect in effects if "move" in effect.occasions),
        spot=spot,
        alternate=alternate,
    )


def _trains(occasion: str, effects: Iterable[EffectTable], amplitude: float) -> tuple[Train, ...]:
    return tuple(train_of(effect, amplitude) for effect in effects if occasion in effect.occasions)
