"""What the panel should feel like: regions of the plate and what to play there. Pure.

A finger belongs to the first region of the file that contains it. What the effects do:

- `click`: one emission when the finger is put down in the region; never by sliding into it.
- `train`: emissions from the moment the finger is put down, where the finger then is, until
  `duration_ms` is over or the finger is lifted or leaves the region; never by sliding into it.
- `texture`: one emission for every `spacing_mm` of way inside the region, by sliding into it as well.
  The way counts from the first report inside. A report that jumps over several spacings gives one
  emission (the time between has passed); the rest of the way is kept.
- `always`: emissions at a fixed point without any finger (a `Spot`).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from controller.board import Board
from controller.scene_file import Always, Click, Region, Texture, Train, always_at, find_scene, read_regions
from controller.shapes import Boxes, Circle, Polygon, Rectangle
from controller.touch.samples import TouchSample

__all__ = [
    "Emission",
    "FingerState",
    "Scene",
    "Spot",
    "edge_warnings",
    "find_scene",
    "load_scene",
    "next_time_s",
    "on_time",
    "on_touch",
    "reach",
]

OUTSIDE = -1
ROUNDING_M = ROUNDING_S = 1e-9  # so that a spacing reached exactly is reached, and a train of 3 beats has 3
SLACK_M = 0.25e-3  # points may be rounded by this much before their cells are asked for (bank/selection.py)


class Emission(NamedTuple):
    """One focus to be played: where and when it is due, for whom, how strong among others."""

    time_s: float
    x_m: float
    y_m: float
    finger: int | None
    region: str
    weight: float = 1.0


class Spot(NamedTuple):
    """A point that is played all the time."""

    x_m: float
    y_m: float
    rate_hz: float
    region: str


class FingerState(NamedTuple):
    """What the scene knows of one finger between samples."""

    finger: int
    x_m: float
    y_m: float
    region: int  # index in the scene, or OUTSIDE
    way_m: float = 0.0  # since the last emission of the texture
    train_next_s: float | None = None
    train_end_s: float = 0.0


@dataclass(frozen=True, slots=True)
class Area:
    """One region, ready to be asked."""

    name: str
    shape: Rectangle | Circle | Polygon
    click: bool
    train: Train | None
    spacing_m: float | None
    spot: Spot | None


@dataclass(frozen=True, slots=True)
class Scene:
    """Regions in the order in which they are asked."""

    areas: tuple[Area, ...]
    spots: tuple[Spot, ...] = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "spots", tuple(area.spot for area in self.areas if area.spot))

    def region_at(self, x_m: float, y_m: float) -> int:
        """Index of the first region that contains a point, or OUTSIDE."""
        for index, area in enumerate(self.areas):
            if area.shape.contains(x_m, y_m):
                return index
        return OUTSIDE


def load_scene(file: Path, board: Board) -> Scene:
    """Read and check a scene.toml against the board it is to be felt on.

    Raises
    ------
    ConfigError
        Naming file, key and value.
    """
    return Scene(tuple(_area(region, shape) for region, shape in read_regions(file, board)))


def on_touch(scene: Scene, state: FingerState | None, sample: TouchSample) -> tuple[FingerState | None, tuple[Emission, ...]]:
    """A finger began (`state` None), moved or was released.

    Returns
    -------
    state : FingerState or None
        To be given with this finger's next sample; None once it is released.
    emissions : tuple of Emission
        Due now, at the finger's place: at most one.
    """
    finger, x_m, y_m, time_s, contact, _ = sample
    if not contact:
        return None, ()
    index = scene.region_at(x_m, y_m)
    area = scene.areas[index] if index != OUTSIDE else None
    if state is None:
        if area is None or not (area.click or area.train):
            return FingerState(finger, x_m, y_m, index), ()
        train_next_s, train_end_s = None, 0.0
        if area.train:
            train_end_s = time_s + area.train.duration_s
            train_next_s = _before(time_s + area.train.period_s, train_end_s)
        pressed = FingerState(finger, x_m, y_m, index, 0.0, train_next_s, train_end_s)
        return pressed, (Emission(time_s, x_m, y_m, finger, area.name),)
    if area is None or index != state.region:
        return FingerState(finger, x_m, y_m, index), ()
    if area.spacing_m is None:
        return state._replace(x_m=x_m, y_m=y_m), ()
    way_m = state.way_m + math.hypot(x_m - state.x_m, y_m - state.y_m)
    if way_m < area.spacing_m - ROUNDING_M:
        return state._replace(x_m=x_m, y_m=y_m, way_m=way_m), ()
    rest_m = max(math.fmod(way_m + ROUNDING_M, area.spacing_m) - ROUNDING_M, 0.0)
    return state._replace(x_m=x_m, y_m=y_m, way_m=rest_m), (Emission(time_s, x_m, y_m, finger, area.name),)


def next_time_s(state: FingerState) -> float | None:
    """When `on_time` has something to do for a finger; None: not before its next sample."""
    return state.train_next_s


def on_time(scene: Scene, state: FingerState, now_s: float) -> tuple[FingerState, tuple[Emission, ...]]:
    """Time has come to `now_s`: the emission of a train that is due, if any.

    Of several missed ones the last is given, with its own time: the others cannot be played any more,
    and the train keeps its beat.
    """
    due_s = state.train_next_s
    if due_s is None or due_s > now_s:
        return state, ()
    area = scene.areas[state.region]
    assert area.train is not None
    period_s = area.train.period_s
    next_s = due_s + period_s
    while next_s <= now_s and next_s < state.train_end_s - ROUNDING_S:
        due_s, next_s = next_s, next_s + period_s
    emission = Emission(due_s, state.x_m, state.y_m, state.finger, area.name)
    return state._replace(train_next_s=_before(next_s, state.train_end_s)), (emission,)


def edge_warnings(scene: Scene, board: Board, channel_edges: int, all_edges: int) -> list[str]:
    """What the FPGA's edge limits would end: one line for each limit that the scene's repetitions exceed.

    Parameters
    ----------
    channel_edges, all_edges : int
        In an emission, of its busiest channel and of all channels together: the worst of a bank.
    """
    spots_hz = sum({spot.rate_hz for spot in scene.spots})  # those of one rate are one emission
    trains_hz = max((area.train.rate_hz for area in scene.areas if area.train), default=0.0)
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


def reach(scene: Scene, points_m: NDArray[np.float64], pitch_m: float) -> NDArray[np.bool_]:
    """Which cells a scene can ask for: for every point where it may emit, the four cells around.

    Beyond the outermost cells a point takes those nearest to it.

    Parameters
    ----------
    points_m : (cell, 2) array
        Cells of a whole regular grid, in any order.
    pitch_m : float
        Distance of neighbouring cells.

    Returns
    -------
    (cell,) bool array
    """
    half_m = pitch_m + SLACK_M
    x, y = points_m[:, 0], points_m[:, 1]
    boxes = Boxes(*_influence(x, half_m, pitch_m), *_influence(y, half_m, pitch_m))
    reached = np.zeros(len(points_m), bool)
    for area in scene.areas:
        if area.click or area.train or area.spacing_m:
            reached |= area.shape.meets(boxes)
        if area.spot:
            reached |= boxes.contain(area.spot.x_m, area.spot.y_m)
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


def _before(next_s: float, end_s: float) -> float | None:
    return next_s if next_s < end_s - ROUNDING_S else None


def _area(region: Region, shape: Rectangle | Circle | Polygon) -> Area:
    effects = region.effects
    always = next((effect for effect in effects if isinstance(effect, Always)), None)
    texture = next((effect for effect in effects if isinstance(effect, Texture)), None)
    return Area(
        name=region.name,
        shape=shape,
        click=any(isinstance(effect, Click) for effect in effects),
        train=next((effect for effect in effects if isinstance(effect, Train)), None),
        spacing_m=texture.spacing_mm * 1e-3 if texture else None,
        spot=Spot(*always_at(always, shape), always.rate_hz, region.name) if always else None,
    )
