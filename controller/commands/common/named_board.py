"""The board that a command line names, with a warning for each relation between its keys that is odd."""

from __future__ import annotations

from controller.console import tell
from controller.device.board.board import Board, load_board
from controller.device.board.lookup import find_board
from controller.device.board.relations.checked import judge
from controller.log import Priority


def named_board(name: str, *, several: bool = False) -> Board:
    """Read and check a board, and say on stderr what of it is odd; `several` FPGAs as in `load_board`.

    Raises ConfigError if there is no such board, or it is refused.
    """
    board = load_board(find_board(name), several=several)
    for odd in judge(board).odd:
        tell(f"{board.folder / 'board.toml'}: {odd}", Priority.WARNING)
    return board
