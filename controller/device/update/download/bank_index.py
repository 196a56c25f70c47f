"""Index of a bank: length and hash of each of its pieces, by which a device fetches only what has changed of it.

An index need not be trusted, nor what is rebuilt by it: the SHA-256 of the whole file decides.

| offset | type | field |
|---|---|---|
| 0 | 8 bytes | `HPNLIDX1` |
| 8 | u64 | bytes of the file |
| 16 | u32 | runs, R |
| 20 | R × 8 bytes | of each run: u32 pieces, u32 bytes of each of them |
| 20 + 8 R | 8 bytes each | BLAKE2b of each piece, 64 bits |

Little-endian; pieces follow each other without a gap.
"""

from __future__ import annotations

import hashlib
import struct
from collections.abc import Container, Iterable, Iterator
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path
from typing import BinaryIO, Final

from controller.errors import UpdateError

MAGIC: Final = b"HPNLIDX1"
HEADER: Final = struct.Struct("<8sQI")
RUN: Final = struct.Struct("<II")
DIGEST_BYTES: Final = 8
PIECE_BYTES_MAX: Final = 1 << 16
PIECES_MAX: Final = 1 << 20
INDEX_BYTES_MAX: Final = HEADER.size + PIECES_MAX * (RUN.size + DIGEST_BYTES)
GAP_BYTES: Final = 32_000  # ranges nearer than this are fetched as one: a request costs about as much


@dataclass(frozen=True, slots=True)
class Piece:
    """Some bytes of a file, by their hash."""

    offset: int
    length: int
    digest: bytes


@dataclass(frozen=True, slots=True)
class BankIndex:
    """Pieces of a file."""

    runs: tuple[tuple[int, int], ...]  # how many pieces of which length in bytes follow each other
    digests: bytes  # `DIGEST_BYTES` of each piece

    @property
    def size_bytes(self) -> int:
        """Bytes of the file."""
        return sum(pieces * length for pieces, length in self.runs)

    def __iter__(self) -> Iterator[Piece]:
        offset = at = 0
        for pieces, length in self.runs:
            for _ in range(pieces):
                yield Piece(offset, length, self.digests[at : at + DIGEST_BYTES])
                offset += length
                at += DIGEST_BYTES

    def to_bytes(self) -> bytes:
        """The index as a file."""
        return HEADER.pack(MAGIC, self.size_bytes, len(self.runs)) + b"".join(RUN.pack(*run) for run in self.runs) + self.digests


def write_index(file: Path, pieces: Iterable[tuple[int, int]]) -> bytes:
    """Index of a file; what lies between the pieces, and what is longer than `PIECE_BYTES_MAX`, is cut into pieces too.

    `pieces` are offset and length in bytes of what changes as one, such as the entry of a cell; by offset, none over another.
    Raises UpdateError if the pieces do not lie one after the other within the file, or are too many.
    """
    size = file.stat().st_size
    cuts: list[int] = []
    end = 0
    for offset, length in [*pieces, (size, 0)]:
        if not (end <= offset and length >= 0 and offset + length <= size):
            raise UpdateError(f"{file}: piece of {length:,} bytes at {offset:,} lies over another, or outside of the file")
        for start, stop in ((end, offset), (offset, offset + length)):
            cuts += [min(PIECE_BYTES_MAX, stop - at) for at in range(start, stop, PIECE_BYTES_MAX)]
        end = offset + length
    if len(cuts) > PIECES_MAX:
        raise UpdateError(f"{file}: {len(cuts):,} pieces are more than the {PIECES_MAX:,} of any index")
    runs = tuple((len(list(group)), length) for length, group in groupby(cuts))
    with file.open("rb") as opened:
        digests = b"".join(_digest(opened.read(length)) for length in cuts)
    return BankIndex(runs, digests).to_bytes()


def read_index(data: bytes, origin: str) -> BankIndex:
    """An index from its bytes. `origin` is what it is called in errors. Raises UpdateError if it is not one."""
    if len(data) < HEADER.size or len(data) > INDEX_BYTES_MAX or not data.startswith(MAGIC):
        raise UpdateError(f"{origin}: is no index of a bank")
    _, size, count = HEADER.unpack_from(data)
    after = HEADER.size + count * RUN.size
    if after > len(data):
        raise UpdateError(f"{origin}: is cut off")
    runs = tuple((pieces, length) for pieces, length in RUN.iter_unpack(data[HEADER.size : after]))
    index = BankIndex(runs, data[after:])
    pieces = sum(pieces for pieces, _ in index.runs)
    if any(not pieces or not 0 < length <= PIECE_BYTES_MAX for pieces, length in index.runs):
        raise UpdateError(f"{origin}: has pieces of an impossible length")
    if len(index.digests) != pieces * DIGEST_BYTES or index.size_bytes != size:
        raise UpdateError(f"{origin}: its parts contradict each other")
    return index


def found_pieces(file: BinaryIO, cut_as: BankIndex) -> Iterator[Piece]:
    """The pieces of a file, with the hashes that they really have, cut where an index cuts; ends where the file ends."""
    file.seek(0)
    for piece in cut_as:
        data = file.read(piece.length)
        if len(data) < piece.length:
            return
        yield Piece(piece.offset, piece.length, _digest(data))


def missing_ranges(index: BankIndex, known: Container[bytes]) -> list[tuple[int, int]]:
    """What is to be fetched of a file: ranges of bytes, nearer ones than `GAP_BYTES` joined; first byte, and one after the last.

    `known` has the hashes of pieces that are at hand.
    """
    ranges: list[tuple[int, int]] = []
    for piece in index:
        if piece.digest in known:
            continue
        if ranges and piece.offset - ranges[-1][1] < GAP_BYTES:
            ranges[-1] = ranges[-1][0], piece.offset + piece.length
        else:
            ranges.append((piece.offset, piece.offset + piece.length))
    return ranges


def _digest(data: bytes) -> bytes:
    """Hash of a piece, its length included."""
    return hashlib.blake2b(data, digest_size=DIGEST_BYTES).digest()
