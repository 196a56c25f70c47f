"""Interface of a source of commands for the event loop (`control`); each command is answered exactly once."""

from __future__ import annotations

from collections.abc import Sequence
from enum import Enum
from typing import TYPE_CHECKING, Protocol

from controller.device.board.panel_state import Condition
from controller.device.loop.preparation import LayerResult
from controller.device.touch.source import TouchSample

if TYPE_CHECKING:
    from controller.device.loop.control import PanelControl


class Outcome(Enum):
    """What became of a command that plays an effect, or of a batch of emissions."""

    PLAYED = "played"  # the FPGA has accepted its first emission
    MERGED = "merged"  # a newer one for the same finger or place replaced it before the plate was free
    SKIPPED = "skipped"  # its finger was lifted, the bank lacks its waveform, or too many waited
    REFUSED = "refused"  # by the FPGA, or because the outputs went off


class CommandSource(Protocol):
    """Source of commands for a `PanelControl`, to which the outcomes are reported."""

    def fileno(self) -> int:
        """File to wait on for reading."""

    def next_time_s(self) -> float:
        """Host time at which to call `serve` even if the file is not readable; inf: never."""

    def serve(self, now_s: float, control: PanelControl) -> None:
        """Read a bounded part of what clients sent, and answer what can be answered at once."""

    def touches(self, samples: Sequence[TouchSample]) -> None:
        """Send touch samples to the clients that subscribed to them."""

    def outcome(self, ticket: int, outcome: Outcome, age_s: float) -> None:
        """Answer a command to play, `age_s` after it was given."""

    def loaded(self, ticket: int, reason: str) -> None:
        """Answer a command to load or save a scene: why it was refused, or empty if it was taken over or saved."""

    def scene_changed(self) -> None:
        """Take note that another scene is in force."""

    def layered(self, ticket: int, result: LayerResult) -> None:
        """Answer a command that replaces a layer."""

    def changed(self, condition: Condition) -> None:
        """Take note of the panel's condition: called once at the start, then after each change."""

    def close(self) -> None:
        """Disconnect all clients."""
