"""Whether a bank that is there suits a board and a scene, or what it was built for: before it is built again."""

import zlib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from controller.arrays import Bools
from controller.device.bank.file_format import model_version_of
from controller.device.bank.inspection import bounds_of, verify_bank, wrong_pitch
from controller.device.bank.provenance import MODEL_VERSION
from controller.device.bank.reader import Bank
from controller.device.board.board import Board
from controller.device.board.lookup import fpga_files
from controller.device.board.paths import is_there
from controller.device.board.records import BYTES_MAX
from controller.errors import BankError
from controller.regular_file import read_regular


@dataclass(frozen=True, slots=True)
class Fit:
    """Whether a bank suits a board and a scene."""

    reason: str  # why it does not; empty: it does
    cells: Bools  # (cells of the grid,): cells of a bank that does


def fit(path: Path, board: Board, cells: Bools) -> Fit:
    """Whether a bank is whole, built by this version for this board and its pitch, and has the cells that are needed.

    `cells`, of the board's grid, are those that it must have; further cells are kept when it is built again because cells are
    missing. Raises BankError if this user may not read it.
    """
    files = zip(board.fpga_boards, fpga_files(path, len(board.link.fpga)), strict=True)
    found = [_fit(file, one, board, cells) for one, file in files]
    reasons = [one.reason for one in found if one.reason]
    return Fit(reasons[0] if reasons else "", np.logical_or.reduce([one.cells for one in found]))


def _fit(path: Path, one: Board, board: Board, cells: Bools) -> Fit:
    """As `fit`, of the file of one FPGA of a board."""
    if not is_there(path):
        return Fit("there is none yet", cells)
    try:
        with Bank.open(path, one) as bank:
            if wrong := wrong_pitch(bank, board):
                return Fit(wrong, cells)
            model_counts = bank.header.provenance is None or not bank.header.provenance.from_measurements
            if model_counts and model_version_of(bank.header.creator) != str(MODEL_VERSION):
                return Fit("it was built by another version of the model", cells)
            if bank.header.parameters.get("channel_edges") is None:
                return Fit("it was built by another version", cells)
            there = bank.cells
        verify_bank(path)
    except BankError as error:
        if isinstance(error.__cause__, PermissionError):  # whoever may not read it is not to replace it
            raise
        return Fit(str(error).removeprefix(f"{path}: ").partition("; rebuild it")[0], cells)
    if len(there) != len(cells):
        return Fit("its cells are others", cells)
    missing = int((cells & ~there).sum())
    return Fit(f"it lacks {missing} cells" if missing else "", cells | there)


def optimised_for(path: Path) -> str:
    """What the entries of the bank at `path` were optimised for; empty: nothing, or there is no such bank that can be read."""
    try:
        with Bank.open(path) as bank:
            reported = bank.header.parameters.get("optimised")
    except BankError:
        return ""
    name = reported.get("name") if isinstance(reported, dict) else None
    return name if isinstance(name, str) and name.isprintable() else ""


def asked_of(board: Board, scene_file: Path) -> dict[str, Any]:
    """What a choice is made for, as its bank repeats it: the board's bounds, and the CRC-32 of the scene's file."""
    return bounds_of(board) | {"scene_crc32": zlib.crc32(read_regular(scene_file, BYTES_MAX, links=True))}


def choice_of(path: Path) -> dict[str, Any] | None:
    """What was chosen with the bank at `path`; None if there is no such bank, or nothing was."""
    try:
        with Bank.open(path) as bank:
            return bank.header.choice
    except BankError:
        return None
