"""Program of the process that prepares scenes (`scene_helper`): it imports what that takes at the first request.

Until then, which may be for ever, it holds 10 MB and has cost 20 ms of processor time.
"""

from __future__ import annotations

import contextlib
import os
import signal
import socket
import sys

NICE = 5


def main() -> None:
    """Serve the socket on standard input; the argument is the time limit in s."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):  # meant for the loop, with which this process ends
        signal.signal(number, signal.SIG_IGN)
    with contextlib.suppress(PermissionError):  # a sandbox may forbid it
        os.nice(NICE)
    with socket.socket(fileno=0) as loop, contextlib.suppress(ConnectionError):
        if not loop.recv(1, socket.MSG_PEEK):
            return  # the loop has ended
        from controller.service.scene_helper import serve  # noqa: PLC0415

        serve(loop, float(sys.argv[1]))
