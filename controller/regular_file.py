"""Files that another user may have written, may replace while they are read, or may lock: no link is followed, nobody waits.

Whoever may write into a folder can put a pipe, a link to a device or a file without end where a small file is expected. What is
opened here is a regular file, by its descriptor and not by its name, and no more of it is read than it may have.
"""

from __future__ import annotations

import contextlib
import errno
import os
import stat
from pathlib import Path
from typing import Final

FLAGS: Final = os.O_RDONLY | os.O_NONBLOCK | os.O_NOCTTY | os.O_CLOEXEC
CHUNK_BYTES: Final = 1 << 16


def open_regular(path: Path, *, owner: int | None = None, links: bool = False) -> int:
    """Open a regular file to read it; the caller closes the descriptor.

    It has to belong to `owner`, if one is given. With `links` its name may be a symbolic link: of files that people name, or that
    only more trusted users write. Raises OSError if it cannot be opened, or is something else; nothing of it was read then.
    `strerror` says what.
    """
    try:
        fd = os.open(path, FLAGS if links else FLAGS | os.O_NOFOLLOW)
    except OSError as error:
        if error.errno == errno.ELOOP and not links:
            raise OSError(errno.ELOOP, "a symbolic link", str(path)) from error
        raise
    try:
        found = os.fstat(fd)
        if stat.S_ISDIR(found.st_mode):
            raise OSError(errno.EISDIR, os.strerror(errno.EISDIR), str(path))
        if not stat.S_ISREG(found.st_mode):
            raise OSError(errno.EINVAL, "not a regular file", str(path))
        if owner is not None and found.st_uid != owner:
            raise OSError(errno.EPERM, f"it belongs to user {found.st_uid}, not to user {owner}", str(path))
    except OSError:
        os.close(fd)
        raise
    return fd


def read_regular(path: Path, most_bytes: int, *, owner: int | None = None, links: bool = False) -> bytes:
    """The content of a regular file of at most `most_bytes`; `owner` and `links` as in `open_regular`.

    Raises OSError as `open_regular`; also if it is larger.
    """
    fd = open_regular(path, owner=owner, links=links)
    try:
        data = bytearray()
        while chunk := os.read(fd, min(CHUNK_BYTES, most_bytes + 1 - len(data))):
            data += chunk
        if len(data) > most_bytes:
            raise OSError(errno.EFBIG, f"more than {_size(most_bytes)}", str(path))
        return bytes(data)
    finally:
        os.close(fd)


def open_private(path: Path) -> int:
    """Open, and if need be create, a file of this user that no other user can open: one to be locked.

    Whoever can open a file, if only to read it, can lock it, and keep everybody else waiting.

    The path is in a folder that no other user may write to; the caller closes the descriptor. Raises OSError if it cannot be
    opened, or is no regular file.
    """
    fd = os.open(path, os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_NOCTTY | os.O_CLOEXEC, 0o600)
    try:
        found = os.fstat(fd)
        if not stat.S_ISREG(found.st_mode):
            raise OSError(errno.EINVAL, "not a regular file", str(path))
        if stat.S_IMODE(found.st_mode) & 0o077:  # made by an earlier release, or on a file system without modes
            with contextlib.suppress(OSError):
                os.fchmod(fd, 0o600)
    except OSError:
        os.close(fd)
        raise
    return fd


def _size(size_bytes: int) -> str:
    return f"{size_bytes >> 20} MiB" if size_bytes >= 1 << 20 else f"{size_bytes:,} bytes"
