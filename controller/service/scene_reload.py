"""Loading of another scene, or of a replaced bank, while the loop runs: a helper process prepares it, the loop takes it over.

Nothing here blocks. The helper (`scene_helper_process`) is started before the loop gets real-time priority: starting a program
waits until the new process was scheduled, which can take long for one of ordinary priority.
"""

from __future__ import annotations

import ctypes
import os
import resource
import signal
import socket
import sys
import time
from pathlib import Path

import msgspec

from controller.bank.reader import Bank
from controller.board.board import Board
from controller.errors import ConfigError, ControllerError
from controller.loop.scene_source import PreparedScene
from controller.scene.scene import Scene
from controller.scene.scene_file import find_scene
from controller.service.scene_message import HEADER, MessageError, length, pack_request, unpack_scene
from controller.waveforms.selection import Selection

LIMIT_S = 30.0  # time limit of one preparation; the bank may have to be read from a slow card
GRACE_S = 5.0  # after that limit, until the helper itself counts as hanging
CHUNK_BYTES = 1 << 16  # read in one turn of the loop
MOST_FILES = 1 << 20  # file descriptors to close in the helper if their number is unlimited
PROGRAM = "import sys; sys.path.insert(0, {!r}); from controller.service.scene_helper_process import main; main()"


class SceneChanger:
    """A `SceneChange` that starts and uses a helper process.

    Parameters
    ----------
    board : Board
    name : str
        Name or path of the scene in force.
    bank : Bank
        The bank in use.
    limit_s : float
        Time limit of one preparation, in s.

    Raises
    ------
    ConfigError
        If there is no such scene.
    """

    def __init__(self, board: Board, name: str, bank: Bank, limit_s: float = LIMIT_S) -> None:
        self._board = msgspec.structs.replace(board, folder=board.folder.absolute())
        self._name = str(find_scene(board, name).absolute())
        self._bank = bank
        self._bank_is = _identity(bank.path)
        self._limit_s = limit_s
        self._cpus = os.sched_getaffinity(0)
        self._pid = 0
        self._socket: socket.socket | None = None
        self._gone: list[int] = []  # killed processes that were not waited for yet
        self._wanted: tuple[str, int] | None = None
        self._request = b""
        self._asked_again = False
        self._until_s = 0.0
        self._again = False
        self._failed: PreparedScene | None = None
        self._said = bytearray()
        self._start()

    @property
    def pid(self) -> int:
        """Process id of the helper."""
        return self._pid

    def begin(self, name: str | None, ticket: int) -> None:
        """Prepare a scene; None: read the scene in force again.

        Raises
        ------
        ConfigError
            If another scene is being prepared; a reload (ticket 0) is instead deferred until that is done.
        """
        if self._wanted is not None:
            if ticket:
                raise ConfigError("another scene is being prepared: ask again when it is there")
            self._again = True
            return
        self._wanted = (self._name if name is None else name, ticket)
        self._until_s = time.monotonic() + self._limit_s + GRACE_S
        self._request = pack_request(self._board, self._wanted[0], self._bank.path.absolute())
        self._said.clear()
        self._asked_again = False
        if not self._send():
            self._ask_again()

    def fileno(self) -> int | None:
        """File that is readable when the helper has answered; None while nothing is being prepared."""
        return None if self._wanted is None or self._socket is None else self._socket.fileno()

    def take(self) -> PreparedScene | None:
        """The prepared scene, or why it was refused; None while it is not ready."""
        if self._wanted is not None and self._failed is None:
            self._read()
        failed, self._failed = self._failed, None
        if failed is None:
            if self._wanted is None or not self._complete():
                return None
            failed = self._prepared()
        self._wanted = None
        if self._again:
            self._again = False
            self.begin(None, 0)
        return failed

    def close(self) -> None:
        """End the helper."""
        self._end_helper()
        for pid in self._gone:
            os.waitpid(pid, 0)
        self._gone.clear()

    def _start(self) -> None:
        """Start a helper. fork does not wait for the new process; calls that start a program (vfork, posix_spawn) do."""
        ours, theirs = socket.socketpair()
        folder = str(Path(__file__).resolve().parent.parent.parent)
        command = [sys.executable, "-I", "-c", PROGRAM.format(folder), repr(self._limit_s)]
        files = resource.getrlimit(resource.RLIMIT_NOFILE)[0]
        files = MOST_FILES if files == resource.RLIM_INFINITY else files
        pid = _fork()
        if pid < 0:  # no memory, or too many processes
            ours.close()
            theirs.close()
            return
        if pid == 0:
            try:
                os.dup2(theirs.fileno(), 0)
                os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
                os.closerange(3, files)
                os.sched_setaffinity(0, self._cpus)  # the loop may have its own core by now
                os.execve(command[0], command, _environment())
            finally:
                os._exit(127)
        theirs.close()
        ours.setblocking(False)
        self._pid, self._socket = pid, ours

    def _end_helper(self) -> None:
        """Kill the helper, without waiting for its end."""
        if self._socket is not None:
            self._socket.close()
            self._socket = None
            os.kill(self._pid, signal.SIGKILL)
            self._gone.append(self._pid)
        self._gone = [pid for pid in self._gone if os.waitpid(pid, os.WNOHANG) == (0, 0)]

    def _send(self) -> bool:
        try:
            return self._socket is not None and self._socket.send(self._request, socket.MSG_NOSIGNAL) == len(self._request)
        except OSError:
            return False

    def _ask_again(self) -> None:
        """The helper has died: start another one and repeat the request, once."""
        if self._asked_again:
            self._fail("the process that prepares scenes ends again and again")
            return
        self._asked_again = True
        self._said.clear()
        self._end_helper()
        self._start()
        if not self._send():
            self._fail("no process to prepare a scene")

    def _read(self) -> None:
        """Read a part of the helper's answer."""
        if self._socket is None:
            return
        try:
            more = self._socket.recv(CHUNK_BYTES)
        except BlockingIOError:
            if time.monotonic() > self._until_s:
                self._fail("the process that prepares scenes hangs, and was ended; ask again")
            return
        except OSError:
            more = b""
        if not more:
            self._ask_again()
        self._said += more

    def _complete(self) -> bool:
        """Whether the answer is complete or invalid."""
        try:
            return len(self._said) >= HEADER.size and len(self._said) >= HEADER.size + length(self._said)
        except MessageError:
            return True

    def _fail(self, reason: str) -> None:
        assert self._wanted is not None
        self._end_helper()
        self._failed = PreparedScene(self._wanted[1], None, reason=reason)

    def _prepared(self) -> PreparedScene:
        assert self._wanted is not None
        name, ticket = self._wanted
        try:
            said = unpack_scene(bytes(self._said))
        except MessageError as error:
            self._end_helper()  # its next answer could not be told from the rest of this one
            return PreparedScene(ticket, None, reason=f"what prepares scenes answers wrongly: {error}")
        if not isinstance(said, Scene):
            return PreparedScene(ticket, None, reason=said)
        self._name = name
        bank_is = _identity(self._bank.path)
        if bank_is == self._bank_is:
            return PreparedScene(ticket, said)
        try:
            bank = Bank.open(self._bank.path, self._board)
            selection = Selection(bank, bank.snap_m(self._board), self._board.idle_word)
            selection.prepare()
        except ControllerError as error:
            return PreparedScene(ticket, None, reason=str(error))
        self._bank, self._bank_is = bank, bank_is
        return PreparedScene(ticket, said, selection)


def _fork() -> int:
    """Fork before an exec; below 0 on failure. _Fork does not run fork handlers; those of OpenBLAS would free its memory."""
    plain = getattr(ctypes.PyDLL(None), "_Fork", None)  # glibc 2.34
    if plain is not None:
        return int(plain())
    try:
        return os.fork()
    except OSError:
        return -1


def _environment() -> dict[str, str]:
    """Environment of the helper: without the service manager's variables, with OpenBLAS limited to one thread."""
    notify = {"NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID"}
    return {name: value for name, value in os.environ.items() if name not in notify} | {"OPENBLAS_NUM_THREADS": "1"}


def _identity(path: Path) -> tuple[int, ...]:
    """Device, inode, time and size, which differ from those of a file that replaces it; empty if the file is gone."""
    try:
        at = path.stat()
    except OSError:
        return ()
    return at.st_dev, at.st_ino, at.st_mtime_ns, at.st_size
