"""Frames of a page: judged, and written anew for the panel, so that what it reads is what was judged."""

from __future__ import annotations

from typing import Any, Final

import msgspec

from controller.device.application_socket.messages import LINE_BYTES
from controller.device.page.permissions import refused

FRAME_BYTES: Final = 65536  # of regions; a page's share of `layer_bytes`
_decoder: Final = msgspec.json.Decoder()
_encoder: Final = msgspec.json.Encoder()


class Rate:
    """Messages that one page may send: an average rate, and so many at once.

    Parameters
    ----------
    per_s, burst : float
        Average rate, and the largest number at once.
    now_s : float
        Time of the first.
    """

    def __init__(self, per_s: float, burst: float, now_s: float) -> None:
        self._per_s, self._burst = per_s, burst
        self._left, self._at_s = burst, now_s

    def takes(self, now_s: float, lines: int = 1) -> bool:
        """Whether one more is within the rate; a long one counts as several lines."""
        self._left = min(self._burst, self._left + (now_s - self._at_s) * self._per_s)
        self._at_s = now_s
        if self._left < lines:
            return False
        self._left -= lines
        return True


def judged(frame: str, rights: frozenset[str], rate: Rate, now_s: float) -> tuple[bytes, str]:
    """A line for the panel, or an answer to the page; one of the two is empty.

    A request to stop is always within the rate.

    Parameters
    ----------
    frame : str
        One JSON object.
    rights : frozenset of str
        Of the page.
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
    longest = FRAME_BYTES if message["kind"] == "regions" else LINE_BYTES
    if len(line) > longest:
        return b"", answer(message.get("id"), f"longer than {longest} bytes")
    if message["kind"] != "stop" and not rate.takes(now_s, 1 + len(line) // LINE_BYTES):
        return b"", answer(message.get("id"), "rate")
    return line, ""


def answer(number: Any, reason: str) -> str:
    """Answer to a request that the bridge refuses, as the panel's own."""
    known = number if isinstance(number, int) or (isinstance(number, str) and len(number) <= 64) else None
    return _encoder.encode({"kind": "answer", "id": known, "outcome": "refused", "reason": reason}).decode()
