"""What the event loop asks of the kernel: real-time priority, a core, memory that is not paged out; and of BLAS: one thread."""

from __future__ import annotations

import contextlib
import ctypes
import errno
import os
import re
import resource
from pathlib import Path

from controller.device.board.devices import Realtime

MCL_CURRENT, MCL_FUTURE, MCL_ONFAULT = 1, 2, 4  # mman-common.h: of every machine but alpha, powerpc and sparc
BLAS_NAMES = [f"{who}openblas_set_num_threads{integers}" for who in ("scipy_", "") for integers in ("64_", "")]  # by who built it
CAP_IPC_LOCK, CAP_SYS_NICE = 14, 23  # linux/capability.h


def enter_realtime(settings: Realtime) -> list[str]:
    """Set priority and core of this thread, lock memory as it is used, and limit BLAS to one thread.

    Threads and processes started later have ordinary priority.

    Returns no line, or one warning: what was refused, and how to permit it.
    """
    refused = [_schedule(settings.priority), _pin(settings.cpu), _lock_memory() if settings.lock_memory else ""]
    one_blas_thread()
    reported = "; ".join(filter(None, refused))
    return [f"not in real time, so the kernel may keep a finger waiting: {reported}"] if reported else []


def _schedule(priority: int) -> str:
    if not priority:
        return ""
    try:
        os.sched_setscheduler(0, os.SCHED_FIFO | os.SCHED_RESET_ON_FORK, os.sched_param(priority))
    except OSError as error:
        limit = resource.getrlimit(resource.RLIMIT_RTPRIO)[1]
        permitted = _has(CAP_SYS_NICE) or limit == resource.RLIM_INFINITY or limit >= priority
        if error.errno == errno.EPERM and permitted:
            why = group_refusal(Path("/"))
        else:
            why = f"ulimit -r is {limit}; LimitRTPRIO={priority} in the unit"
        return f"SCHED_FIFO at priority {priority}: {error.strerror} ({why})"
    return ""


def group_refusal(root: Path) -> str:
    """Why a process that has the right to SCHED_FIFO is refused it: CONFIG_RT_GROUP_SCHED, and what to do.

    A kernel built with it refuses real-time scheduling in a control group that was given no share of it (sched(7),
    Documentation/scheduler/sched-rt-group.rst); in the unified hierarchy no group but the root has one.
    """
    groups = dict(line.split(":", 2)[1:] for line in _text(root / "proc/self/cgroup").splitlines() if line.count(":") >= 2)
    names = next((names for names in groups if "cpu" in names.split(",")), "")
    group = groups.get(names, groups.get("", "/"))
    inside = group.lstrip("/")
    if names:
        for place in (names, "cpu"):
            share = root / "sys/fs/cgroup" / place / inside / "cpu.rt_runtime_us"
            if _text(share).strip() == "0":
                return f"RT_GROUP_SCHED of the kernel: {share} is 0: give the group a share, such as 950000"
    if inside:
        return (
            f"the limits permit it, so RT_GROUP_SCHED of the kernel does not, in the control group {group}: start the kernel with"
            " rt_group_sched=0 (Linux 6.16), or take one without it; in a container its seccomp profile may refuse it too"
        )
    return "the limits permit it: a container's seccomp profile, or another security module, refuses it"


def _pin(cpu: int | None) -> str:
    if cpu is None:
        return ""
    try:
        os.sched_setaffinity(0, {cpu})
    except OSError as error:
        return f"core {cpu}: {error.strerror} (this process may use {sorted(os.sched_getaffinity(0))}; realtime.cpu of the board)"
    return ""


def _lock_memory() -> str:
    """Lock pages as they are used (MCL_ONFAULT): a plain mlockall would read and keep the whole bank.

    With a limit, nothing is locked: a later mapping counts in full against it, although only the pages used are kept, so that
    mapping a bank would fail (mmap(2), EAGAIN).
    """
    hard = resource.getrlimit(resource.RLIMIT_MEMLOCK)[1]
    if hard == resource.RLIM_INFINITY:
        resource.setrlimit(resource.RLIMIT_MEMLOCK, (hard, hard))
    elif not _has(CAP_IPC_LOCK):
        return f"memory is not locked (ulimit -l is {hard // 1024} KiB; LimitMEMLOCK=infinity in the unit)"
    libc = ctypes.CDLL(None, use_errno=True)
    if libc.mlockall(MCL_CURRENT | MCL_FUTURE | MCL_ONFAULT):
        return f"memory is not locked: {os.strerror(ctypes.get_errno())}"
    return ""


def _has(capability: int) -> bool:
    effective = re.search(r"^CapEff:\s*(\w+)", _text(Path("/proc/self/status")), re.MULTILINE)
    return bool(effective and int(effective[1], 16) >> capability & 1)


def _text(file: Path) -> str:
    try:
        return file.read_text(errors="replace")
    except OSError:
        return ""


def one_blas_thread() -> list[str]:
    """Limit OpenBLAS to one thread, in this process and its children: for the loop's small products, threads cost time.

    Returns the paths of the OpenBLAS libraries found; none if numpy uses another BLAS.
    """
    os.environ["OPENBLAS_NUM_THREADS"] = "1"  # for libraries loaded later
    reported = []
    for path in sorted(set(re.findall(r"(/.*openblas.*)$", Path("/proc/self/maps").read_text(), re.MULTILINE))):
        library = ctypes.CDLL(path)
        for name in BLAS_NAMES:
            with contextlib.suppress(AttributeError):
                getattr(library, name)(1)
                reported.append(path)
                break
    return reported
