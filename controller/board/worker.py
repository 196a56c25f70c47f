"""A process of its own for what may block, such as a bus that hangs: the loop never waits for its messages."""

from __future__ import annotations

import contextlib
import socket
import subprocess
import sys
from collections.abc import Sequence

from controller.errors import ControllerError

MESSAGE_BYTES = 16384  # the longest: a report of ten contacts is 1 kB
END_S = 0.5  # a process whose bus hangs cannot be ended before; systemd does it, or it ends by itself


class WorkerEnded(ControllerError):
    """A process that the loop needs has ended by itself: the service ends too, and is started again as a whole."""


class Worker:
    """The loop's end of such a process; messages keep their bounds.

    Started before real time begins: an ordinary process, which takes its own priority. It finds the other end at its
    standard input, and ends when that does.

    Parameters
    ----------
    arguments : sequence of str
        For the interpreter; code from the working directory is not among what it can import.
    """

    def __init__(self, arguments: Sequence[str]) -> None:
        self._socket, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        with theirs:
            self._process = subprocess.Popen([sys.executable, "-P", *arguments], stdin=theirs.fileno())
        self._socket.setblocking(False)
        self._buffer = memoryview(bytearray(MESSAGE_BYTES))

    def fileno(self) -> int:
        """Readable when there is a message, or the process has ended."""
        return self._socket.fileno()

    def receive(self) -> memoryview | None:
        """The next message, which holds until the next call; None if there is none.

        Raises
        ------
        WorkerEnded
            If none will come any more.
        """
        try:
            size = self._socket.recv_into(self._buffer)
        except BlockingIOError:
            return None
        except OSError:
            size = 0
        if not size:
            raise WorkerEnded(f"process {self._process.pid}, which reads a device for the loop, has ended: the log may say why")
        return self._buffer[:size]

    def send(self, message: bytes) -> None:
        """Send a message; one that finds no room, or nobody, is lost."""
        with contextlib.suppress(OSError):
            self._socket.send(message)

    def close(self) -> None:
        """End the process."""
        self._socket.close()
        self._process.kill()
        with contextlib.suppress(subprocess.TimeoutExpired):
            self._process.wait(END_S)
