"""Where what this software makes lies: one bank for each board, found by whoever builds, plays, looks at or judges it.

A board of /etc is the service's, and so is its bank, whoever asks; what belongs to no service lies in the user's cache.
"""

from __future__ import annotations

import os
import pwd
import shlex
from pathlib import Path

import platformdirs

from controller.board.board import Board
from controller.errors import BankError

SERVICE = "haptic-panel"  # the service's user, and its group
SERVICE_STATE = Path("/var/lib/haptic-panel")  # StateDirectory= of the unit
SERVICE_STATE_MODE = 0o750  # StateDirectoryMode=


def state_folder(board: Board | None = None) -> Path:
    """Folder for what is made: as systemd says, else of a board of /etc the service's, else the user's own cache.

    It need not exist yet.
    """
    state = os.environ.get("STATE_DIRECTORY")  # set by systemd's StateDirectory=
    if state:
        return Path(state.split(":")[0])
    return SERVICE_STATE if board is not None and board.is_the_systems else platformdirs.user_cache_path("haptic-panel")


def bank_path(board: Board, pitch_m: float | None = None) -> Path:
    """File of a board's bank, which serves all scenes whose cells it has.

    Parameters
    ----------
    pitch_m : float, optional
        Of the grid. Another than the board's own has a file of its own, which is played only where it is asked for.
    """
    own_m = board.bank.pitch_mm * 1e-3
    name = board.key if pitch_m is None or pitch_m == own_m else f"{board.key}-{pitch_m * 1e3:g}mm"
    return state_folder(board) / "banks" / f"{name}.bank"


def is_there(path: Path) -> bool:
    """Whether a file is there, or its folder is closed to this user, as opening it then says."""
    try:
        return path.exists()
    except PermissionError:
        return True


def build_line(path: Path, board: Board | str | None) -> str:
    """Line for a shell that builds a bank at a path; of a board only its name may be known, or nothing."""
    called = board.called if isinstance(board, Board) else board or "NAME"
    out = [] if isinstance(board, Board) and path == bank_path(board) else ["--out", str(path)]
    return shlex.join(["haptic-panel", "bank", "build", "--board", called, *out])


def make_folder(folder: Path) -> None:
    """Make the folder of a bank; where root makes the service's, it is the service's then.

    Raises
    ------
    BankError
        If it cannot be made.
    """
    try:
        owner = service_user() if os.geteuid() == 0 else None
        for place in (*reversed(folder.parents), folder):
            if owner is not None and SERVICE_STATE in (place, *place.parents):
                if not place.exists():
                    place.mkdir(SERVICE_STATE_MODE)
                if place.stat().st_uid == 0:  # just made, or before there was such a user
                    os.chown(place, owner.pw_uid, owner.pw_gid, follow_symlinks=False)
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        hint = f": root and the user {SERVICE} may; else give --out FILE" if SERVICE_STATE in folder.parents else ""
        raise BankError(f"{folder}: cannot be made ({error.strerror}){hint}") from error


def service_user() -> pwd.struct_passwd | None:
    """The user that the service runs as; None where it was never installed."""
    try:
        return pwd.getpwnam(SERVICE)
    except KeyError:
        return None
