"""A link whose far end costs next to nothing: right answers, frame by frame, without a gateware behind them.

Bring-up and arming go to the gateware model; from `answer_alone` on every frame is accepted and every status is
packed here. What the host does is the same, and no model's memory pushes the host's out of the caches.
"""

from __future__ import annotations

import time
import zlib
from collections.abc import Callable, Sequence

from controller.device.board.board import Board
from controller.device.fpga.frames import CRC, FRAME_BYTES, PLAY_FIELDS, SHORT_FIELDS_AT
from controller.device.fpga.registers import STATUS_SYNC, FrameType, Result, Start, State
from controller.device.fpga.status import STATUS
from controller.workshop.gateware.simulated_link import open_simulated

PAUSE_S = 0.25e-6  # chip select high between frames
REST_EVERY_NS, REST_S = 600_000_000, 0.06  # the kernel stops a real-time process that never sleeps for 50 ms in each second
STATUS_END = FRAME_BYTES - CRC.size
NEVER_TICKS = 1 << 64  # a play that waits for the trigger


class NullLink:
    """`Link` with an end that says yes.

    Parameters
    ----------
    board : Board
    now_s : callable
        The loop's clock.
    sent : callable, optional
        Reported of every message that goes out, in time that is not the host's.
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
        self._triggers = self._emissions = self._queued = 0
        self._repeats = False
        self._when, self._counts = [0] * 3, [0] * 3  # of the plays in the queue
        self._reported = sent
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
                self._status(received, start, ticks)
                self._execute(sent, start)
                self._sequence = sent[start + 3]
                at_s += 8 * length / self._settings.sck_hz + PAUSE_S
                start += length
            self._free_s = at_s
            self.bytes_sent += start
            self.wire_ns += round((at_s - first_s) * 1e9)
            if self._reported is not None:
                self._reported(sent, lengths)
            if started_ns > self._rested_ns + REST_EVERY_NS:
                time.sleep(REST_S)
                self._rested_ns = time.perf_counter_ns()
        self.blocked_ns += time.perf_counter_ns() - started_ns

    def trigger(self) -> float:
        """The edge comes when the wire is free."""
        if not self._alone:
            return self._model.trigger()
        self._triggers += 1
        self._begin()
        return max(self._now_s(), self._free_s)

    def _status(self, received: memoryview, start: int, ticks: int) -> None:
        """Answer a frame that begins at a tick."""
        while self._queued and self._when[0] <= ticks:
            self._begin()
        state = self._state | State.REPEATING if self._repeats else self._state
        STATUS.pack_into(
            received,
            start,
            STATUS_SYNC,
            Result.OK,
            self._sequence,
            state,
            0,
            0,
            self._triggers,
            ticks,
            self._emissions,
            self._queued,
            0,
            0,
            0,
        )
        CRC.pack_into(received, start + STATUS_END, zlib.crc32(received[start : start + STATUS_END]))

    def _execute(self, sent: memoryview, start: int) -> None:
        """Take a PLAY into the queue; empty it after a STOP."""
        kind = sent[start + 2]
        if kind == FrameType.PLAY:
            _, _, _, count, begins, _, _, _, when_ticks = PLAY_FIELDS.unpack_from(sent, start + SHORT_FIELDS_AT)
            self._when[self._queued], self._counts[self._queued] = when_ticks if begins == Start.TIME else NEVER_TICKS, count
            self._queued += 1
        elif kind == FrameType.WRITE:  # of what the loop writes once it plays, only a STOP
            self._queued, self._repeats = 0, False

    def _begin(self) -> None:
        """The first play of the queue begins, and at once has ended."""
        assert self._queued, "a trigger that starts nothing"
        self._queued -= 1
        self._repeats = not self._counts[0]
        self._emissions += self._counts[0]
        self._when[0], self._counts[0] = self._when[1], self._counts[1]

    def wire_free_s(self) -> float:
        """When the frames sent so far have gone."""
        return self._free_s if self._alone else self._model.wire_free_s()

    def close(self) -> None:
        """Nothing is held."""
