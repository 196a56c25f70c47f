"""A board on the plate of another: what the real panel is like, where the host believes its own board.toml."""

import tomllib
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import msgspec

from controller.device.board.board import Board, load_board
from controller.device.board.lookup import find_board
from controller.device.board.plate.plate import Plate
from controller.device.board.records import as_record
from controller.device.board.relations.panel import PLACES
from controller.errors import ConfigError


def on_other_plate(board: Board, given: Sequence[str]) -> Board:
    """The board on the plate that a command line asks for.

    `given` is a board by name, folder or file, whose plate it is; or KEY=VALUE for a key of [plate], such as edges=free. Raises
    ConfigError if there is no such board, key or value, or the patches do not fit on that plate.
    """
    keys: dict[str, Any] = {}
    for text in given:
        key, equals, value = text.partition("=")
        if not equals or Path(text).exists():
            board = on_plate_of(board, load_board(Path(text) if Path(text).is_file() else find_board(text)))
            continue
        try:
            keys[key.strip()] = tomllib.loads(f"value = {value}")["value"]
        except ValueError:
            keys[key.strip()] = value.strip()
    if keys:
        there = {name: kept for name, kept in msgspec.to_builtins(board.plate).items() if kept is not None}
        board = msgspec.structs.replace(board, plate=as_record("--plate: ", there | keys, Plate))
    if refused := [said for relation in PLACES for said in relation.broken(board)]:
        raise ConfigError(f"--plate: {'; '.join(refused)}")
    return board


def on_plate_of(board: Board, real: Board) -> Board:
    """The board on another one's plate: with its plate, patches and driver, but with what the host plays and the idle levels.

    Raises ConfigError if the other one's patches are of other channels.
    """
    idle = {actuator.channel: actuator.idle for actuator in board.actuators}
    if set(idle) != {actuator.channel for actuator in real.actuators}:
        raise ConfigError(f"{real.folder / 'board.toml'}: the patches are of other channels than those of board {board.name!r}")
    patches = tuple(msgspec.structs.replace(patch, idle=idle[patch.channel]) for patch in real.actuators)
    return msgspec.structs.replace(
        board, name=real.name, plate=real.plate, actuators=patches, driver=real.driver, patches=real.patches
    )
