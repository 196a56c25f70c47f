"""Loading of another scene, or of a replaced bank, while the loop runs: a helper process prepares it, the loop takes it over.

Nothing here blocks.
"""

from __future__ import annotations

import time
from pathlib import Path

import msgspec

from controller.device.bank.reader import Bank
from controller.device.board.board import Board
from controller.device.loop.scene_source import PreparedScene
from controller.device.scene.scene import Scene
from controller.device.scene.scene_file import find_scene
from controller.device.service.scenes.helper_process import HelperProcess
from controller.device.service.scenes.message_frame import HEADER, MessageError, length
from controller.device.service.scenes.scene_message import pack_request, unpack_scene
from controller.device.waveforms.selection import Selection
from controller.errors import ConfigError, ControllerError

LIMIT_S = 30.0  # time limit of one preparation; the bank may have to be read from a slow card
GRACE_S = 5.0  # after that limit, until the helper itself counts as hanging


class SceneChanger:
    """A `SceneChange` that starts and uses a helper process.

    `name` is the name or path of the scene in force; `limit_s` is the time limit of one preparation. Raises ConfigError if there is
    no such scene.
    """

    def __init__(self, board: Board, name: str, bank: Bank, limit_s: float = LIMIT_S) -> None:
        self._board = msgspec.structs.replace(board, folder=board.folder.absolute())
        self._name = str(find_scene(board, name).absolute())
        self._bank = bank
        self._bank_is = _identity(bank.path)
        self._limit_s = limit_s
        self._helper = HelperProcess("scenes", limit_s)
        self._wanted: tuple[str, int] | None = None
        self._saves = False
        self._request = b""
        self._asked_again = False
        self._until_s = 0.0
        self._again = False
        self._failed: PreparedScene | None = None
        self._said = bytearray()
        self._helper.start()

    @property
    def name(self) -> str:
        """Name of the scene in force: that of its file, without ending."""
        return Path(self._name).stem

    @property
    def pid(self) -> int:
        """Process id of the helper."""
        return self._helper.pid

    def begin(self, name: str | None, ticket: int) -> None:
        """Prepare a scene; None: read the scene in force again.

        Raises ConfigError if another scene is being prepared; a reload (ticket 0) is instead deferred until that is done.
        """
        if self._wanted is not None and not ticket:
            self._again = True
            return
        self._ask(self._name if name is None else name, ticket, None)

    def save(self, name: str, toml: str, ticket: int) -> None:
        """Save a scene for this board, to be found by `begin`; raises ConfigError if a scene is being prepared or saved."""
        self._ask(name, ticket, toml)

    def _ask(self, name: str, ticket: int, toml: str | None) -> None:
        if self._wanted is not None:
            raise ConfigError("another scene is being prepared: ask again when it is there")
        self._wanted, self._saves = (name, ticket), toml is not None
        self._until_s = time.monotonic() + self._limit_s + GRACE_S
        self._request = pack_request(self._board, name, self._bank.path.absolute(), toml)
        self._said.clear()
        self._asked_again = False
        if not self._helper.send(self._request):
            self._ask_again()

    def fileno(self) -> int | None:
        """File that is readable when the helper has answered; None while nothing is being prepared."""
        return None if self._wanted is None else self._helper.fileno()

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
        self._helper.close()

    def _ask_again(self) -> None:
        """The helper has died: start another one and repeat the request, once."""
        if self._asked_again:
            self._fail("the process that prepares scenes ends again and again")
            return
        self._asked_again = True
        self._said.clear()
        self._helper.end()
        self._helper.start()
        if not self._helper.send(self._request):
            self._fail("no process to prepare a scene")

    def _read(self) -> None:
        """Read a part of the helper's answer."""
        more = self._helper.receive()
        if more is None:
            if time.monotonic() > self._until_s:
                self._fail("the process that prepares scenes hangs, and was ended; ask again")
            return
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
        self._helper.end()
        self._failed = PreparedScene(self._wanted[1], None, reason=reason, saves=self._saves)

    def _prepared(self) -> PreparedScene:
        assert self._wanted is not None
        name, ticket = self._wanted
        try:
            said = unpack_scene(bytes(self._said))
        except MessageError as error:
            self._helper.end()  # its next answer could not be distinguished from the rest of this one
            return PreparedScene(ticket, None, reason=f"what prepares scenes answers wrongly: {error}", saves=self._saves)
        if not isinstance(said, Scene):
            return PreparedScene(ticket, None, reason=said, saves=self._saves)
        self._name = name
        bank_is = _identity(self._bank.path)
        if bank_is == self._bank_is:
            return PreparedScene(ticket, said)
        try:
            bank = Bank.open(self._bank.path, self._board)
            board = self._board
            selection = Selection(bank, bank.snap_m(board), board.idle_word, board.waveform.band_hz)
            selection.prepare()
        except ControllerError as error:
            return PreparedScene(ticket, None, reason=str(error))
        self._bank, self._bank_is = bank, bank_is
        return PreparedScene(ticket, said, selection)


def _identity(path: Path) -> tuple[int, ...]:
    """Device, inode, time and size, which differ from those of a file that replaces it; empty if the file is gone."""
    try:
        at = path.stat()
    except OSError:
        return ()
    return at.st_dev, at.st_ino, at.st_mtime_ns, at.st_size
