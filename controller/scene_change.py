"""Another scene, and a bank that was replaced, while the loop goes on: prepared by a child process, taken over at once."""

from __future__ import annotations

import os
import pickle
import subprocess
import sys
from pathlib import Path

from controller.bank.reader import Bank
from controller.bank.selection import Selection
from controller.board import Board
from controller.errors import ConfigError, ControllerError
from controller.scene_source import Prepared

CHUNK_BYTES = 1 << 16


class SceneChanger:
    """`SceneChange` by a child process.

    Parameters
    ----------
    board : Board
    name : str
        Of the scene that is played.
    bank : Bank
        That it is played from.
    """

    def __init__(self, board: Board, name: str, bank: Bank) -> None:
        self._board = board
        self._name = name
        self._bank = bank
        self._bank_is = _identity(bank.path)
        self._child: subprocess.Popen[bytes] | None = None
        self._wanted = ("", 0)
        self._again = False
        self._failed: Prepared | None = None
        self._said = bytearray()

    def begin(self, name: str | None, ticket: int) -> None:
        """Prepare a scene; None: the one that is played, read again.

        Raises
        ------
        ConfigError
            If another is being prepared for somebody: what was asked for last would not be what is answered. A reload
            is put off until then.
        """
        if self._child is not None:
            if ticket:
                raise ConfigError("another scene is being prepared: ask again when it is there")
            self._again = True
            return
        self._wanted = (self._name if name is None else name, ticket)
        self._said.clear()
        command = [sys.executable, "-m", "controller.prepare_scene", str(self._board.folder), self._wanted[0], str(self._bank.path)]
        try:
            self._child = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE)
        except OSError as error:  # no memory, no processes left
            self._failed = Prepared(ticket, None, reason=f"no process to prepare a scene: {error.strerror}")
            return
        assert self._child.stdout is not None
        os.set_blocking(self._child.stdout.fileno(), False)

    def fileno(self) -> int | None:
        """Readable when the child has said something; None while there is none."""
        return None if self._child is None or self._child.stdout is None else self._child.stdout.fileno()

    def take(self) -> Prepared | None:
        """What was prepared; None while it is not done."""
        failed, self._failed = self._failed, None
        if failed is not None:
            return failed
        child = self._child
        if child is None or child.stdout is None:
            return None
        try:
            while data := os.read(child.stdout.fileno(), CHUNK_BYTES):
                self._said += data
        except BlockingIOError:
            return None
        child.stdout.close()
        child.wait()  # it has closed its output, and ends
        self._child = None
        prepared = self._prepared()
        if self._again:
            self._again = False
            self.begin(None, 0)
        return prepared

    def close(self) -> None:
        """End a child that still works."""
        if self._child is not None:
            self._child.kill()
            self._child.wait()
            if self._child.stdout is not None:
                self._child.stdout.close()
            self._child = None

    def _prepared(self) -> Prepared:
        name, ticket = self._wanted
        try:
            said = pickle.loads(bytes(self._said))  # of our own child
        except (pickle.UnpicklingError, EOFError):
            return Prepared(ticket, None, reason=f"preparing the scene {name!r} failed: see the log")
        if isinstance(said, str):
            return Prepared(ticket, None, reason=said)
        self._name = name
        bank_is = _identity(self._bank.path)
        if bank_is == self._bank_is:
            return Prepared(ticket, said)
        try:
            bank = Bank.open(self._bank.path, self._board)
            selection = Selection(bank, self._board.bank.snap_mm * 1e-3, self._board.idle_word)
            selection.prepare()
        except ControllerError as error:
            return Prepared(ticket, None, reason=str(error))
        self._bank, self._bank_is = bank, bank_is
        return Prepared(ticket, said, selection)


def _identity(path: Path) -> tuple[int, ...]:
    """What tells a file from one that has taken its place; of one that is gone nothing."""
    try:
        at = path.stat()
    except OSError:
        return ()
    return at.st_dev, at.st_ino, at.st_mtime_ns, at.st_size
