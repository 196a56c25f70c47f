"""Interfaces between the event loop and a source of commands; each command is answered exactly once."""

from __future__ import annotations

from collections.abc import Sequence
from enum import Enum
from typing import Any, Protocol

from controller.device.board.panel_state import Condition
from controller.device.loop.emission_ring import EmissionRing
from controller.device.loop.layer_source import LayerResult
from controller.device.scene.clips import ClientEffect
from controller.device.scene.layers import Placement
from controller.device.scene.scene import Scene
from controller.device.touch.source import Heard, TouchSample
from controller.metrics import Skipped


class Outcome(Enum):
    """What became of a command that plays an effect, or of a batch of emissions."""

    PLAYED = "played"  # the FPGA has accepted its first emission
    MERGED = "merged"  # a newer one for the same finger or place replaced it before the plate was free
    SKIPPED = "skipped"  # its finger was lifted, the bank lacks its waveform, or too many waited
    REFUSED = "refused"  # by the FPGA, or because the outputs went off


class PanelControl(Protocol):
    """What commands may ask of the loop."""

    emissions: EmissionRing  # the last ones, noted while they are wanted
    skipped: Skipped  # what was due and is not played

    def play(
        self, ticket: int, effect: str | ClientEffect, x_m: float, y_m: float, finger: int | None, amplitude: float, now_s: float
    ) -> None:
        """Play an effect at a point, or at a finger wherever it moves, `amplitude` times the effect's own, MIN_AMPLITUDE to 1.

        Exactly one `CommandSource.outcome` follows, with the ticket; 0: nobody waits for it. Raises ControllerError, and no
        outcome follows, if the outputs are off, or the effect or the finger is unknown.
        """

    def test_channel(self, ticket: int, channel: int, x_m: float, y_m: float, now_s: float) -> None:
        """Play a chirp on one channel alone, whose actuator is at the point; exactly one `CommandSource.outcome` follows.

        Raises ControllerError, and no outcome follows, if the outputs are off.
        """

    def fingers_in(self, owner: int, region: str) -> tuple[int, ...]:
        """Fingers in a region, by its name: of the layer of the client with this number, else of the scene.

        Raises ConfigError if neither has a region of this name.
        """

    def switch(self, *, on: bool, by: str = "a client") -> None:
        """Disarm the outputs, or arm them as soon as the FPGA allows it; `CommandSource.changed` reports when they are.

        A disarmed panel stays disarmed, through faults and reconnections, until it is switched on. `by` stands in the cause
        of its state.
        """

    def write_trace(self, reason: str) -> None:
        """Have written what the loop did in the last seconds, with the reason; the log says where.

        Raises ConfigError if nothing writes it.
        """

    def hear(self, heard: Heard | None) -> None:
        """Have the contacts of each report handed on as the touch panel has them, ghosts too; None: no longer."""

    def load_scene(self, ticket: int, name: str) -> None:
        """Prepare another scene outside the loop and take it over; `CommandSource.loaded` follows.

        Raises ControllerError, and `loaded` does not follow, if this panel cannot change its scene.
        """

    def save_scene(self, ticket: int, name: str, toml: str) -> None:
        """Check a scene.toml outside the loop and keep it, so that `load_scene` finds it; `CommandSource.loaded` follows.

        Raises ControllerError, and `loaded` does not follow, if this panel cannot change its scene.
        """

    def put_layer(self, ticket: int, owner: int, line: bytes, placement: Placement | None, now_s: float) -> None:
        """Replace a client's layer of regions, once it is checked outside the loop; `CommandSource.layered` follows.

        The layer of a higher owner lies on top. `line` is JSON, as `layer_tables.read_layer` takes it. With no placement the
        layer lies where the one before lies. Raises ControllerError, and `layered` does not follow, if this panel takes no
        layers.
        """

    def move_layer(self, owner: int, placement: Placement) -> None:
        """Move a client's layer: at once, or with the one that is being prepared; ControllerError if it has sent none."""

    def drop_layer(self, owner: int, now_s: float) -> None:
        """Remove the layer of a client that has gone."""

    def figures(self) -> dict[str, Any]:
        """Counters and latencies so far, ready for JSON."""

    def scene(self) -> tuple[str, Scene]:
        """Name of the scene in force, empty if it has none, and the scene without clients' layers."""

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
        """Answer a command to load or save a scene: why it was refused, or empty if it was taken over or saved."""

    def scene_changed(self) -> None:
        """Take note that another scene is in force."""

    def layered(self, ticket: int, result: LayerResult) -> None:
        """Answer a command that replaces a layer."""

    def changed(self, condition: Condition) -> None:
        """Take note of the panel's condition: called once at the start, then after each change."""

    def close(self) -> None:
        """Disconnect all clients."""
