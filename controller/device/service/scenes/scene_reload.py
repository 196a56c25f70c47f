"""Loading of another scene, or of a replaced bank, while the loop runs: a helper process prepares it, the loop takes it over.

Nothing here blocks.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import msgspec

from controller.device.bank.expectation import Expectation
from controller.device.bank.file_format import Header
from controller.device.bank.reader import Bank
from controller.device.board.board import Board
from controller.device.loop.preparation import PreparedScene
from controller.device.scene.scene import Scene
from controller.device.scene.scene_file import find_scene
from controller.device.service.scenes.helper_process import Helper
from controller.device.service.scenes.scene_message import pack_request, unpack_scene
from controller.device.waveforms.wide_selection import selection_of
from controller.errors import ConfigError, ControllerError

LIMIT_S = 30.0  # time limit of one preparation; the bank may have to be read from a slow card


class SceneChanger:
    """A `SceneChange` that starts and uses a helper process.

    `name` is the name or path of the scene in force; `limit_s` is the time limit of one preparation. Raises ConfigError if there is
    no such scene.
    """

    def __init__(
        self,
        board: Board,
        name: str,
        bank: Bank,
        limit_s: float = LIMIT_S,
        expect: Callable[[Header], Expectation | None] = lambda _: None,  # of what a bank says, what it will do here
    ) -> None:
        self._board = msgspec.structs.replace(board, folder=board.folder.absolute())
        self._name = str(find_scene(board, name).absolute())
        self._bank, self._expect = bank, expect
        self._bank_is = _identity(bank.path)
        self.helper = Helper("scenes", limit_s, "prepares scenes")
        self.fileno = self.helper.fileno
        self.close = self.helper.process.close
        self._wanted, self._ticket, self._saves = "", 0, False  # what was asked for last
        self._again = False

    @property
    def name(self) -> str:
        """Name of the scene in force: that of its file, without ending."""
        return Path(self._name).stem

    def begin(self, name: str | None, ticket: int) -> None:
        """Prepare a scene; None: read the scene in force again.

        Raises ConfigError if another scene is being prepared; a reload (ticket 0) is instead deferred until that is done.
        """
        if self.helper.asked and not ticket:
            self._again = True
            return
        self._ask(self._name if name is None else name, ticket, None)

    def save(self, name: str, toml: str, ticket: int) -> None:
        """Save a scene for this board, to be found by `begin`; raises ConfigError if a scene is being prepared or saved."""
        self._ask(name, ticket, toml)

    def _ask(self, name: str, ticket: int, toml: str | None) -> None:
        if self.helper.asked:
            raise ConfigError("another scene is being prepared: ask again when it is there")
        self._wanted, self._ticket, self._saves = name, ticket, toml is not None
        self.helper.ask(pack_request(self._board, name, self._bank.path.absolute(), toml))

    def take(self) -> PreparedScene | None:
        """The prepared scene, or why it was refused; None while it is not ready."""
        said = self.helper.take(unpack_scene)
        if said is None:
            return None
        if isinstance(said, str):
            prepared = PreparedScene(self._ticket, None, reason=said, saves=self._saves)
        else:
            prepared = self._prepared(said)
        if self._again:
            self._again = False
            self.begin(None, 0)
        return prepared

    def _prepared(self, scene: Scene) -> PreparedScene:
        self._name = self._wanted
        bank_is = _identity(self._bank.path)
        if bank_is == self._bank_is:
            return PreparedScene(self._ticket, scene)
        board = self._board
        try:
            bank = Bank.open(self._bank.path, board)
            selection = selection_of(bank, board, bank.snap_m(board))
            selection.prepare()
        except ControllerError as error:
            return PreparedScene(self._ticket, None, reason=str(error))
        self._bank, self._bank_is = bank, bank_is
        return PreparedScene(self._ticket, scene, selection, expected=self._expect(bank.header))


def _identity(path: Path) -> tuple[int, ...]:
    """Device, inode, time and size, which differ from those of a file that replaces it; empty if the file is gone."""
    try:
        at = path.stat()
    except OSError:
        return ()
    return at.st_dev, at.st_ino, at.st_mtime_ns, at.st_size
