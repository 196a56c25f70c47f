"""Between the event loop and what gives it commands: each command is answered exactly once."""

from __future__ import annotations

from collections.abc import Sequence
from enum import Enum
from typing import Any, Protocol

from controller.board.panel_state import Condition
from controller.touch.source import TouchSample


class Outcome(Enum):
    """What became of a command to play."""

    PLAYED = "played"  # its first emission was triggered
    MERGED = "merged"  # a newer one for the same finger or place came before the plate was free
    SKIPPED = "skipped"  # its finger was lifted, or the bank has nothing there, or the plate had no room for it
    REFUSED = "refused"  # by the FPGA, or by a scene that does not know the effect


class PanelControl(Protocol):
    """What a command may ask of the loop."""

    def play(self, ticket: int, effect: str, x_m: float, y_m: float, finger: int | None, amplitude: float, now_s: float) -> None:
        """Play an effect at a point, or for a finger wherever it goes; exactly one `outcome` follows. A ticket is above 0.

        Raises
        ------
        ControllerError
            If it cannot be: the effect or the finger is unknown. No outcome follows then.
        """

    def switch(self, on: bool) -> None:
        """Have the outputs disarmed, or armed again as soon as the FPGA allows it; `changed` tells when they are.

        A panel that was disarmed stays so, whatever else happens to it, until it is switched on.
        """

    def load_scene(self, ticket: int, name: str) -> None:
        """Prepare another scene outside the loop and take it over; `loaded` follows."""

    def figures(self) -> dict[str, Any]:
        """Counters and latencies so far, ready for JSON."""

    def effects(self) -> tuple[str, ...]:
        """Names of the effects that `play` knows."""


class CommandSource(Protocol):
    """Gives commands to a `PanelControl`, and is told what became of them."""

    def fileno(self) -> int:
        """File to wait on for reading."""

    def next_time_s(self) -> float:
        """When to call `serve` though the file is not readable; inf: never."""

    def serve(self, now_s: float, control: PanelControl) -> None:
        """Read what clients sent, a bounded part of it, and answer what can be answered."""

    def touches(self, samples: Sequence[TouchSample]) -> None:
        """Tell those who asked for touches."""

    def outcome(self, ticket: int, outcome: Outcome, age_s: float) -> None:
        """Answer a command to play, `age_s` after it was given."""

    def loaded(self, ticket: int, reason: str) -> None:
        """Answer a command to load a scene; an empty reason: it was taken over."""

    def changed(self, condition: Condition) -> None:
        """Take note of how the panel is now: called once at the start, then whenever something of it has changed."""

    def close(self) -> None:
        """Let all clients go."""
