"""Independent pieces of work in processes of this machine, which share what was made before them.

Processes are forked: they read what their parent holds without a copy of it, and take memory only for what they write.
"""

import multiprocessing
import os
import signal
import threading
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from typing import Any, TypeVar

Item = TypeVar("Item")
Result = TypeVar("Result")
USABLE = min(len(os.sched_getaffinity(0)), 4)  # one for each core that this process may use; each adds 0.3 GB to a benchmark

_work: Callable[[Any], Any]  # of this process, if it was forked here


def in_processes(work: Callable[[Item], Result], items: Sequence[Item], processes: int) -> Iterator[Result]:
    """Yield `work(item)` for each item, in their order; `work` may be any function, items and results are pickled.

    With one process or one item the calling process does it. An interrupt ends the processes, and so does the end of their parent.
    """
    if min(processes, len(items)) < 2:
        yield from map(work, items)
        return
    fork = multiprocessing.get_context("fork")
    executor = ProcessPoolExecutor(min(processes, len(items)), fork, _begin, (work,))
    try:
        yield from executor.map(_do, items)
    finally:
        executor.shutdown(cancel_futures=True)


def _begin(work: Callable[[Any], Any]) -> None:
    global _work  # noqa: PLW0603 - what a forked process has of its parent without pickling
    _work = work
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _do(item: Any) -> Any:
    return _work(item)


def _end_with_parent() -> None:
    if (parent := multiprocessing.parent_process()) is not None:
        parent.join()
        os._exit(1)
