"""The loop's trace as a file that Perfetto (ui.perfetto.dev) and chrome://tracing open: a ring's copy, written between turns.

The format is Chrome's JSON trace event format: complete events (`ph` X) with times in us. Tracks: the loop's turns, the host's
part of each emission, its part on the wire, its wait for the plate, and the plate.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Mapping
from itertools import islice
from pathlib import Path
from typing import Final, Self

from controller.clocks import NEVER
from controller.device.board.lookup import running_release
from controller.device.loop.context import SpareTime
from controller.device.loop.rings.trace_ring import StartRecord, TraceRing, TurnRecord, records_of
from controller.log import Priority, log

TRACKS: Final = {1: "loop: turns", 2: "host: deciding, composing, packing", 3: "wire", 4: "waiting for the plate", 5: "plate"}
TURNS, HOST, WIRE, WAIT, PLATE = TRACKS
FILES: Final = 3  # the newest stay
APART_S: Final = 60.0  # of traces that nobody asked for: a panel that is late again and again has one a minute
AFTER_S: Final = 0.2  # the turns after what is to be explained are kept too
SPARE_S: Final = 2e-3  # to the next turn
LONG_S: Final = 20e-3
STEP, LONG_STEP = 16, 64  # records at a time: 0.2 ms on a PC; where the next turn is far, four times as many
PATIENCE_S: Final = 1.0
FLAGS: Final = os.O_WRONLY | os.O_CREAT | os.O_TRUNC | os.O_CLOEXEC | os.O_NOFOLLOW


def events_of(record: TurnRecord | StartRecord, origin_s: float, emission_s: float) -> Iterator[str]:
    """Events of a record as JSON, in a trace that begins at the host time `origin_s`; `emission_s` is the length of an emission."""
    if isinstance(record, TurnRecord):
        args = f'"due":{record.due},"report_age_us":{record.report_age_s * 1e6:.1f},"started":{str(record.started).lower()}'
        yield _event("turn", TURNS, record.began_s - origin_s, record.ended_s - record.began_s, args)
        return
    sent_s, work_s = record.ready_s - record.wire_s, record.decide_s + record.frame_s
    yield _event("decide and pack", HOST, sent_s - work_s - origin_s, work_s)
    yield _event("play" if record.resident else "upload and play", WIRE, sent_s - origin_s, record.wire_s)
    if record.start_s > record.ready_s:
        yield _event("wait", WAIT, record.ready_s - origin_s, record.start_s - record.ready_s)
    due_s, ready_s = record.due_s - origin_s, record.ready_s - origin_s
    times_s = {"due": due_s, "late": record.late_s, "ready": ready_s}
    times_s |= {"decide": record.decide_s, "frame": record.frame_s, "wire": record.wire_s}
    known = {"pulse": record.pulse, "resident": record.resident, "by_clock": record.by_clock}
    args = ",".join(f'"{name}_us":{time_s * 1e6:.1f}' for name, time_s in times_s.items())
    args += f',"foci":{record.foci},' + ",".join(f'"{name}":{str(value).lower()}' for name, value in known.items())
    yield _event("pulse" if record.pulse else "emission", PLATE, record.start_s - origin_s, emission_s, args)


def _event(name: str, track: int, begin_s: float, length_s: float, args: str = "") -> str:
    begin_us, end_us = round(begin_s * 1e6, 1), round((begin_s + length_s) * 1e6, 1)  # what follows begins where this ends
    times = f'"ts":{begin_us:.1f},"dur":{max(end_us - begin_us, 0.0):.1f}'
    return f'{{"name":"{name}","cat":"panel","ph":"X","pid":1,"tid":{track},{times},"args":{{{args}}}}}'


def head_of(reason: str, board: str, release: str) -> str:
    """Beginning of a file, up to its first event of a record."""
    named = [{"name": "process_name", "ph": "M", "pid": 1, "args": {"name": f"haptic panel {board}"}}]
    named += [{"name": "thread_name", "ph": "M", "pid": 1, "tid": track, "args": {"name": name}} for track, name in TRACKS.items()]
    other = {"reason": reason, "board": board, "release": release}
    events = ",\n".join(json.dumps(event) for event in named)
    return f'{{"displayTimeUnit":"ms","otherData":{json.dumps(other)},"traceEvents":[\n{events}'


END: Final = "\n]}\n"


class TraceFile(SpareTime):
    """Writes the ring of a loop when that is asked for: a copy at first, then its records, a few between two turns.

    The folder is in memory (tmpfs): nothing waits for a disk; None: nothing is written. `emission_s` is the length of an emission.
    """

    def __init__(self, folder: Path | None, board: str, emission_s: float) -> None:
        super().__init__()
        release = running_release()
        self._release = "checkout" if release is None else release.name
        self._folder = folder
        self._board = board
        self._emission_s = emission_s
        self._ring: TraceRing | None = None
        self._copy = bytearray()
        self._reason, self._by_hand = "", False
        self._asked_s = -NEVER  # when the last one was begun
        self._number = 0
        self._file = -1
        self._records: Iterator[TurnRecord | StartRecord] = iter(())
        self._origin_s: float | None = None

    @classmethod
    def from_environment(cls, board: str, emission_s: float, environment: Mapping[str, str] = os.environ) -> Self:
        """Files in the folder that $RUNTIME_DIRECTORY names (systemd.exec(5))."""
        named = environment.get("RUNTIME_DIRECTORY", "").partition(":")[0]
        return cls(Path(named) if named else None, board, emission_s)

    def watch(self, ring: TraceRing) -> None:
        """Take the ring that is written; call it before the loop runs."""
        if self._folder is not None:
            self._ring = ring
            self._copy = bytearray(len(ring.bytes))
            ring.asked = self.ask

    def ask(self, reason: str, *, by_hand: bool = False) -> None:
        """Have the ring written soon, unless it is being written; `by_hand`: however soon after another one."""
        if not self._reason:
            self._reason, self._by_hand = reason, by_hand
            self.due_s = 0.0

    def use(self, now_s: float, next_s: float) -> None:
        """Copy the ring, or write some of its records, if there is time before the next turn, or there was none for long."""
        if self._file < 0 and not self._wanted(now_s):
            return
        if next_s - now_s < SPARE_S and now_s - self.due_s < PATIENCE_S:
            return
        try:
            if self._file < 0:
                self._begin(now_s)
            else:
                self._write(LONG_STEP if next_s - now_s >= LONG_S else STEP)
        except OSError as error:
            self._give_up(error)
        else:
            self.due_s = now_s if self._file >= 0 else NEVER

    def close(self, now_s: float) -> None:
        """Write what was asked for, to its end: nothing is played any more."""
        if self._ring is None or not self._reason:
            return
        try:
            if self._file < 0:
                self._begin(now_s)
            while self._file >= 0:
                self._write(LONG_STEP)
        except OSError as error:
            self._give_up(error)

    def _wanted(self, now_s: float) -> bool:
        """Whether the time has come to copy the ring."""
        if self.due_s == 0.0:
            if not self._by_hand and now_s - self._asked_s < APART_S:
                self._reason, self.due_s = "", NEVER
                return False
            self.due_s = now_s + AFTER_S
        return now_s >= self.due_s

    def _path(self) -> Path:
        assert self._folder is not None
        return self._folder / f"trace-{self._number % FILES + 1}.json"

    def _begin(self, now_s: float) -> None:
        assert self._ring is not None
        self._asked_s = now_s
        self._copy[:] = self._ring.bytes
        self._records = records_of(self._copy, self._ring.at)
        self._origin_s = None
        self._file = os.open(self._path().with_suffix(".new"), FLAGS, 0o644)
        os.write(self._file, head_of(self._reason, self._board, self._release).encode())

    def _write(self, count: int) -> None:
        records = list(islice(self._records, count))
        if not records:
            self._end()
            return
        if self._origin_s is None:
            self._origin_s = _begins_s(records[0])
        text = "".join(
            f",\n{event}" for record in records for event in events_of(record, self._origin_s, self._emission_s)
        ).encode()
        if os.write(self._file, text) != len(text):
            raise OSError(0, "no space for all of it")

    def _end(self) -> None:
        os.write(self._file, END.encode())
        os.close(self._file)
        self._file = -1
        path = self._path()
        path.with_suffix(".new").replace(path)
        path.chmod(0o644)  # whatever the umask: it holds no secrets
        log(f"{self._reason}: what the loop did before and after is in {path}; haptic-panel trace {path} explains it")
        self._reason = ""
        self._number += 1

    def _give_up(self, error: OSError) -> None:
        if self._file >= 0:
            os.close(self._file)
            self._file = -1
        log(f"the trace cannot be written to {self._folder} ({error.strerror}); the panel plays on", Priority.WARNING)
        self._reason, self.due_s = "", NEVER


def _begins_s(record: TurnRecord | StartRecord) -> float:
    return record.began_s if isinstance(record, TurnRecord) else record.ready_s - record.wire_s - record.frame_s - record.decide_s
