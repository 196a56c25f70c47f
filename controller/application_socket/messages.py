"""What goes over the application socket: one JSON object a line, `kind` says which.

Every line of a client is answered exactly once, with its own `id` (null where it gave none, or one
that cannot be read). Touches and states come unasked between answers, once subscribed. Lengths are mm and
times ms here, at the edge; an unknown key is refused, so that a misspelt one is not overlooked.
"""

from __future__ import annotations

from typing import Annotated, Any, Literal

import msgspec
from msgspec import Meta, Struct

LINE_BYTES = 8192  # longest line of a client, its end included
LEAST_AMPLITUDE = 0.25  # below, the response of a waveform to its bits is no longer what was measured

Id = Annotated[int, Meta(ge=-(2**53), le=2**53)] | Annotated[str, Meta(max_length=64)] | None
Word = Annotated[str, Meta(min_length=1, max_length=64)]
PlainName = Annotated[str, Meta(pattern="^[A-Za-z0-9][A-Za-z0-9_-]{0,63}$")]  # never a path: clients choose among installed scenes
Outcome = Literal["played", "merged", "skipped", "refused", "done"]


class Request(Struct, frozen=True, kw_only=True, forbid_unknown_fields=True, tag_field="kind", gc=False):
    """What all requests have."""

    id: Id = None


class Play(Request, frozen=True, kw_only=True, tag="play", gc=False):
    """Play an effect at a point, or for a finger wherever it goes: either `x_mm` and `y_mm`, or `finger`.

    `amplitude` is the share of the full one; left out, it is the largest the board allows to a client.
    """

    effect: Word
    x_mm: float | None = None
    y_mm: float | None = None
    finger: Annotated[int, Meta(ge=0, le=2**53)] | None = None
    amplitude: float | None = None


class Subscribe(Request, frozen=True, kw_only=True, tag="subscribe", gc=False):
    """From now on tell of every touch, or of the panel's state, now and whenever it changes; or of both."""

    to: Annotated[tuple[Literal["touches", "state"], ...], Meta(min_length=1, max_length=2)] = ("touches",)


class Unsubscribe(Request, frozen=True, kw_only=True, tag="unsubscribe", gc=False):
    """No touches and states any more."""


class Arm(Request, frozen=True, kw_only=True, tag="arm", gc=False):
    """Have the outputs on from now on, as far as the FPGA allows it; the state tells when they are."""


class Disarm(Request, frozen=True, kw_only=True, tag="disarm", gc=False):
    """Have the outputs glide to 0 V, and stay off whatever happens, until somebody arms."""


class AskState(Request, frozen=True, kw_only=True, tag="state", gc=False):
    """How is the panel?"""


class LoadScene(Request, frozen=True, kw_only=True, tag="load_scene", gc=False):
    """Take over another scene of the board, by its name; answered when it is in force, or refused."""

    name: PlainName


class AskFigures(Request, frozen=True, kw_only=True, tag="figures", gc=False):
    """What the panel counted so far."""


class Hello(Request, frozen=True, kw_only=True, tag="hello", gc=False):
    """Who is there?"""


class Numbered(Struct, gc=False):
    """All that is wanted of a line that is refused: whom to answer."""

    id: Id = None


class Answer(Struct, frozen=True, kw_only=True, omit_defaults=True, tag_field="kind", tag="answer", gc=False):
    """What became of a request; `age_ms` tells how old a command to play was when it was decided."""

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
    rights: tuple[Literal["play", "operate"], ...]


class Figures(Struct, frozen=True, kw_only=True, tag_field="kind", tag="figures", gc=False):
    """Answer to `AskFigures`; they are at most a second old."""

    id: Id
    figures: dict[str, Any]


class Touch(Struct, frozen=True, kw_only=True, tag_field="kind", tag="touch", gc=False):
    """A finger began, moved or was released; those of one report have the same `time_s` (CLOCK_MONOTONIC)."""

    finger: int
    x_mm: float
    y_mm: float
    time_s: float
    contact: bool
    size_mm: float


class State(Struct, frozen=True, kw_only=True, tag_field="kind", tag="state", gc=False):
    """How the panel is: answer to `AskState`, or, with an id of null, told to who subscribed.

    `state` is one of `panel_state.PanelState`; `cause` says why not everything works; `temperature_c` is the plate's,
    null where it is not known.
    """

    id: Id = None
    state: str
    cause: str
    outputs_on: bool
    panel_present: bool
    temperature_c: float | None


class Farewell(Struct, frozen=True, kw_only=True, omit_defaults=True, tag_field="kind", tag="farewell", gc=False):
    """The panel ends the connection, and why; `lacks` names a right without which there is none."""

    reason: str
    lacks: Literal["play", "operate"] | None = None


AnyRequest = Play | Subscribe | Unsubscribe | Arm | Disarm | LoadScene | AskFigures | AskState | Hello
AnyMessage = Answer | Greeting | Figures | State | Touch | Farewell


def request_decoder() -> msgspec.json.Decoder[AnyRequest]:
    """Decoder of a client's lines."""
    return msgspec.json.Decoder(AnyRequest)


def message_decoder() -> msgspec.json.Decoder[AnyMessage]:
    """Decoder of the panel's lines."""
    return msgspec.json.Decoder(AnyMessage)
