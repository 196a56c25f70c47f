"""The last turns of the loop and the last starts, kept to explain a late pulse: 48 bytes each, in a ring that is made once.

Writing a record is one call of `struct`, which allocates nothing that stays. Whoever wants the ring written (`trace_file.py`) is
called once something is asked to be explained.
"""

from __future__ import annotations

from collections.abc import Iterator
from struct import Struct
from typing import Final, NamedTuple, Protocol

from controller.clocks import FPGA_NEVER, ClockOffset
from controller.device.loop.playing.records import Accepted

RECORDS: Final = 1 << 15  # 10 s of 3,000 turns and starts a second, more than any panel has; 1.5 MB
LATE_S: Final = 2e-3  # of a pulse that has to be explained
TURN: Final = Struct("=BBHfdd24x")
START: Final = Struct("=BBHfdddff8x")
RECORD_BYTES: Final = TURN.size
IS_TURN, IS_START = 1, 2
PULSE, RESIDENT, BY_CLOCK = 1, 2, 4
MOST_DUE: Final = 65535


class TurnRecord(NamedTuple):
    """One turn; host time in s."""

    began_s: float
    ended_s: float
    report_age_s: float  # of the touch report that it read, from the kernel's timestamp; below 0: none
    due: int  # emissions that were due
    started: bool  # whether an emission started


class StartRecord(NamedTuple):
    """One start of an emission, or of a repetition; host time in s."""

    due_s: float  # when it was due
    ready_s: float  # ready_s, start_s: when its command had arrived in the FPGA; when it started
    start_s: float
    # decide_s, frame_s, wire_s: from the beginning of the turn to the decision, for composing and packing, and on the wire
    decide_s: float
    frame_s: float
    wire_s: float
    foci: int  # emissions that it plays at once
    pulse: bool  # of a train that had begun: it has to be on time
    resident: bool  # its waveform was in the FPGA already
    by_clock: bool  # started by the FPGA's clock, not by the trigger

    @property
    def late_s(self) -> float:
        """How much after it was due it started."""
        return self.start_s - self.due_s


class Asked(Protocol):
    """Takes note that the ring is to be written."""

    def __call__(self, reason: str, *, by_hand: bool = False) -> None:
        """See `TraceRing.asked`."""


class TraceRing:
    """Records of turns and starts."""

    def __init__(self, records: int = RECORDS) -> None:
        self.bytes = bytearray(records * RECORD_BYTES)
        self._end = len(self.bytes)
        # Called with the reason when the ring is to be written, and with `by_hand` where somebody wants it now; not more
        # than it has to be, as it is called on the hot path
        self.asked: Asked = _nobody
        self.at = 0  # of the next record, in bytes

    @property
    def is_written(self) -> bool:
        """Whether anything writes it when that is asked for."""
        return self.asked is not _nobody

    def turn(self, began_s: float, ended_s: float, report_ns: int, due: int, *, started: bool) -> None:
        """Note a turn; `report_ns` as in `Turn`."""
        TURN.pack_into(self.bytes, self.at, IS_TURN, started, min(due, MOST_DUE), report_ns * 1e-9, began_s, ended_s)
        at = self.at + RECORD_BYTES
        self.at = at if at < self._end else 0

    def started(self, accepted: Accepted, start_s: float, offset_s: ClockOffset) -> None:
        """Note a start at the host's `start_s`; `offset_s` from host time to FPGA time."""
        plan = accepted.plan
        emissions = plan.batch.emissions
        due, is_pulse = FPGA_NEVER, False  # a pulse that is due goes before all else
        for emission in emissions:
            if bool(emission.pulse) == is_pulse:
                due = emission.time_s if emission.time_s < due else due
            elif emission.pulse:
                due, is_pulse = emission.time_s, True
        due_s = due - offset_s
        flags = (PULSE if is_pulse else 0) | (0 if plan.resident is None else RESIDENT)
        flags |= 0 if plan.start_ticks is None else BY_CLOCK
        START.pack_into(
            self.bytes,
            self.at,
            IS_START,
            flags,
            len(emissions),
            accepted.decide_ns * 1e-9,
            due_s,
            accepted.ready_s,
            start_s,
            accepted.frame_ns * 1e-9,
            accepted.wire_ns * 1e-9,
        )
        at = self.at + RECORD_BYTES
        self.at = at if at < self._end else 0
        if is_pulse and start_s - due_s > LATE_S:
            self.asked(f"a pulse was {(start_s - due_s) * 1e3:.1f} ms late")


def records_of(data: bytes | bytearray, at: int) -> Iterator[TurnRecord | StartRecord]:
    """Records of a copy of a ring, the oldest first. `at` is `TraceRing.at` when it was copied."""
    size = len(data)
    for begin in range(at, at + size, RECORD_BYTES):
        place = begin % size
        if data[place] == IS_TURN:
            _, started, due, report_age_s, began_s, ended_s = TURN.unpack_from(data, place)
            yield TurnRecord(began_s, ended_s, report_age_s, due, bool(started))
        elif data[place] == IS_START:
            _, flags, foci, decide_s, due_s, ready_s, start_s, frame_s, wire_s = START.unpack_from(data, place)
            is_pulse, is_resident, by_clock = bool(flags & PULSE), bool(flags & RESIDENT), bool(flags & BY_CLOCK)
            yield StartRecord(due_s, ready_s, start_s, decide_s, frame_s, wire_s, foci, is_pulse, is_resident, by_clock)


def _nobody(reason: str, *, by_hand: bool = False) -> None:
    """In place of a writer."""
