"""What tells one panel from another of the same board: a bank measured on one is of no use on the next."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Final

from controller.device.board.board import Board
from controller.device.board.digest import sha256
from controller.regular_file import read_regular

MACHINE_ID = Path("/etc/machine-id")
DIGITS: Final = 16
_MACHINE_ID: Final = re.compile("[0-9a-f]{32}")  # machine-id(5); `uninitialized` is none


def machine_id(file: Path = MACHINE_ID) -> str | None:
    """The machine-id of this computer; None if it has none."""
    try:
        found = read_regular(file, 64, links=True).decode("ascii").strip()
    except (OSError, UnicodeDecodeError):
        return None
    return found if _MACHINE_ID.fullmatch(found) else None


def panel_identity(file: Path = MACHINE_ID) -> str | None:
    """Identity of the panel of this computer; None if it has no machine-id, which itself is not to leave it (machine-id(5))."""
    found = machine_id(file)
    return None if found is None else _hashed(found)


def simulated_identity(real: Board) -> str:
    """Identity of a simulated panel, by the board that says what is there: the same plate, patches and driver are one panel."""
    return _hashed(real.digest().hex())


def _hashed(text: str) -> str:
    return sha256(f"haptic-panel panel\n{text}".encode()).hex()[:DIGITS]
