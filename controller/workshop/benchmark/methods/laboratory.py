"""What the methods under test share: one board, its model, and banks and tables of just the cells that the scenes need."""

import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from controller.device.bank.grid import Grid
from controller.device.bank.reader import Bank
from controller.device.board.board import Board
from controller.workshop.bank_builder.build import build_bank
from controller.workshop.bank_builder.request import BankRequest, cells_around
from controller.workshop.benchmark.methods.interpolation import Interpolation
from controller.workshop.benchmark.methods.response_table import ResponseTable, fill
from controller.workshop.physics.responses.impulse_response import ResponseModel

Place = tuple[float, float]


class Laboratory:
    """Cells for the `places` of all scenes."""

    def __init__(self, board: Board, places: Sequence[Place]) -> None:
        self.board = board
        self.model = ResponseModel(board)
        self._places = places
        self._banks: dict[float, Bank] = {}
        self._tables: dict[Any, tuple[float, ResponseTable, list[Interpolation]]] = {}
        self._prepared: set[Place] = set()

    def bank(self, pitch_m: float) -> Bank:
        """An open bank with the cells around all places; built when it is first asked for."""
        if pitch_m not in self._banks:
            cells = cells_around(Grid.of(self.board.plate, pitch_m), self._places)
            with tempfile.TemporaryDirectory() as folder:  # an open file lasts without a name
                build_bank(BankRequest(self.board, Path(folder) / "bank", pitch_m, cells))
                self._banks[pitch_m] = Bank.open(Path(folder) / "bank", self.board)
        return self._banks[pitch_m]

    def table(
        self, pitch_m: float, bits: int, interpolation: Interpolation, projection: NDArray[np.float32] | None = None
    ) -> ResponseTable:
        """A table that will hold what `interpolation` needs at the places of `prepare`."""
        key = pitch_m, bits, None if projection is None else projection.shape
        if key not in self._tables:
            self._tables[key] = pitch_m, ResponseTable(self.board, pitch_m, bits, projection), []
        _, table, interpolations = self._tables[key]
        if interpolation not in interpolations:
            interpolations.append(interpolation)
        return table

    def prepare(self, places: Sequence[Place]) -> None:
        """Fill the tables for places, and for no others: what is in a cell depends in its last bits on the others."""
        if set(places) == self._prepared:
            return
        self._prepared = set(places)
        for pitch_m in {pitch_m for pitch_m, _, _ in self._tables.values()}:
            wanted = []
            for table, interpolations in [(table, some) for pitch, table, some in self._tables.values() if pitch == pitch_m]:
                table.forget()
                stencils = [interpolation(table.grid, *place).cells for interpolation in interpolations for place in places]
                wanted.append((table, np.unique(np.concatenate(stencils)) if stencils else np.zeros(0, np.intp)))
            fill(self.board, self.model, wanted)
