"""The one interface of everything that gives touch samples: a recording now, panels on real buses next.

The event loop waits until `fileno()` is readable or `next_time_s()` has come, then calls `read`.
"""

from __future__ import annotations

from collections import Counter
from typing import Protocol

from controller.touch.panel import Counts
from controller.touch.samples import TouchSample


class TouchSource(Protocol):
    """A touch panel, or what stands in for one."""

    @property
    def counts(self) -> Counts:
        """Reports, contacts and fingers seen so far."""

    @property
    def warnings(self) -> Counter[str]:
        """What had to be skipped or clamped so far, counted by kind (`warnings.in_words`)."""

    def fileno(self) -> int | None:
        """File to wait on for reading; None where only `next_time_s` says when."""

    def next_time_s(self) -> float | None:
        """When to call `read`, in the loop's clock; None: when the file is readable, or, without a file, never again."""

    def read(self, now_s: float) -> tuple[TouchSample, ...]:
        """Samples of at most one report (SYN_REPORT) due by `now_s`; empty if none is due or no finger changed."""

    def close(self) -> None:
        """Give the device back."""
