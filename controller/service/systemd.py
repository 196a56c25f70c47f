"""What a service owes to systemd, and what the loop asks of the kernel: sd_notify, watchdog, real-time scheduling.

The protocol is that of sd_notify(3): datagrams of VARIABLE=value lines to the socket that $NOTIFY_SOCKET names.
"""

from __future__ import annotations

import contextlib
import ctypes
import os
import re
import resource
import socket
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Self

from controller.board.devices import Realtime

PINGS_PER_TIMEOUT = 3  # sd_watchdog_enabled(3) recommends every half of it; one may be late
MCL_CURRENT, MCL_FUTURE, MCL_ONFAULT = 1, 2, 4  # mman-common.h: of every machine but alpha, powerpc and sparc
BLAS_NAMES = [f"{who}openblas_set_num_threads{integers}" for who in ("scipy_", "") for integers in ("64_", "")]  # by who built it
CAP_IPC_LOCK = 14  # linux/capability.h


class Notifier:
    """Tells the service manager how the service is; silent where there is none.

    Nothing here blocks: what finds the manager's queue full is kept and sent, in its order, by a later call.

    Parameters
    ----------
    address : str
        $NOTIFY_SOCKET: a path, or a name in the abstract namespace with @ in front; empty: nobody listens.
    """

    def __init__(self, address: str) -> None:
        self._address = b"\0" + os.fsencode(address[1:]) if address.startswith("@") else os.fsencode(address)
        self._socket = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM | socket.SOCK_CLOEXEC) if address else None
        self._owed: list[bytes] = []

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Fall silent."""
        if self._socket is not None:
            self._socket.close()
            self._socket = None

    @classmethod
    def from_environment(cls, environment: Mapping[str, str] = os.environ) -> Self:
        """The one that this process was started with."""
        return cls(environment.get("NOTIFY_SOCKET", ""))

    def ready(self, status: str) -> None:
        """It plays, or plays again after `reloading`."""
        self._tell(f"READY=1\nSTATUS={_line(status)}")

    def reloading(self, status: str) -> None:
        """It is preparing another scene; `ready` follows, whether that was taken over or not."""
        self._tell(f"RELOADING=1\nMONOTONIC_USEC={time.monotonic_ns() // 1000}\nSTATUS={_line(status)}")

    def stopping(self, status: str) -> None:
        """Outputs are being switched off; the process ends."""
        self._tell(f"STOPPING=1\nSTATUS={_line(status)}")

    def status(self, status: str) -> None:
        """One line for `systemctl status`."""
        self._tell(f"STATUS={_line(status)}")

    def alive(self) -> None:
        """Put off the watchdog; allocates nothing while the manager listens."""
        if self._owed:
            self._settle()
        self._send(b"WATCHDOG=1")

    def _tell(self, message: str) -> None:
        self._owed.append(message.encode())
        self._settle()

    def _settle(self) -> None:
        while self._owed and self._send(self._owed[0]):
            del self._owed[0]

    def _send(self, message: bytes) -> bool:
        """Whether it is dealt with: sent, or there is nobody who would ever take it."""
        if self._socket is None:
            return True
        try:
            self._socket.sendto(message, socket.MSG_DONTWAIT, self._address)
        except BlockingIOError:
            return False
        except OSError:  # the manager is gone: none of the panel's business
            return True
        return True


class Watchdog:
    """Lets the service manager see that the loop turns: a loop that hangs stops calling, and is killed.

    Parameters
    ----------
    notifier : Notifier
        Who is told.
    timeout_s : float
        After so much silence the service is killed, in s; inf: nobody watches.
    """

    def __init__(self, notifier: Notifier, timeout_s: float) -> None:
        self._notifier = notifier
        self._period_s = timeout_s / PINGS_PER_TIMEOUT
        self._due_s = float("inf") if timeout_s == float("inf") else float("-inf")

    @classmethod
    def from_environment(cls, notifier: Notifier, environment: Mapping[str, str] = os.environ) -> Self:
        """The one that this process was started with: $WATCHDOG_USEC, if $WATCHDOG_PID is this process or not set."""
        microseconds = environment.get("WATCHDOG_USEC", "")
        ours = environment.get("WATCHDOG_PID", str(os.getpid())) == str(os.getpid())
        return cls(notifier, int(microseconds) * 1e-6 if ours and microseconds.isdecimal() and int(microseconds) else float("inf"))

    def progress(self, now_s: float) -> None:
        """Called in each turn of the loop; sends at most every third of the timeout."""
        if now_s >= self._due_s:
            self._due_s = now_s + self._period_s
            self._notifier.alive()


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


def _line(text: str) -> str:
    return " ".join(text.split())
