"""The border to dask: a scheduler of the same version or none, and whatever dask raises as one line.

What is taken from dask is kept, so that the same command goes on where a failure has ended it.
"""

from __future__ import annotations

import asyncio
import contextlib
import logging
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from controller.errors import BankError, ControllerError

FOUND_WITHIN_S = 30.0  # a scheduler on another machine
LOST_WORKERS = 10  # that one group of cells may have had; more, and it is taken to be the cause
OWN_HTTP = "127.0.0.1:0"  # without an address dask's pages are open to the network, at a port that another may have
KEPT = "what was done is kept: the same command goes on there"
SAID_CHARACTERS = 160


@contextlib.contextmanager
def dask_errors(where: str) -> Iterator[None]:
    """Raise what dask raises as a BankError of one line. `where` is the option that asked for dask, with its value."""
    try:
        yield
    except (ControllerError, ModuleNotFoundError) as error:
        if isinstance(error, ModuleNotFoundError) and (error.name or "").partition(".")[0] != "controller":
            raise  # on this computer: dask itself
        if isinstance(error, ControllerError):
            raise
        raise BankError(f"{where}: its workers lack this package ({error}): install the same version on all; {KEPT}") from error
    except Exception as error:
        from distributed import CancelledError, KilledWorker

        said = " ".join(str(error).split())[:SAID_CHARACTERS]
        if "deserialization" in said:
            raise BankError(f"{where}: scheduler or workers lack this package: install the same version on all; {KEPT}") from error
        if isinstance(error, KilledWorker | CancelledError):
            raise BankError(f"{where}: the workers are lost ({said}); {KEPT}") from error
        why = f"{type(error).__name__}: {said}" if said else type(error).__name__
        raise BankError(f"{where}: dask failed ({why}); {KEPT}") from error


@contextlib.contextmanager
def open_client(address: str | None, processes: int) -> Iterator[Any]:
    """Client of a scheduler that is there, or of one with as many processes of this computer.

    Raises BankError if no scheduler answers at the address, or scheduler or workers have another version of dask.
    """
    import dask
    from distributed import Client, LocalCluster

    logging.getLogger("distributed").setLevel(logging.CRITICAL)  # the failure is reported once, by this program
    with contextlib.ExitStack() as stack:
        stack.enter_context(dask.config.set({"distributed.scheduler.allowed-failures": LOST_WORKERS}))
        if address is None:
            stack.enter_context(dask.config.set({"distributed.scheduler.http.routes": [], "distributed.worker.http.routes": []}))
            local = LocalCluster(
                n_workers=processes,
                threads_per_worker=1,
                memory_limit=0,
                host="127.0.0.1",
                dashboard_address=OWN_HTTP,
                worker_dashboard_address=OWN_HTTP,
                silence_logs="CRITICAL",
            )
            yield stack.enter_context(Client(stack.enter_context(local), timeout=FOUND_WITHIN_S))
            return
        _require_same(f"--dask {address}: the scheduler", asyncio.run(_versions(address)))
        client = stack.enter_context(Client(address, timeout=FOUND_WITHIN_S))
        for worker, reported in client.get_versions()["workers"].items():
            _require_same(f"--dask {address}: the worker {worker}", reported)
        yield client


def results_of(number_of: dict[Any, int]) -> Iterator[tuple[int, NDArray[np.uint32]]]:
    """Number of each future and its result, as they come."""
    from distributed import as_completed

    for future in as_completed(list(number_of)):
        yield number_of[future], future.result()
        future.release()


async def _versions(address: str) -> dict[str, Any]:
    """What a scheduler of any version says of its own."""
    from distributed import rpc

    try:
        async with rpc(address, timeout=FOUND_WITHIN_S) as scheduler:
            return dict(await asyncio.wait_for(scheduler.versions(), FOUND_WITHIN_S))
    except (OSError, ValueError, TimeoutError) as error:
        why = " ".join(str(error).split())[:SAID_CHARACTERS] or "no answer in time"
        raise BankError(f"--dask {address}: no dask scheduler answers there ({why})") from error


def _require_same(who: str, reported: dict[str, Any]) -> None:
    """Versions of dask do not understand each other, and not all of them say so."""
    import distributed

    theirs = reported.get("packages", {}).get("distributed")
    if theirs != distributed.__version__:
        raise BankError(f"{who} has distributed {theirs}, this computer {distributed.__version__}: install the same on all")
