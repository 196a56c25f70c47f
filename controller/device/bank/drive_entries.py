"""Waveforms of a bank, packed as finished frames: those of cells, and those composed beforehand."""

from __future__ import annotations

import os
from collections.abc import Iterable

from controller.device.bank.bank_file import BankFile
from controller.device.bank.tables import LatticePoints
from controller.device.kernel import unpack_loads


class DriveEntries:
    """Waveforms of one bank; each is checked when it is first used."""

    def __init__(self, file: BankFile) -> None:
        # By its points the row and the CRC-32 of each waveform that was composed beforehand. One that is found damaged is
        # taken out
        self.compositions = file.tables.compositions
        self._file = file
        self._entries, self._crcs = file.tables.entries, file.tables.crcs
        self._samples = file.header.samples
        self._mapped: memoryview | None = None
        self._good = bytearray(file.header.entries)
        self._stride = file.sections["drive"].stride
        self._row_bytes = file.sections["drive"].row_bytes
        self._composed: memoryview | None = None
        self._composed_good: set[LatticePoints] = set()
        self._checked_words = bytearray(4 * self._samples)  # room for a check

    def frames(self, cell: int) -> tuple[memoryview, int]:
        """Drive words of a cell as LOAD frames numbered from 0 on, a read-only view of the file, and the words' CRC-32.

        The CRC-32 is that of the bank's table, whatever the file holds by now: with it the FPGA finds what changed.

        Raises BankError if the cell has no entry, or a damaged one.
        """
        self._file.counters.lookups += 1
        entry = self._file.entry_of(cell)
        if self._file.header.compact:
            raise self._file.unusable("is compact: it holds no waveforms of cells, all are composed")
        if self._mapped is None:
            self._mapped = self._file.map("drive")
        start = entry * self._stride
        view = self._mapped[start : start + self._row_bytes]
        if not self._good[entry]:
            self._file.counters.drive_checked += 1
            self._unpack(self._checked_words, view, entry, cell)
            self._good[entry] = 1
        return view, self._crcs[entry][0]

    def composed(self, points: LatticePoints) -> tuple[memoryview, int]:
        """A waveform of `compositions`, as `frames` gives those of cells.

        Raises BankError if it is damaged; it is not in `compositions` any more.
        """
        self._file.counters.lookups += 1
        row, crc = self.compositions[points]
        if self._composed is None:
            self._composed = self._file.map("composed")
        section = self._file.sections["composed"]
        view = self._composed[row * section.stride : row * section.stride + section.row_bytes]
        if points not in self._composed_good:
            self._file.counters.drive_checked += 1
            if not self._holds(view, crc):
                del self.compositions[points]
                raise self._file.damaged(f"composition {row}")
            self._composed_good.add(points)
        return view, crc

    def recheck_composed(self, points: LatticePoints) -> None:
        """Check a composition again, if there is one of these points, after the FPGA has refused it or one of its frames.

        Raises BankError as `composed`.
        """
        if points in self.compositions:
            self._composed_good.discard(points)
            self.composed(points)

    def check_frames(self, cells: Iterable[int]) -> None:
        """Check the frames of cells that have an entry, so that their first use need not.

        They are read, not mapped: then they are in the page cache, but no memory of this process, which may be locked.

        Raises BankError if one is damaged, or cannot be read.
        """
        self._file.require_open()
        if self._file.header.compact:
            return
        row = memoryview(bytearray(self._row_bytes))
        offset = self._file.sections["drive"].offset
        for cell in cells:
            entry = self._entries[cell]
            self._file.counters.drive_checked += 1
            try:
                whole = os.preadv(self._file.fd, [row], offset + entry * self._stride) == len(row)
            except OSError as error:
                raise self._file.unusable(f"cannot be read ({error.strerror})") from error
            if not whole:
                raise self._file.damaged(f"drive of entry {entry} (cell {cell})")
            self._unpack(self._checked_words, row, entry, cell)
            self._good[entry] = 1

    def words(self, cell: int) -> memoryview:
        """Drive words of a cell, 4 bytes a sample: a copy, taken out of its frames.

        Raises BankError if the cell has no entry, or a damaged one.
        """
        view, _ = self.frames(cell)
        words = bytearray(4 * self._samples)
        self._unpack(words, view, self._entries[cell], cell)
        return memoryview(words).toreadonly()

    def recheck(self, cell: int) -> None:
        """Check the drive words of a cell that has an entry again, after the FPGA has refused them or one of their frames.

        Raises BankError if they are not as they were built, as in a file that was written over in place.
        """
        self._good[self._entries[cell]] = 0
        self.frames(cell)

    def _unpack(self, words: bytearray, frames: memoryview, entry: int, cell: int) -> None:
        """Take the words out of an entry's frames, each byte of which is checked."""
        if not self._holds(frames, self._crcs[entry][0], words):
            raise self._file.damaged(f"drive of entry {entry} (cell {cell})")

    def _holds(self, frames: memoryview, crc: int, words: bytearray | None = None) -> bool:
        """Whether frames are whole, and carry words with this CRC-32; the words are taken out."""
        try:
            return unpack_loads(self._checked_words if words is None else words, frames) == crc
        except ValueError:
            return False
