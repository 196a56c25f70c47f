"""The border to dask: a scheduler of the same version or none, and whatever dask raises as one line."""

import asyncio
import contextlib
import json
import logging
import platform
import signal
from collections.abc import Iterator
from multiprocessing import resource_tracker
from typing import Any

from controller.console import tell
from controller.errors import ControllerError, WorkersError
from controller.workshop.workers.workers import Workers

FOUND_WITHIN_S = 30.0  # a scheduler on another machine
LOST_WORKERS = 10  # that one task may have had; more, and it is taken to be the cause
OWN_CLIENT = {
    "distributed.scheduler.allowed-failures": LOST_WORKERS,
    "distributed.admin.large-graph-warning-threshold": "1TB",  # what is large is sent once
}
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
        if isinstance(error, KilledWorker):
            lost = f"a task has lost its worker {error.allowed_failures + 1} times, the last was {error.last_worker.address}"
            raise WorkersError(f"{where}: {lost}: it may need more memory; {KEPT}") from error
        if isinstance(error, CancelledError):
            raise WorkersError(f"{where}: the scheduler is lost; {KEPT}") from error
        why = f"{type(error).__name__}: {said}" if said else type(error).__name__
        raise WorkersError(f"{where}: dask failed ({why}); {KEPT}") from error


@contextlib.contextmanager
def open_client(workers: Workers) -> Iterator[Any]:
    """Client of a scheduler that is there, or of one with as many processes of this computer.

    Keys and certificates for addresses tls:// are those of dask's own configuration. Raises WorkersError if no scheduler answers,
    or scheduler or workers have another version of dask or Python.
    """
    import dask
    from distributed import Client, LocalCluster

    for name in ("distributed", "distributed.client"):  # the failure is reported once, by this program
        logging.getLogger(name).setLevel(logging.CRITICAL)
    with contextlib.ExitStack() as stack:
        stack.enter_context(dask.config.set(OWN_CLIENT))
        if not workers.strangers:
            stack.enter_context(dask.config.set(OWN_CLUSTER))
            resource_tracker.ensure_running()  # which would take back what follows
            interrupt = {signal.SIGINT}  # at a terminal all its processes get it: this one ends the others, also those begun later
            signal.pthread_sigmask(signal.SIG_BLOCK, interrupt)
            try:
                local = LocalCluster(
                    n_workers=workers.processes,
                    threads_per_worker=1,
                    memory_limit=0 if workers.memory_mb is None else int(workers.memory_mb * 1e6),
                    host="127.0.0.1",
                    dashboard_address=OWN_HTTP,
                    worker_dashboard_address=OWN_HTTP,
                    silence_logs="CRITICAL",
                )
                stack.enter_context(local)
            finally:
                signal.pthread_sigmask(signal.SIG_UNBLOCK, interrupt)
            yield stack.enter_context(Client(local, timeout=FOUND_WITHIN_S))
            return
        address = workers.address or _address_in(workers)
        _require_same(f"{workers.option}: the scheduler", asyncio.run(_versions(address, workers.option)))
        client = stack.enter_context(Client(address, timeout=FOUND_WITHIN_S))
        found = client.get_versions()["workers"]
        if not found:
            tell(f"{workers.option}: the scheduler has no workers yet; they are waited for")
        for worker, reported in found.items():
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


def answers_of(client: Any, where: str, task_of: dict[Any, Any]) -> Iterator[Any]:
    """What workers answer to the task of each future, as it comes; raises WorkersError if one answers something else."""
    from distributed import as_completed

    for future in as_completed(list(task_of)):
        answer = future.result()
        if not task_of[future].is_answered(answer):
            (workers,) = client.who_has([future]).values()
            raise WorkersError(f"{where}: the worker {', '.join(workers)} answered what is no result: end it; {KEPT}")
        yield answer
        future.release()


async def _versions(address: str, option: str) -> dict[str, Any]:
    """What a scheduler of any version says of its own."""
    from distributed import Security, rpc

    try:
        async with rpc(address, timeout=FOUND_WITHIN_S, connection_args=Security().get_connection_args("client")) as scheduler:
            return dict(await asyncio.wait_for(scheduler.versions(), FOUND_WITHIN_S))
    except (OSError, ValueError, TypeError, TimeoutError, MemoryError) as error:
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
