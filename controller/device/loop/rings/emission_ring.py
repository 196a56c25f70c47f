"""The last starts of emissions, for those who want to see them: noted in the loop, read at leisure."""

from __future__ import annotations

from typing import Final

from controller.device.bank.expectation import Expectation
from controller.device.loop.playing.records import Plan

SLOTS: Final = 64  # a thirtieth of a second has at most 33 emissions of 1 ms


class EmissionRing:
    """Starts in memory of fixed size: a new one takes the place of the oldest."""

    def __init__(self) -> None:
        self.wanted = False  # whether anybody reads; otherwise nothing is noted
        self.count = 0  # starts noted so far
        self.expected: Expectation | None = None  # of the bank that is played; None: it does not say what it will do
        self._starts: list[tuple[float, Plan] | None] = [None] * SLOTS

    def started(self, start_s: float, plan: Plan) -> None:
        """Note that a plan starts at a host time."""
        self._starts[self.count % SLOTS] = start_s, plan
        self.count += 1

    def since(self, count: int) -> list[tuple[float, Plan]]:
        """Host time and plan of each start since `count` was read, the oldest first, but for those that others have replaced."""
        first = max(count, self.count - SLOTS)
        return [start for at in range(first, self.count) if (start := self._starts[at % SLOTS]) is not None]
