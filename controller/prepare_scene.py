"""Prepares a scene in a process of its own: `python -m controller.prepare_scene BOARD SCENE BANK`, for the running loop.

What would keep the loop waiting is done here: reading and checking the file, and reading the waveforms it can ask for,
so that they are in the page cache. The result goes to stdout, pickled: the scene, or a sentence that says why not.
"""

from __future__ import annotations

import pickle
import sys
from pathlib import Path

from controller.bank.reader import Bank
from controller.board import Board, load_board
from controller.errors import BankError, ControllerError
from controller.scene import Scene, find_scene, load_scene, reach


def prepare(board: Board, name: str, bank_file: Path) -> Scene:
    """A scene that this board can play from this bank.

    Raises
    ------
    ConfigError, BankError
        If it cannot be meant, or the bank has not all it can ask for.
    """
    scene_file = find_scene(board, name)
    scene = load_scene(scene_file, board)
    with Bank.open(bank_file, board) as bank:
        populate(bank, scene, str(scene_file))
    return scene


def populate(bank: Bank, scene: Scene, called: str) -> int:
    """Read and check all of a bank that a scene can ask for, so that nothing is read or checked while it plays.

    Returns
    -------
    int
        Cells.

    Raises
    ------
    BankError
        If the bank lacks one, or one is damaged.
    """
    wanted = reach(scene, bank.grid.points(), bank.grid.pitch_m)
    missing = int((wanted & ~bank.cells).sum())
    if missing:
        raise BankError(f"{bank.path}: has no entry for {missing} cells that {called} can reach; rebuild it: {bank.rebuild}")
    cells = wanted.nonzero()[0].tolist()
    for cell in cells:
        bank.words(cell)
        bank.response(cell)
    return len(cells)


def main(arguments: list[str]) -> int:
    """Prepare what the arguments name, and write it."""
    board, name, bank_file = arguments
    prepared: Scene | str
    try:
        prepared = prepare(load_board(Path(board)), name, Path(bank_file))
    except ControllerError as error:
        prepared = str(error)
    sys.stdout.buffer.write(pickle.dumps(prepared))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
