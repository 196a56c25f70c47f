"""What the panel sends to clients of the application socket: answers, and what they subscribed to, between the answers.

One JSON object per line; `kind` names the message. Lengths are in mm, ages in ms, `time_s` in s.
"""

from __future__ import annotations

from typing import Any, Literal

import msgspec
from msgspec import Struct

from controller.device.application_socket.protocol.client_messages import Id, Right
from controller.device.scene.layers import RefusedRegion

PROTOCOL = 1  # raised when a message changes so that a client has to know
Outcome = Literal["played", "merged", "skipped", "refused", "done"]


class Answer(Struct, frozen=True, kw_only=True, omit_defaults=True, tag_field="kind", tag="answer", gc=False):
    """Outcome of a request; `age_ms` is the time from a command to play to its outcome."""

    id: Id
    outcome: Outcome
    age_ms: float | None = None
    reason: str = ""


class Greeting(Struct, frozen=True, kw_only=True, tag_field="kind", tag="hello", gc=False):
    """Answer to `Hello`."""

    id: Id
    version: str
    board: str
    length_mm: float
    width_mm: float
    max_amplitude: float
    effects: tuple[str, ...]
    rights: tuple[Right, ...]


class LayerAnswer(Struct, frozen=True, kw_only=True, tag_field="kind", tag="layer", gc=False):
    """Answer to `Regions`: the layer is in force since now, `age_ms` after it had been read.

    `regions` are in it, `off_plate` of them as a whole off the plate. Of the `refused_count` others `refused` says the first.
    """

    id: Id
    regions: int
    off_plate: int
    age_ms: float
    refused: tuple[RefusedRegion, ...]
    refused_count: int


class FiguresAnswer(Struct, frozen=True, kw_only=True, tag_field="kind", tag="figures", gc=False):
    """Answer to `AskFigures`; at most a second old."""

    id: Id
    figures: dict[str, Any]


class Touch(Struct, frozen=True, kw_only=True, tag_field="kind", tag="touch", gc=False):
    """A finger was put down, moved or lifted; touches of one report have the same `time_s` (CLOCK_MONOTONIC)."""

    finger: int
    x_mm: float
    y_mm: float
    time_s: float
    contact: bool
    size_mm: float


class ContactNotice(Touch, frozen=True, kw_only=True, tag="contact", gc=False):
    """As `Touch`, of each contact as the touch panel has it, before it is decided which are fingers: ghosts too.

    `finger` is the source's own number, which may differ from that of the same finger as a `Touch`.
    """


class PlayedFocus(Struct, frozen=True, kw_only=True, omit_defaults=True, gc=False):
    """One focus of an emission that started at `time_s` (CLOCK_MONOTONIC): where it is, how strong, of which region or effect.

    `period_ms` of a fixed emitter: the FPGA repeats it until another emission starts, another scene is in force, or outputs go off.
    `expected_um`: least, expected and most that the finger feels, or without one that the plate moves at T; the truth lies between
    least and most with 95 %. Expected is null where the bank may be of another plate; all are left out near an edge.
    """

    time_s: float
    x_mm: float
    y_mm: float
    amplitude: float
    of: str
    finger: int | None = None
    period_ms: float | None = None
    expected_um: tuple[float, float | None, float] | None = None


class Emissions(Struct, frozen=True, kw_only=True, tag_field="kind", tag="emissions", gc=False):
    """What was played since the last such message, a thirtieth of a second before or longer, and what was due and was not.

    `skipped` counts the latter by cause, as in the figures; `lost` starts are not among the `foci`, since too many came.
    """

    foci: tuple[PlayedFocus, ...]
    skipped: dict[str, int]
    lost: int


class StateAnswer(Struct, frozen=True, kw_only=True, tag_field="kind", tag="state", gc=False):
    """State of the panel: the answer to `AskState` or, with an id of null, a notification to subscribers.

    `state` is a value of `panel_state.PanelState`; `cause` says why not everything works; `outputs_on` is false only once a status
    of the FPGA has said that there is no voltage at the actuators, or it has certainly switched off by itself; `temperature_c` is
    the plate's temperature, null if unknown.
    """

    id: Id = None
    state: str
    cause: str
    outputs_on: bool
    panel_present: bool
    temperature_c: float | None


class PatchPlace(Struct, frozen=True, gc=False):
    """A piezo patch: the FPGA's output that drives it, its centre and its edge length in mm."""

    channel: int
    x_mm: float
    y_mm: float
    size_mm: float


class Axes(Struct, frozen=True, gc=False):
    """How a touch panel's axes, 0 to 1, become millimetres: x_mm = a X + b Y + c, and so y_mm."""

    x_mm_from_axes: tuple[float, float, float]
    y_mm_from_axes: tuple[float, float, float]


class SceneRegion(Struct, frozen=True, gc=False):
    """A region of the scene: its name, its shape with the keys of a scene.toml, and on which occasions something is felt."""

    name: str
    shape: dict[str, Any]
    occasions: tuple[str, ...]


class ClientLimits(Struct, frozen=True, kw_only=True, gc=False):
    """What a client may ask for: the settings of the board's `application_socket`."""

    max_amplitude: float
    line_bytes: int
    commands_per_s: float
    burst: int
    layer_regions: int
    layer_bytes: int
    layers_per_s: float


class ClientCounts(Struct, frozen=True, gc=False):
    """Clients that are connected now, and all since the service started."""

    connected: int
    accepted: int


class FaultNotice(Struct, frozen=True, kw_only=True, tag_field="kind", tag="fault", gc=False):
    """The panel cannot play: since when (CLOCK_MONOTONIC), its state and the cause."""

    time_s: float
    state: str
    cause: str


class LogLine(Struct, frozen=True, kw_only=True, tag_field="kind", tag="log", gc=False):
    """A line of the service's log: when it was written (CLOCK_MONOTONIC), its priority as of syslog(3), its text."""

    time_s: float
    priority: int
    text: str


class Description(Struct, frozen=True, kw_only=True, tag_field="kind", tag="description", gc=False):
    """The panel: the answer to `Describe` or, with an id of null, a notification to subscribers.

    `release` is the name of the installed release, empty outside of one; `emission_ms` is how long one emission lasts; of the
    scene's `region_count` regions `regions` has the first, without those of clients; `faults` are the last 50, the oldest first.
    """

    id: Id
    protocol: int
    version: str
    release: str
    board: str
    board_digest: str
    length_mm: float
    width_mm: float
    emission_ms: float
    patches: tuple[PatchPlace, ...]
    axes: Axes
    scene: str
    regions: tuple[SceneRegion, ...]
    region_count: int
    effects: tuple[str, ...]
    limits: ClientLimits
    faults: tuple[FaultNotice, ...]
    clients: ClientCounts


class Farewell(Struct, frozen=True, kw_only=True, omit_defaults=True, tag_field="kind", tag="farewell", gc=False):
    """The panel ends the connection for `reason`; `lacks` is the right that the user does not have."""

    reason: str
    lacks: Right | None = None


Data = Greeting | FiguresAnswer | StateAnswer | Description
AnyMessage = Answer | LayerAnswer | Data | FaultNotice | Touch | ContactNotice | Emissions | LogLine | Farewell


def message_decoder() -> msgspec.json.Decoder[AnyMessage]:
    """Decoder of the lines that the panel sends."""
    return msgspec.json.Decoder(AnyMessage)
