"""One function of many items: in this process, in processes of this machine, or on the workers of a dask scheduler.

Results do not depend on where and with which others they are computed, so a task is a small group of items, and one whose worker is
lost is simply computed again by another. What is done is kept in a file: the same call goes on where a failure has ended it.
"""

from __future__ import annotations

import asyncio
import contextlib
import fcntl
import json
import logging
import os
import platform
import resource
import struct
import threading
import time
from collections.abc import Callable, Generator, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any, BinaryIO, Generic, TypeVar

from threadpoolctl import threadpool_limits
from tqdm import tqdm

from controller.device.bank.file_format import creator
from controller.device.kernel.crc import intact, sealed
from controller.errors import ControllerError, UsageError, WorkersError
from controller.regular_file import open_private

Item = TypeVar("Item")

FOUND_WITHIN_S = 30.0  # a scheduler on another machine
LOST_WORKERS = 10  # that one task may have had; more, and it is taken to be the cause
OWN_HTTP = "127.0.0.1:0"  # without an address dask's pages are open to the network, at a port that another may have
SAME = "install the same version on all"
OWN_CLUSTER = {
    "distributed.scheduler.http.routes": [],
    "distributed.worker.http.routes": [],
    # Without dask's MALLOC_TRIM_THRESHOLD_, by which each large array that is freed goes back to the system: a third of the time
    "distributed.nanny.pre-spawn-environ": dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), 1),
}
KEPT = "what was done is kept: the same command goes on there"
SAID_CHARACTERS = 160
TASKS_PER_WORKER = 4  # at least, so that all end at about the same time
ONE_AT_A_TIME = threading.Lock()  # in a process: a model may have one workspace, and a dask worker several threads
RECORD = struct.Struct("<QI")  # number of the item, bytes of its result; then these; then the CRC-32 of all


@dataclass(frozen=True)
class Workers:
    """Who computes: this process, with 1 of `processes`; that many; or the workers of a scheduler, in place of both."""

    processes: int = 1
    address: str | None = None  # of a dask scheduler, whose workers have this package in the same version
    scheduler_file: Path | None = None  # of `dask scheduler --scheduler-file`, which holds its address
    memory_mb: float | None = None  # that each of `processes` may take; dask ends one that takes more, and starts it again

    @property
    def strangers(self) -> bool:
        """Whether they are those of a scheduler: who knows how many there are."""
        return self.address is not None or self.scheduler_file is not None

    @property
    def option(self) -> str:
        """What asked for them on the command line."""
        if self.scheduler_file is not None:
            return f"--scheduler-file {self.scheduler_file}"
        return f"--workers {self.processes}" if self.address is None else f"--dask {self.address}"


ALONE = Workers()


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
class Group(Generic[Item]):
    """A task: some items, the function for them, and who asks."""

    function: Callable[[Sequence[Item]], Sequence[bytes]]
    items: tuple[Item, ...]
    maker: str  # `creator()` of who asks: a worker of another version would compute something else

    def compute(self) -> tuple[Sequence[bytes], str, Share]:
        """Results, the worker's name and its share; raises WorkersError if it is of another version."""
        if self.maker != creator():
            raise WorkersError(
                f"a worker has another version than asked for: {creator()}, not {self.maker}: install the same on all"
            )
        before_s = time.process_time()
        with ONE_AT_A_TIME, threadpool_limits(1, "blas"):
            results = self.function(self.items)
        peak_mb = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024e-6
        return results, f"{platform.node()}, process {os.getpid()}", Share(len(self.items), time.process_time() - before_s, peak_mb)


def map_kept(
    function: Callable[[Sequence[Item]], Sequence[bytes]],
    items: Mapping[int, Item],
    kept: Path,
    workers: Workers = ALONE,
    *,
    at_once: int = 1,
    what: str = "",
    unit: str = "item",
) -> Mapped:
    """Results of `function`, bytes for each of at most `at_once` items, for all `items` by number: the same whoever computes.

    `function` and items are pickled. What the file `kept` holds is not computed again: the caller names it by all that determines
    the results, and removes it when they are safe. With `what`, a bar of that name shows the time left on stderr if that is a
    terminal.

    Raises WorkersError if the scheduler is not found, a worker has another version, all workers are lost, or what is done cannot be
    kept; UsageError if another process has the file.
    """
    with _Kept.open(kept) as done:
        results = {number: done.results[number] for number in items if number in done.results}
        missing = [number for number in items if number not in results]
        mapped = Mapped(results, len(results))
        size = at_once if workers.strangers else max(1, min(at_once, -(-len(missing) // (TASKS_PER_WORKER * workers.processes))))
        groups = [missing[first : first + size] for first in range(0, len(missing), size)]
        tasks = [Group(function, tuple(items[number] for number in group), creator()) for group in groups]
        bar = tqdm(total=len(items), initial=len(results), unit=unit, desc=what, disable=None if what else True)
        with bar, contextlib.closing(_computed(tasks, workers)) as computed:
            for index, (found, worker, share) in computed:
                for number, result in zip(groups[index], found, strict=True):
                    results[number] = result
                    done.add(number, result)
                done.flush()
                of_worker = mapped.shares.setdefault(worker, Share())
                of_worker.items += share.items
                of_worker.processor_s += share.processor_s
                of_worker.peak_mb = max(of_worker.peak_mb, share.peak_mb)
                bar.update(len(found))
    return mapped


def _computed(tasks: Sequence[Group[Any]], workers: Workers) -> Generator[tuple[int, tuple[Sequence[bytes], str, Share]]]:
    """Number of each task and what it computes, as they come."""
    if not tasks:
        return
    if not workers.strangers and workers.processes == 1:
        for number, task in enumerate(tasks):
            yield number, task.compute()
        return
    with contextlib.ExitStack() as stack:
        with dask_errors(workers.option):
            client = stack.enter_context(_open_client(workers))
            number_of = {future: number for number, future in enumerate(client.map(Group.compute, tasks, pure=False))}
            results = _results_of(number_of)
        while True:
            with dask_errors(workers.option):  # of dask, not of who takes the results
                found = next(results, None)
            if found is None:
                return
            yield found


class _Kept:
    """The file of results that are there, one record each, of which the last may be torn."""

    def __init__(self, file: BinaryIO) -> None:
        self._file = file
        self.results: dict[int, bytes] = {}
        whole = 0
        while len(head := file.read(RECORD.size)) == RECORD.size:
            number, size = RECORD.unpack(head)
            record = head + file.read(min(size, os.fstat(file.fileno()).st_size) + 4)  # a torn size may be any
            if len(record) != RECORD.size + size + 4 or not intact(record):
                break
            self.results[number] = record[RECORD.size : -4]
            whole += len(record)
        file.seek(whole)
        file.truncate()

    @classmethod
    @contextlib.contextmanager
    def open(cls, path: Path) -> Iterator[_Kept]:
        try:
            with os.fdopen(open_private(path), "r+b") as file:
                try:
                    fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
                except BlockingIOError:
                    raise UsageError(f"{path}: another command is at work on the same: wait for it, or give another file") from None
                yield cls(file)
        except OSError as error:
            raise WorkersError(f"{path}: cannot be written ({error.strerror})") from error

    def add(self, number: int, result: bytes) -> None:
        self._file.write(sealed(RECORD.pack(number, len(result)) + result))

    def flush(self) -> None:
        self._file.flush()


@contextlib.contextmanager
def dask_errors(where: str) -> Iterator[None]:
    """Raise what dask raises as a WorkersError of one line. `where` is the option that asked for dask, with its value."""
    try:
        yield
    except (ControllerError, ModuleNotFoundError) as error:
        if isinstance(error, ModuleNotFoundError) and (error.name or "").partition(".")[0] != "controller":
            raise  # on this computer: dask itself
        if isinstance(error, ControllerError):
            raise
        raise WorkersError(f"{where}: its workers lack this package ({error}): {SAME}; {KEPT}") from error
    except Exception as error:
        from distributed import CancelledError, KilledWorker

        said = " ".join(str(error).split())[:SAID_CHARACTERS]
        if "deserialization" in said:
            raise WorkersError(f"{where}: scheduler or workers lack this package: {SAME}; {KEPT}") from error
        if isinstance(error, KilledWorker | CancelledError):
            raise WorkersError(f"{where}: the workers are lost ({said}); {KEPT}") from error
        why = f"{type(error).__name__}: {said}" if said else type(error).__name__
        raise WorkersError(f"{where}: dask failed ({why}); {KEPT}") from error


@contextlib.contextmanager
def _open_client(workers: Workers) -> Iterator[Any]:
    """Client of a scheduler that is there, or of one with as many processes of this computer.

    Keys and certificates for addresses tls:// are those of dask's own configuration. Raises WorkersError if no scheduler answers,
    or scheduler or workers have another version of dask or Python.
    """
    import dask
    from distributed import Client, LocalCluster

    logging.getLogger("distributed").setLevel(logging.CRITICAL)  # the failure is reported once, by this program
    with contextlib.ExitStack() as stack:
        stack.enter_context(dask.config.set({"distributed.scheduler.allowed-failures": LOST_WORKERS}))
        if not workers.strangers:
            stack.enter_context(dask.config.set(OWN_CLUSTER))
            local = LocalCluster(
                n_workers=workers.processes,
                threads_per_worker=1,
                memory_limit=0 if workers.memory_mb is None else int(workers.memory_mb * 1e6),
                host="127.0.0.1",
                dashboard_address=OWN_HTTP,
                worker_dashboard_address=OWN_HTTP,
                silence_logs="CRITICAL",
            )
            yield stack.enter_context(Client(stack.enter_context(local), timeout=FOUND_WITHIN_S))
            return
        address = workers.address or _address_in(workers)
        _require_same(f"{workers.option}: the scheduler", asyncio.run(_versions(address, workers.option)))
        client = stack.enter_context(Client(address, timeout=FOUND_WITHIN_S))
        for worker, reported in client.get_versions()["workers"].items():
            _require_same(f"{workers.option}: the worker {worker}", reported)
        yield client


def _address_in(workers: Workers) -> str:
    """Address in a scheduler's file."""
    assert workers.scheduler_file
    try:
        return str(json.loads(workers.scheduler_file.read_text(encoding="utf-8"))["address"])
    except (OSError, ValueError, LookupError, TypeError) as error:
        why = error.strerror if isinstance(error, OSError) else "it has no address"
        raise WorkersError(f"{workers.option}: not the file of a running `dask scheduler --scheduler-file` ({why})") from error


def _results_of(number_of: dict[Any, int]) -> Iterator[tuple[int, Any]]:
    """Number of each future and its result, as they come."""
    from distributed import as_completed

    for future in as_completed(list(number_of)):
        yield number_of[future], future.result()
        future.release()


async def _versions(address: str, option: str) -> dict[str, Any]:
    """What a scheduler of any version says of its own."""
    from distributed import Security, rpc

    try:
        async with rpc(address, timeout=FOUND_WITHIN_S, connection_args=Security().get_connection_args("client")) as scheduler:
            return dict(await asyncio.wait_for(scheduler.versions(), FOUND_WITHIN_S))
    except (OSError, ValueError, TypeError, TimeoutError) as error:
        why = " ".join(str(error).split())[:SAID_CHARACTERS] or "no answer in time"
        raise WorkersError(f"{option}: no dask scheduler answers there ({why})") from error


def _require_same(who: str, reported: dict[str, Any]) -> None:
    """Versions of dask do not understand each other, and not all of them say so; those of Python do not read each other's code."""
    import distributed

    packages = reported.get("packages", {})
    python = ".".join(str(packages.get("python")).split(".")[:2])
    pairs = {
        "distributed": (packages.get("distributed"), distributed.__version__),
        "Python": (python, ".".join(platform.python_version_tuple()[:2])),
    }
    theirs, ours = (", ".join(f"{name} {pair[side]}" for name, pair in pairs.items() if pair[0] != pair[1]) for side in (0, 1))
    if theirs:
        raise WorkersError(f"{who} has {theirs}, this computer {ours}: {SAME}")
