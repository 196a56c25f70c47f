"""Files that are whole after a power cut: the old one or the new one, never a part."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from controller.errors import UpdateError


def write_durably(path: Path, data: bytes, mode: int = 0o644) -> None:
    """Write a small file: beside it, synced, renamed, and its folder synced.

    Raises OSError if it cannot be written; the old file is there, whole.
    """
    new = path.with_name(f".{path.name}.new")
    try:
        with new.open("wb") as file:
            file.write(data)
            file.flush()
            os.fchmod(file.fileno(), mode)
            os.fsync(file.fileno())
        new.replace(path)
    except OSError:
        with suppress(OSError):
            new.unlink()
        raise
    sync_folder(path.parent)


def sync_folder(folder: Path) -> None:
    """Make the names in a folder last."""
    fd = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
    try:
        os.fsync(fd)
    finally:
        os.close(fd)


@contextmanager
def tell_disk(folder: Path) -> Iterator[None]:
    """Errors of a disk as one line that says where."""
    try:
        yield
    except OSError as error:
        raise UpdateError(
            f"{error.filename or folder}: cannot be written ({error.strerror}): make room or mend it, then repeat"
        ) from error
