"""The process that prepares scenes for the event loop: of ordinary priority, started before the loop gets real-time priority.

It reads requests from its standard input, a socket, and forks a child for each one. The child has limits of time and memory,
holds nothing of the loop, and ends with its answer. Each request gets exactly one answer, even if its child hangs, exceeds
its limits or dies. The process ends when the loop closes the socket.
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
import time
from pathlib import Path

from controller.device.service.scenes.message_frame import HEADER, MOST_BYTES, board_of, length
from controller.device.service.scenes.prepare_scene import prepare
from controller.device.service.scenes.saved_scene import BYTES_MAX, save_scene
from controller.device.service.scenes.scene_message import pack_refusal, pack_saved, pack_scene, unpack_request
from controller.errors import ControllerError

MEMORY_BYTES = 256 << 20  # limit for a preparation, in addition to the bank's size
PR_SET_PDEATHSIG = 1  # linux/prctl.h
CHUNK_BYTES = 1 << 16


def serve(loop: socket.socket, limit_s: float) -> None:
    """Answer requests until the other end of the socket is closed.

    `loop` is a stream to the loop; `limit_s` is the time limit of one preparation.
    """
    while (request := receive(loop)) is not None:
        pid, pipe = _begin(request, loop, limit_s)
        try:
            answer = _wait(pipe, loop, limit_s)
        finally:
            os.close(pipe)
            os.kill(pid, signal.SIGKILL)  # it has ended, or must end now
            _, status = os.waitpid(pid, 0)
        if answer is None:
            return
        if not _whole(answer):
            answer = pack_refusal(f"preparing the scene failed: {_in_words(status)}; see the log")
        loop.sendall(answer)


def receive(loop: socket.socket) -> bytes | None:
    """The next message of the loop; None once the socket is closed."""
    message = bytearray()
    while lacking := HEADER.size - len(message) + (length(message) if len(message) >= HEADER.size else 0):
        more = loop.recv(min(lacking, CHUNK_BYTES))
        if not more:
            return None
        message += more
    return bytes(message)


def _begin(request: bytes, loop: socket.socket, limit_s: float) -> tuple[int, int]:
    """Fork a child for a request; returns its process id, and the pipe to read its answer from."""
    reads, writes = os.pipe()
    pid = os.fork()
    if pid:
        os.close(writes)
        return pid, reads
    try:  # no exception may leave the child's branch
        ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
        loop.close()
        os.close(reads)
        _write(writes, _work(request, limit_s))
    finally:
        os._exit(0)


def _work(request: bytes, limit_s: float) -> bytes:
    """The answer to a request; any error becomes a refusal."""
    try:
        asked = unpack_request(request)
        board, bank = board_of(asked.board), Path(asked.bank)
        limit_memory(bank, 0 if asked.toml is None else BYTES_MAX)
        _lower(resource.RLIMIT_CPU, math.ceil(limit_s) + 1)  # `_wait` reports the time limit before this applies
        os.chdir(board.folder)  # plain names of scenes are looked up here
        if asked.toml is None:
            return pack_scene(prepare(board, asked.scene, bank))
        save_scene(board, asked.scene, asked.toml)
        return pack_saved()
    except ControllerError as error:
        return pack_refusal(str(error))
    except MemoryError:
        return pack_refusal(f"preparing the scene takes more memory than {MEMORY_BYTES >> 20} MB beside the bank")
    except Exception as error:  # whatever it is, the answer is one line, and the scene before stays in force
        return pack_refusal(f"preparing the scene failed: {type(error).__name__}: {error}")


def limit_memory(bank: Path, file_bytes: int = 0) -> None:
    """Limit memory and files of this process to what it needs; when memory runs out, the kernel ends this process first.

    `file_bytes` are those of the largest file that it may write.
    """
    with contextlib.suppress(OSError):
        Path("/proc/self/oom_score_adj").write_text("1000", encoding="ascii")
    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0])
    with contextlib.suppress(FileNotFoundError):
        _lower(resource.RLIMIT_AS, pages * resource.getpagesize() + bank.stat().st_size + MEMORY_BYTES)
    _lower(resource.RLIMIT_FSIZE, file_bytes)
    _lower(resource.RLIMIT_CORE, 0)


def _lower(which: int, most: int) -> None:
    hard = resource.getrlimit(which)[1]
    most = most if hard == resource.RLIM_INFINITY else min(most, hard)
    resource.setrlimit(which, (most, most))


def _write(pipe: int, answer: bytes) -> None:
    while answer:
        answer = answer[os.write(pipe, answer) :]


def _wait(pipe: int, loop: socket.socket, limit_s: float) -> bytes | None:
    """Output of the child, until it ends, exceeds the size of an answer or the time limit; None if the loop has ended meanwhile."""
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
