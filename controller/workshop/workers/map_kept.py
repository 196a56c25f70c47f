"""One function of many items: in this process, in processes of this machine, or on the workers of a dask scheduler.

Results do not depend on where and with which others they are computed, so a task is a small group of items, and one whose worker is
lost is simply computed again by another. What is done is kept in a file: the same call goes on where a failure has ended it.
"""

import contextlib
import os
import platform
import resource
import threading
import time
from collections.abc import Callable, Generator, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any, Generic, TypeAlias, TypeVar

from threadpoolctl import threadpool_limits
from tqdm import tqdm

from controller.device.bank.file_format import creator
from controller.errors import WorkersError
from controller.workshop.workers.dask_client import answers_of, dask_errors, open_client
from controller.workshop.workers.kept_file import KeptFile, record_of, result_in
from controller.workshop.workers.workers import ALONE, Workers

Item = TypeVar("Item")
Function: TypeAlias = Callable[[Sequence[Item]], Sequence[bytes]]

TASKS_PER_WORKER = 4  # at least, so that all end at about the same time
# In a process: a model may have one workspace, and a dask worker several threads; an item may map others itself
ONE_AT_A_TIME = threading.RLock()
tqdm.set_lock(threading.RLock())  # in place of a semaphore, which a worker that is ended would leave behind


@dataclass
class Share:
    """What one worker has done."""

    items: int = 0
    processor_s: float = 0.0
    peak_mb: float = 0.0  # largest resident memory of its process, in MB of 10^6 bytes


@dataclass(frozen=True)
class Mapped:
    """Results of all items by number, and who has computed them."""

    results: dict[int, bytes]
    kept: int  # were there before
    shares: dict[str, Share] = field(default_factory=dict)  # by the host and process of each worker

    def figures(self) -> dict[str, Any]:
        """Who did how much, as plain values."""
        return {"kept": self.kept, **{worker: asdict(share) for worker, share in sorted(self.shares.items())}}


@dataclass(frozen=True)
class Computed:
    """What a worker makes of a task."""

    records: list[bytes]  # as `kept_file` keeps them, with a CRC from where they were computed
    worker: str
    share: Share


@dataclass(frozen=True)
class Group(Generic[Item]):
    """A task: some items by number, and who asks."""

    items: dict[int, Item]
    maker: str  # `creator()` of who asks: a worker of another version would compute something else

    def compute(self, function: Function[Item]) -> Computed:
        """Compute all; raises WorkersError if this worker is of another version."""
        if self.maker != creator():
            raise WorkersError(
                f"a worker has another version than asked for: {creator()}, not {self.maker}: install the same on all"
            )
        before_s = time.process_time()
        with ONE_AT_A_TIME, threadpool_limits(1, "blas"):
            results = function(tuple(self.items.values()))
        peak_mb = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024e-6
        share = Share(len(self.items), time.process_time() - before_s, peak_mb)
        records = [record_of(number, result) for number, result in zip(self.items, results, strict=True)]
        return Computed(records, f"{platform.node()}, process {os.getpid()}", share)

    def is_answered(self, answer: object) -> bool:
        """Whether an answer is whole, and to this task."""
        found = map(result_in, answer.records) if isinstance(answer, Computed) else ()
        return [one and one[0] for one in found] == list(self.items)


def map_kept(
    function: Function[Item],
    items: Mapping[int, Item],
    kept: Path,
    workers: Workers = ALONE,
    *,
    at_once: int = 1,
    what: str = "",
    unit: str = "item",
    still_holds: Callable[[bytes], bool] = lambda _: True,  # whether a result that was kept counts, or is computed again
) -> Mapped:
    """Results of `function`, bytes for each of at most `at_once` items, for all `items` by number: the same whoever computes.

    `function` and items are pickled. What the file `kept` holds is not computed again: the caller names it by all that determines
    the results, and removes it when they are safe. With `what`, a bar of that name shows the time left on stderr if that is a
    terminal.

    Raises WorkersError if the scheduler is not found, a worker has another version, all workers are lost, or what is done cannot be
    kept; UsageError if another process has the file.
    """
    with KeptFile.open(kept) as done:
        results = {number: done.results[number] for number in items if number in done.results and still_holds(done.results[number])}
        missing = [number for number in items if number not in results]
        mapped = Mapped(results, len(results))
        size = at_once if workers.strangers else max(1, min(at_once, -(-len(missing) // (TASKS_PER_WORKER * workers.processes))))
        groups = [missing[first : first + size] for first in range(0, len(missing), size)]
        tasks = [Group({number: items[number] for number in group}, creator()) for group in groups]
        bar = tqdm(total=len(items), initial=len(results), unit=unit, desc=what, disable=None if what else True)
        with bar, contextlib.closing(_computed(function, tasks, workers)) as computed:
            for answer in computed:
                for record in answer.records:
                    done.add(record)
                done.flush()
                results.update(filter(None, map(result_in, answer.records)))
                of_worker, share = mapped.shares.setdefault(answer.worker, Share()), answer.share
                of_worker.items += share.items
                of_worker.processor_s += share.processor_s
                of_worker.peak_mb = max(of_worker.peak_mb, share.peak_mb)
                bar.update(share.items)
    return mapped


def _computed(function: Function[Item], tasks: Sequence[Group[Item]], workers: Workers) -> Generator[Computed]:
    """What becomes of each task, as they come."""
    if not tasks:
        return
    if workers.is_this_process:
        for task in tasks:
            yield task.compute(function)
        return
    with contextlib.ExitStack() as stack:
        with dask_errors(workers.option):
            client = stack.enter_context(open_client(workers))
            sent = client.submit(_itself, function, pure=False)  # once to each worker, not with each task
            task_of = dict(zip(client.map(Group.compute, tasks, function=sent, pure=False), tasks, strict=True))
            answers = answers_of(client, workers.option, task_of)
        while True:
            with dask_errors(workers.option):  # of dask, not of who takes the results
                answer = next(answers, None)
            if answer is None:
                return
            yield answer


def _itself(function: Function[Item]) -> Function[Item]:
    """What a worker keeps of a function."""
    return function
