"""What the interpreter does with memory while the event loop runs: nothing."""

from __future__ import annotations

import contextlib
import gc
from collections.abc import Iterator

FREE_TUPLES, TUPLE_LENGTHS = 2000, 20  # CPython keeps this many freed tuples of each length below, 5 MB in all
BLOCK_BYTES, ARENA_BYTES = 448, 1 << 20  # CPython has blocks of up to 512 bytes in arenas


@contextlib.contextmanager
def no_garbage_collection() -> Iterator[None]:
    """Switch the cyclic garbage collector off, and fill the interpreter's stores, so that they do not grow.

    These are its free tuples, and an arena of small objects (Objects/obmalloc.c): where the others are nearly full, one would be
    asked of the kernel and given back again and again. The last of many blocks keeps one. The loop makes no reference cycles. On
    exit the collector is on again.
    """
    gc.collect()
    gc.disable()
    for length in range(1, TUPLE_LENGTHS):
        _ = list(zip(*[[None] * FREE_TUPLES] * length, strict=True))
    kept = [bytes(BLOCK_BYTES) for _ in range(2 * ARENA_BYTES // BLOCK_BYTES)][-1]
    try:
        yield
    finally:
        del kept
        gc.enable()
