"""Regions of a client's layer, as JSON: checked one by one with a scene's rules, so that a bad one takes no other along."""

from __future__ import annotations

import re
from typing import Any, Final, NamedTuple

import msgspec
import numpy as np

from controller.device.board.board import Board
from controller.device.board.records import as_record
from controller.device.scene.effects.effects import EffectTable
from controller.device.scene.effects.library import Effects, Tables, known_effects, resolved
from controller.device.scene.layers import Placement, RefusedRegion
from controller.device.scene.scene import Region, region_of
from controller.device.scene.scene_file import CheckedRegion, check_effects, covering, never_felt, shape_of
from controller.device.scene.scene_tables import AnyRegionTable
from controller.device.scene.shapes import Rectangle
from controller.errors import ConfigError

REFUSED_MOST: Final = 16  # regions that are named with the reason; the others are counted
REASON_CHARACTERS: Final = 200
NAME_CHARACTERS: Final = 64
REGION_KEY: Final = re.compile(r"(?<![\w.])region(?=[.:\[]| is missing)")  # of a record that holds one region


class LayerTables(msgspec.Struct, frozen=True):
    """The part of a client's line that describes its layer."""

    regions: tuple[dict[str, Any], ...]
    effects: Tables = msgspec.field(default_factory=dict)


class CheckedLayer(NamedTuple):
    """The regions of a layer that may be in force, with their indices in the client's line, and those that may not."""

    regions: tuple[Region, ...]
    indices: tuple[int, ...]
    refused: tuple[RefusedRegion, ...]


class _Shaped(msgspec.Struct, frozen=True):
    region: AnyRegionTable


def read_layer(line: bytes, board: Board) -> CheckedLayer:
    """Read the regions of a layer and check them against a board.

    `line` is a client's: JSON with `regions` and `effects`. Raises ConfigError if `regions` or `effects` as a whole are invalid, or
    one of the effects is; naming key and value.
    """
    try:
        tables = msgspec.json.decode(line, type=LayerTables)
    except msgspec.ValidationError as error:
        raise ConfigError(str(error)) from error
    reader = _Reader(known_effects("", tables.effects, board)[0], board)
    for index, table in enumerate(tables.regions):
        try:
            reader.read(index, table)
        except ConfigError as error:
            reader.refused.append(refusal(index, table.get("name"), str(error)))
    return CheckedLayer(tuple(reader.regions), tuple(reader.indices), tuple(reader.refused))


class _Reader:
    """Checks one region after the other. Most have the effects of another one: what these are is found once."""

    def __init__(self, known: Effects, board: Board) -> None:
        self.regions: list[Region] = []
        self.indices: list[int] = []
        self.refused: list[RefusedRegion] = []
        self._known = known
        self._board = board
        self._plate = Rectangle(0.0, 0.0, board.plate.length_m, board.plate.width_m)
        self._names: dict[str, int] = {}
        self._found: list[CheckedRegion] = []
        self._bounds = np.empty((0, 4))
        self._alike: dict[tuple[Any, ...], tuple[tuple[EffectTable, ...], Region]] = {}

    def read(self, index: int, table: dict[str, Any]) -> None:
        """Take the next region; raises ConfigError if it is refused."""
        key = f"regions[{index}]"
        region = _region_table(key, table)
        if region.name in self._names:
            raise ConfigError(f"{key}.name = {region.name!r} is taken by regions[{self._names[region.name]}] already")
        shape = shape_of(region, self._plate)
        alike = region.effects, region.amplitude, region.policy, region.nulled
        effects, other = self._alike.get(alike, ((), None))
        if other is None:
            effects = _effects(key, region, self._known, self._board)
        checked = CheckedRegion(region, shape, effects)
        self._require_felt(key, checked)
        if other is None or other.spacings:  # of which lines lie as the shape does
            ready = region_of(checked)
            self._alike[alike] = effects, ready
        else:
            ready = msgspec.structs.replace(other, name=region.name, shape=shape)
        self._names[region.name] = index
        self.regions.append(ready)
        self.indices.append(index)

    def _require_felt(self, key: str, checked: CheckedRegion) -> None:
        """Refuse a region that an earlier one covers; else it is one of those."""
        count = len(self._found)
        if count == len(self._bounds):
            self._bounds = np.concatenate([self._bounds, np.empty((max(count, 16), 4))])
        above = covering(checked.shape, self._found, self._bounds[:count])
        if above is not None:
            raise never_felt(key, checked.table, self.indices[above], self._found[above].table)
        self._bounds[count] = checked.shape.bounds
        self._found.append(checked)


def refusal(index: int, name: Any, reason: str) -> RefusedRegion:
    """A region that is refused, with texts of bounded length."""
    return RefusedRegion(index, name[:NAME_CHARACTERS] if isinstance(name, str) else "", reason[:REASON_CHARACTERS])


def off_plate(regions: tuple[Region, ...], placement: Placement, board: Board) -> int:
    """How many regions of a layer have no point on the plate."""
    count = 0
    x_m, y_m, scale = placement
    for region in regions:
        low_x, low_y, high_x, high_y = region.shape.bounds
        across = x_m + scale * high_x >= 0.0 and x_m + scale * low_x <= board.plate.length_m
        count += not (across and y_m + scale * high_y >= 0.0 and y_m + scale * low_y <= board.plate.width_m)
    return count


def _region_table(key: str, table: dict[str, Any]) -> AnyRegionTable:
    """A region as a record, with the keys of its line in messages."""
    try:
        region: AnyRegionTable = msgspec.convert(table, AnyRegionTable)
    except msgspec.ValidationError as wrong:
        try:
            as_record("", {"region": table}, _Shaped)
        except ConfigError as error:
            raise ConfigError(REGION_KEY.sub(key, str(error))) from error
        raise ConfigError(f"{key}: {wrong}") from wrong
    if region.keep_armed:
        raise ConfigError(f"{key}.keep_armed = true is for scenes: no client's regions keep the outputs on")
    return region


def _effects(key: str, region: AnyRegionTable, known: Effects, board: Board) -> tuple[EffectTable, ...]:
    """Effects of a region, all their keys filled in, checked."""
    effects = tuple(resolved(f"{key}.effects[{number}]", effect, known, board) for number, effect in enumerate(region.effects))
    for number, effect in enumerate(effects):
        if "always" in effect.occasions:
            raise ConfigError(
                f'{key}.effects[{number}] has when = "always", which is for scenes: a client plays without a finger by `play`'
            )
    check_effects(key, region, effects, board)
    return effects
