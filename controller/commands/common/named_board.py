"""The board that a command line names, with a warning for each relation between its keys that is odd."""

import argparse

from controller.console import tell
from controller.device.board.board import Board, load_board
from controller.device.board.lookup import find_board
from controller.device.board.relations.checked import judge
from controller.errors import UsageError
from controller.log import Priority


def board_of(options: argparse.Namespace) -> Board:
    """The board of --board; raises ConfigError if there is none, or it is refused."""
    return load_board(find_board(options.board))


def named_board(name: str) -> Board:
    """Read and check a board, and say on stderr what of it is odd.

    Raises ConfigError if there is no such board, or it is refused.
    """
    board = load_board(find_board(name))
    for odd in judge(board).odd:
        tell(f"{board.folder / 'board.toml'}: {odd}", Priority.WARNING)
    return board


def add_fpga(step: argparse.ArgumentParser, *, all_by_default: bool = False) -> None:
    """Declare --fpga."""
    default, said = (None, "all") if all_by_default else (0, "0, the first")
    step.add_argument("--fpga", type=int, default=default, metavar="N", help=f"of several FPGAs, which one (default: {said})")


def with_one_fpga(board: Board, number: int) -> Board:
    """The board as its FPGA of this number drives it; raises UsageError if there is none."""
    boards = board.fpga_boards
    if not 0 <= number < len(boards):
        raise UsageError(f"--fpga: board {board.name!r} has no FPGA {number}: they are counted from 0 to {len(boards) - 1}")
    return boards[number]
