"""Work on all cores, by threads: most of it is NumPy on large arrays, which needs no lock of the interpreter."""

import os
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

Item = TypeVar("Item")
Result = TypeVar("Result")


def cores() -> int:
    """Cores that this process may use."""
    return len(os.sched_getaffinity(0))


def on_all_cores(compute: Callable[[Item], Result], items: Iterable[Item]) -> Iterator[Result]:
    """Results of all items in their order, each computed by itself: the same bytes on any number of cores."""
    if cores() == 1:
        yield from map(compute, items)
        return
    with ThreadPoolExecutor(cores()) as pool:
        yield from pool.map(compute, items)
