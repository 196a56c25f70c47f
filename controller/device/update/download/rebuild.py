"""A new bank from old ones: what they share is copied, the rest is fetched; whether it is right, its SHA-256 decides."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import BinaryIO, Final

from controller.device.update.download.bank_index import BankIndex, found_pieces, missing_ranges
from controller.regular_file import open_regular

WORTH: Final = 0.5  # share of a bank above which the whole of it is fetched instead


def rebuild(
    part: Path, index: BankIndex, olds: Sequence[tuple[Path, BankIndex]], read: Callable[[int, int], Iterator[bytes]]
) -> int | None:
    """Make a bank from old banks and what is read for it. One that was begun before is gone on with.

    `index` is that of the bank that is wanted; what `olds` really hold is looked up. `read` gives bytes of the bank that is wanted,
    from an offset on, this many. Returns how many bytes were not read; None if too much has changed, and nothing was read. `part`
    is synced then. Raises OSError.
    """
    with ExitStack() as stack:
        file = stack.enter_context(os.fdopen(os.open(part, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o600), "r+b"))
        file.truncate(index.size_bytes)
        found = zip(index, found_pieces(file, index), strict=True)
        places: dict[bytes, tuple[BinaryIO, int]] = {
            wanted.digest: (file, wanted.offset) for wanted, there in found if wanted.digest == there.digest
        }
        for path, cut_as in olds:
            old = stack.enter_context(os.fdopen(open_regular(path), "rb"))
            for piece in found_pieces(old, cut_as):
                places.setdefault(piece.digest, (old, piece.offset))
        ranges = missing_ranges(index, places)
        to_read = sum(stop - start for start, stop in ranges)
        if to_read > WORTH * index.size_bytes:
            return None
        for piece in index:
            origin, offset = places.get(piece.digest, (file, piece.offset))
            if origin is not file or offset != piece.offset:
                origin.seek(offset)
                data = origin.read(piece.length)
                file.seek(piece.offset)
                file.write(data)
        for start, stop in ranges:
            file.seek(start)
            for chunk in read(start, stop - start):
                file.write(chunk)
        file.flush()
        os.fsync(file.fileno())
    return index.size_bytes - to_read
