"""What bank is to be built, and how."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import msgspec
import numpy as np

from controller.arrays import Bools
from controller.device.bank.grid import Grid
from controller.device.board.board import Board
from controller.device.scene.scene import FixedEmitter
from controller.workshop.bank_builder.methods.aims import DescentAim
from controller.workshop.bank_builder.methods.measured_plate import MeasuredPlate
from controller.workshop.physics.plate import mode_cut_hz
from controller.workshop.physics.responses.response_source import ResponseSource
from controller.workshop.workers.workers import ALONE, Workers


def cells_around(grid: Grid, places_m: Iterable[tuple[float, float]]) -> Bools:
    """The cells that are interpolated between at some places, alone and among many: (cells of the grid,)."""
    cells, rows = np.zeros(grid.cells, bool), range(-1, 3)
    for x_m, y_m in places_m:
        iy, ix = divmod(grid.corners(x_m, y_m)[0][0], grid.nx)
        for x, y in ((x, y) for y in rows for x in rows if x in (0, 1) or y in (0, 1)):
            if 0 <= ix + x < grid.nx and 0 <= iy + y < grid.ny:
                cells[(iy + y) * grid.nx + ix + x] = True
    return cells


@dataclass(frozen=True)
class BankRequest:
    """What `build_bank` makes: the first fields say of what the bank is, the last five how it is built."""

    board: Board
    path: Path  # its folder is made if it is missing
    pitch_m: float | None = None  # of the grid; the board's own by default
    cells: Bools | None = None  # (cells of the grid,): cells to build; all by default
    emitters: Sequence[FixedEmitter] = ()
    scene: str | None = None  # what `cells` and `fixed emitters` came from, noted in the build parameters
    highest_hz: float | None = None  # modes above are left out; `mode_cut_hz` by default
    choice: dict[str, Any] | None = None  # what `choice.choose` returned; its `composes` says whether responses are written
    compact: bool = False  # four-bit weights of pulses, without waveforms of cells (`compact`)
    source: ResponseSource | None = None  # of the responses; the board's plate model by default
    # Optimise every entry for this (`workshop/bank_builder/methods/descent.py`). What is done of an interrupted build is kept
    # beside `path`
    aim: DescentAim | None = None
    plate: MeasuredPlate | None = None  # by which entries of a `source` are optimised
    workers: Workers = ALONE  # who optimises, or else computes the cells
    # Memory that the build may take, in MB of 10^6 bytes, `DEFAULT_MB` by default; the bank is the same whatever it is
    memory_mb: float | None = None
    progress: bool = False  # show a bar on stderr if that is a terminal
    overwrite: bool = False  # replace a file at `path` even if it is no bank: for paths that this software chooses itself

    @property
    def board_as_chosen(self) -> Board:
        """The board with the snapping distance of `choice`."""
        if self.choice is None:
            return self.board
        bank = msgspec.structs.replace(self.board.bank, snap_mm=self.choice["snap_mm"])
        return msgspec.structs.replace(self.board, bank=bank)

    @property
    def highest_mode_hz(self) -> float:
        """`highest_hz`, or its default."""
        return mode_cut_hz(self.board) if self.highest_hz is None else self.highest_hz
