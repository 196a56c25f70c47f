"""Where boards, gateware and unit files lie: in /etc, in the source tree, or in the installed data."""

from __future__ import annotations

import sys
import sysconfig
from pathlib import Path

from controller.errors import ConfigError

SYSTEM_BOARDS = Path("/etc/haptic-panel/boards")


def find_board(name_or_path: str) -> Path:
    """Folder of a board.

    Parameters
    ----------
    name_or_path : str
        Path of a folder or of its board.toml; else a name, looked up in /etc, the source tree and the installed data.

    Raises
    ------
    ConfigError
        If there is no such board; the message lists those that exist.
    """
    given = Path(name_or_path)
    if given.is_file() and given.suffix == ".toml":
        return given.parent
    if (given / "board.toml").is_file():
        return given
    places = board_places()
    for place in places:
        if (place / name_or_path / "board.toml").is_file():
            return place / name_or_path
    known = sorted({file.parent.name for place in places for file in place.glob("*/board.toml")})
    raise ConfigError(f"board {name_or_path!r} not found; there are: {', '.join(known) or 'none'} (or a folder with a board.toml)")


def in_system_folder(folder: Path) -> bool:
    """Whether a board's folder is in /etc, where the service looks for its board."""
    return folder.parent.resolve() == SYSTEM_BOARDS.resolve()


def board_places() -> list[Path]:
    """Folders in which boards are looked up by name."""
    return [SYSTEM_BOARDS, data_folder("boards")]


def data_folder(room: str) -> Path:
    """Folder of `boards`, `fpga_rtl` or `systemd`: in the source tree, else below share/ of the installation."""
    beside = Path(__file__).resolve().parent.parent.parent / room
    if beside.is_dir() and (beside.parent / "pyproject.toml").is_file():
        return beside
    for prefix in (sysconfig.get_path("data"), sys.prefix, "/usr"):
        folder = Path(prefix) / "share" / "haptic-panel" / room
        if folder.is_dir():
            return folder
    return beside
