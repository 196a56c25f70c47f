"""Reads a bank: each section is mapped when it is first needed, each entry is checked when it is first used."""

from __future__ import annotations

import contextlib
import math
import mmap
import os
import weakref
import zlib
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path
from types import TracebackType

import numpy as np
from numpy.typing import NDArray

from controller.bank.file_format import COMPOSITION, FOCI, Header, Section, begins_as_bank, header_length, parse
from controller.bank.packing import CHANNELS
from controller.bank.provenance import MEASURE_AGAIN
from controller.board.board import Board
from controller.board.paths import build_line
from controller.errors import BankError
from controller.kernel import unpack_loads
from controller.regular_file import open_regular

AHEAD = 2  # cells around one that is used for the first time whose responses are read ahead
LatticePoints = tuple[tuple[int, int, int], ...]  # x, y and amplitude of each point in steps (waveforms/selection.py)
Composed = dict[LatticePoints, tuple[int, int]]  # row and CRC-32 of the words of each composition
Tables = tuple[list[int], list[list[int]], list[float], Composed]  # entry of each cell; CRC-32s and scale of each entry


@dataclass(slots=True)
class Counters:
    """Counts of what was read from a bank and checked on the way."""

    lookups: int = 0  # drive words handed out or refused
    drive_checked: int = 0  # entries whose drive words' CRC-32 was computed
    response_checked: int = 0
    bad: int = 0  # entries refused for a wrong CRC-32, each time
    mapped_bytes: dict[str, int] = field(default_factory=dict)  # by section


class Bank:
    """An open bank; the file may be replaced by a new one while it is open.

    Use `Bank.open`. Memoryviews and arrays handed out stay valid as long as they are held.

    Attributes
    ----------
    compositions : dict
        By its points the row and the CRC-32 of each waveform that was composed beforehand. One that is found damaged is taken out.
    """

    def __init__(self, path: Path, fd: int, header: Header, sections: dict[str, Section], tables: Tables, rebuild: str) -> None:
        self.path = path
        self.header = header
        self.sections = sections
        self.grid = header.grid
        self.samples = header.samples
        self.composes = header.composes
        opened = os.fstat(fd)
        self.file_bytes = opened.st_size
        self._written_ns = opened.st_mtime_ns
        self.counters = Counters()
        self.rebuild = rebuild
        self._fd = fd
        self.close = weakref.finalize(self, os.close, fd)
        self._entry_of, self._crc_of, self._scale_of, self.compositions = tables
        self._composed: memoryview | None = None
        self._composed_good: set[LatticePoints] = set()
        self._drive: memoryview | None = None
        self._response = memoryview(b"")
        self._drive_good = bytearray(header.entries)
        self._response_good = memoryview(mmap.mmap(-1, max(header.entries, 1)))  # shared with forked processes (`verify_response`)
        self._drive_stride = sections["drive"].stride
        self._drive_bytes = sections["drive"].row_bytes
        self._checked_words = bytearray(4 * header.samples)  # room for a check
        self._response_stride = sections["response"].stride
        self._response_bytes = sections["response"].row_bytes

    @classmethod
    def open(cls, path: Path, board: Board | None = None) -> Bank:
        """Open a bank and check its header and tables.

        Parameters
        ----------
        path : Path
            The file.
        board : Board, optional
            Refuse a bank that was not built for this board.

        Raises
        ------
        BankError
            With the reason and how to rebuild.
        """
        rebuild = build_line(path, board)
        try:
            fd = open_regular(path, links=True)
        except OSError as error:
            hint = f"; build it: {rebuild}" if isinstance(error, FileNotFoundError) else ""
            raise BankError(f"{path}: cannot be read ({error.strerror}){hint}") from error
        start: bytes | None = None  # None: unreadable, so no advice to rebuild it
        try:
            size = os.fstat(fd).st_size
            start = os.pread(fd, 16, 0)
            header, sections = parse(os.pread(fd, header_length(start, size), 0), size)
            name = header.parameters.get("board")
            if not board and isinstance(name, str) and name.isprintable():
                rebuild = build_line(path, name)
            if header.provenance and header.provenance.from_measurements:
                rebuild = MEASURE_AGAIN
            if board and header.board_digest != board.digest():
                raise BankError(
                    f"was built for another board: digest {header.board_digest.hex()[:16]}, "
                    f"board {board.name!r} has {board.digest().hex()[:16]}"
                )
            tables = _tables(fd, header, sections)
        except (OSError, BankError) as error:
            os.close(fd)
            reason = error if isinstance(error, BankError) else f"cannot be read ({error.strerror})"
            advised = start is not None and begins_as_bank(start)
            raise BankError(f"{path}: {reason}" + (f"; rebuild it: {rebuild}" if advised else "")) from error
        return cls(path, fd, header, sections, tables, rebuild)

    def __enter__(self) -> Bank:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self.close()

    @property
    def cells(self) -> NDArray[np.bool_]:
        """Which cells have an entry, (grid.cells,)."""
        return np.array(self._entry_of) >= 0

    @property
    def wave_scale(self) -> float:
        """As `Header.wave_scale`."""
        return self.header.wave_scale

    def snap_m(self, board: Board) -> float:
        """How far from a cell a lone finger plays it: as was chosen with this bank, or as the board says.

        A bank without responses has nothing else to play: its cells are played as far as was chosen with it in any case.
        """
        choice = self.header.choice if board.compose.method == "auto" or not self.composes else None
        if choice is None and not self.composes:
            return math.inf
        return float(choice["snap_mm"] if choice else board.bank.snap_mm) * 1e-3

    @property
    def worst_edges(self) -> tuple[int, int]:
        """Most edges in an entry, with those from and to the idle word: of one channel, and of all channels together.

        For a bank whose parameters do not say, the most that an emission can have.
        """
        told = self.header.parameters.get("channel_edges"), self.header.parameters.get("all_edges")
        most = self.samples + 1
        channel, together = (edges if type(edges) is int and edges >= 0 else None for edges in told)
        return most if channel is None else channel, CHANNELS * most if together is None else together

    @property
    def checksums(self) -> list[list[int]]:
        """CRC-32 of the drive words and of the response of each entry."""
        return self._crc_of

    def read(self, offset: int, size: int) -> bytes:
        """Copy `size` bytes of the file from `offset` on; fewer at its end."""
        return os.pread(self._fd, size, offset)

    def frames(self, cell: int) -> tuple[memoryview, int]:
        """Drive words of a cell as LOAD frames numbered from 0 on, a read-only view of the file, and the words' CRC-32.

        The CRC-32 is that of the bank's table, whatever the file holds by now: with it the FPGA finds what changed.

        Raises
        ------
        BankError
            If the cell has no entry, or a damaged one.
        """
        self.counters.lookups += 1
        entry = self._entry_of[cell] if 0 <= cell < len(self._entry_of) else -1
        if entry < 0:
            raise self._missing(cell)
        if self._drive is None:
            self._drive = self._map("drive")
        start = entry * self._drive_stride
        view = self._drive[start : start + self._drive_bytes]
        if not self._drive_good[entry]:
            self.counters.drive_checked += 1
            self._unpack(self._checked_words, view, entry, cell)
            self._drive_good[entry] = 1
        return view, self._crc_of[entry][0]

    def composed(self, points: LatticePoints) -> tuple[memoryview, int]:
        """A waveform of `compositions`, as `frames` gives those of cells.

        Raises
        ------
        BankError
            If it is damaged; it is not in `compositions` any more.
        """
        self.counters.lookups += 1
        row, crc = self.compositions[points]
        if self._composed is None:
            self._composed = self._map("composed")
        section = self.sections["composed"]
        view = self._composed[row * section.stride : row * section.stride + section.row_bytes]
        if points not in self._composed_good:
            self.counters.drive_checked += 1
            if not self._holds(view, crc):
                del self.compositions[points]
                self.counters.bad += 1
                raise BankError(f"{self.path}: composition {row} is damaged; rebuild it: {self.rebuild}")
            self._composed_good.add(points)
        return view, crc

    def recheck_composed(self, points: LatticePoints) -> None:
        """Check a composition again, if there is one of these points, after the FPGA has refused it or one of its frames.

        Raises
        ------
        BankError
            As `composed`.
        """
        if points in self.compositions:
            self._composed_good.discard(points)
            self.composed(points)

    def check_frames(self, cells: Iterable[int]) -> None:
        """Check the frames of cells that have an entry, so that their first use need not.

        They are read, not mapped: then they are in the page cache, but no memory of this process, which may be locked.

        Raises
        ------
        BankError
            If one is damaged, or cannot be read.
        """
        self._require_open()
        row = memoryview(bytearray(self._drive_bytes))
        offset = self.sections["drive"].offset
        for cell in cells:
            entry = self._entry_of[cell]
            self.counters.drive_checked += 1
            try:
                whole = os.preadv(self._fd, [row], offset + entry * self._drive_stride) == len(row)
            except OSError as error:
                raise BankError(f"{self.path}: cannot be read ({error.strerror}); rebuild it: {self.rebuild}") from error
            if not whole:
                raise self._bad("drive", entry, cell)
            self._unpack(self._checked_words, row, entry, cell)
            self._drive_good[entry] = 1

    def words(self, cell: int) -> memoryview:
        """Drive words of a cell, 4 bytes a sample: a copy, taken out of its frames.

        Raises
        ------
        BankError
            If the cell has no entry, or a damaged one.
        """
        view, _ = self.frames(cell)
        words = bytearray(4 * self.samples)
        self._unpack(words, view, self._entry_of[cell], cell)
        return memoryview(words).toreadonly()

    def recheck(self, cell: int) -> None:
        """Check the drive words of a cell that has an entry again, after the FPGA has refused them or one of their frames.

        Raises
        ------
        BankError
            If they are not as they were built, as in a file that was written over in place.
        """
        self._drive_good[self._entry_of[cell]] = 0
        self.frames(cell)

    def _unpack(self, words: bytearray, frames: memoryview, entry: int, cell: int) -> None:
        """Take the words out of an entry's frames, each byte of which is checked."""
        if not self._holds(frames, self._crc_of[entry][0], words):
            raise self._bad("drive", entry, cell)

    def _holds(self, frames: memoryview, crc: int, words: bytearray | None = None) -> bool:
        """Whether frames are whole, and carry words with this CRC-32; the words are taken out."""
        try:
            return unpack_loads(self._checked_words if words is None else words, frames) == crc
        except ValueError:
            return False

    def require_unchanged(self) -> None:
        """Refuse a file that was written to since it was opened, since responses are checked only when they are first used.

        Raises
        ------
        BankError
            If its size or its time of modification has changed.
        """
        now = os.fstat(self._fd)
        if now.st_mtime_ns != self._written_ns or now.st_size != self.file_bytes:
            self.counters.bad += 1
            raise BankError(f"{self.path}: was changed in place while in use; load the scene again, or restart")

    def response(self, cell: int) -> tuple[NDArray[np.int8], float]:
        """Response of a cell.

        Returns
        -------
        levels : (samples, 32) int8 array
            In drive order; a read-only view of the file.
        scale_m_per_v : float
            m per V of one level.

        Raises
        ------
        BankError
            If the cell has no entry, or a damaged one.
        """
        entry = self._checked_response(cell)
        start = entry * self._response_stride
        levels: NDArray[np.int8] = np.frombuffer(self.responses, np.int8, self.samples * CHANNELS, start)
        return levels.reshape(self.samples, CHANNELS), self._scale_of[entry]

    @property
    def responses(self) -> memoryview:
        """The response section, in which entry n begins at n strides; mapped when it is first asked for."""
        if not self._response:
            self._response = self._map("response")
        return self._response

    def response_tables(self) -> tuple[list[int], list[float], memoryview]:
        """What is needed to find responses in their section.

        Returns
        -------
        entries : list of int
            Entry of each cell, -1 for none.
        scales : list of float
            m per V of one level of each entry's response.
        good : memoryview
            For each entry, one byte: whether its response was found good. The bank's own, which changes with `check_response`.
        """
        return self._entry_of, self._scale_of, self._response_good

    def has_responses(self, x_m: float, y_m: float) -> bool:
        """Whether the cells around the point (x_m, y_m) have entries."""
        cells, weights = self.grid.corners(x_m, y_m)
        return all(not weight or self._entry_of[cell] >= 0 for cell, weight in zip(cells, weights, strict=True))

    def check_response(self, cell: int) -> None:
        """Map the responses and check a cell's, if that was not done.

        Raises
        ------
        BankError
            If the cell has no entry, or a damaged one.
        """
        self._checked_response(cell)

    def verify_response(self, cell: int) -> None:
        """Read and check the response of a cell that has an entry, without mapping it.

        A process forked from one that has the bank open does this beside it: what it finds good, the other one uses unchecked.

        Raises
        ------
        BankError
            If it is damaged.
        """
        entry = self._entry_of[cell]
        offset = self.sections["response"].offset + entry * self._response_stride
        if zlib.crc32(self.read(offset, self._response_bytes)) != self._crc_of[entry][1]:
            raise self._bad("response", entry, cell)
        self._response_good[entry] = 1

    def _checked_response(self, cell: int) -> int:
        """Entry of a cell whose response is mapped and good."""
        entry = self._entry_of[cell] if 0 <= cell < len(self._entry_of) else -1
        if entry < 0:
            raise self._missing(cell)
        if not self.composes:
            raise BankError(
                f"{self.path}: holds no responses, so only its cells are played, one at a time; rebuild it: {self.rebuild}"
            )
        if not self._response_good[entry]:
            self._read_ahead(cell)
            start = entry * self._response_stride
            self.counters.response_checked += 1
            if zlib.crc32(self.responses[start : start + self._response_bytes]) != self._crc_of[entry][1]:
                raise self._bad("response", entry, cell)
            self._response_good[entry] = 1
        return entry

    def _read_ahead(self, cell: int) -> None:
        """Have the kernel read the responses around a cell: a finger between cells needs four of them now, and the next ones soon.

        A finger that moves then finds them in memory, and none are read of places that nobody touches.
        """
        if not self.close.alive:
            return
        row, column = divmod(cell, self.grid.nx)
        section, stride = self.sections["response"], self._response_stride
        left, right = max(column - AHEAD, 0), min(column + 1 + AHEAD, self.grid.nx)
        for y in range(max(row - AHEAD, 0), min(row + 1 + AHEAD, self.grid.ny)):
            here = [entry for entry in self._entry_of[y * self.grid.nx + left : y * self.grid.nx + right] if entry >= 0]
            if here:
                size = (here[-1] + 1 - here[0]) * stride
                with contextlib.suppress(OSError):  # a file system that cannot: they are read when they are used
                    os.posix_fadvise(self._fd, section.offset + here[0] * stride, size, os.POSIX_FADV_WILLNEED)

    def _missing(self, cell: int) -> BankError:
        return BankError(f"{self.path}: no entry for cell {cell} of {self.grid.nx} x {self.grid.ny}; rebuild it: {self.rebuild}")

    def _bad(self, section: str, entry: int, cell: int) -> BankError:
        self.counters.bad += 1
        return BankError(f"{self.path}: {section} of entry {entry} (cell {cell}) is damaged; rebuild it: {self.rebuild}")

    def _require_open(self) -> None:
        if not self.close.alive:
            raise ValueError("the bank is closed")

    def _map(self, name: str) -> memoryview:
        self._require_open()
        section = self.sections[name]
        self.counters.mapped_bytes[name] = section.size
        return map_bytes(self._fd, section.offset, section.size)


def _tables(fd: int, header: Header, sections: dict[str, Section]) -> Tables:
    """Read the small sections whole; as lists, whose elements are read five times faster than an array's."""
    data = {}
    for name in ("index", "checksums", "scale", "points"):
        data[name] = os.pread(fd, sections[name].size, sections[name].offset)
        if zlib.crc32(data[name]) != sections[name].crc:
            raise BankError(f"is damaged: CRC-32 of section {name!r} is wrong")
    index = np.frombuffer(data["index"], "<i4")
    if not np.array_equal(index[index != -1], np.arange(header.entries)):
        raise BankError("has an index that does not name every entry once, in the order of the cells")
    checksums = np.frombuffer(data["checksums"], "<u4").reshape(-1, 2)
    return index.tolist(), checksums.tolist(), np.frombuffer(data["scale"], "<f4").tolist(), _compositions(data["points"])


def _compositions(data: bytes) -> Composed:
    """Rows and CRC-32s of the compositions, by their points."""
    found: Composed = {}
    for row, (crc, count, *steps) in enumerate(COMPOSITION.iter_unpack(data)):
        if not 1 <= count <= FOCI or any(steps[3 * count :]):
            raise BankError(f"has a composition of {count} points")
        found[tuple((steps[at], steps[at + 1], steps[at + 2]) for at in range(0, 3 * count, 3))] = row, crc
    if COMPOSITION.size * len(found) != len(data):
        raise BankError("has two compositions of the same points")
    return found


def map_bytes(fd: int, offset: int, size: int, granularity: int = mmap.ALLOCATIONGRANULARITY) -> memoryview:
    """Map a part of a file, read only.

    Parameters
    ----------
    fd : int
    offset, size : int
        In bytes; any.
    granularity : int
        Of mappings on this machine: it may be larger than the 4 kB to which sections are aligned (16 kB on a Pi 5).
    """
    if size == 0:
        return memoryview(b"")
    start = offset // granularity * granularity
    mapped = mmap.mmap(fd, offset - start + size, access=mmap.ACCESS_READ, offset=start)
    return memoryview(mapped)[offset - start :]
