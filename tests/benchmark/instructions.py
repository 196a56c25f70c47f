"""Instructions of the host for an upload and for a play from a slot, from the begin of the turn to the trigger call.

    python -m tests.benchmark.host_latency --instructions [--bank FILE] [--emissions 500]

The loop of `host_latency.py` runs under `valgrind --tool=callgrind` (Debian: package valgrind); what the link does is not
counted. The same on every machine of one kind, whatever else it does. An emission that was handed over while the
one before still sounded is counted up to there: its trigger, in a later turn, is one call.
"""

from __future__ import annotations

import ctypes
import re
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from controller.bank.reader import Bank
from controller.board.board import Board, load_board
from controller.board.lookup import find_board
from controller.loop.event_loop import EventLoop
from controller.loop.playback import Playback
from controller.metrics import Counters
from tests.benchmark import host_latency
from tests.benchmark.null_link import NullLink

SOURCE = Path(__file__).with_name("marks.c")
WARM_UP = 100  # emissions that fill caches
COUNTED = re.compile(r"^desc: Trigger: Client Request: (\w+)$.*?^(?:summary|totals): (\d+)", re.MULTILINE | re.DOTALL)


def count(bank: Path, emissions: int, folder: Path) -> dict[str, Any]:
    """Instructions by kind ("uploads", "resident"): how many were counted, median, 99 %, most."""
    marks, out = folder / "marks.so", folder / "callgrind"
    subprocess.run(["cc", "-O2", "-Wall", "-shared", "-fPIC", "-o", marks, SOURCE], check=True)
    valgrind = ["valgrind", "-q", "--tool=callgrind", "--collect-atstart=no", "--instr-atstart=no", f"--callgrind-out-file={out}"]
    loop = [sys.executable, "-m", "tests.benchmark.instructions", str(bank), str(emissions), str(marks)]
    subprocess.run([*valgrind, *loop], check=True, cwd=Path(__file__).parents[2])
    found: dict[str, list[int]] = {"uploads": [], "resident": []}
    for dump in folder.glob("callgrind.*"):
        for kind, instructions in COUNTED.findall(dump.read_text()):
            found[kind].append(int(instructions))
    return {kind: _summary(sorted(counts)) for kind, counts in found.items()}


def _summary(counts: Sequence[int]) -> dict[str, int]:
    return {"count": len(counts), "p50": counts[len(counts) // 2], "p99": counts[len(counts) * 99 // 100], "most": counts[-1]}


class Marks:
    """Counts from the begin of a turn to the first trigger, or to the end of `Playback.prepare`, without the link."""

    def __init__(self, library: str) -> None:
        self._marks = ctypes.CDLL(library)
        self._on = False
        self.emissions = 0

    def begin(self) -> None:
        """A turn begins."""
        if self.emissions == WARM_UP:
            self._marks.marks_begin()
        if self.emissions >= WARM_UP:
            self._marks.marks_forget()
            self.toggle()

    def toggle(self) -> bool:
        """Begin, go on or pause; whether it counts now."""
        self._marks.marks_toggle()
        self._on = not self._on
        return self._on

    def pause(self) -> bool:
        """Pause; whether it counted."""
        if self._on:
            self.toggle()
            return True
        return False

    def end(self, kind: str) -> None:
        """What was counted since `begin` was of this kind."""
        self.pause()
        self.emissions += 1
        if self.emissions > WARM_UP:
            self._marks.marks_end(kind.encode())


class CountedLink(NullLink):
    """A link whose own instructions are not counted."""

    marks: Marks

    def exchange(self, sent: memoryview, lengths: Sequence[int], received: memoryview) -> None:
        """As `NullLink`."""
        counting = self.marks.pause()
        super().exchange(sent, lengths, received)
        if counting:
            self.marks.toggle()

    def trigger(self) -> float:
        """As `NullLink`; what follows is not counted."""
        self.marks.pause()
        return super().trigger()


def play(board: Board, bank: Bank, emissions: int, marks: Marks) -> Counters:
    """The loop, with marks."""
    turn, prepare = EventLoop._turn, Playback.prepare

    def counted_turn(loop: EventLoop) -> float | None:
        marks.begin()
        try:
            return turn(loop)
        finally:
            marks.pause()

    def counted_prepare(playback: Playback, *arguments: Any, **more: Any) -> Any:
        counters = playback._counters
        before = counters.uploads, counters.resident
        attempt = prepare(playback, *arguments, **more)
        if playback.accepted is not None:
            marks.end("uploads" if playback.accepted.plan.resident is None else "resident")
        elif before != (counters.uploads, counters.resident):
            marks.end("uploads" if counters.uploads > before[0] else "resident")
        return attempt

    CountedLink.marks = marks
    EventLoop._turn, Playback.prepare = counted_turn, counted_prepare  # type: ignore[method-assign]
    host_latency.NullLink = CountedLink  # type: ignore[misc]
    return host_latency.play(board, bank, emissions)[0]


def main() -> None:
    """The process under valgrind."""
    file, emissions, library = sys.argv[1:]
    board = load_board(find_board("simulated"))
    with Bank.open(Path(file), board) as bank:
        play(board, bank, WARM_UP + int(emissions), Marks(library))


if __name__ == "__main__":
    main()
