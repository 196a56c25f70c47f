"""Messages of the application socket: one JSON object per line; `kind` names the message.

Every line of a client is answered exactly once, with the line's `id` (null if it has none that can be read). Touches and
states are sent between answers to clients that subscribed to them. Lengths are in mm, ages in ms, `time_s` in s. Unknown keys
are refused, so that a misspelt key is noticed.
"""

from __future__ import annotations

from typing import Annotated, Any, Literal

import msgspec
from msgspec import Meta, Raw, Struct

from controller.device.scene.layers import MOST_SHIFT_MM, RefusedRegion, Scale

LINE_BYTES = 8192  # longest line of a client, with its newline, but for `LONG`
PROTOCOL = 1  # raised when a message changes so that a client has to know

Id = Annotated[int, Meta(ge=-(2**53), le=2**53)] | Annotated[str, Meta(max_length=64)] | None
Word = Annotated[str, Meta(min_length=1, max_length=64)]
# Never a path: a client chooses among the installed scenes.
PlainName = Annotated[str, Meta(pattern=r"^[A-Za-z0-9][A-Za-z0-9_-]{0,63}\Z")]
BY_CHARACTERS = 120
LAST_CHANNEL = 127  # of a board of four FPGAs; a client needs no board
Right = Literal["look", "play", "regions", "operate"]
ShiftMm = Annotated[float, Meta(ge=-MOST_SHIFT_MM, le=MOST_SHIFT_MM)]
Topic = Literal["touches", "contacts", "emissions", "state", "description", "faults", "log"]
Outcome = Literal["played", "merged", "skipped", "refused", "done"]


def _empty() -> Raw:
    return Raw(b"{}")


class Request(Struct, frozen=True, kw_only=True, forbid_unknown_fields=True, tag_field="kind", gc=False):
    """A request; `id` is returned with its answer."""

    id: Id = None


class Aimed(Request, frozen=True, kw_only=True, gc=False):
    """A request for a place: a point (`x_mm` and `y_mm`), a finger as it moves (`finger`, as in `Touch`), or each in a `region`.

    The region is this client's own of that name, else the scene's. `amplitude` is a share of the full amplitude; null: the largest
    that the board allows to clients.
    """

    x_mm: float | None = None
    y_mm: float | None = None
    finger: Annotated[int, Meta(ge=0, le=2**53)] | None = None
    region: Word | None = None
    amplitude: float | None = None


class PlayRequest(Aimed, frozen=True, kw_only=True, tag="play", gc=False):
    """Play an effect of the scene or the library, or one that this client has sent as a `Clip` with that name."""

    effect: Word


class Clip(Aimed, frozen=True, kw_only=True, tag="clip", gc=False):
    """Play an effect that is sent along, with the keys of a scene's [effects.NAME], or keep it for this client, or both.

    With a `name` it is kept until another one of that name comes, or the client goes; with a place it is played there.
    """

    effect: Raw
    name: Word | None = None


class Subscribe(Request, frozen=True, kw_only=True, tag="subscribe", gc=False):
    """Send touches, emissions or faults from now on, state or description of the panel now and at each change, the log from now on.

    The log's last 50 lines come first. It is for operators, and so are contacts; touches and emissions are for who may play.
    """

    to: Annotated[tuple[Topic, ...], Meta(min_length=1, max_length=7)] = ("touches",)


class Unsubscribe(Request, frozen=True, kw_only=True, tag="unsubscribe", gc=False):
    """Send no more of what was subscribed to."""


class Describe(Request, frozen=True, kw_only=True, tag="describe", gc=False):
    """Request what the panel is and plays, as `Description`."""


class Transform(Struct, frozen=True, kw_only=True, forbid_unknown_fields=True, gc=False):
    """Where a client's layer lies: its point (x, y) is at (`x_mm` + `scale` x, `y_mm` + `scale` y) on the plate."""

    x_mm: ShiftMm = 0.0
    y_mm: ShiftMm = 0.0
    scale: Scale = 1.0


class Regions(Request, frozen=True, kw_only=True, tag="regions", gc=False):
    """Replace this client's layer of regions; answered when it is in force, as `LayerAnswer`.

    `regions` and `effects` are a scene's tables, checked beside the loop (`layer_tables.read_layer`); `transform` null: where the
    layer before lies.
    """

    regions: tuple[Raw, ...]
    effects: Raw = msgspec.field(default_factory=_empty)
    transform: Transform | None = None


class MoveRegions(Request, frozen=True, kw_only=True, tag="transform", gc=False):
    """Move this client's layer of regions, as `Transform` says, without describing it again."""

    x_mm: ShiftMm = 0.0
    y_mm: ShiftMm = 0.0
    scale: Scale = 1.0


class Arm(Request, frozen=True, kw_only=True, tag="arm", gc=False):
    """Switch the outputs on as soon as the FPGA allows it; `StateAnswer` reports when they are."""


class Disarm(Request, frozen=True, kw_only=True, tag="disarm", gc=False):
    """Ramp the outputs down to 0 V; they stay off until a client arms, whatever happens meanwhile."""


class Stop(Request, frozen=True, kw_only=True, tag="stop", gc=False):
    """As `Disarm`, for every client, whatever its rights and its rate: outputs off, and off they stay.

    `by`: for whom a client that speaks for others asks; log and state name it, behind the client's own user.
    """

    by: Annotated[str, Meta(max_length=BY_CHARACTERS, pattern=r"^[ -~]*\Z")] = ""


class ChannelTest(Request, frozen=True, kw_only=True, tag="test_channel", gc=False):
    """Play a chirp through the band on one channel alone: its patch moves and no other; answered as `PlayRequest`."""

    channel: Annotated[int, Meta(ge=0, le=LAST_CHANNEL)]


class WriteTrace(Request, frozen=True, kw_only=True, tag="trace", gc=False):
    """Write what the loop did in the last seconds to a file of the service's folder, which its log names."""


class AskState(Request, frozen=True, kw_only=True, tag="state", gc=False):
    """Request the panel's state, as `StateAnswer`."""


class LoadScene(Request, frozen=True, kw_only=True, tag="load_scene", gc=False):
    """Load another scene of the board by its name; answered when it is in force, or refused."""

    name: PlainName


class SaveScene(Request, frozen=True, kw_only=True, tag="save_scene", gc=False):
    """Check a scene.toml, sent as text, and keep it on the device, so that `LoadScene` finds it by this name.

    It replaces one that was saved under this name, never one of the board's own.
    """

    name: PlainName
    toml: str


class AskFigures(Request, frozen=True, kw_only=True, tag="figures", gc=False):
    """Request counters and latencies, as `FiguresAnswer`."""


class Hello(Request, frozen=True, kw_only=True, tag="hello", gc=False):
    """Request version, board and rights, as `Greeting`."""


class Numbered(Struct, gc=False):
    """Decodes only the id of a line that is refused."""

    id: Id = None


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


AnyOrder = PlayRequest | Clip | Regions | MoveRegions | Arm | Disarm | Stop | LoadScene | SaveScene | ChannelTest | WriteTrace
AnyQuestion = Subscribe | Unsubscribe | AskFigures | AskState | Describe | Hello
AnyRequest = AnyOrder | AnyQuestion
OPERATIONS = Arm | Disarm | LoadScene | SaveScene | ChannelTest | WriteTrace  # for operators
LONG = Regions | SaveScene  # lines of these kinds have at most `layer_bytes`
Data = Greeting | FiguresAnswer | StateAnswer | Description
AnyMessage = Answer | LayerAnswer | Data | FaultNotice | Touch | ContactNotice | Emissions | LogLine | Farewell


def request_decoder() -> msgspec.json.Decoder[AnyRequest]:
    """Decoder of the lines that clients send."""
    return msgspec.json.Decoder(AnyRequest)


def message_decoder() -> msgspec.json.Decoder[AnyMessage]:
    """Decoder of the lines that the panel sends."""
    return msgspec.json.Decoder(AnyMessage)
