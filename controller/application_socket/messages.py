"""Messages of the application socket: one JSON object per line; `kind` names the message.

Every line of a client is answered exactly once, with the line's `id` (null if it has none that can be read). Touches and
states are sent between answers to clients that subscribed to them. Lengths are in mm, ages in ms, `time_s` in s. Unknown keys
are refused, so that a misspelt key is noticed.
"""

from __future__ import annotations

from typing import Annotated, Any, Literal

import msgspec
from msgspec import Meta, Struct

LINE_BYTES = 8192  # longest line of a client, with its newline
LEAST_AMPLITUDE = 0.25  # below, the response of a waveform to its bits is no longer what was measured

Id = Annotated[int, Meta(ge=-(2**53), le=2**53)] | Annotated[str, Meta(max_length=64)] | None
Word = Annotated[str, Meta(min_length=1, max_length=64)]
# Never a path: a client chooses among the installed scenes.
PlainName = Annotated[str, Meta(pattern=r"^[A-Za-z0-9][A-Za-z0-9_-]{0,63}\Z")]
Outcome = Literal["played", "merged", "skipped", "refused", "done"]


class Request(Struct, frozen=True, kw_only=True, forbid_unknown_fields=True, tag_field="kind", gc=False):
    """A request; `id` is returned with its answer."""

    id: Id = None


class Play(Request, frozen=True, kw_only=True, tag="play", gc=False):
    """Play an effect at a point (`x_mm` and `y_mm`), or at a finger as it moves (`finger`, as in `Touch`).

    `amplitude` is a share of the full amplitude; null: the largest that the board allows to clients.
    """

    effect: Word
    x_mm: float | None = None
    y_mm: float | None = None
    finger: Annotated[int, Meta(ge=0, le=2**53)] | None = None
    amplitude: float | None = None


class Subscribe(Request, frozen=True, kw_only=True, tag="subscribe", gc=False):
    """Send every touch from now on, or the panel's state, now and whenever it changes; or both."""

    to: Annotated[tuple[Literal["touches", "state"], ...], Meta(min_length=1, max_length=2)] = ("touches",)


class Unsubscribe(Request, frozen=True, kw_only=True, tag="unsubscribe", gc=False):
    """Send no more touches and states."""


class Arm(Request, frozen=True, kw_only=True, tag="arm", gc=False):
    """Switch the outputs on as soon as the FPGA allows it; `State` reports when they are."""


class Disarm(Request, frozen=True, kw_only=True, tag="disarm", gc=False):
    """Ramp the outputs down to 0 V; they stay off until a client arms, whatever happens meanwhile."""


class AskState(Request, frozen=True, kw_only=True, tag="state", gc=False):
    """Request the panel's state, as `State`."""


class LoadScene(Request, frozen=True, kw_only=True, tag="load_scene", gc=False):
    """Load another scene of the board by its name; answered when it is in force, or refused."""

    name: PlainName


class AskFigures(Request, frozen=True, kw_only=True, tag="figures", gc=False):
    """Request counters and latencies, as `Figures`."""


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
    rights: tuple[Literal["look", "play", "operate"], ...]


class Figures(Struct, frozen=True, kw_only=True, tag_field="kind", tag="figures", gc=False):
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


class State(Struct, frozen=True, kw_only=True, tag_field="kind", tag="state", gc=False):
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


class Farewell(Struct, frozen=True, kw_only=True, omit_defaults=True, tag_field="kind", tag="farewell", gc=False):
    """The panel ends the connection for `reason`; `lacks` is the right that the user does not have."""

    reason: str
    lacks: Literal["look", "play", "operate"] | None = None


AnyRequest = Play | Subscribe | Unsubscribe | Arm | Disarm | LoadScene | AskFigures | AskState | Hello
AnyMessage = Answer | Greeting | Figures | State | Touch | Farewell


def request_decoder() -> msgspec.json.Decoder[AnyRequest]:
    """Decoder of the lines that clients send."""
    return msgspec.json.Decoder(AnyRequest)


def message_decoder() -> msgspec.json.Decoder[AnyMessage]:
    """Decoder of the lines that the panel sends."""
    return msgspec.json.Decoder(AnyMessage)
