"""A trace of the loop in plain words: what it holds, and for each pulse that was late, whose part it was."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from statistics import median
from typing import Any, Final

import msgspec

from controller.device.board.validation import NO_JSON
from controller.device.loop.rings.trace_ring import LATE_S
from controller.errors import ConfigError
from controller.text_file import read_text

BYTES_MAX: Final = 1 << 26
EXPLAINED: Final = 5  # pulses, the latest
SMALL_US: Final = 50.0  # a part of a delay that is not worth a word


class EmissionStart(msgspec.Struct):
    """One start of an emission, in us from the trace's beginning; for its fields see `trace_ring.StartRecord`."""

    start_us: float = 0.0
    due_us: float = 0.0
    late_us: float = 0.0
    ready_us: float = 0.0
    decide_us: float = 0.0
    frame_us: float = 0.0
    wire_us: float = 0.0
    foci: int = 0
    pulse: bool = False
    resident: bool = False

    @property
    def host_us(self) -> float:
        """The host's own work for it."""
        return self.decide_us + self.frame_us

    @property
    def begun_us(self) -> float:
        """When the turn began that it was decided in."""
        return self.ready_us - self.wire_us - self.host_us


class _TurnArgs(msgspec.Struct):
    due: int = 0


class _Event(msgspec.Struct):
    name: str
    ph: str
    ts: float = 0.0
    dur: float = 0.0
    args: msgspec.Raw = msgspec.Raw(b"{}")


class _About(msgspec.Struct):
    reason: str = "not known"
    board: str = "not known"
    release: str = "not known"


class _File(msgspec.Struct):
    traceEvents: list[_Event]  # noqa: N815 - the format's name
    otherData: _About = msgspec.field(default_factory=_About)  # noqa: N815


class Span(msgspec.Struct, frozen=True):
    """One turn of the loop, in us from the trace's beginning."""

    begin_us: float
    end_us: float
    due: int


class Trace(msgspec.Struct, frozen=True):
    """A trace that was read."""

    reason: str
    board: str
    release: str
    turns: tuple[Span, ...]
    starts: tuple[EmissionStart, ...]


def read_trace(file: Path) -> Trace:
    """Read a trace; raises ConfigError if it cannot be read, or is no trace of a panel."""
    try:
        read = msgspec.json.decode(read_text(file, BYTES_MAX), type=_File)
        turns, starts = [], []
        for event in read.traceEvents:
            if event.ph != "X":
                continue
            if event.name == "turn":
                turns.append(Span(event.ts, event.ts + event.dur, msgspec.json.decode(event.args, type=_TurnArgs).due))
            elif event.name in {"pulse", "emission"}:
                start = msgspec.json.decode(event.args, type=EmissionStart)
                start.start_us = event.ts
                starts.append(start)
    except OSError as error:
        raise ConfigError(f"{file}: cannot be read ({error.strerror})") from error
    except (*NO_JSON, ValueError) as error:
        raise ConfigError(f"{file}: is no trace of a panel: {error}") from error
    if not turns and not starts:
        raise ConfigError(f"{file}: has no turns of a panel's loop: is it another program's trace?")
    about = read.otherData
    by_begin = tuple(sorted(turns, key=lambda turn: turn.begin_us))
    return Trace(about.reason, about.board, about.release, by_begin, tuple(sorted(starts, key=lambda start: start.start_us)))


def figures_of(trace: Trace) -> dict[str, Any]:
    """What a trace holds, and the latest pulses with their causes, for JSON."""
    times = [turn.begin_us for turn in trace.turns] + [start.start_us for start in trace.starts]
    late = sorted((start for start in trace.starts if start.pulse), key=lambda start: -start.late_us)
    explained = [start for start in late[:EXPLAINED] if start.late_us > LATE_S * 1e6]
    return {
        "reason": trace.reason,
        "board": trace.board,
        "release": trace.release,
        "seconds": round((max(times) - min(times)) * 1e-6, 3),
        "turns": len(trace.turns),
        "longest_turn_ms": _ms(max((turn.end_us - turn.begin_us for turn in trace.turns), default=0.0)),
        "starts": len(trace.starts),
        "pulses": len(late),
        "pulses_late": sum(start.late_us > LATE_S * 1e6 for start in late),
        "latest_ms": _ms(late[0].late_us) if late else 0.0,
        "explained": [
            {"due_ms": _ms(start.due_us), "late_ms": _ms(start.late_us), "parts_ms": parts_of(trace, start)} for start in explained
        ],
    }


def parts_of(trace: Trace, start: EmissionStart) -> dict[str, float]:
    """The parts of a delay in ms, by cause; their sum is how late it was, unless its command was there in time.

    What it took beyond what others of its kind take (resident or not) is the host's, or the wire's. What is left before it was
    begun is a turn that was in the way, or a loop that did not run: its host did not, or its lead was too short. What passes from
    its arrival on is the plate's.
    """
    alike = [other for other in trace.starts if other.resident == start.resident]
    usual_host_us, usual_wire_us = (median(values) for values in zip(*((o.host_us, o.wire_us) for o in alike), strict=True))
    plate_us = max(start.start_us - max(start.ready_us, start.due_us), 0.0)
    host_us, wire_us = max(start.host_us - usual_host_us, 0.0), max(start.wire_us - usual_wire_us, 0.0)
    arrived_late_us = max(start.ready_us - start.due_us, 0.0)
    begun_late_us = max(arrived_late_us - host_us - wire_us, 0.0)
    busy_us = min(_busy_us(trace.turns, start.begun_us - begun_late_us, start.begun_us), begun_late_us)
    parts = {
        "the loop was busy with other turns": busy_us,
        "begun too late, with no turn in the way": begun_late_us - busy_us,
        "the host took longer than usual": min(host_us, arrived_late_us),
        "the wire took longer than usual": min(wire_us, max(arrived_late_us - host_us, 0.0)),
        "the plate was still playing": plate_us,
    }
    return {cause: _ms(part_us) for cause, part_us in parts.items() if part_us >= SMALL_US}


def _busy_us(turns: Sequence[Span], begin_us: float, end_us: float) -> float:
    """How much of a span turns of the loop took."""
    return sum(max(min(turn.end_us, end_us) - max(turn.begin_us, begin_us), 0.0) for turn in turns)


def _ms(time_us: float) -> float:
    return round(time_us * 1e-3, 3)
