"""The states in which a disk may be found after a power cut, from the log of what was written to it.

A disk keeps what was written before a flush that it had answered. Of what came later it has kept any part, in any order: crash
states are all prefixes of the log, and drawn subsets of the writes since the last flush, torn at blocks of the file system.
"""

import hashlib
import random
from dataclasses import dataclass

from recording_disk import FLUSH, MARK, WRITE

BLOCK_BYTES = 4096
PIECE_BYTES = 8 * BLOCK_BYTES  # a long write is a prefix of itself this often


@dataclass
class CrashState:
    """One state of the disk.

    Attributes
    ----------
    content : bytearray
        Of the whole disk, before `blocks` are put over it; shared by all states, not to be kept.
    blocks : dict
        Content of some blocks, by their number.
    marks : list of str
        Those before it.
    entry : int
        The last entry of the log before the cut.
    is_prefix : bool
        Whether all until that entry was kept.
    digest : int
        Of its content.
    """

    content: bytearray
    blocks: dict
    marks: list
    entry: int
    is_prefix: bool
    digest: int

    def write_to(self, image):
        """Into a memory map, or any buffer of the disk's size."""
        image[:] = self.content
        for number, block in self.blocks.items():
            image[number * BLOCK_BYTES : (number + 1) * BLOCK_BYTES] = block


def digest(number, block):
    """Of one block; a disk's is the exclusive or of those of its blocks."""
    return int.from_bytes(hashlib.blake2b(block, digest_size=16, salt=number.to_bytes(8, "little")).digest(), "little")


def blocks_of(offset, data):
    """(number, content) of each block of a write. Raises ValueError where it is not in whole blocks."""
    if offset % BLOCK_BYTES or len(data) % BLOCK_BYTES:
        raise ValueError(f"a write of {len(data)} bytes at {offset} is not in whole blocks")
    return [((offset + at) // BLOCK_BYTES, data[at : at + BLOCK_BYTES]) for at in range(0, len(data), BLOCK_BYTES)]


class Disk:
    """The disk as the log fills it."""

    def __init__(self, size_bytes):
        self.content = bytearray(size_bytes)
        self.digest = 0  # of the difference to its first state
        self.flushed_digest = 0
        self.flushed = {}  # blocks that were written since the last flush, as they were at that flush
        self.since_flush = []  # [(entry, number, block)]

    def block(self, number):
        return bytes(self.content[number * BLOCK_BYTES : (number + 1) * BLOCK_BYTES])

    def write(self, entry, blocks):
        for number, block in blocks:
            old = self.block(number)
            self.flushed.setdefault(number, old)
            self.digest ^= digest(number, old) ^ digest(number, block)
            self.content[number * BLOCK_BYTES : (number + 1) * BLOCK_BYTES] = block
            self.since_flush.append((entry, number, block))

    def flush(self):
        self.flushed_digest = self.digest
        self.flushed.clear()
        self.since_flush.clear()

    def subset(self, kept):
        """Blocks and digest with only some of the writes since the last flush."""
        blocks = dict(self.flushed)
        for _, number, block in kept:
            blocks[number] = block
        value = self.flushed_digest
        for number, block in blocks.items():
            value ^= digest(number, self.flushed[number]) ^ digest(number, block)
        return blocks, value


def crash_states(entries, size_bytes, first_mark, subsets=2, seed=14):
    """All different states after a mark: every prefix, and some subsets of each stretch between flushes.

    The same content comes again behind each mark: it must hold what has been said since.

    Parameters
    ----------
    entries : list
        Of `read_log`.
    size_bytes : int
    first_mark : str
    subsets : int
        Drawn for each stretch of more than one block.
    seed : int

    Yields
    ------
    CrashState
    """
    disk, marks, seen, draw = Disk(size_bytes), [], set(), random.Random(seed)
    marks_at = []  # number of marks before each entry

    def state(value, blocks, entry, is_prefix):
        reported = marks[: marks_at[entry]]
        if first_mark in reported and (value, reported[-1]) not in seen:
            seen.add((value, reported[-1]))
            yield CrashState(disk.content, blocks, reported, entry, is_prefix, value)

    def drawn():
        """Subsets of the writes since the last flush, until a cut somewhere among them."""
        count = len(disk.since_flush)
        for _ in range(subsets if count > 1 else 0):
            until = draw.randint(1, count)
            share = draw.choice((0.1, 0.5, 0.9))
            blocks, value = disk.subset([write for write in disk.since_flush[:until] if draw.random() < share])
            yield from state(value, blocks, disk.since_flush[until - 1][0], is_prefix=False)

    for number, (kind, offset, data) in enumerate(entries):
        if kind == MARK:
            marks.append(data.decode())
        marks_at.append(len(marks))
        if kind == MARK:  # what is said now must be safe, even if nothing of what was not flushed is
            for blocks, value in (({}, disk.digest), disk.subset([])):
                yield from state(value, blocks, number, is_prefix=not blocks)
        elif kind == WRITE:
            for at in range(0, len(data), PIECE_BYTES):
                disk.write(number, blocks_of(offset + at, data[at : at + PIECE_BYTES]))
                yield from state(disk.digest, {}, number, is_prefix=True)
        elif kind == FLUSH:
            yield from drawn()
            disk.flush()
    yield from drawn()
