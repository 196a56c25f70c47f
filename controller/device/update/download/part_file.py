"""A file on its way: what came of it outlives the process and a power cut, and is gone on with."""

from __future__ import annotations

import os
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from tuf.api.exceptions import LengthOrHashMismatchError
from tuf.api.metadata import TargetFile

from controller.device.update.download.source import NoRanges
from controller.device.update.trust.trust import DeviceUpdater


def complete(part: Path, repository: DeviceUpdater, target: TargetFile, tell: Callable[[int], None]) -> None:
    """Fetch a file of a repository, or what is missing of it; fetch it again if it is then not the signed one.

    `part` is the file, checked and synced when this returns; `tell` is called with the bytes that came, or with a negative count if
    some are of no use. Raises DownloadError if not all of it came; what came is there. Raises LengthOrHashMismatchError if it is
    not the signed one; nothing is there. Raises OSError if it cannot be written; nothing is there, so that a full disk does not
    stay full.
    """
    while True:
        start = part.stat().st_size if part.exists() else 0
        if start > target.length:
            part.unlink()
            start = 0
        tell(start)
        came = start
        try:
            with part.open("ab") as file:
                for chunk in repository.chunks(target, start, target.length - start):
                    file.write(chunk)
                    came += len(chunk)
                    tell(len(chunk))
                file.flush()
                os.fsync(file.fileno())
            with part.open("rb") as file:
                target.verify_length_and_hashes(file)
            return
        except (NoRanges, LengthOrHashMismatchError):
            part.unlink()
            if not start:
                raise
            tell(-came)
        except OSError:
            with suppress(OSError):
                part.unlink()
            raise
