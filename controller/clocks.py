"""Where the event loop's time comes from, and how it waits."""

from __future__ import annotations

import math
import selectors
import time
from typing import Protocol

NEVER = math.inf


class Clock(Protocol):
    """A clock that never goes back."""

    def now_s(self) -> float:
        """Time in s."""

    def wait(self, selector: selectors.BaseSelector, until_s: float) -> None:
        """Return at `until_s`, or earlier when a file of the selector is ready."""


class MonotonicClock:
    """Real time: the kernel's CLOCK_MONOTONIC, in which it also stamps the events of touch panels."""

    def now_s(self) -> float:
        """Time in s since some fixed point; setting the clock of the day does not change it."""
        return time.monotonic()

    def wait(self, selector: selectors.BaseSelector, until_s: float) -> None:
        """Sleep in the selector."""
        selector.select(None if until_s == NEVER else max(until_s - time.monotonic(), 0.0))


class VirtualClock:
    """Time that jumps to whatever comes next: a replay as fast as the machine goes, the same every time."""

    def __init__(self) -> None:
        self._now_s = 0.0

    def now_s(self) -> float:
        """Time in s since the start."""
        return self._now_s

    def wait(self, selector: selectors.BaseSelector, until_s: float) -> None:
        """Jump; signals still come through the selector."""
        selector.select(0)
        if until_s != NEVER:
            self._now_s = max(self._now_s, until_s)
