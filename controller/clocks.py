"""The loop's clock, and the type of a moment in the FPGA's clock.

Times are floats in s. Host time is CLOCK_MONOTONIC and a plain float, as is every duration. A moment in FPGA time is an
`FpgaTime`: mypy refuses to compare or mix it with host time, and `fpga.clock_estimate` converts one into the other.
"""

from __future__ import annotations

import math
import selectors
import time
from typing import TYPE_CHECKING, Protocol, overload

NEVER = math.inf

if TYPE_CHECKING:

    class FpgaTime:
        """A moment in FPGA time, in s since the FPGA's reset; for the type checker only, at run time it is a float."""

        def __init__(self, seconds: float) -> None: ...
        def __float__(self) -> float: ...
        def __add__(self, duration_s: float, /) -> FpgaTime: ...
        @overload
        def __sub__(self, other: FpgaTime | ClockOffset, /) -> float: ...
        @overload
        def __sub__(self, duration_s: float, /) -> FpgaTime: ...
        def __sub__(self, other: FpgaTime | ClockOffset | float, /) -> FpgaTime | float: ...
        def __lt__(self, other: FpgaTime, /) -> bool: ...
        def __le__(self, other: FpgaTime, /) -> bool: ...
        def __gt__(self, other: FpgaTime, /) -> bool: ...
        def __ge__(self, other: FpgaTime, /) -> bool: ...

    class ClockOffset:
        """FPGA time minus host time, in s: host time + offset is FPGA time, FPGA time - offset is host time; in the same way."""

        def __init__(self, seconds: float) -> None: ...
        def __radd__(self, host_s: float, /) -> FpgaTime: ...

else:
    FpgaTime = ClockOffset = float

FPGA_NEVER = FpgaTime(NEVER)


class Clock(Protocol):
    """A monotonic clock."""

    def now_s(self) -> float:
        """Host time in s."""

    def wait(self, selector: selectors.BaseSelector, until_s: float) -> None:
        """Return at the host time `until_s`, or earlier when a file of the selector is ready."""


class MonotonicClock:
    """Real time: the kernel's CLOCK_MONOTONIC, in which it also stamps the events of touch panels.

    Setting the system's date and time does not change it.
    """

    now_s = staticmethod(time.monotonic)  # itself: the loop asks several times a turn

    def wait(self, selector: selectors.BaseSelector, until_s: float) -> None:
        """Block in the selector; inf: until a file is ready."""
        selector.select(None if until_s == NEVER else max(until_s - time.monotonic(), 0.0))


class VirtualClock:
    """Simulated time, which jumps to the next event: a replay as fast as the machine allows, the same every time."""

    def __init__(self) -> None:
        self._now_s = 0.0

    def now_s(self) -> float:
        """Simulated host time in s since the start."""
        return self._now_s

    def wait(self, selector: selectors.BaseSelector, until_s: float) -> None:
        """Jump to `until_s`; signals are still served by the selector."""
        selector.select(0)
        if until_s != NEVER:
            self._now_s = max(self._now_s, until_s)
