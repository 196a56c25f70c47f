"""scene.toml: regions and effects as typed tables, read and checked against a board."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Annotated

from msgspec import Meta

from controller.board import Board
from controller.errors import ConfigError
from controller.records import NotNegative, Positive, Record, load_toml
from controller.shapes import Circle, Point, Polygon, Rectangle

ROUNDING_M = 1e-9
Rate = Annotated[float, Meta(ge=0.1, le=1000)]  # the FPGA counts periods in 32 bits of its clock


class Click(Record, frozen=True, tag_field="effect", tag="click"):
    """One emission when the finger is put down."""


class Train(Record, frozen=True, tag_field="effect", tag="train"):
    """Emissions at a rate from the moment the finger is put down."""

    rate_hz: Rate
    duration_ms: Annotated[float, Meta(gt=0, le=3.6e6)]

    @property
    def period_s(self) -> float:
        """From the start of one emission to the next, in s."""
        return 1 / self.rate_hz

    @property
    def duration_s(self) -> float:
        """How long it lasts, in s."""
        return self.duration_ms * 1e-3


class Texture(Record, frozen=True, tag_field="effect", tag="texture"):
    """One emission for every so many millimetres of way."""

    spacing_mm: Annotated[float, Meta(ge=0.1)]


class Always(Record, frozen=True, tag_field="effect", tag="always"):
    """Emissions at a fixed point, the region's centre if none is given, without any finger."""

    rate_hz: Rate
    x_mm: NotNegative | None = None
    y_mm: NotNegative | None = None


Effect = Click | Train | Texture | Always


class RegionTable(Record, frozen=True, tag_field="shape"):
    """What all regions have. Without effects it is a place where nothing is felt."""

    name: Annotated[str, Meta(min_length=1)]
    effects: tuple[Effect, ...]

    def __post_init__(self) -> None:
        kinds = [type(effect) for effect in self.effects]
        for kind in kinds:
            if kinds.count(kind) > 1:
                raise ValueError(f"region {self.name!r} has the effect {kind.__struct_config__.tag!r} more than once")


class RectangleTable(RegionTable, frozen=True, tag="rectangle"):
    """A rectangle from its corner of smallest x and y."""

    x_mm: float
    y_mm: float
    width_mm: Positive
    height_mm: Positive


class CircleTable(RegionTable, frozen=True, tag="circle"):
    """A disc around its centre."""

    x_mm: float
    y_mm: float
    radius_mm: Positive


class PolygonTable(RegionTable, frozen=True, tag="polygon"):
    """A polygon by its corners."""

    corners_mm: Annotated[tuple[tuple[float, float], ...], Meta(min_length=3, max_length=1000)]

    def __post_init__(self) -> None:
        super().__post_init__()
        crossing = Polygon(self.corners_mm).crossing()
        if crossing:
            first, second = (list(self.corners_mm[edge]) for edge in crossing)
            raise ValueError(f"corners_mm: the edges from {first} and from {second} cross or touch")


class PlateTable(RegionTable, frozen=True, tag="plate"):
    """The whole plate."""


Region = RectangleTable | CircleTable | PolygonTable | PlateTable


class SceneTable(Record, frozen=True):
    """The whole file."""

    regions: Annotated[tuple[Region, ...], Meta(min_length=1)]


def find_scene(board: Board, name_or_path: str) -> Path:
    """File of a scene: a path, else `<name>.toml` beside the board's file.

    Raises
    ------
    ConfigError
        If there is none, listing the scenes that exist.
    """
    for file in (Path(name_or_path), board.folder / name_or_path, board.folder / f"{name_or_path}.toml"):
        if file.is_file() and file.name != "board.toml":
            return file
    known = sorted(file.stem for file in board.folder.glob("*.toml") if file.name != "board.toml")
    raise ConfigError(f"scene {name_or_path!r} not found; board {board.name!r} has: {', '.join(known) or 'none'} (or a path)")


def read_regions(file: Path, board: Board) -> tuple[tuple[Region, Rectangle | Circle | Polygon], ...]:
    """Regions of a scene.toml with their shapes in metres, in the file's order.

    Raises
    ------
    ConfigError
        Naming file, key and value.
    """
    regions = load_toml(file, SceneTable).regions
    plate = Rectangle(0.0, 0.0, board.plate.length_m, board.plate.width_m)
    names = [region.name for region in regions]
    found = []
    for index, region in enumerate(regions):
        key = f"{file}: regions[{index}]"
        if region.name in names[:index]:
            raise ConfigError(f"{key}.name = {region.name!r} is taken by regions[{names.index(region.name)}] already")
        shape = _shape(region, plate)
        low_x, low_y, high_x, high_y = shape.bounds
        off = max(-low_x, -low_y, high_x - plate.x_high, high_y - plate.y_high)
        if off > ROUNDING_M:
            size = f"{board.plate.length_mm:g} × {board.plate.width_mm:g} mm"
            raise ConfigError(f"{key} ({region.name!r}) reaches {off * 1e3:.4g} mm beyond the plate of {size}")
        for number, effect in enumerate(region.effects):
            _check(f"{key}.effects[{number}]", effect, board)
        found.append((region, shape))
    return tuple(found)


def always_at(effect: Always, shape: Rectangle | Circle | Polygon) -> Point:
    """Where an always-on spot is."""
    x_m, y_m = shape.centre
    return x_m if effect.x_mm is None else effect.x_mm * 1e-3, y_m if effect.y_mm is None else effect.y_mm * 1e-3


def _shape(region: Region, plate: Rectangle) -> Rectangle | Circle | Polygon:
    match region:
        case RectangleTable():
            x_m, y_m = region.x_mm * 1e-3, region.y_mm * 1e-3
            return Rectangle(x_m, y_m, x_m + region.width_mm * 1e-3, y_m + region.height_mm * 1e-3)
        case CircleTable():
            return Circle(region.x_mm * 1e-3, region.y_mm * 1e-3, region.radius_mm * 1e-3)
        case PolygonTable():
            return Polygon(tuple((x_mm * 1e-3, y_mm * 1e-3) for x_mm, y_mm in region.corners_mm))
        case PlateTable():
            return plate


def _check(key: str, effect: Effect, board: Board) -> None:
    if isinstance(effect, Train | Always):
        duty = effect.rate_hz * board.waveform.duration_s
        if duty > board.limits.max_duty * (1 + 1e-9):
            most = board.limits.max_duty / board.waveform.duration_s
            raise ConfigError(
                f"{key}.rate_hz = {effect.rate_hz:g} is above {most:g}, as often as emissions of"
                f" {board.waveform.duration_ms:g} ms fit into limits.max_duty = {board.limits.max_duty:g}"
            )
    if isinstance(effect, Always):
        rest_ticks = board.period_ticks(1 / effect.rate_hz) - board.emission_ticks
        word_ticks = board.bit_period >> 16
        if 0 < rest_ticks < word_ticks:
            clock_hz = board.link.clock_hz
            raise ConfigError(
                f"{key}.rate_hz = {effect.rate_hz:g} leaves {rest_ticks / clock_hz * 1e6:.3g} us between emissions, less than a"
                f" drive word: give {clock_hz / board.emission_ticks:.7g} (no pause)"
                f" or at most {math.floor(clock_hz / (board.emission_ticks + word_ticks) * 1e3) / 1e3:.7g}"
            )
        for name, value, most in (("x_mm", effect.x_mm, board.plate.length_mm), ("y_mm", effect.y_mm, board.plate.width_mm)):
            if value is not None and value > most:
                raise ConfigError(f"{key}.{name} = {value:g} is off the plate (0 to {most:g} mm)")
