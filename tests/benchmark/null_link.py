"""A link whose far end costs next to nothing: right answers, frame by frame, without a gateware behind them.

Bring-up and arming go to the gateware model; from `answer_alone` on every frame is accepted and every status is
packed here. What the host does is the same, and no model's memory pushes the host's out of the caches.
"""

from __future__ import annotations

import time
import zlib
from collections.abc import Callable, Sequence

from controller.board.board import Board
from controller.fpga.frames import CRC, FRAME_BYTES
from controller.fpga.registers import STATUS_SYNC, Result, State
from controller.fpga.status import STATUS
from controller.service.drivers import open_simulated

PAUSE_S = 0.25e-6  # chip select high between frames
REST_EVERY_NS, REST_S = 600_000_000, 0.06  # the kernel stops a real-time process that never sleeps for 50 ms in each second
STATUS_END = FRAME_BYTES - CRC.size


class NullLink:
    """`Link` with an end that says yes.

    Parameters
    ----------
    board : Board
    now_s : callable
        The loop's clock.
    sent : callable, optional
        Told of every message that goes out, in time that is not the host's.
    """

    def __init__(self, board: Board, now_s: Callable[[], float], sent: Callable[[memoryview, Sequence[int]], None] | None = None):
        self.bytes_sent = 0
        self.wire_ns = 0
        self.blocked_ns = 0
        self._settings = board.link
        self._now_s = now_s
        self._start_s = now_s()
        self._model = open_simulated(board, now_s)
        self._alone = False
        self._free_s = 0.0
        self._sequence = 0
        self._state = State.ARMED | State.HV_ENABLE
        self._told = sent
        self._rested_ns = time.perf_counter_ns()

    def answer_alone(self) -> None:
        """From now on nothing is computed but statuses; the FPGA has to be armed."""
        self._free_s = self._model.wire_free_s()
        self._alone = True

    def exchange(self, sent: memoryview, lengths: Sequence[int], received: memoryview) -> None:
        """Accept every frame."""
        started_ns = time.perf_counter_ns()
        if not self._alone:
            self._model.exchange(sent, lengths, received)
            self._sequence = sent[sum(lengths[:-1]) + 3]
        else:
            at_s = first_s = max(self._now_s(), self._free_s)
            start = 0
            for length in lengths:
                ticks = round((at_s - self._start_s) * self._settings.clock_hz)
                STATUS.pack_into(
                    received, start, STATUS_SYNC, Result.OK, self._sequence, self._state, 0, 0, 0, ticks, 0, 0, 0, 0, 0
                )
                CRC.pack_into(received, start + STATUS_END, zlib.crc32(received[start : start + STATUS_END]))
                self._sequence = sent[start + 3]
                at_s += 8 * length / self._settings.sck_hz + PAUSE_S
                start += length
            self._free_s = at_s
            self.bytes_sent += start
            self.wire_ns += round((at_s - first_s) * 1e9)
            if self._told is not None:
                self._told(sent, lengths)
            if started_ns > self._rested_ns + REST_EVERY_NS:
                time.sleep(REST_S)
                self._rested_ns = time.perf_counter_ns()
        self.blocked_ns += time.perf_counter_ns() - started_ns

    def trigger(self) -> float:
        """The edge comes when the wire is free."""
        return max(self._now_s(), self._free_s) if self._alone else self._model.trigger()

    def wire_free_s(self) -> float:
        """When the frames sent so far have gone."""
        return self._free_s if self._alone else self._model.wire_free_s()

    def close(self) -> None:
        """Nothing is held."""
