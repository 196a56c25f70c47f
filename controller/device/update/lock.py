"""One update at a time."""

from __future__ import annotations

import fcntl
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from controller.errors import UpdateError
from controller.regular_file import open_private


@contextmanager
def alone(lock: Path, held: str = "another update is at work: try again when it is done") -> Iterator[None]:
    """Hold a lock for the time of the block; it ends with its process, however that ends. No other user can take it.

    `held` is what is said if another process holds it. Raises UpdateError if another process holds it; OSError if its file cannot
    be made.
    """
    fd = open_private(lock)
    try:
        try:
            fcntl.flock(fd, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError as error:
            raise UpdateError(f"{lock}: {held}") from error
        yield
    finally:
        os.close(fd)
