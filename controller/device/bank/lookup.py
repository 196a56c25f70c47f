"""Which bank of a board is played: one measured on this device, else that of the running release, else the device's own."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

from controller.device.bank.file_format import COMPACT_VERSION, VERSION
from controller.device.bank.inspection import header_of, wrong_pitch
from controller.device.bank.reader import Bank
from controller.device.board.board import Board
from controller.device.board.lookup import running_release
from controller.device.board.paths import bank_path, earlier_bank_path, is_there
from controller.errors import BankError
from controller.regular_file import open_regular


@dataclass(frozen=True, slots=True)
class FoundBank:
    """A board's bank."""

    path: Path  # it need not exist
    why: str  # why it and no other, for people
    of_release: bool = False  # whether it belongs to the running release, hence is never written


def find_bank(board: Board) -> FoundBank:
    """The bank that is played unless another is given.

    What was measured on a device comes first: no release can know its plate. One that cannot be read counts as measured, so that it
    is reported and not passed over. A bank of the release that was built for another board or pitch is passed over.
    """
    own = bank_path(board)
    if not is_there(own) and of_this_format(earlier := earlier_bank_path(board)):
        own = earlier
    folder = running_release()
    release = folder / "banks" / f"{board.key}.bank" if folder else None
    if release is None or not is_there(release):
        return FoundBank(own, "the device's own")
    if is_there(own) and _may_be_measured(own):
        return FoundBank(own, f"measured on this device, hence before {release}")
    if other := _of_another_board(release, board):
        return FoundBank(own, f"the device's own: {release} {other}")
    unused = f", before {own}, which was computed and not measured" if is_there(own) else ""
    return FoundBank(release, f"of the release{unused}", of_release=True)


def bank_as_it_is(board: Board, given: str | None, *, keep: bool) -> Bank | None:
    """The bank that is played whatever the scene needs; None: it is the device's own, which is built for the scene.

    `given` is a file that is played instead of the board's own. With `keep` the device's own is played as it is, if it is there:
    the service of a panel never replaces a bank. Raises BankError if it does not fit the board.
    """
    if given:
        return Bank.open(Path(given), board)
    found = find_bank(board)
    if not (found.of_release or (keep and is_there(found.path))):
        return None
    bank = Bank.open(found.path, board)
    if wrong := wrong_pitch(bank, board):
        bank.close()
        raise BankError(f"{found.path}: {wrong}; rebuild it: {bank.rebuild}")
    return bank


def of_this_format(path: Path) -> bool:
    """Whether a file is there and is no bank of another format."""
    if not is_there(path):
        return False
    try:
        with os.fdopen(open_regular(path, links=True), "rb") as file:
            start = file.read(16)
    except OSError:
        return True
    return len(start) < 16 or int.from_bytes(start[8:12], "little") in (VERSION, COMPACT_VERSION)


def _may_be_measured(path: Path) -> bool:
    try:
        provenance = header_of(path).provenance
    except (OSError, BankError):
        return True
    return provenance is None or provenance.from_measurements


def _of_another_board(path: Path, board: Board) -> str:
    """How a bank differs from what a board needs; empty: it does not, or is damaged, which opening it tells."""
    try:
        with Bank.open(path) as bank:
            if bank.header.board_digest != board.fpga_boards[0].digest():
                return "is of another board"
            return wrong_pitch(bank, board)
    except BankError:
        return ""
