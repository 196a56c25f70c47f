"""The open file of a bank: what is read or mapped of it, and whether it is still the same."""

from __future__ import annotations

import mmap
import os
import weakref
from dataclasses import dataclass, field
from pathlib import Path

from controller.device.bank.file_format import Header, Section
from controller.device.bank.tables import Tables
from controller.errors import BankError


@dataclass(slots=True)
class ReadCounters:
    """Counts of what was read from a bank and checked on the way."""

    lookups: int = 0  # drive words handed out or refused
    drive_checked: int = 0  # entries whose drive words' CRC-32 was computed
    response_checked: int = 0
    bad: int = 0  # entries refused for a wrong CRC-32, each time
    mapped_bytes: dict[str, int] = field(default_factory=dict)  # by section


class BankFile:
    """An open bank's file; it may be replaced by a new one meanwhile.

    `close` closes `fd`; `rebuild` says what to do about a damaged bank.
    """

    def __init__(self, path: Path, fd: int, header: Header, sections: dict[str, Section], tables: Tables, rebuild: str) -> None:
        self.path = path
        self.header = header
        self.sections = sections
        self.tables = tables
        self.rebuild = rebuild
        opened = os.fstat(fd)
        self.size = opened.st_size
        self._written_ns = opened.st_mtime_ns
        self.fd = fd
        self.close = weakref.finalize(self, os.close, fd)
        self.counters = ReadCounters()

    def read(self, offset: int, size: int) -> bytes:
        """Copy `size` bytes of the file from `offset` on; fewer at its end."""
        return os.pread(self.fd, size, offset)

    def map(self, name: str) -> memoryview:
        """Map a section; the view stays valid as long as it is held."""
        self.require_open()
        section = self.sections[name]
        self.counters.mapped_bytes[name] = section.size
        return map_bytes(self.fd, section.offset, section.size)

    def entry_of(self, cell: int) -> int:
        """Entry of a cell; raises BankError if it has none."""
        entries = self.tables.entries
        entry = entries[cell] if 0 <= cell < len(entries) else -1
        if entry < 0:
            raise self.unusable(f"no entry for cell {cell} of {self.header.grid.nx} x {self.header.grid.ny}")
        return entry

    def require_open(self) -> None:
        """Raise ValueError if it was closed."""
        if not self.close.alive:
            raise ValueError("the bank is closed")

    def require_unchanged(self) -> None:
        """Refuse a file that was written to since it was opened, since responses are checked only when they are first used.

        Raises BankError if its size or its time of modification has changed.
        """
        now = os.fstat(self.fd)
        if now.st_mtime_ns != self._written_ns or now.st_size != self.size:
            self.counters.bad += 1
            raise BankError(f"{self.path}: was changed in place while in use; load the scene again, or restart")

    def damaged(self, what: str) -> BankError:
        """Count what was found damaged; the error to raise."""
        self.counters.bad += 1
        return self.unusable(f"{what} is damaged")

    def unusable(self, why: str) -> BankError:
        """Error that says how to rebuild the bank."""
        return BankError(f"{self.path}: {why}; rebuild it: {self.rebuild}")


def map_bytes(fd: int, offset: int, size: int, granularity: int = mmap.ALLOCATIONGRANULARITY) -> memoryview:
    """Map a part of a file, read only.

    Any `offset` and `size` will do: mappings have a `granularity`, which may be larger than the 4 kB to which sections are aligned
    (16 kB on a Pi 5).
    """
    if size == 0:
        return memoryview(b"")
    start = offset // granularity * granularity
    mapped = mmap.mmap(fd, offset - start + size, access=mmap.ACCESS_READ, offset=start)
    return memoryview(mapped)[offset - start :]
