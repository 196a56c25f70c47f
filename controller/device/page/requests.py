"""Frames of a page: evaluated, and encoded again for the panel, so that what it reads is what was evaluated."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, Final

import msgspec

from controller.device.application_socket.messages import LINE_BYTES
from controller.device.application_socket.token_bucket import TokenBucket
from controller.device.page.permissions import refused

FRAME_BYTES: Final = 65536  # of what may be long; a page's share of `layer_bytes`
LONG_KINDS: Final = ("regions", "save_scene")
_decoder: Final = msgspec.json.Decoder()
_encoder: Final = msgspec.json.Encoder()
NOTHING: Final[Mapping[str, Any]] = {}


OwnKinds = Mapping[str, Callable[[dict[str, Any]], str]]


def evaluated(frame: str, rights: frozenset[str], rate: TokenBucket, now_s: float, own: OwnKinds = NOTHING) -> tuple[bytes, str]:
    """A line for the panel, or an answer to the page; one of the two is empty.

    A request to stop is always within the rate.

    Parameters
    ----------
    frame : str
        One JSON object.
    rights : frozenset of str
        Of the page.
    own : mapping
        What carries out the kinds of messages that are for the bridge, and says why it does not.
    """
    try:
        message = _decoder.decode(frame)
    except (msgspec.DecodeError, RecursionError, UnicodeError) as error:
        return b"", answer(None, f"not JSON: {error}")
    if not isinstance(message, dict):
        return b"", answer(None, "must be one JSON object")
    if reason := refused(message, rights):
        return b"", answer(message.get("id"), reason)
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
        return b"", answer(message.get("id"), own[message["kind"]](message))
    return line, ""


def answer(number: Any, reason: str) -> str:
    """Answer to a request that the bridge refuses for this reason, or has carried out if there is none, as the panel's own."""
    known = number if isinstance(number, int) or (isinstance(number, str) and len(number) <= 64) else None
    became = {"outcome": "refused", "reason": reason} if reason else {"outcome": "done"}
    return _encoder.encode({"kind": "answer", "id": known} | became).decode()
