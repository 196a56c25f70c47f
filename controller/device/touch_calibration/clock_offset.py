"""Offset of another program's clock, bounded by messages there and back: no message arrives before it is sent."""

from __future__ import annotations

from math import inf


class ClockOffset:
    """What has to be added to times of another clock, which runs as fast as ours."""

    def __init__(self) -> None:
        self._low_s, self._high_s = -inf, inf

    def heard(self, sent_s: float, received_s: float) -> None:
        """A message came: sent by the other clock, received by ours."""
        self._high_s = min(self._high_s, received_s - sent_s)

    def answered(self, sent_s: float, received_s: float) -> None:
        """A message went: sent by our clock, received by the other."""
        self._low_s = max(self._low_s, sent_s - received_s)

    @property
    def offset_s(self) -> float:
        """The middle of what is possible."""
        return (self._low_s + self._high_s) / 2

    @property
    def error_s(self) -> float:
        """How far off it may be: half of the quickest way there and back. Below 0: the clocks do not run together. Inf: unknown."""
        return (self._high_s - self._low_s) / 2
