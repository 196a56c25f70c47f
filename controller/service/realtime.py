"""What the event loop asks of the kernel: real-time priority, a core, memory that is not paged out; and of BLAS: one thread."""

from __future__ import annotations

import contextlib
import ctypes
import os
import re
import resource
from pathlib import Path

from controller.board.devices import Realtime

MCL_CURRENT, MCL_FUTURE, MCL_ONFAULT = 1, 2, 4  # mman-common.h: of every machine but alpha, powerpc and sparc
BLAS_NAMES = [f"{who}openblas_set_num_threads{integers}" for who in ("scipy_", "") for integers in ("64_", "")]  # by who built it
CAP_IPC_LOCK = 14  # linux/capability.h


def enter_realtime(settings: Realtime) -> list[str]:
    """Give this thread its priority and core, and keep in memory whatever it touches from now on.

    Threads and processes started later are ordinary again. BLAS is limited to one thread.

    Returns
    -------
    list of str
        Empty, or one warning that says what was refused and what to do.
    """
    refused = [_schedule(settings.priority), _pin(settings.cpu), _lock_memory() if settings.lock_memory else ""]
    one_blas_thread()
    told = "; ".join(filter(None, refused))
    return [f"not in real time, so the kernel may keep a finger waiting: {told}"] if told else []


def _schedule(priority: int) -> str:
    if not priority:
        return ""
    try:
        os.sched_setscheduler(0, os.SCHED_FIFO | os.SCHED_RESET_ON_FORK, os.sched_param(priority))
    except OSError as error:
        limit = resource.getrlimit(resource.RLIMIT_RTPRIO)[1]
        return f"SCHED_FIFO at priority {priority}: {error.strerror} (ulimit -r is {limit}; LimitRTPRIO={priority} in the unit)"
    return ""


def _pin(cpu: int | None) -> str:
    if cpu is None:
        return ""
    try:
        os.sched_setaffinity(0, {cpu})
    except OSError as error:
        return f"core {cpu}: {error.strerror} (this process may use {sorted(os.sched_getaffinity(0))}; realtime.cpu of the board)"
    return ""


def _lock_memory() -> str:
    """Lock on fault: a plain mlockall would read the whole bank in and keep it.

    What is mapped later counts in full against the limit, the bank as a whole, though only pages touched are
    kept: with a limit the map would fail later on, so that nothing is locked then (mmap(2), EAGAIN).
    """
    hard = resource.getrlimit(resource.RLIMIT_MEMLOCK)[1]
    if hard == resource.RLIM_INFINITY:
        resource.setrlimit(resource.RLIMIT_MEMLOCK, (hard, hard))
    elif not _may_lock():
        return f"memory is not locked (ulimit -l is {hard // 1024} KiB; LimitMEMLOCK=infinity in the unit)"
    libc = ctypes.CDLL(None, use_errno=True)
    if libc.mlockall(MCL_CURRENT | MCL_FUTURE | MCL_ONFAULT):
        return f"memory is not locked: {os.strerror(ctypes.get_errno())}"
    return ""


def _may_lock() -> bool:
    """Whether this process is above RLIMIT_MEMLOCK."""
    effective = re.search(r"^CapEff:\s*(\w+)", Path("/proc/self/status").read_text(), re.MULTILINE)
    return bool(effective and int(effective[1], 16) >> CAP_IPC_LOCK & 1)


def one_blas_thread() -> list[str]:
    """Limit every OpenBLAS of this process to one thread, and those of its children: the loop's products are small.

    Returns
    -------
    list of str
        The libraries that were told; empty where numpy has another BLAS.
    """
    os.environ["OPENBLAS_NUM_THREADS"] = "1"  # for one that is loaded later
    told = []
    for path in sorted(set(re.findall(r"(/.*openblas.*)$", Path("/proc/self/maps").read_text(), re.MULTILINE))):
        library = ctypes.CDLL(path)
        for name in BLAS_NAMES:
            with contextlib.suppress(AttributeError):
                getattr(library, name)(1)
                told.append(path)
                break
    return told
