"""Between the event loop and what prepares another scene for it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from controller.scene.scene import Scene
from controller.waveforms.selection import Selection


@dataclass(frozen=True, slots=True)
class PreparedScene:
    """Another scene and, if that has changed, the bank to play it from; or why there is none."""

    ticket: int
    scene: Scene | None
    selection: Selection | None = None
    reason: str = ""


class SceneChange(Protocol):
    """Prepares another scene outside the loop."""

    def begin(self, name: str | None, ticket: int) -> None:
        """Prepare the scene of this name; None: the one that is played, read again."""

    def fileno(self) -> int | None:
        """Readable when it is done; None while nothing is prepared."""

    def take(self) -> PreparedScene | None:
        """What was prepared; None while it is not done."""
