"""Preparation of a scene before it is played: at the start of the service, and for a reload in a process of its own.

Reads and checks the file, and the waveforms that the scene can need.
"""

from __future__ import annotations

from pathlib import Path

from controller.device.bank.reader import Bank
from controller.device.board.board import Board
from controller.device.loop.fixed_emitters import needs_responses
from controller.device.scene.coverage import cells_needed
from controller.device.scene.scene import Scene, load_scene
from controller.device.scene.scene_file import find_scene
from controller.device.waveforms.selection import LATTICE_M, lattice_key
from controller.errors import BankError


def prepare(board: Board, name: str, bank_file: Path) -> Scene:
    """A scene that this board can play from this bank.

    Raises ConfigError or BankError if it cannot be meant, or the bank has not all it can ask for.
    """
    scene_file = find_scene(board, name)
    scene = load_scene(scene_file, board)
    with Bank.open(bank_file, board) as bank:
        populate(bank, scene, str(scene_file), responses=True)
    return scene


def populate(bank: Bank, scene: Scene, called: str, *, responses: bool = False) -> int:
    """Read and check what a scene, `called` so in errors, can ask of a bank; returns the number of cells.

    With `responses` also those from which waveforms are composed: nine tenths of a bank. Otherwise they are read and checked when
    they are used. Raises BankError if the bank lacks one, or one is damaged.
    """
    cells = cells_of(bank, scene, called)
    if not bank.composes and (needs_responses(scene, bank.wave_scale) or not _emitters_composed(bank, scene)):
        raise BankError(
            f"{bank.path}: holds no responses, from which {called} needs waveforms composed; rebuild it: {bank.rebuild}"
        )
    bank.drive.check_frames(cells)
    if responses and bank.composes:
        for cell in cells:
            bank.responses.check(cell)
    return len(cells)


def _emitters_composed(bank: Bank, scene: Scene) -> bool:
    """Whether a cell or a ready composition of the bank serves what the fixed emitters of one period play together."""
    emitters = [(emitter.x_m, emitter.y_m, emitter.amplitude) for emitter in scene.emitters]
    return (
        not emitters
        or (len(emitters) == 1 and emitters[0][2] == 1)
        or lattice_key(emitters, LATTICE_M * bank.wave_scale) in bank.drive.compositions
    )


def cells_of(bank: Bank, scene: Scene, called: str) -> list[int]:
    """Cells that a scene can ask for; parameters as of `populate`; raises BankError if the bank lacks one."""
    wanted = cells_needed(scene, bank.grid.points(), bank.grid.pitch_m, wave_scale=bank.wave_scale)
    missing = int((wanted & ~bank.cells).sum())
    if missing:
        raise BankError(f"{bank.path}: has no entry for {missing} cells that {called} can reach; rebuild it: {bank.rebuild}")
    return list(wanted.nonzero()[0].tolist())
