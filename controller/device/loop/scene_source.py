"""Interface between the event loop and what prepares another scene for it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from controller.device.bank.expectation import Expectation
from controller.device.scene.scene import Scene
from controller.device.waveforms.selection import Selection


@dataclass(frozen=True, slots=True)
class PreparedScene:
    """A scene that was prepared, or why it was refused."""

    ticket: int  # of the command that asked for it; 0: SIGHUP
    scene: Scene | None  # None: refused
    selection: Selection | None = None  # of another bank, if that was replaced
    reason: str = ""  # why it was refused; empty if it was not
    expected: Expectation | None = None  # of that bank
    saves: bool = False  # it was to be saved only: the scene in force stays


class SceneChange(Protocol):
    """Prepares another scene in another process."""

    @property
    def name(self) -> str:
        """Name of the scene in force."""

    def begin(self, name: str | None, ticket: int) -> None:
        """Begin to prepare the scene of this name; None: the present one, read again; raises ControllerError if it cannot begin."""

    def save(self, name: str, toml: str, ticket: int) -> None:
        """Begin to save a scene under a name; raises ControllerError if it cannot begin."""

    def fileno(self) -> int | None:
        """File that becomes readable when it is done; None while nothing is being prepared."""

    def take(self) -> PreparedScene | None:
        """Take what was prepared; None while it is not done."""
