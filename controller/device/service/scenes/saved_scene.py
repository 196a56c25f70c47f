"""A scene that an operator saves under a name, for `load_scene`: checked as a scene, beside the loop, before it is kept."""

from __future__ import annotations

import tomllib
from typing import Final

from controller.device.board.board import Board
from controller.device.board.paths import make_folder
from controller.device.scene.scene import scene_of
from controller.device.scene.scene_file import check_scene, own_scenes, saved_scenes
from controller.durable import write_durably
from controller.errors import ConfigError

BYTES_MAX: Final = 65_536  # of one; a rectangle has 160
SAVED_MAX: Final = 64  # of a board


def save_scene(board: Board, name: str, toml: str) -> None:
    """Keep a scene; one that was saved under this name before is replaced.

    `name` is a plain name, as `messages.PlainName`. Raises ConfigError or BankError if the board has a file of this name itself,
    the scene is refused or too large, there are too many, or it cannot be written.
    """
    own = next((file for file in own_scenes(board, name) if file.exists()), None)
    if own is not None:
        raise ConfigError(
            f"{name!r} is taken by the board's own {own.name}, which a saved scene never replaces: choose another name"
        )
    folder = saved_scenes(board)
    if folder is None:
        raise ConfigError("there is no folder for saved scenes: set STATE_DIRECTORY")
    file, data = folder / f"{name}.toml", toml.encode()
    if len(data) > BYTES_MAX:
        raise ConfigError(f"{file.name}: {len(data):,} bytes, a saved scene has at most {BYTES_MAX:,}")
    try:
        tables = tomllib.loads(toml)
    except (ValueError, RecursionError) as error:
        raise ConfigError(f"{file.name}: not valid TOML: {error}") from error
    scene_of(check_scene(file.name, tables, board))
    if not file.exists() and len(list(folder.glob("*.toml"))) >= SAVED_MAX:
        raise ConfigError(f"{folder}: {SAVED_MAX} scenes are saved, the most of one board: remove one, or replace it by its name")
    make_folder(folder)
    try:
        write_durably(file, data)
    except OSError as error:
        raise ConfigError(f"{file}: cannot be written ({error.strerror}); what was there before is whole") from error
