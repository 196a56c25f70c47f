"""No garbage collection while the event loop runs."""

from __future__ import annotations

import contextlib
import gc
from collections.abc import Iterator

FREE_TUPLES, TUPLE_LENGTHS = 2000, 20  # CPython keeps this many freed tuples of each length below, 5 MB in all


@contextlib.contextmanager
def no_garbage_collection() -> Iterator[None]:
    """Switch the cyclic garbage collector off, and fill the interpreter's store of free tuples, so that it does not grow.

    The loop makes no reference cycles. On exit the collector is on again.
    """
    gc.collect()
    gc.disable()
    for length in range(1, TUPLE_LENGTHS):
        _ = list(zip(*[[None] * FREE_TUPLES] * length, strict=True))
    try:
        yield
    finally:
        gc.enable()
