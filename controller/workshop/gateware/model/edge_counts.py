"""Edges of each channel and of all channels within a sliding window, counted in parts: the memory of `stage_limits.v`.

The window is divided into parts. The edges of the current part and of the 15 parts before it count, so that a limit covers every
window, wherever it begins. The parts of different channels begin at different ticks, because the Verilog visits one channel a tick:
channel n in each tick T with T modulo 32 = n.
"""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from controller.device.fpga.registers import CHANNELS

Ticks = NDArray[np.int64]

PARTS: Final = 16  # the current one and those before it
ALL: Final = CHANNELS  # index of the edges of all channels, after those of each
COUNTED_TICKS: Final = 2  # from a change to the first turn of its channel that sees it
# A channel's part ends with its turn in the last round of a part, one tick later for each further channel
_PHASES: Ticks = np.array([*range(1 - COUNTED_TICKS - CHANNELS, 1 - COUNTED_TICKS), 0])
_PLACES = np.arange(CHANNELS + 1)


def part_ticks(window_ticks: int) -> int:
    """Ticks of a part: a multiple of 32, so that 15 parts are at least `window_ticks`."""
    return -(-window_ticks // (CHANNELS * (PARTS - 1))) * CHANNELS


def turn(tick: int, channel: int) -> int:
    """Tick in which a change of `channel` in `tick` is counted: the first turn of the channel that sees it."""
    first = tick + COUNTED_TICKS
    return first + (channel - first) % CHANNELS


class EdgeCounts(NamedTuple):
    """Edges of each channel (indices 0 to 31) and of all (index 32)."""

    part: Ticks  # (33,): number of the current part
    made: Ticks  # (16, 33): edges in each part that counts, by its number modulo 16
    live: Ticks  # (33,): their sums
    until: int  # tick in which the next part of any channel begins

    def at(self, tick: int, part_ticks: int) -> EdgeCounts:
        """The counts at `tick`, with parts of `part_ticks`; edges of parts that have left the window are gone."""
        if tick < self.until:
            return self
        part = (tick - _PHASES) // part_ticks
        made, live = self.made.copy(), self.live.copy()
        passed = part - self.part
        for step in range(1, min(int(passed.max()), PARTS) + 1):
            place = _PLACES[passed >= step]
            number = (self.part[place] + step) % PARTS
            live[place] -= made[number, place]
            made[number, place] = 0
        return EdgeCounts(part, made, live, int((_PHASES + (part + 1) * part_ticks).min()))

    def after(self, edges: Ticks) -> EdgeCounts:
        """The counts with `edges`, (33,), added to the current parts."""
        made = self.made.copy()
        made[self.part % PARTS, _PLACES] += edges
        return self._replace(made=made, live=self.live + edges)


_NOTHING = np.zeros(CHANNELS + 1, np.int64)
NO_EDGES = EdgeCounts(_NOTHING - 1, np.zeros((PARTS, CHANNELS + 1), np.int64), _NOTHING, 0)
