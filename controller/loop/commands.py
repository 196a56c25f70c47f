"""Interfaces between the event loop and a source of commands; each command is answered exactly once."""

from __future__ import annotations

from collections.abc import Sequence
from enum import Enum
from typing import Any, Protocol

from controller.board.panel_state import Condition
from controller.touch.source import TouchSample


class Outcome(Enum):
    """What became of a command that plays an effect, or of a batch of emissions."""

    PLAYED = "played"  # the FPGA has accepted its first emission
    MERGED = "merged"  # a newer one for the same finger or place replaced it before the plate was free
    SKIPPED = "skipped"  # its finger was lifted, the bank lacks its waveform, or too many waited
    REFUSED = "refused"  # by the FPGA, or because the outputs went off


class PanelControl(Protocol):
    """What commands may ask of the loop."""

    def play(self, ticket: int, effect: str, x_m: float, y_m: float, finger: int | None, amplitude: float, now_s: float) -> None:
        """Play an effect at a point, or at a finger wherever it moves; exactly one `CommandSource.outcome` follows.

        Parameters
        ----------
        ticket : int
            Above 0; the outcome is reported with it.
        effect : str
            One of `effects`.
        x_m, y_m : float
            Place on the plate; unused with a finger.
        finger : int or None
        amplitude : float
            0.25 to 1, times the effect's own.
        now_s : float
            Host time of the command.

        Raises
        ------
        ControllerError
            If the outputs are off, or the effect or the finger is unknown. No outcome follows then.
        """

    def switch(self, on: bool) -> None:
        """Disarm the outputs, or arm them as soon as the FPGA allows it; `CommandSource.changed` tells when they are.

        A disarmed panel stays disarmed, through faults and reconnections, until it is switched on.
        """

    def load_scene(self, ticket: int, name: str) -> None:
        """Prepare another scene outside the loop and take it over; `CommandSource.loaded` follows.

        Raises
        ------
        ControllerError
            If this panel cannot change its scene. `loaded` does not follow then.
        """

    def figures(self) -> dict[str, Any]:
        """Counters and latencies so far, ready for JSON."""

    def effects(self) -> tuple[str, ...]:
        """Names of the effects that `play` accepts."""


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
        """Answer a command to load a scene: why it was refused, or empty if it was taken over."""

    def changed(self, condition: Condition) -> None:
        """Take note of the panel's condition: called once at the start, then after each change."""

    def close(self) -> None:
        """Disconnect all clients."""
