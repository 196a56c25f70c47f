"""Paths of generated files: one bank for each board and format, at the same path for every command.

The bank of a board in /etc is in the state folder of the service, whichever user asks; that of any other board is in the user's
cache.
"""

from __future__ import annotations

import os
import pwd
import shlex
from pathlib import Path
from typing import Final

from controller.device.board.board import Board
from controller.errors import BankError, ConfigError

SERVICE = "haptic-panel"  # name of the service's user and group
SERVICE_STATE = Path("/var/lib/haptic-panel")  # StateDirectory= of the unit
SERVICE_STATE_MODE = 0o750  # StateDirectoryMode=
BANK_FORMAT: Final = 9  # of bank.file_format: part of a bank's name, so that an older release finds its own beside it


def state_folder(board: Board | None = None) -> Path:
    """Folder for generated files: $STATE_DIRECTORY, else for a board in /etc that of the service, else the user's cache.

    It need not exist.

    Raises ConfigError if there is none of these.
    """
    state = os.environ.get("STATE_DIRECTORY")  # set by systemd's StateDirectory=
    if state:
        return Path(state.split(":")[0])
    if board is not None and board.is_the_systems:
        return SERVICE_STATE
    return user_cache()


def user_cache() -> Path:
    """Folder of the user's cache for this program; it need not exist.

    Raises ConfigError if the user has none: a number without an entry of passwd, as containers have it, and no HOME.
    """
    import platformdirs  # noqa: PLC0415 - what a service needs not

    try:
        folder = platformdirs.user_cache_path("haptic-panel")
    except RuntimeError:  # since platformdirs 4.9; before, and without a passwd entry, it is the text ~/.cache
        folder = Path("~")
    if not folder.is_absolute():
        raise ConfigError(f"user {os.geteuid()} has no home folder for what is kept: set HOME, XDG_CACHE_HOME or STATE_DIRECTORY")
    return folder


def bank_path(board: Board, pitch_m: float | None = None) -> Path:
    """Path of a board's bank on this device, of the format of this program. It serves every scene whose cells it has.

    A bank with another pitch than the board's (`pitch_m`) has a file of its own, played only with --bank.
    """
    own_m = board.bank.pitch_mm * 1e-3
    name = board.key if pitch_m is None or pitch_m == own_m else f"{board.key}-{pitch_m * 1e3:g}mm"
    return state_folder(board) / "banks" / f"{name}.v{BANK_FORMAT}.bank"


def earlier_bank_path(board: Board) -> Path:
    """Path of a board's bank before names included formats."""
    return state_folder(board) / "banks" / f"{board.key}.bank"


def is_there(path: Path) -> bool:
    """Whether a file exists. True also if this user may not look: opening the file then raises an error that says so."""
    try:
        path.stat()  # Path.exists() of Python 3.14 does not report that it may not look
    except PermissionError:
        return True
    except (OSError, ValueError):
        return False
    return True


def build_line(path: Path, board: Board | str | None) -> str:
    """Command line that builds a bank at a path. The board may be given as its name only, or as None."""
    called = board.called if isinstance(board, Board) else board or "NAME"
    out = [] if isinstance(board, Board) and path == bank_path(board) else ["--out", str(path)]
    return shlex.join(["haptic-panel", "bank", "build", "--board", called, *out])


def make_folder(folder: Path) -> None:
    """Create the folder of a bank; if root creates that of the service, its owner is the service's user.

    Raises BankError if it cannot be created.
    """
    try:
        owner = service_user() if os.geteuid() == 0 else None
        for place in (*reversed(folder.parents), folder):
            if SERVICE_STATE in (place, *place.parents):
                if not place.exists():
                    place.mkdir(SERVICE_STATE_MODE)
                if owner is not None and place.stat().st_uid == 0:  # just created, or created before that user existed
                    os.chown(place, owner.pw_uid, owner.pw_gid, follow_symlinks=False)
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        hint = f": root and the user {SERVICE} may; else give --out FILE" if SERVICE_STATE in folder.parents else ""
        raise BankError(f"{folder}: cannot be made ({error.strerror}){hint}") from error


def service_user() -> pwd.struct_passwd | None:
    """User that the service runs as; None if the service is not installed."""
    try:
        return pwd.getpwnam(SERVICE)
    except KeyError:
        return None
