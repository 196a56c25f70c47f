"""Responses of a bank, from which waveforms for several points, or for places between cells, are composed."""

from __future__ import annotations

import contextlib
import mmap
import os
import zlib

import numpy as np
from numpy.typing import NDArray

from controller.device.bank.bank_file import BankFile
from controller.device.bank.packing import CHANNELS
from controller.device.kernel.compact_twin import CompactTables, PulseLayer, along

AHEAD = 2  # cells around one that is used for the first time whose responses are read ahead


class ResponseEntries:
    """Responses of one bank, mapped when the first is needed; each is checked when it is first used."""

    def __init__(self, file: BankFile) -> None:
        self._file = file
        self._grid, self._samples = file.header.grid, file.header.samples
        self._entries, self._crcs, self._scales = file.tables.entries, file.tables.crcs, file.tables.scales
        self._mapped = self._common = memoryview(b"")
        self._layer = PulseLayer(1, 1, 1, 1, 1)  # of a compact bank, with `common`
        self._good = memoryview(mmap.mmap(-1, max(file.header.entries, 1)))  # shared with forked processes (`verify`)
        self._stride = file.sections["response"].stride
        self._row_bytes = file.sections["response"].row_bytes

    def response(self, cell: int) -> tuple[NDArray[np.int8], float]:
        """Response of a cell: levels (samples, 32) in drive order, a read-only view of the file; and m per V of one level.

        Raises BankError if the cell has no entry, or a damaged one, or the bank is compact.
        """
        if self._file.header.compact:
            raise self._file.unusable("is compact: it holds no samples of responses")
        entry = self._checked(cell)
        start = entry * self._stride
        levels: NDArray[np.int8] = np.frombuffer(self.section, np.int8, self._samples * CHANNELS, start)
        return levels.reshape(self._samples, CHANNELS), self._scales[entry]

    @property
    def section(self) -> memoryview:
        """The response section, in which entry n begins at n strides; mapped when it is first asked for."""
        if not self._mapped:
            self._mapped = self._file.map("response")
        return self._mapped

    @property
    def common(self) -> memoryview:
        """What all cells of a compact bank have in common, mapped and checked when it is first asked for; empty for others.

        Raises BankError if it is damaged.
        """
        if not self._file.header.compact or self._common:
            return self._common
        mapped = self._file.map("tables")
        if zlib.crc32(mapped) != self._file.sections["tables"].crc:
            raise self._file.damaged("section 'tables'")
        try:
            self._layer = CompactTables(mapped, self._samples, self._file.header.rest_rows).in_band
        except ValueError as error:
            raise self._file.unusable(f"cannot be used: {error}") from error
        self._common = mapped
        return mapped

    def tables(self) -> tuple[list[int], list[float], memoryview]:
        """What is needed to find responses in their section.

        The entry of each cell, -1 for none; m per V of one level of each entry's response; and for each entry one byte, whether its
        response was found good: the bank's own, which changes with `check`.
        """
        return self._entries, self._scales, self._good

    def has(self, x_m: float, y_m: float) -> bool:
        """Whether the cells around the point (x_m, y_m) have entries."""
        if self.common:
            grid, layer = self._grid, self._layer
            ix, _ = along(x_m - grid.x0_m, grid.pitch_m, grid.nx, layer)
            iy, _ = along(y_m - grid.y0_m, grid.pitch_m, grid.ny, layer)
            rows = range(iy * grid.nx + ix, (iy + layer.across) * grid.nx + ix, grid.nx)
            return all(entry >= 0 for row in rows for entry in self._entries[row : row + layer.across])
        cells, weights = self._grid.corners(x_m, y_m)
        return all(not weight or self._entries[cell] >= 0 for cell, weight in zip(cells, weights, strict=True))

    def check(self, cell: int) -> None:
        """Map the responses and check a cell's, if that was not done.

        Raises BankError if the cell has no entry, or a damaged one.
        """
        self._checked(cell)

    def verify(self, cell: int) -> None:
        """Read and check the response of a cell that has an entry, without mapping it.

        A process forked from one that has the bank open does this beside it: what it finds good, the other one uses unchecked.

        Raises BankError if it is damaged.
        """
        entry = self._entries[cell]
        offset = self._file.sections["response"].offset + entry * self._stride
        if zlib.crc32(self._file.read(offset, self._row_bytes)) != self._crcs[entry][1]:
            raise self._file.damaged(f"response of entry {entry} (cell {cell})")
        self._good[entry] = 1

    def _checked(self, cell: int) -> int:
        """Entry of a cell whose response is mapped and good."""
        entry = self._file.entry_of(cell)
        if not self._file.header.composes:
            raise self._file.unusable("holds no responses, so only its cells are played, one at a time")
        if not self._good[entry]:
            self._read_ahead(cell)
            start = entry * self._stride
            self._file.counters.response_checked += 1
            if zlib.crc32(self.section[start : start + self._row_bytes]) != self._crcs[entry][1]:
                raise self._file.damaged(f"response of entry {entry} (cell {cell})")
            self._good[entry] = 1
        return entry

    def _read_ahead(self, cell: int) -> None:
        """Have the kernel read the responses around a cell: a finger between cells needs four of them now, and the next ones soon.

        A finger that moves then finds them in memory, and none are read of places that nobody touches.
        """
        if not self._file.close.alive:
            return
        row, column = divmod(cell, self._grid.nx)
        section, stride = self._file.sections["response"], self._stride
        left, right = max(column - AHEAD, 0), min(column + 1 + AHEAD, self._grid.nx)
        for y in range(max(row - AHEAD, 0), min(row + 1 + AHEAD, self._grid.ny)):
            here = [entry for entry in self._entries[y * self._grid.nx + left : y * self._grid.nx + right] if entry >= 0]
            if here:
                size = (here[-1] + 1 - here[0]) * stride
                with contextlib.suppress(OSError):  # a file system that cannot: they are read when they are used
                    os.posix_fadvise(self._file.fd, section.offset + here[0] * stride, size, os.POSIX_FADV_WILLNEED)
