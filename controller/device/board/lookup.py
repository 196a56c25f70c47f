"""Where boards, gateware and unit files lie: in /etc, in the running release, in the source tree, or in the installed data."""

from __future__ import annotations

import sys
import sysconfig
from pathlib import Path

from controller.errors import ConfigError

SYSTEM_BOARDS = Path("/etc/haptic-panel/boards")
MANIFEST = "release.json"  # in the folder of a release


def running_release() -> Path | None:
    """Folder of the release that this program belongs to; None outside of a release, such as in a checkout."""
    folder = Path(sys.prefix).parent
    return folder if (folder / MANIFEST).is_file() else None


def find_board(name_or_path: str) -> Path:
    """Folder of a board.

    `name_or_path` is the path of a folder or of its board.toml; else a name, looked up in /etc, the running release, the source
    tree and the installed data. Raises ConfigError if there is no such board; the message lists those that exist.
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


def fpga_files(path: Path, fpgas: int) -> list[Path]:
    """Files of the bank, or the bitstream, at `path`: one for each FPGA, the first at `path` itself."""
    return [path, *(path.with_name(f"{path.stem}.fpga{number}{path.suffix}") for number in range(1, fpgas))]


def own_board() -> str:
    """Name of the board of this device: `panel`, which its service runs, else the simulated one."""
    return "panel" if any((place / "panel/board.toml").is_file() for place in _system_places()) else "simulated"


def in_system_folder(folder: Path) -> bool:
    """Whether a board's folder is in /etc or in the running release, where the service looks for its board."""
    return folder.parent.resolve() in [place.resolve() for place in _system_places()]


def board_places() -> list[Path]:
    """Folders in which boards are looked up by name."""
    return [*_system_places(), data_folder("boards")]


def _system_places() -> list[Path]:
    release = running_release()
    return [SYSTEM_BOARDS, release / "boards"] if release else [SYSTEM_BOARDS]


def data_folder(room: str) -> Path:
    """Folder of `boards`, `fpga_rtl` or `systemd`: in the source tree, else below share/ of the installation."""
    beside = Path(__file__).resolve().parents[3] / room
    if beside.is_dir() and (beside.parent / "pyproject.toml").is_file():
        return beside
    for prefix in (sysconfig.get_path("data"), sys.prefix, "/usr"):
        folder = Path(prefix) / "share" / "haptic-panel" / room
        if folder.is_dir():
            return folder
    return beside
