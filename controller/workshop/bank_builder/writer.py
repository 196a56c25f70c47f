"""Writes a bank so that at any moment either the old or the new bank is there, complete.

Entries are written to a temporary file beside the bank as they come; when all are there, the file is fsynced and
renamed over the old bank, and the folder is fsynced. Any interruption, loss of power included, leaves the old bank;
the next writer removes the temporary file of one that died.
"""

import contextlib
import dataclasses
import errno
import fcntl
import glob
import os
import secrets
import zlib
from collections.abc import Iterator, Sequence
from pathlib import Path
from types import TracebackType
from typing import Self

import numpy as np
from numpy.typing import NDArray

from controller.arrays import Bools
from controller.device.bank.file_format import COMPOSITION, FOCI, MAGIC, Header, Section
from controller.device.bank.header_reading import begins_as_bank
from controller.device.bank.packing import CHANNELS, WORD
from controller.device.kernel import pack_loads
from controller.durable import sync_folder
from controller.errors import BankError


class BankWriter:
    """A bank being written; use as a context manager.

    Leaving the block commits the bank if every cell has its entry; an exception discards it.

    Its folder must exist. `header.entries` is the number of `cells` (grid.cells,), which lie in their order, `header.compositions`
    that of calls of `add_composition`. With `overwrite` a file at `path` is replaced even if it is no bank: for paths that this
    software chooses itself. Raises BankError if the folder or the disk does not take the file, or a file is there that is no bank;
    it is untouched.
    """

    def __init__(self, path: Path, header: Header, cells: Bools, *, overwrite: bool = False) -> None:
        if cells.shape != (header.grid.cells,) or np.count_nonzero(cells) != header.entries:
            raise ValueError(f"{np.count_nonzero(cells)} of {cells.shape} cells do not fit the header")
        header.pack(header.sections())  # parameters that do not fit the format are refused before the work
        self.path = path
        self._overwrite = overwrite
        self._header = header
        self._sections = {s.name: s for s in header.sections()}
        self._index = np.where(cells, np.cumsum(cells) - 1, -1).astype("<i4")
        self._checksums = np.zeros((header.entries, 2), "<u4")
        self._scale = np.zeros(header.entries, "<f4")
        self._written = np.zeros(header.entries, bool)
        self._points: list[bytes] = []  # of the compositions
        self.tables = b""  # of a compact bank: given before it is complete
        self._fd = -1

    def __enter__(self) -> Self:
        with self._disk_errors():
            folder = self.path.parent.stat()
            by_root_for_others = os.geteuid() == 0 != folder.st_uid
            if not by_root_for_others:  # else the owner of the folder could point root at any file
                self.path = self.path.resolve()  # a link stays, its target is replaced
            if self.path.is_dir():
                raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
            if self.path.exists() and not self.path.is_file():
                raise OSError(errno.EINVAL, "not a regular file")
            if not self._overwrite:
                _refuse_foreign(self.path)
            remove_leftovers(self.path)
            self._temporary, self._fd = _create_locked(self.path)
            try:
                if by_root_for_others:  # root builds, the service plays
                    os.fchown(self._fd, folder.st_uid, folder.st_gid)
                _reserve(self._fd, self._header.file_bytes)
            except BaseException:
                self._discard()
                raise
        return self

    def add(self, cell: int, words: NDArray[np.uint32], response: NDArray[np.int8], scale_m_per_v: float) -> None:
        """Write the entry of one of `cells` that has none yet: its drive words (samples,), and its response.

        `response` (samples + rest_rows, 32) is in drive order, then its rest outside the band, in steps of `scale_m_per_v`. It is
        not written where the header says that there are none.
        """
        samples = self._header.samples
        rows = samples + self._header.rest_rows
        if words.shape != (samples,) or words.dtype != WORD or response.shape != (rows, CHANNELS) or response.dtype != np.int8:
            raise ValueError(
                f"entry of {words.shape} {words.dtype} and {response.shape} {response.dtype}, not {samples} samples and {rows} rows"
            )
        entry = int(self._index[cell])
        if entry < 0 or self._written[entry]:
            raise ValueError(f"cell {cell} {'was not asked for' if entry < 0 else 'has its entry already'}")
        levels = np.ascontiguousarray(response).data.cast("B")
        frames = bytearray(self._sections["drive"].row_bytes)
        crc = pack_loads(frames, 0, np.ascontiguousarray(words).data.cast("B"))
        kept = (("drive", memoryview(frames)), ("response", levels))[: 1 + self._header.composes]
        self._checksums[entry] = crc, zlib.crc32(levels) if self._header.composes else 0
        with self._disk_errors():
            for name, row in kept:
                section = self._sections[name]
                _write(self._fd, row, section.offset + entry * section.stride)
        self._scale[entry] = scale_m_per_v
        self._written[entry] = True

    def add_row(self, cell: int, row: NDArray[np.uint8], scale_m_per_v: float) -> None:
        """Write the entry of a cell of a compact bank: its bytes, and the scale of its levels."""
        section, entry = self._sections["response"], int(self._index[cell])
        if len(row) != section.row_bytes or entry < 0 or self._written[entry]:
            raise ValueError(f"cell {cell}: {len(row)} bytes, not {section.row_bytes}, or an entry too many")
        payload = np.ascontiguousarray(row).data
        self._checksums[entry] = 0, zlib.crc32(payload)
        with self._disk_errors():
            _write(self._fd, payload, section.offset + entry * section.stride)
        self._scale[entry] = scale_m_per_v
        self._written[entry] = True

    def add_composition(self, points: Sequence[tuple[int, int, int]], words: NDArray[np.uint32]) -> None:
        """Write the drive words (samples,) of 1 to 10 points, in ascending order.

        Each is x and y in lattice steps, and steps of amplitude (`device/waveforms/selection.py`).
        """
        number = len(self._points)
        if number >= self._header.compositions or not 1 <= len(points) <= FOCI or words.shape != (self._header.samples,):
            raise ValueError(f"composition {number} of {self._header.compositions}: {len(points)} points, {words.shape} words")
        section = self._sections["composed"]
        frames = bytearray(section.row_bytes)
        crc = pack_loads(frames, 0, np.ascontiguousarray(words, WORD).data.cast("B"))
        flat = [step for point in points for step in point]
        self._points.append(COMPOSITION.pack(crc, len(points), *flat, *([0] * (3 * FOCI - len(flat)))))
        with self._disk_errors():
            _write(self._fd, memoryview(frames), section.offset + number * section.stride)

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        try:
            if kind is None:
                self._commit()
        finally:
            self._discard()

    def _commit(self) -> None:
        if not self._written.all():
            raise BankError(f"{self.path}: {np.count_nonzero(~self._written)} of {self._written.size} entries were never written")
        if len(self._points) != self._header.compositions:
            raise BankError(f"{self.path}: {self._header.compositions - len(self._points)} compositions were never written")
        if self._header.header_bytes != self._sections["index"].offset:
            raise ValueError("the build parameters have grown beyond the header's pages")
        with self._disk_errors():
            sections = tuple(self._finished(s) for s in self._sections.values())
            _write(self._fd, memoryview(self._header.pack(sections)), 0)
            os.fsync(self._fd)
            self._temporary.replace(self.path)
        _sync_folder(self.path)

    def _finished(self, section: Section) -> Section:
        """Write a table and note its CRC-32; entries have theirs in `checksums`."""
        tables = {"index": self._index.tobytes(), "checksums": self._checksums.tobytes(), "scale": self._scale.tobytes()}
        tables["points"] = b"".join(self._points)
        if len(self.tables) != (self._header.compact or {"tables_bytes": 0})["tables_bytes"]:
            raise ValueError(f"tables of {len(self.tables)} bytes do not fit the header")
        tables["tables"] = self.tables
        if section.name not in tables:
            return section
        payload = tables[section.name]
        _write(self._fd, memoryview(payload), section.offset)
        return dataclasses.replace(section, crc=zlib.crc32(payload))

    def _discard(self) -> None:
        """Remove the temporary file if it has not become the bank; its lock goes with it."""
        if self._fd < 0:
            return
        with contextlib.suppress(OSError):
            self._temporary.unlink()
        os.close(self._fd)
        self._fd = -1

    @contextlib.contextmanager
    def _disk_errors(self) -> Iterator[None]:
        try:
            yield
        except OSError as error:
            raise BankError(f"{self.path}: cannot be written ({error.strerror}); a bank that was there is untouched") from error


def _refuse_foreign(path: Path) -> None:
    """Refuse to replace a file that is no bank."""
    try:
        with path.open("rb") as file:
            start = file.read(len(MAGIC))
    except FileNotFoundError:
        return
    if not begins_as_bank(start):
        raise BankError(f"{path}: is no bank, so it is not replaced: give another --out, or remove it first")


def _create_locked(path: Path) -> tuple[Path, int]:
    """Create a temporary file beside `path` and lock it; the lock shows other writers that this one is alive."""
    while True:
        temporary = path.with_name(f".{path.name}.{secrets.token_hex(4)}.building")
        fd = os.open(temporary, os.O_RDWR | os.O_CREAT | os.O_EXCL | os.O_CLOEXEC, 0o600)
        fcntl.flock(fd, fcntl.LOCK_EX)  # as no other user can open it yet
        umask = os.umask(0o077)
        os.umask(umask)
        os.fchmod(fd, 0o666 & ~umask)
        if os.fstat(fd).st_nlink:  # else another writer removed it as a leftover before it was locked
            return temporary, fd
        os.close(fd)


def remove_leftovers(path: Path) -> int:
    """Remove temporary files of the bank at `path` whose writer has died; return their number."""
    removed = 0
    for leftover in path.parent.glob(f".{glob.escape(path.name)}.*.building"):
        with contextlib.suppress(OSError):  # another writer may remove it first, or own it
            fd = os.open(leftover, os.O_RDWR | os.O_CLOEXEC | os.O_NOFOLLOW | os.O_NONBLOCK)
            try:
                fcntl.flock(fd, fcntl.LOCK_EX | fcntl.LOCK_NB)
                leftover.unlink()
                removed += 1
            finally:
                os.close(fd)
    return removed


def _sync_folder(path: Path) -> None:
    """Fsync the folder, so that the new name is as durable as the file."""
    try:
        sync_folder(path.parent)
    except OSError as error:
        if error.errno != errno.EINVAL:  # a file system whose folders cannot be synced
            raise BankError(f"{path}: written, but its folder cannot be synced ({error.strerror})") from error


def _reserve(fd: int, size: int) -> None:
    """Reserve the file's full size, so that a disk that is too small is found before the work."""
    try:
        os.posix_fallocate(fd, 0, size)
    except OSError as error:
        if error.errno not in {errno.EOPNOTSUPP, errno.EINVAL}:
            raise
        os.ftruncate(fd, size)  # this file system cannot reserve: a full disk is found while writing


def _write(fd: int, data: memoryview, offset: int) -> None:
    while data:
        written = os.pwrite(fd, data, offset)
        data, offset = data[written:], offset + written
