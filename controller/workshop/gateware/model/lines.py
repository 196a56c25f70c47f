"""Changes of the gateware model's other outputs: `waiting_o`, `fault_o`, MISO and the UART's transmit line."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from controller.device.fpga.capture import Capture
from controller.workshop.gateware.pin_timing import SCK_TICKS, SCK_TO_RELEASE_TICKS, SELECT_TO_SCK_TICKS

PAD_TICKS = 1  # from the state to `waiting_o` and `fault_o`, which are registered
ANSWER_TICKS = 4  # from the fall of chip select to the first bit of the answer on MISO
RELEASE_TICKS = 3  # from the rise of chip select until MISO is low
SHIFT_TICKS = 1  # from the fall of SCK to the next bit


class Lines:
    """Changes of these outputs since the last capture.

    With `record_frames` also those of MISO and the UART, which takes time and memory.
    """

    def __init__(self, *, record_frames: bool) -> None:
        self._record_frames = record_frames
        self._waiting = self._fault = False
        self._waiting_from: int | None = None
        self._waits: list[int] = []
        self._faults: list[int] = []
        self._miso: list[NDArray[np.int64]] = []

    def settle(self, tick: int) -> None:
        """Record a change of `waiting_o` that was expected up to `tick`, before which nothing else happens."""
        if not self._waiting and self._waiting_from is not None and self._waiting_from <= tick:
            self._waits.append(self._waiting_from)
            self._waiting = True

    def note(self, tick: int, *, fault: bool, waiting_from: int | None) -> None:
        """Record the state from `tick` on: whether a fault is latched, and since when the head of the queue waits for a trigger.

        `waiting_from` holds if nothing else happens.
        """
        if fault != self._fault:
            self._faults.append(tick)
            self._fault = fault
        if self._waiting and (waiting_from is None or waiting_from > tick):
            self._waits.append(tick)
            self._waiting = False
        self._waiting_from = None if waiting_from is None else max(waiting_from, tick)

    def exchange(self, select_tick: int, release_tick: int, answer: bytearray, size_bytes: int) -> None:
        """Record MISO during a frame; parameters as in `miso_changes`."""
        if self._record_frames:
            self._miso.append(miso_changes(select_tick, release_tick, answer, size_bytes))

    def take(self, capture: Capture, now: int, uart_ticks: Sequence[int]) -> Capture:
        """`capture` with these outputs, up to tick `now`; `uart_ticks` are the changes of the UART's transmit line."""
        miso = np.concatenate([np.zeros(0, np.int64), *self._miso])
        due = miso <= now
        self._miso = [miso[~due]]
        return replace(
            capture,
            waiting_ticks=_taken(self._waits, now),
            fault_ticks=_taken(self._faults, now),
            miso_ticks=miso[due].astype(np.uint64),
            uart_ticks=np.array(uart_ticks if self._record_frames else [], np.uint64),
        )


def _taken(changes: list[int], now: int) -> NDArray[np.uint64]:
    """Remove and return the changes that have reached their pin."""
    due = sum(tick + PAD_TICKS <= now for tick in changes)
    taken = np.array(changes[:due], np.uint64) + np.uint64(PAD_TICKS)
    del changes[:due]
    return taken


def miso_changes(select_tick: int, release_tick: int, answer: bytearray, size_bytes: int) -> NDArray[np.int64]:
    """Ticks (n,) of the changes of MISO during one frame, with SCK spread evenly between fall and rise of chip select.

    `answer` is `size_bytes` bytes and one more, whose first bit appears with the last fall of SCK.
    """
    bits = 8 * size_bytes
    levels = np.unpackbits(np.frombuffer(answer, np.uint8))[: bits + 1].astype(np.int8)
    room = release_tick - select_tick - SELECT_TO_SCK_TICKS - (SCK_TO_RELEASE_TICKS - SCK_TICKS)
    rises = select_tick + SELECT_TO_SCK_TICKS + np.arange(bits + 1) * room // max(bits, 1)
    falls = (rises[:-1] + rises[1:]) // 2 + SHIFT_TICKS
    ticks = np.concatenate([[select_tick + ANSWER_TICKS], falls, [release_tick + RELEASE_TICKS]])
    changed = np.flatnonzero(np.diff(np.concatenate([[0], levels, [0]])))
    return ticks.take(changed).astype(np.int64)
