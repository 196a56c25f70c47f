"""Instructions of the host for an upload and for a play from a slot, from the begin of the turn to the trigger call.

    python -m tests.workshop.benchmark.host_latency --instructions [--bank FILE] [--emissions 500]

The loop of `host_latency.py` runs under `valgrind --tool=callgrind` (Debian: package valgrind); what the link does is not
counted. The same on every machine of one kind, whatever else it does. An emission that was handed over while the
one before still sounded is counted to the end of that turn: its trigger, in a later turn, is one call.
"""

from __future__ import annotations

import ctypes
import re
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from controller.device.bank.reader import Bank
from controller.device.board.board import Board, load_board
from controller.device.board.lookup import find_board
from controller.device.fpga.registers import FrameType
from controller.metrics import Counters
from tests.workshop.benchmark import host_latency
from tests.workshop.benchmark.looped_panel import LoopedPanel
from tests.workshop.benchmark.null_link import NullLink

SOURCE = Path(__file__).with_name("marks.c")
SHORTEST_UPLOAD = 8  # frames; a play alone has three at most
WARM_UP = 1000  # emissions that fill caches, and for which the responses of all cells are checked
COUNTED = re.compile(r"^desc: Trigger: Client Request: (\w+)$.*?^(?:summary|totals): (\d+)", re.MULTILINE | re.DOTALL)


def count(bank: Path, emissions: int, folder: Path) -> dict[str, Any]:
    """Instructions by kind ("uploads", "resident"): how many were counted, median, 99 %, most."""
    marks, out = folder / "marks.so", folder / "callgrind"
    subprocess.run(["cc", "-O2", "-Wall", "-shared", "-fPIC", "-o", marks, SOURCE], check=True)
    valgrind = ["valgrind", "-q", "--tool=callgrind", "--collect-atstart=no", "--instr-atstart=no", f"--callgrind-out-file={out}"]
    loop = [sys.executable, "-m", "tests.workshop.benchmark.instructions", str(bank), str(emissions), str(marks)]
    subprocess.run([*valgrind, *loop], check=True, cwd=Path(__file__).parents[3])
    found: dict[str, list[int]] = {"uploads": [], "resident": []}
    for dump in folder.glob("callgrind.*"):
        for kind, instructions in COUNTED.findall(dump.read_text()):
            found[kind].append(int(instructions))
    return {kind: _summary(sorted(counts)) for kind, counts in found.items()}


def _summary(counts: Sequence[int]) -> dict[str, int]:
    return {"count": len(counts), "p50": counts[len(counts) // 2], "p99": counts[len(counts) * 99 // 100], "most": counts[-1]}


class Marks:
    """Counts a turn from its begin to its trigger, or to its end if an emission was handed over before its time.

    Works from outside of the loop, which may be a compiled one: by what is called in each turn, and by the link.
    """

    def __init__(self, library: str) -> None:
        self._marks = ctypes.CDLL(library)
        self._on = False
        self._emissions = 0
        self._kind = ""  # of what was handed over in this turn

    def turn(self) -> None:
        """A turn begins, and the one before has ended."""
        self.end()
        if self._emissions == WARM_UP:
            self._marks.marks_begin()
        if self._emissions >= WARM_UP:
            self._marks.marks_forget()
            self._toggle()

    def pause(self) -> bool:
        """What the link does is not counted; whether it would be."""
        counting = self._on
        if counting:
            self._toggle()
        return counting

    def exchanged(self, sent: memoryview, lengths: Sequence[int], counting: bool) -> None:
        """A message has gone; count again, if `counting`."""
        if sent[sum(lengths[:-2]) + 2] == FrameType.PLAY:  # its answer comes with the NOP behind it
            self._kind = "uploads" if len(lengths) > SHORTEST_UPLOAD else "resident"
        if counting:
            self._toggle()

    def end(self) -> None:
        """Nothing more of this turn is counted."""
        if self._on:
            self._toggle()
        if self._kind:
            self._emissions += 1
            if self._emissions > WARM_UP:
                self._marks.marks_end(self._kind.encode())
        self._kind = ""

    def _toggle(self) -> None:
        self._marks.marks_toggle()
        self._on = not self._on


class CountedLink(NullLink):
    """A link whose own instructions are not counted."""

    marks: Marks

    def exchange(self, sent: memoryview, lengths: Sequence[int], received: memoryview) -> None:
        """As `NullLink`."""
        counting = self.marks.pause()
        super().exchange(sent, lengths, received)
        self.marks.exchanged(sent, lengths, counting)

    def trigger(self) -> float:
        """As `NullLink`; what follows is not counted."""
        self.marks.end()
        return super().trigger()


class CountedPanel(LoopedPanel):
    """A panel that ends the count where the loop asks for the next report: what was to be handed over has been."""

    marks: Marks

    def next_time_s(self) -> float | None:
        """As `LoopedPanel`."""
        self.marks.end()
        return super().next_time_s()


def play(board: Board, bank: Bank, emissions: int, marks: Marks) -> Counters:
    """The loop, with marks."""
    CountedLink.marks = CountedPanel.marks = marks
    host_latency.NullLink, host_latency.LoopedPanel = CountedLink, CountedPanel  # type: ignore[misc]
    return host_latency.play(board, bank, emissions, turn=marks.turn)[0]


def main() -> None:
    """The process under valgrind."""
    file, emissions, library = sys.argv[1:]
    board = load_board(find_board("simulated"))
    with Bank.open(Path(file), board) as bank:
        play(board, bank, WARM_UP + int(emissions), Marks(library))


if __name__ == "__main__":
    main()
