"""What a bank's emissions sound like, and what they bend, on the board's own plate model: some cells, spread over the plate."""

from typing import Any, Final

import numpy as np

from controller.device.bank.packing import WORD
from controller.device.bank.reader import Bank
from controller.device.board.board import Board
from controller.workshop.benchmark.focus.sound_figures import sound_figures
from controller.workshop.physics.responses.impulse_response import ResponseModel
from controller.workshop.physics.sound import PlateSound
from controller.workshop.physics.stress import focal_stress, stress_warnings
from controller.workshop.physics.word_capture import volts_above_idle

Figures = dict[str, Any]

CELLS: Final = 12


def bank_emissions(board: Board, bank: Bank) -> Figures:
    """Figures of `sound_figures`, median and max, and of `focal_stress`, largest, of some cells; warnings of what bears too much.

    Raises BankError if an entry is damaged.
    """
    model = ResponseModel(board)
    sound, in_drive_order = PlateSound(board, model.plate_modes), model.modal[:, ::-1]
    cells = np.flatnonzero(bank.cells)
    heard, borne = [], []
    for cell in cells[np.unique(np.linspace(0, len(cells) - 1, CELLS + 2)[1:-1].round().astype(int))].tolist():
        words = np.frombuffer(bank.drive.words(cell), WORD).astype(np.uint32)
        bent = np.einsum("ms,ms->m", in_drive_order, model.forces @ volts_above_idle(board, words).T)
        heard.append(sound_figures(board, sound, words))
        borne.append(focal_stress(board, model.plate_modes, bent, [bank.grid.place(cell)]))
    stress = {name: max(one[name] for one in borne) for name in borne[0]}
    return {
        "sound": {name: _spread([one[name] for one in heard]) for name in heard[0]},
        "stress": stress,
        "warnings": stress_warnings(**stress),
    }


def _spread(values: list[float]) -> dict[str, float]:
    return {"median": float(np.median(values)), "max": max(values)}
