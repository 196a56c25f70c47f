"""The lines of the gateware model beside its channels, change by change: `waiting_o`, `fault_o`, MISO, the UART's answers.

What the status says of a line holds for the line; here is since when.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from controller.fpga.capture import Capture
from controller.gateware_model.gateware import SCK_TICKS, SCK_TO_RELEASE_TICKS, SELECT_TO_SCK_TICKS

PAD_TICKS = 1  # from the state to `waiting_o` and `fault_o`, which have a register each
ANSWER_TICKS = 4  # from the fall of chip select to the first bit of the answer on MISO
RELEASE_TICKS = 3  # from its rise until MISO is low
SHIFT_TICKS = 1  # from the fall of SCK to the next bit


class Lines:
    """Changes since the last capture.

    Parameters
    ----------
    noting_frames : bool
        MISO and the UART's line too, which take time and memory.
    """

    def __init__(self, *, noting_frames: bool) -> None:
        self._noting_frames = noting_frames
        self._waiting = self._fault = False
        self._waiting_from: int | None = None
        self._waits: list[int] = []
        self._faults: list[int] = []
        self._miso: list[NDArray[np.int64]] = []

    def settle(self, tick: int) -> None:
        """Until this tick nothing happens but what was foreseen."""
        if not self._waiting and self._waiting_from is not None and self._waiting_from <= tick:
            self._waits.append(self._waiting_from)
            self._waiting = True

    def note(self, tick: int, *, fault: bool, waiting_from: int | None) -> None:
        """How things are from this tick on, and since when, or when, the head waits for a trigger if nothing happens."""
        if fault != self._fault:
            self._faults.append(tick)
            self._fault = fault
        if self._waiting and (waiting_from is None or waiting_from > tick):
            self._waits.append(tick)
            self._waiting = False
        self._waiting_from = None if waiting_from is None else max(waiting_from, tick)

    def exchange(self, select_tick: int, release_tick: int, answer: bytearray, size_bytes: int) -> None:
        """A frame of the SPI and its answer, of which the first bit behind the last byte is shown too."""
        if self._noting_frames:
            self._miso.append(miso_changes(select_tick, release_tick, answer, size_bytes))

    def take(self, capture: Capture, now: int, uart_ticks: Sequence[int]) -> Capture:
        """A capture with these lines, up to now."""
        miso = np.concatenate([np.zeros(0, np.int64), *self._miso])
        due = miso <= now
        self._miso = [miso[~due]]
        return replace(
            capture,
            waiting_ticks=_taken(self._waits, now),
            fault_ticks=_taken(self._faults, now),
            miso_ticks=miso[due].astype(np.uint64),
            uart_ticks=np.array(uart_ticks if self._noting_frames else [], np.uint64),
        )


def _taken(changes: list[int], now: int) -> NDArray[np.uint64]:
    """The changes that have come to their pin, which are taken off the list."""
    due = sum(tick + PAD_TICKS <= now for tick in changes)
    taken = np.array(changes[:due], np.uint64) + np.uint64(PAD_TICKS)
    del changes[:due]
    return taken


def miso_changes(select_tick: int, release_tick: int, answer: bytearray, size_bytes: int) -> NDArray[np.int64]:
    """(n,) ticks of the changes of MISO during one chip-select assertion, SCK spread evenly in it.

    Parameters
    ----------
    answer : bytearray
        `size_bytes` and one more, whose first bit the last fall of SCK brings.
    """
    bits = 8 * size_bytes
    levels = np.unpackbits(np.frombuffer(answer, np.uint8))[: bits + 1].astype(np.int8)
    room = release_tick - select_tick - SELECT_TO_SCK_TICKS - (SCK_TO_RELEASE_TICKS - SCK_TICKS)
    rises = select_tick + SELECT_TO_SCK_TICKS + np.arange(bits + 1) * room // max(bits, 1)
    falls = (rises[:-1] + rises[1:]) // 2 + SHIFT_TICKS
    ticks = np.concatenate([[select_tick + ANSWER_TICKS], falls, [release_tick + RELEASE_TICKS]])
    changed = np.flatnonzero(np.diff(np.concatenate([[0], levels, [0]])))
    return ticks.take(changed).astype(np.int64)
