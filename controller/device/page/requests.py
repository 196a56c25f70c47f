"""Frames of a page: evaluated, and encoded again for the panel, so that what it reads is what was evaluated."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, Final, get_args

import msgspec

from controller.device.application_socket.protocol.client_messages import LINE_BYTES, LONG
from controller.device.application_socket.token_bucket import TokenBucket
from controller.device.page.permissions import refused
from controller.errors import ControllerError

FRAME_BYTES: Final = 65536  # of what may be long; a page's share of `layer_bytes`
LONG_KINDS: Final = [kind.__struct_config__.tag for kind in get_args(LONG)]
_decoder: Final = msgspec.json.Decoder()
_encoder: Final = msgspec.json.Encoder()
NOTHING: Final[Mapping[str, Any]] = {}


# What the bridge answers itself: the fields of the answer, a ControllerError for a refusal, or None for an answer that comes later.
OwnKinds = Mapping[str, Callable[[dict[str, Any]], Mapping[str, Any] | None]]


def evaluated(
    frame: str, rights: frozenset[str], rate: TokenBucket, now_s: float, own: OwnKinds = NOTHING, called: str = ""
) -> tuple[bytes, str]:
    """A line for the panel, or an answer to the page; one of the two is empty, or both where the bridge answers later.

    `frame` is one JSON object, `rights` are the page's, `own` carries out the kinds of messages that are for the bridge, and
    `called` is the page, for whom a stop is asked for. A request to stop is always within the rate.
    """
    try:
        message = _decoder.decode(frame)
    except (msgspec.DecodeError, RecursionError, UnicodeError) as error:
        return b"", answer(None, f"not JSON: {error}")
    if not isinstance(message, dict):
        return b"", answer(None, "must be one JSON object")
    if reason := refused(message, rights):
        return b"", answer(message.get("id"), reason)
    if message["kind"] == "stop" and called:
        message["by"] = called
    try:
        line = _encoder.encode(message) + b"\n"
    except (ValueError, RecursionError, UnicodeError) as error:  # a surrogate alone, a number beyond 64 bits
        return b"", answer(message.get("id"), f"cannot be passed on: {error}")
    longest = FRAME_BYTES if message["kind"] in LONG_KINDS else LINE_BYTES
    if len(line) > longest:
        return b"", answer(message.get("id"), f"longer than {longest} bytes")
    if message["kind"] != "stop" and not rate.take(now_s, 1 + len(line) // LINE_BYTES):
        return b"", answer(message.get("id"), "rate")
    if message["kind"] in own:
        return b"", _answered_here(message, own)
    return line, ""


def _answered_here(message: dict[str, Any], own: OwnKinds) -> str:
    try:
        fields = own[message["kind"]](message)
    except ControllerError as error:
        return answer(message.get("id"), str(error))
    return "" if fields is None else _encoder.encode({"id": _known(message.get("id"))} | dict(fields)).decode()


def answer(number: Any, reason: str) -> str:
    """Answer to a request that the bridge refuses for this reason, or has carried out if there is none, as the panel's own."""
    return _encoder.encode({"kind": "answer", "id": _known(number)} | outcome(reason)).decode()


def _known(number: Any) -> int | str | None:
    """An id as the panel takes it; None for anything else."""
    return number if isinstance(number, int) or (isinstance(number, str) and len(number) <= 64) else None


def outcome(reason: str) -> dict[str, Any]:
    """Why something was refused, or that it is done."""
    return {"outcome": "refused", "reason": reason} if reason else {"outcome": "done"}
