"""What clients of the application socket send: one JSON object per line; `kind` names the request.

Every line is answered exactly once, with the line's `id` (null if it has none that can be read). Lengths are in mm. Unknown keys
are refused, so that a misspelt key is noticed.
"""

from __future__ import annotations

from typing import Annotated, Literal, get_args

import msgspec
from msgspec import Meta, Raw, Struct

from controller.device.scene.layers import MOST_SHIFT_MM, Scale

LINE_BYTES = 8192  # longest line of a client, with its newline, but for `LONG`

Id = Annotated[int, Meta(ge=-(2**53), le=2**53)] | Annotated[str, Meta(max_length=64)] | None
Word = Annotated[str, Meta(min_length=1, max_length=64)]
# Never a path: a client chooses among the installed scenes.
PlainName = Annotated[str, Meta(pattern=r"^[A-Za-z0-9][A-Za-z0-9_-]{0,63}\Z")]
BY_CHARACTERS = 120
LAST_CHANNEL = 127  # of a board of four FPGAs; a client needs no board
ShiftMm = Annotated[float, Meta(ge=-MOST_SHIFT_MM, le=MOST_SHIFT_MM)]
Right = Literal["look", "play", "regions", "operate"]
Topic = Literal["touches", "contacts", "emissions", "state", "description", "faults", "log"]


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


AnyOrder = PlayRequest | Clip | Regions | MoveRegions | Arm | Disarm | Stop | LoadScene | SaveScene | ChannelTest | WriteTrace
AnyQuestion = Subscribe | Unsubscribe | AskFigures | AskState | Describe | Hello
AnyRequest = AnyOrder | AnyQuestion
OPERATIONS = Arm | Disarm | LoadScene | SaveScene | ChannelTest | WriteTrace  # for operators
# The right that each needs; whoever may connect may look
RIGHTS: dict[type[Request], Right] = {
    **{PlayRequest: "play", Clip: "play", Regions: "regions", MoveRegions: "regions", Stop: "look"},
    **dict.fromkeys(get_args(OPERATIONS), "operate"),
    **dict.fromkeys(get_args(AnyQuestion), "look"),
}
RIGHTS_TO_FOLLOW: dict[Topic, Right] = {"log": "operate", "contacts": "operate", "touches": "play", "emissions": "play"}
LONG = Regions | SaveScene  # lines of these kinds have at most `layer_bytes`


def request_decoder() -> msgspec.json.Decoder[AnyRequest]:
    """Decoder of the lines that clients send."""
    return msgspec.json.Decoder(AnyRequest)
