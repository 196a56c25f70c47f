"""What the build of a bank writes, and what the header says of it: edges of waveforms, whether anything moves, a hash."""

import hashlib
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from controller.arrays import Words
from controller.device.bank.file_format import Header
from controller.device.bank.packing import channel_bits, edges, framed
from controller.device.board.board import Board
from controller.errors import ConfigError
from controller.workshop.bank_builder.writer import BankWriter


class Entries:
    """Writes waveforms, and keeps what the header says of them."""

    def __init__(self, board: Board, header: Header, writer: BankWriter) -> None:
        self._board, self._results, self._writer = board, header.parameters, writer
        self.content = hashlib.sha256()  # hash of all that was written
        self.worst_edge_rate_hz = 0.0
        self._moves = False  # whether any channel moves any cell

    def add_cell(self, cell: int, words: Words, levels: NDArray[np.int8], scale_m_per_v: float) -> None:
        """Write the waveform and the response of a cell, in steps of `scale_m_per_v`."""
        self.count_edges(words, f"cell {cell}")
        self._writer.add(cell, words, levels, scale_m_per_v)
        self._moves = self._moves or scale_m_per_v > 0
        for part in (words, levels, np.float32(scale_m_per_v)):
            self.content.update(part.data)

    def add_row(self, cell: int, row: NDArray[np.uint8], scale_m_per_v: float) -> None:
        """Write the row of a cell of a compact bank."""
        self._writer.add_row(cell, row, scale_m_per_v)
        self._moves = self._moves or scale_m_per_v > 0
        for part in (row, np.float32(scale_m_per_v)):
            self.content.update(part.data)

    def set_tables(self, tables: bytes) -> None:
        """Give the writer the tables of a compact bank."""
        self._writer.tables = tables
        self.content.update(tables)

    def require_motion(self, cells: int) -> None:
        """Refuse a bank of nothing; raises ConfigError."""
        if not self._moves:
            raise ConfigError(
                f"board {self._board.name!r}: no channel moves any of the {cells} cells: a bank of nothing is not written"
            )

    def add_composition(self, key: Sequence[tuple[int, int, int]], words: Words) -> None:
        """Write the waveform of several spots."""
        self.count_edges(words, f"{len(key)} spots")
        self._writer.add_composition(key, words)
        self.content.update(words.data)

    def count_edges(self, words: Words, name: str) -> None:
        """Note the edges of the busiest channel, and of all; refused above the board's limit."""
        board, results = self._board, self._results
        idle = np.array([board.idle_word], np.uint32)
        counts = edges(framed(board.idle_word, words, board.idle_word))
        own_edges = counts - channel_bits(words[[0, -1]] ^ idle).sum(axis=0)  # without those from and to the idle word
        rate_hz = float(own_edges.max()) / board.waveform.duration_s
        if rate_hz > board.limits.max_edge_rate_hz:
            raise ConfigError(
                f"board {board.name!r}: limits.max_edge_rate_hz = {board.limits.max_edge_rate_hz:g} is less than the {rate_hz:g}"
                f" edges per second of channel {int(own_edges.argmax())} in the waveform of {name}: raise it if the driver"
                f" allows it"
            )
        results["channel_edges"] = max(results["channel_edges"], int(counts.max()))
        results["all_edges"] = max(results["all_edges"], int(counts.sum()))
        self.worst_edge_rate_hz = max(self.worst_edge_rate_hz, rate_hz)
