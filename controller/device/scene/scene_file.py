"""Finds a scene.toml, reads it and checks it against a board."""

from __future__ import annotations

import math
import os
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from controller.arrays import Floats
from controller.device.board.board import Board
from controller.device.board.devices import MIN_AMPLITUDE
from controller.device.board.paths import state_folder
from controller.device.board.records import as_record, read_tables
from controller.device.scene.effects.effects import ROUNDING, EffectTable
from controller.device.scene.effects.library import Effects, highest_rate_hz, known_effects, resolved
from controller.device.scene.effects.trains import silent, train_of
from controller.device.scene.scene_tables import AnyRegionTable, CircleTable, PlateTable, PolygonTable, RectangleTable, SceneTable
from controller.device.scene.shapes import Circle, Point, Polygon, Rectangle
from controller.errors import ConfigError

ROUNDING_M = 1e-9
Shape = Rectangle | Circle | Polygon


class CheckedRegion(NamedTuple):
    """A region that was checked: its table, its shape in metres, and its effects with all their keys filled in."""

    table: AnyRegionTable
    shape: Shape
    effects: tuple[EffectTable, ...]


class CheckedScene(NamedTuple):
    """A scene that was checked: regions in the file's order, and the effects that a command can play, by name."""

    regions: tuple[CheckedRegion, ...]
    playable: Effects


def find_scene(board: Board, name_or_path: str | None = None) -> Path:
    """File of a scene.

    `name_or_path` is a path, else `<name>.toml` beside the board's file, else one that was saved; default: the scene that the board
    names. Raises ConfigError if there is none, listing the scenes that exist.
    """
    name = name_or_path or board.scene
    given = [Path(name)] if name_or_path else []  # a name in board.toml is never relative to the current folder
    saved = saved_scenes(board)
    saved = saved if saved and os.access(saved, os.R_OK | os.X_OK) else None  # it is the service's own folder
    for file in (*given, *own_scenes(board, name), *([saved / f"{name}.toml"] if saved and Path(name).name == name else [])):
        if file.is_file() and file.name != "board.toml":
            return file
    files = [*board.folder.glob("*.toml"), *(saved.glob("*.toml") if saved else ())]
    known = sorted({file.stem for file in files if file.name != "board.toml"})
    raise ConfigError(f"scene {name!r} not found; board {board.name!r} has: {', '.join(known) or 'none'} (or a path)")


def own_scenes(board: Board, name: str) -> tuple[Path, Path]:
    """Files that a scene of this name may have beside the board's; they come before one that was saved."""
    return board.beside(name), board.beside(f"{name}.toml")


def saved_scenes(board: Board) -> Path | None:
    """Folder of the scenes that operators have saved for a board, which need not exist; None: this user has no place for any."""
    try:
        return state_folder(board) / "scenes" / board.key
    except ConfigError:
        return None


def read_scene(file: Path, board: Board) -> CheckedScene:
    """Read a scene.toml and check it against a board: its plate, its limits; raises ConfigError, naming file, key and value."""
    return check_scene(str(file), read_tables(file), board)


def check_scene(file: str, tables: dict[str, Any], board: Board) -> CheckedScene:
    """Check what was read from a scene.toml against a board.

    `file` is what messages call it. Raises ConfigError, naming file, key and value.
    """
    scene = as_record(f"{file}: ", tables, SceneTable)
    known, playable = known_effects(f"{file}: ", scene.effects, board)
    plate = Rectangle(0.0, 0.0, board.plate.length_m, board.plate.width_m)
    numbers: dict[str, int] = {}  # of the regions by their names
    bounds = np.empty((len(scene.regions), 4))
    found: list[CheckedRegion] = []
    for index, region in enumerate(scene.regions):
        key = f"{file}: regions[{index}]"
        if region.name in numbers:
            raise ConfigError(f"{key}.name = {region.name!r} is taken by regions[{numbers[region.name]}] already")
        numbers[region.name] = index
        shape = shape_of(region, plate)
        bounds[index] = low_x, low_y, high_x, high_y = shape.bounds
        off = max(-low_x, -low_y, high_x - plate.x_high, high_y - plate.y_high)
        if off > ROUNDING_M:
            size = f"{board.plate.length_mm:g} × {board.plate.width_mm:g} mm"
            raise ConfigError(f"{key} ({region.name!r}) reaches {off * 1e3:.4g} mm beyond the plate of {size}")
        effects = tuple(resolved(f"{key}.effects[{number}]", effect, known, board) for number, effect in enumerate(region.effects))
        check_effects(key, region, effects, board)
        if any("always" not in effect.occasions for effect in effects):
            above = covering(shape, found, bounds[:index])
            if above is not None:
                raise never_felt(key, region, above, found[above].table)
        found.append(CheckedRegion(region, shape, effects))
    return CheckedScene(tuple(found), playable)


def emitter_at(effect: EffectTable, shape: Shape) -> Point:
    """Place of a fixed emitter in m: where its effect says, else the centre of its region's shape."""
    x_m, y_m = shape.centre
    return x_m if effect.x_mm is None else effect.x_mm * 1e-3, y_m if effect.y_mm is None else effect.y_mm * 1e-3


def shape_of(region: AnyRegionTable, plate: Rectangle) -> Shape:
    """Shape of a region in m; `plate` is that of the whole plate."""
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


def check_effects(key: str, region: AnyRegionTable, effects: tuple[EffectTable, ...], board: Board) -> None:
    """Check that the effects of one region go together, and their amplitude with that of the region.

    `key` is file and key of the region, for messages. Raises ConfigError, naming file, key and value.
    """
    for number, effect in enumerate(effects):
        at = f"{key}.effects[{number}]"
        if effect in effects[:number]:
            raise ConfigError(f"{at}: region {region.name!r} has this effect more than once: effects[{effects.index(effect)}]")
        if effect.occasions == ("command",):
            raise ConfigError(f'{at} has when = "command": an application plays it, no region does; keep it in [effects]')
        if "always" in effect.occasions and any("always" in other.occasions for other in effects[:number]):
            raise ConfigError(f"{at}: region {region.name!r} has a fixed emitter already; give each fixed emitter a region")
        if "always" in effect.occasions and region.nulled == "others":
            raise ConfigError(
                f'{at} has when = "always" in a region with nulled = "others": a fixed emitter does not know where fingers are;'
                " leave nulled out, or give the fixed emitter a region of its own"
            )
        if effect.strength * region.amplitude < MIN_AMPLITUDE * (1 - ROUNDING):
            raise ConfigError(
                f"{at}: amplitude {effect.strength:g} in a region of amplitude {region.amplitude:g} is"
                f" {effect.strength * region.amplitude:.3g}, below {MIN_AMPLITUDE:g}, the lowest amplitude that can be played"
            )
        if silent(train_of(effect)):
            raise ConfigError(f"{at}.envelope is silent at every emission of the train")
    for occasion in ("press", "enter", "leave"):
        rates = [train_of(effect).rate_hz for effect in effects if occasion in effect.occasions]
        most_hz = highest_rate_hz(board)
        if sum(rates) > most_hz * (1 + ROUNDING):
            raise ConfigError(
                f"{key}.effects: the trains that begin with when = {occasion!r} are {sum(rates):g} emissions a second together,"
                f" above {most_hz:g}, as often as they fit into limits.max_duty = {board.limits.max_duty:g}"
            )


def covering(shape: Shape, earlier: list[CheckedRegion], bounds: Floats) -> int | None:
    """Index of the first earlier region that covers a shape, which is never felt then: a finger belongs to the first region.

    Only regions whose bounds, (region, 4), contain those of the shape are compared in detail: a scene may have thousands.
    """
    low_x, low_y, high_x, high_y = shape.bounds
    low = (bounds[:, 0] <= low_x + ROUNDING_M) & (bounds[:, 1] <= low_y + ROUNDING_M)
    high = (bounds[:, 2] >= high_x - ROUNDING_M) & (bounds[:, 3] >= high_y - ROUNDING_M)
    near = (low & high).nonzero()[0].tolist()
    return next((index for index in near if _covers(earlier[index].shape, shape)), None)


def never_felt(key: str, region: AnyRegionTable, index: int, other: AnyRegionTable) -> ConfigError:
    """That a region lies within an earlier one, `regions[index]`."""
    return ConfigError(
        f"{key} ({region.name!r}) is never felt: regions[{index}] ({other.name!r}) covers it and comes first;"
        " put the smaller one before it"
    )


def _covers(outer: Shape, inner: Shape) -> bool:
    """Whether one shape certainly lies within another; for a polygon as the outer shape, only if both are equal."""
    if outer == inner:
        return True
    if isinstance(outer, Polygon):
        return False
    if isinstance(outer, Circle) and isinstance(inner, Circle):
        return math.dist((outer.x_m, outer.y_m), (inner.x_m, inner.y_m)) + inner.radius_m <= outer.radius_m
    if isinstance(inner, Polygon):
        return all(outer.contains(*corner) for corner in inner.corners)
    low_x, low_y, high_x, high_y = inner.bounds
    return all(outer.contains(x, y) for x in (low_x, high_x) for y in (low_y, high_y))
