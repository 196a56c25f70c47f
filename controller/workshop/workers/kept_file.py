"""The file that keeps what is done: records of number and result with a CRC-32, of which the last may be torn."""

import contextlib
import fcntl
import os
import struct
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO, Self

from controller.device.kernel.crc import intact, sealed
from controller.errors import UsageError, WorkersError
from controller.regular_file import open_private

RECORD = struct.Struct("<QI")  # number of the item, bytes of its result; then these; then the CRC-32 of all


def record_of(number: int, result: bytes) -> bytes:
    """Record of a result."""
    return sealed(RECORD.pack(number, len(result)) + result)


def result_in(record: object) -> tuple[int, bytes] | None:
    """Number and result of a record; None if it is none."""
    if not isinstance(record, bytes) or len(record) < RECORD.size + 4 or not intact(record):
        return None
    number, size = RECORD.unpack_from(record)
    return (number, record[RECORD.size : -4]) if len(record) == RECORD.size + size + 4 else None


class KeptFile:
    """The file of results that are there, one record each, of which the last may be torn."""

    def __init__(self, file: BinaryIO, path: Path) -> None:
        self._file, self._path = file, path
        self.results: dict[int, bytes] = {}
        whole = 0
        while len(head := file.read(RECORD.size)) == RECORD.size:
            _, size = RECORD.unpack(head)
            record = head + file.read(min(size, os.fstat(file.fileno()).st_size) + 4)  # a torn size may be any
            if (found := result_in(record)) is None:
                break
            number, self.results[number] = found
            whole += len(record)
        file.seek(whole)
        file.truncate()

    @classmethod
    @contextlib.contextmanager
    def open(cls, path: Path) -> Iterator[Self]:
        """The file at a path, made if it is not there; raises WorkersError if it cannot be written, UsageError if it is in use."""
        with writing(path):
            file = os.fdopen(open_private(path), "r+b")
        try:
            try:
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                raise UsageError(f"{path}: another command is at work on the same: wait for it, or give another file") from None
            with writing(path):
                kept = cls(file, path)
            yield kept
        finally:
            with writing(path):  # it flushes
                file.close()

    def add(self, record: bytes) -> None:
        """Append a result; raises WorkersError if it cannot be written."""
        with writing(self._path):
            self._file.write(record)

    def flush(self) -> None:
        """Hand what was added to the system; raises WorkersError if it cannot be written."""
        with writing(self._path):
            self._file.flush()


@contextlib.contextmanager
def writing(path: Path) -> Iterator[None]:
    """Raise WorkersError for what the system says of the file."""
    try:
        yield
    except OSError as error:
        raise WorkersError(f"{path}: cannot be written ({error.strerror})") from error
