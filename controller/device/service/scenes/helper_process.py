"""A process beside the loop, started without waiting for it, and one request at a time to it; nothing here blocks.

It is started before the loop gets real-time priority: starting a program waits until the new process was scheduled, which can take
long for one of ordinary priority.
"""

from __future__ import annotations

import contextlib
import os
import signal
import socket
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from controller.device.kernel import start_program
from controller.device.service.scenes.message_frame import HEADER, MessageError, length

T = TypeVar("T")

GRACE_S = 5.0  # after the limit, until a helper counts as hanging: it may still be importing, or reading the bank from a slow card
CHUNK_BYTES = 1 << 16  # read in one turn of the loop
PROGRAM = (
    "import sys; sys.path.insert(0, {!r});"
    " from controller.device.service.scenes.scene_helper_process import main; main(sys.argv[1], float(sys.argv[2]))"
)


class HelperProcess:
    """One helper at a time; another one can be started in its place.

    `what` it prepares is a word that `scene_helper_process` knows; `limit_s` is the time limit of one preparation.
    """

    def __init__(self, what: str, limit_s: float) -> None:
        self.pid = 0  # process id of the last one started; 0: there was none
        self.socket: socket.socket | None = None
        self._arguments = (what, repr(limit_s))
        self._cpus = os.sched_getaffinity(0)
        self._gone: list[int] = []  # killed processes that were not waited for yet

    def fileno(self) -> int | None:
        """File that is readable when it answers or ends; None: there is no helper."""
        return None if self.socket is None else self.socket.fileno()

    def start(self) -> None:
        """Start a helper; on failure there is none."""
        try:
            ours, theirs = socket.socketpair()
        except OSError:  # no file is left: the loop goes on without
            return
        folder = str(Path(__file__).resolve().parents[4])
        command = [sys.executable, "-I", "-c", PROGRAM.format(folder), *self._arguments]
        pid = start_program(tuple(map(os.fsencode, command)), _environment(), theirs.fileno())
        theirs.close()
        if pid < 0:  # no memory, or too many processes
            ours.close()
            return
        with contextlib.suppress(OSError):  # it has ended already
            os.sched_setaffinity(pid, self._cpus)  # the loop may have its own core by now
        ours.setblocking(False)
        self.pid, self.socket = pid, ours

    def end(self) -> None:
        """Kill the helper, without waiting for its end."""
        if self.socket is not None:
            self.socket.close()
            self.socket = None
            os.kill(self.pid, signal.SIGKILL)
            self._gone.append(self.pid)
        self._gone = [pid for pid in self._gone if os.waitpid(pid, os.WNOHANG) == (0, 0)]

    def close(self) -> None:
        """End the helper, and wait until it has ended."""
        self.end()
        for pid in self._gone:
            os.waitpid(pid, 0)
        self._gone.clear()

    def send(self, message: bytes) -> bool:
        """Send a whole message; False: there is no helper, or it takes no more."""
        try:
            return self.socket is not None and self.socket.send(message, socket.MSG_NOSIGNAL) == len(message)
        except OSError:
            return False

    def receive(self) -> bytes | None:
        """What it has sent, at most a chunk; None: nothing yet; empty: it has ended."""
        if self.socket is None:
            return b""
        try:
            return self.socket.recv(CHUNK_BYTES)
        except BlockingIOError:
            return None
        except OSError:
            return b""


class Helper:
    """Asks a helper process, one request after the other; one that dies is replaced and asked again, once.

    `does` is what it does, for messages; `first` is a message that each new process gets before any request.
    """

    def __init__(self, what: str, limit_s: float, does: str, first: bytes = b"") -> None:
        self.process = HelperProcess(what, limit_s)
        self.asked = False  # and not answered yet
        self._limit_s = limit_s
        self._does, self._first = does, first
        self._request, self._said, self._failure = b"", bytearray(), ""
        self._again, self._until_s = False, 0.0
        self._restart()

    def ask(self, request: bytes) -> None:
        """Begin a request."""
        self.asked, self._again, self._request, self._failure = True, False, request, ""
        self._said.clear()
        self._wait_until()
        if not self.process.send(request):
            self._ask_again()

    def fileno(self) -> int | None:
        """File that is readable when it has answered; None while nothing is asked."""
        return self.process.fileno() if self.asked else None

    def take(self, unpack: Callable[[bytes], T]) -> T | str | None:
        """The answer, once for each request, or why there is none; None while it is not there."""
        if not self.asked:
            return None
        if not self._failure:
            self._read()
        answer: T | str = self._failure
        if not answer:
            try:
                if len(self._said) < HEADER.size or len(self._said) < HEADER.size + length(self._said):
                    return None
                answer = unpack(bytes(self._said))
            except MessageError as error:
                self._restart()  # its next answer could not be distinguished from the rest of this one
                answer = f"what {self._does} answers wrongly: {error}"
        self.asked = False
        return answer

    def _restart(self) -> None:
        self.process.end()
        self.process.start()
        if self._first:
            self.process.send(self._first)

    def _wait_until(self) -> None:
        """Begin to wait for an answer: for the limit and the grace, and as long as the process has no processor meanwhile."""
        self._until_s = time.monotonic() + self._limit_s + GRACE_S - starved_s(self.process.pid)

    def _ask_again(self) -> None:
        self._restart()
        self._said.clear()
        self._wait_until()
        if self._again:
            self._failure = f"the process that {self._does} ends again and again"
        elif not self.process.send(self._request):
            self._failure = f"there is no process that {self._does}"
        self._again = True

    def _read(self) -> None:
        """Read a part of the answer."""
        more = self.process.receive()
        if more:
            self._said += more
        elif more is not None:
            self._ask_again()
        elif (now_s := time.monotonic()) > self._until_s and now_s > self._until_s + starved_s(self.process.pid):
            self._restart()
            self._failure = f"the process that {self._does} hangs, and was ended; ask again"


def starved_s(pid: int) -> float:
    """Time since its start for which a process was ready to run and had no processor; 0 if the kernel does not count it.

    A busy computer starts a helper of low priority late; it does not hang. proc(5), /proc/PID/schedstat: its second number, in ns.
    """
    try:
        return int(Path(f"/proc/{pid}/schedstat").read_text(encoding="ascii").split()[1]) * 1e-9
    except (OSError, IndexError, ValueError):
        return 0.0


def _environment() -> tuple[bytes, ...]:
    """Environment of the helper: without the service manager's variables, with OpenBLAS limited to one thread."""
    notify = {b"NOTIFY_SOCKET", b"WATCHDOG_USEC", b"WATCHDOG_PID", b"OPENBLAS_NUM_THREADS"}
    kept = (name + b"=" + value for name, value in os.environb.items() if name not in notify)
    return (*kept, b"OPENBLAS_NUM_THREADS=1")
