"""Program of the processes that prepare scenes (`scene_helper`) and layers (`layer_helper`): it imports that at the first message.

Until then, which for scenes may be for ever, it holds 10 MB and has cost 20 ms of processor time.
"""

from __future__ import annotations

import contextlib
import os
import resource
import signal
import socket

NICE = 5
MOST_FILES = 1 << 20  # to close, if their number is unlimited


def main(what: str, limit_s: float) -> None:
    """Serve the socket on standard input: "scenes" or "layers" are prepared, each within `limit_s`."""
    files = resource.getrlimit(resource.RLIMIT_NOFILE)[0]
    os.closerange(3, MOST_FILES if files == resource.RLIM_INFINITY else files)  # of libraries, whose files an exec does not close
    # Meant for the loop, with which this process ends.
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGUSR1):
        signal.signal(number, signal.SIG_IGN)
    with contextlib.suppress(PermissionError):  # a sandbox may forbid it
        os.nice(NICE)
    with socket.socket(fileno=0) as loop, contextlib.suppress(ConnectionError):
        if not loop.recv(1, socket.MSG_PEEK):
            return  # the loop has ended
        if what == "layers":
            from controller.device.service.scenes.layer_helper import serve_layers  # noqa: PLC0415

            serve_layers(loop, limit_s)
        else:
            from controller.device.service.scenes.scene_helper import serve  # noqa: PLC0415

            serve(loop, limit_s)
