"""Where a repository is read from; a folder, such as a stick. What is read is not trusted here.

A source gives bytes of a file from any offset, and raises python-tuf's `DownloadError` with one line that says what happened.
"""

from __future__ import annotations

import errno
import os
import stat
from abc import abstractmethod
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO, Final
from urllib.parse import unquote

from tuf.api.exceptions import DownloadError, DownloadHTTPError
from tuf.ngclient.fetcher import FetcherInterface

from controller.errors import UpdateError

CHUNK_BYTES: Final = 1 << 16


class NoRanges(DownloadError):
    """The server sends whole files only."""


class Source(FetcherInterface):
    """Files of a repository."""

    def __init__(self, address: str) -> None:
        self.address = address.rstrip("/")  # of the repository: `metadata/` and `targets/` are below it. Without a slash at its end
        self.name = self.address.removeprefix("file://")  # what it is called in errors
        self.fetched_bytes = 0  # bytes read so far

    @abstractmethod
    def look(self) -> None:
        """Say clearly that nothing can be there, before anything is read; raises UpdateError."""

    @abstractmethod
    def open(self, url: str, start: int = 0, length: int | None = None) -> Iterator[bytes]:
        """Chunks of a file from byte `start` on; no more than `length` bytes if that is given.

        Raises NoRanges if only the whole file is to be had. Raises DownloadError in all other cases; also while chunks are taken.
        """

    def _fetch(self, url: str) -> Iterator[bytes]:
        """Python-tuf's way to read metadata, whose length it bounds."""
        return self.open(url)


def _is_folder(path: Path) -> bool:
    """As `Path.is_dir`, which of Python 3.14 does not raise OSError where it may not look."""
    try:
        return stat.S_ISDIR(path.stat().st_mode)
    except (FileNotFoundError, NotADirectoryError):
        return False


class FolderSource(Source):
    """A repository in a folder: regular files inside it, read without any network."""

    def __init__(self, folder: str) -> None:
        super().__init__(f"file://{Path(folder).absolute()}")
        self._folder = Path(folder).absolute()

    def look(self) -> None:
        """Check that the folder is there, and is a repository."""
        try:
            is_there, is_repository = _is_folder(self._folder), _is_folder(self._folder / "metadata")
        except OSError as error:
            raise UpdateError(
                f"{self._folder}: cannot be read ({error.strerror}): the user haptic-update must be able to"
            ) from None
        if not is_there:
            raise UpdateError(f"{self._folder}: there is no such folder: is the stick plugged in and mounted?")
        if not is_repository:
            raise UpdateError(f"{self._folder}: is no repository of releases, which has a folder `metadata`")

    def open(self, url: str, start: int = 0, length: int | None = None) -> Iterator[bytes]:
        """Open a file; links that lead out of the folder, devices and pipes count as absent."""
        name = unquote(url.removeprefix(self.address + "/"))
        left = length
        with self._opened(name) as file:
            while left is None or left:
                try:
                    file.seek(start)
                    chunk = file.read(CHUNK_BYTES if left is None else min(CHUNK_BYTES, left))
                except OSError as error:
                    raise self._trouble(name, error) from error
                if not chunk:
                    break
                start += len(chunk)
                left = None if left is None else left - len(chunk)
                self.fetched_bytes += len(chunk)
                yield chunk
            if left:
                raise DownloadError(f"{self._folder / name}: is cut off, {left:,} bytes are missing: copy the repository again")

    def _opened(self, name: str) -> BinaryIO:
        try:
            path = (self._folder / name).resolve()
            if not path.is_relative_to(self._folder.resolve()):
                raise DownloadHTTPError(f"{self._folder / name}: leads out of the folder", 404)
            fd = os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_NOFOLLOW | os.O_CLOEXEC)
        except (OSError, ValueError, RuntimeError) as error:
            raise self._trouble(name, error) from error
        if not stat.S_ISREG(os.fstat(fd).st_mode):
            os.close(fd)
            raise DownloadHTTPError(f"{self._folder / name}: is no regular file", 404)
        return os.fdopen(fd, "rb")

    def _trouble(self, name: str, error: Exception) -> DownloadError:
        if not os.path.isdir(self._folder / "metadata"):  # noqa: PTH112 - Path.is_dir() fails where it may not look
            return DownloadError(f"{self._folder}: is gone: was the stick pulled? Plug it in and repeat; what came is kept")
        if isinstance(error, OSError) and error.errno not in {errno.ENOENT, errno.ENOTDIR, errno.ELOOP, errno.EISDIR}:
            return DownloadError(f"{self._folder / name}: cannot be read ({error.strerror}): is the stick whole, and still there?")
        return DownloadHTTPError(f"{self._folder / name}: is not there", 404)
