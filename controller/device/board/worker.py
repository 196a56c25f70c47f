"""A helper process for reads that may block, such as on an I2C bus that hangs; the event loop never waits for it."""

from __future__ import annotations

import contextlib
import socket
import subprocess
import sys
from collections.abc import Sequence

from controller.errors import ControllerError

MAX_MESSAGE_BYTES = 16384  # a report of ten contacts has 1 kB
END_S = 0.5  # wait for its end; a process whose bus hangs ends later, by itself or by systemd


class WorkerEnded(ControllerError):
    """A helper process that the loop needs has ended; the service ends too, and systemd restarts it as a whole."""


class Worker:
    """The event loop's end of a helper process. Messages keep their boundaries (SOCK_SEQPACKET).

    Create it before the loop gets real-time priority: the process starts with ordinary priority and sets its own. Its standard
    input is the other end of the socket; it ends when that is closed.

    `arguments` are the Python interpreter's, which does not import modules from the working directory (-P).
    """

    def __init__(self, arguments: Sequence[str]) -> None:
        self._socket, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        with theirs:
            self._process = subprocess.Popen([sys.executable, "-P", *arguments], stdin=theirs.fileno())
        self._socket.setblocking(False)
        self._buffer = memoryview(bytearray(MAX_MESSAGE_BYTES))

    def fileno(self) -> int:
        """File that is readable when there is a message, or when the process has ended."""
        return self._socket.fileno()

    def receive(self) -> memoryview | None:
        """The next message, valid until the next call; None if there is none; raises WorkerEnded if the process has ended."""
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
        """Send a message; it is dropped if the socket is full or closed."""
        with contextlib.suppress(OSError):
            self._socket.send(message)

    def close(self) -> None:
        """End the process."""
        self._socket.close()
        self._process.kill()
        with contextlib.suppress(subprocess.TimeoutExpired):
            self._process.wait(END_S)
