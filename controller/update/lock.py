"""One update at a time."""

from __future__ import annotations

import fcntl
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from controller.errors import UpdateError


@contextmanager
def alone(lock: Path) -> Iterator[None]:
    """Hold a lock for the time of the block; it ends with its process, however that ends.

    Raises
    ------
    UpdateError
        If another process holds it.
    """
    with lock.open("ab") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError as error:
            raise UpdateError(f"{lock}: another update is at work: try again when it is done") from error
        yield
