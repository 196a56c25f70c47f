"""The process that prepares scenes for the loop: started before real time begins, ordinary in all, and nice.

It waits for one request after the other on its standard input, a socket, and has each carried out by a child of its
own, which has limits of time and memory, sees nothing of the loop, and ends with its answer. What comes of it, also
of a child that hangs, grows or dies, is one message back; and the next request finds a new child. It ends when
the loop does.
"""

from __future__ import annotations

import contextlib
import ctypes
import math
import os
import resource
import select
import signal
import socket
import sys
import time
from pathlib import Path

from controller.errors import ControllerError
from controller.service.prepare_scene import prepare
from controller.service.scene_message import HEADER, MOST_BYTES, length, pack_refusal, pack_scene, unpack_request

NICE = 5
MEMORY_BYTES = 256 << 20  # that a preparation may take beside the bank
PR_SET_PDEATHSIG = 1  # linux/prctl.h
CHUNK_BYTES = 1 << 16


def serve(loop: socket.socket, limit_s: float) -> None:
    """Answer requests until the other end is closed.

    Parameters
    ----------
    loop : socket
        Stream, to the loop.
    limit_s : float
        For one preparation.
    """
    while (request := _receive(loop)) is not None:
        pid, pipe = _begin(request, loop, limit_s)
        try:
            answer = _wait(pipe, loop, limit_s)
        finally:
            os.close(pipe)
            os.kill(pid, signal.SIGKILL)  # it has ended, or has to
            _, status = os.waitpid(pid, 0)
        if answer is None:
            return
        if not _whole(answer):
            answer = pack_refusal(f"preparing the scene failed: {_in_words(status)}; see the log")
        loop.sendall(answer)


def _receive(loop: socket.socket) -> bytes | None:
    """The next request; None at the end."""
    message = bytearray()
    while len(message) < HEADER.size or len(message) < HEADER.size + length(message):
        more = loop.recv(CHUNK_BYTES)
        if not more:
            return None
        message += more
    return bytes(message)


def _begin(request: bytes, loop: socket.socket, limit_s: float) -> tuple[int, int]:
    """A child that works on a request: its number, and what to read its answer from."""
    reads, writes = os.pipe()
    pid = os.fork()
    if pid:
        os.close(writes)
        return pid, reads
    try:  # nothing of this process goes on in the child
        ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
        loop.close()
        os.close(reads)
        _write(writes, _work(request, limit_s))
    finally:
        os._exit(0)


def _work(request: bytes, limit_s: float) -> bytes:
    """The answer to a request, whatever happens."""
    try:
        asked = unpack_request(request)
        _limit(Path(asked.bank), limit_s)
        os.chdir(asked.board.folder)  # where plain names of scenes are looked up
        return pack_scene(prepare(asked.board, asked.scene, Path(asked.bank)))
    except ControllerError as error:
        return pack_refusal(str(error))
    except MemoryError:
        return pack_refusal(f"preparing the scene takes more memory than {MEMORY_BYTES >> 20} MB beside the bank")
    except Exception as error:  # whatever it is, it is told in a line, and the old scene plays on
        return pack_refusal(f"preparing the scene failed: {type(error).__name__}: {error}")


def _limit(bank: Path, limit_s: float) -> None:
    """Take what a preparation needs, and no more."""
    with contextlib.suppress(OSError):
        Path("/proc/self/oom_score_adj").write_text("1000", encoding="ascii")  # of all processes of the service this goes first
    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0])
    with contextlib.suppress(FileNotFoundError):
        _lower(resource.RLIMIT_AS, pages * resource.getpagesize() + bank.stat().st_size + MEMORY_BYTES)
    _lower(resource.RLIMIT_CPU, math.ceil(limit_s) + 1)  # it is told to have taken too long before
    _lower(resource.RLIMIT_FSIZE, 0)
    _lower(resource.RLIMIT_CORE, 0)


def _lower(which: int, most: int) -> None:
    hard = resource.getrlimit(which)[1]
    most = most if hard == resource.RLIM_INFINITY else min(most, hard)
    resource.setrlimit(which, (most, most))


def _write(pipe: int, answer: bytes) -> None:
    while answer:
        answer = answer[os.write(pipe, answer) :]


def _wait(pipe: int, loop: socket.socket, limit_s: float) -> bytes | None:
    """What the child says, until it ends, says too much or takes too long; None if the loop has ended meanwhile."""
    poll = select.poll()
    poll.register(pipe, select.POLLIN)
    poll.register(loop, select.POLLRDHUP)
    end_s = time.monotonic() + limit_s
    answer = bytearray()
    while len(answer) <= HEADER.size + MOST_BYTES:
        left_s = end_s - time.monotonic()
        ready = dict(poll.poll(max(left_s, 0.0) * 1e3))
        if loop.fileno() in ready:
            return None
        if not ready and left_s <= 0.0:
            return pack_refusal(f"preparing the scene took longer than {limit_s:g} s")
        if pipe in ready:
            more = os.read(pipe, CHUNK_BYTES)
            if not more:
                break
            answer += more
    return bytes(answer)


def _whole(answer: bytes) -> bool:
    try:
        return len(answer) == HEADER.size + length(answer)
    except ControllerError:
        return False


def _in_words(status: int) -> str:
    if os.WIFSIGNALED(status):
        return f"its process ended by {signal.Signals(os.WTERMSIG(status)).name}"
    return "its process ended without an answer"


def main() -> None:
    """Serve the socket on standard input; the only argument is the time limit in s."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):  # meant for the loop: this ends with it
        signal.signal(number, signal.SIG_IGN)
    with contextlib.suppress(PermissionError):  # a sandbox may forbid even that
        os.nice(NICE)
    with socket.socket(fileno=0) as loop, contextlib.suppress(ConnectionError):
        serve(loop, float(sys.argv[1]))
