"""Python's memory as the event loop wants it: nothing collected, nothing grown while it runs."""

from __future__ import annotations

import contextlib
import gc
from collections.abc import Iterator

KEPT_TUPLES, KEPT_TUPLE_LENGTHS = 2000, 20  # CPython keeps so many freed tuples of each length below, 5 MB in all


@contextlib.contextmanager
def collector_off() -> Iterator[None]:
    """No garbage collection while the loop runs: it makes no cycles."""
    gc.collect()
    gc.freeze()
    gc.disable()
    for length in range(1, KEPT_TUPLE_LENGTHS):  # so that the interpreter's store of them does not grow while the loop runs
        _ = [tuple([None] * length) for _ in range(KEPT_TUPLES)]
    try:
        yield
    finally:
        gc.enable()
        gc.unfreeze()
