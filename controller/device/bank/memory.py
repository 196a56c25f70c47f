"""Whether the memory of the machine that plays suits a board's full bank; where it does not, the board gets a compact one."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Final

from controller.device.bank.file_format import Header
from controller.device.bank.grid import Grid
from controller.device.board.board import Board

SHARE: Final = 0.25  # of the memory that a bank may take: pages of it that do not stay are read again while fingers wait


@dataclass(frozen=True, slots=True)
class MemoryFit:
    """What a machine's memory allows of a board's banks."""

    memory_bytes: int
    full_bytes: int  # of the bank of the whole plate, its cells `bank.pitch_mm` apart
    by_pitch: bool  # whether the board says `compose.method = "bank"`

    @property
    def most_bytes(self) -> float:
        """What a bank may have, unless it is compact."""
        return SHARE * self.memory_bytes

    @property
    def compact(self) -> bool:
        """Whether the board's bank is compact for want of memory."""
        return self.by_pitch and self.full_bytes > self.most_bytes

    def in_words(self) -> str:
        """A line for people."""
        said = f"memory: {self.memory_bytes / 1e6:,.0f} MB, of which a bank may have {100 * SHARE:.0f} %; the full bank takes"
        if self.full_bytes <= self.most_bytes:
            return f"{said} {self.full_bytes / 1e6:,.1f} MB"
        compact = "the board's is a compact one" if self.by_pitch else "not chosen"
        return f"{said} {self.full_bytes / 1e6:,.1f} MB, too much: {compact}"


def memory_fit(board: Board, memory_bytes: int | None = None) -> MemoryFit:
    """For a machine of `memory_bytes`; by default `compose.memory_mb`, else this machine's."""
    if memory_bytes is None:
        given_mb = board.compose.memory_mb
        memory_bytes = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") if given_mb is None else round(1e6 * given_mb)
    grid = Grid.of(board.plate, board.bank.pitch_mm * 1e-3)
    full = Header("", b"", grid, board.waveform.bit_clock_hz, board.waveform.samples, grid.cells, {"composes": True})
    return MemoryFit(memory_bytes, full.file_bytes * len(board.fpga_boards), board.compose.method == "bank")
