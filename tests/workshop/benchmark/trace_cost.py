"""What the loop's trace costs: `python -m tests.workshop.benchmark.trace_cost`, instructions of a turn with it by those without.

The device's loop, on a link that says yes and in virtual time, plays recordings over and over. Each run has the same turns, and
the same is counted on every machine of one kind, whatever else it does (valgrind, Debian: package valgrind). What a longer run has
more than a shorter one is that of its turns.
"""

import argparse
import itertools
import json
import os
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from controller.clocks import VirtualClock
from controller.device.bank.reader import Bank
from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.device.loop.context import LoopContext, Watch
from controller.device.loop.trace_ring import TraceRing
from controller.device.loop.wiring import assemble
from controller.device.scene.scene import load_scene
from controller.device.service.drivers import open_session, tracked
from controller.device.touch.live_source import LiveSource
from controller.workshop.bank_builder.build import build_bank
from controller.workshop.bank_builder.request import BankRequest
from tests.device.loop.steady_loop import RECORDINGS
from tests.workshop.benchmark.looped_panel import LoopedPanel
from tests.workshop.benchmark.null_link import NullLink

ROOT = Path(__file__).parents[3]
SCENE = Path(__file__).with_name("scene.toml")
BOARD = load_board(find_board("simulated"))
PITCH_M = 10e-3
SHORT, LONG = 1000, 3000  # turns
CALLS = 20_000
COUNTED = re.compile(r"^(?:summary|totals): (\d+)", re.MULTILINE)


def nothing(*_, **__):
    """In place of a record."""


def play(bank_path, most_turns, *, kept):
    """One run; the emissions. `kept`: with the trace."""
    clock = VirtualClock()
    link = NullLink(BOARD, clock.now_s)
    session = open_session(link, BOARD, clock.now_s)
    panel = LoopedPanel([BOARD.folder / "demo.evemu", *RECORDINGS], clock.now_s() + 0.1)
    turns = itertools.count(1)

    def progress(_):
        panel.stopped = next(turns) >= most_turns

    context = LoopContext(BOARD, clock, session, tracked(LiveSource(panel, BOARD), BOARD))
    if not kept:
        context.trace.turn = context.trace.started = nothing
    with Bank.open(bank_path, BOARD) as bank:
        assembly = assemble(context, load_scene(SCENE, BOARD), bank, watch=Watch(progress))
        assembly.selection.prepare()
        assembly.loop.run(link.answer_alone)
    return assembly.counters.emissions


def instructions(folder, bank_path, turns, *, kept):
    """Of one run, the start of Python included."""
    out = folder / "callgrind"
    valgrind = ["valgrind", "-q", "--tool=callgrind", f"--callgrind-out-file={out}"]
    run = [sys.executable, "-m", "tests.workshop.benchmark.trace_cost", "--turns", str(turns), "--bank", str(bank_path)]
    environment = os.environ | {"PYTHONHASHSEED": "0", "OPENBLAS_NUM_THREADS": "1"}
    subprocess.run(
        [*valgrind, *run, *([] if kept else ["--without"])], check=True, cwd=ROOT, env=environment, stdout=subprocess.PIPE
    )
    return int(COUNTED.search(out.read_text())[1])


def record_us():
    """One record of a turn, with the reading of the clock that it needs: the least of ten times, less an empty loop."""
    trace, now_s = TraceRing(), time.monotonic
    least_ns = [1 << 60, 1 << 60]
    for _ in range(10):
        begun_ns = time.thread_time_ns()
        for _ in range(CALLS):
            trace.turn(1.5, now_s(), 50_000, 1, started=False)
        middle_ns = time.thread_time_ns()
        for _ in range(CALLS):
            pass
        ended_ns = time.thread_time_ns()
        least_ns = [min(least_ns[0], middle_ns - begun_ns), min(least_ns[1], ended_ns - middle_ns)]
    return (least_ns[0] - least_ns[1]) / CALLS * 1e-3


def measure(folder):
    """Everything, ready for JSON."""
    bank_path = folder / "simulated.bank"
    build_bank(BankRequest(BOARD, bank_path, PITCH_M))
    a_turn = {}
    for kept in (True, False):
        long, short = (instructions(folder, bank_path, turns, kept=kept) for turns in (LONG, SHORT))
        a_turn[kept] = (long - short) / (LONG - SHORT)
    return {
        "instructions_of_a_turn": round(a_turn[True]),
        "without_the_trace": round(a_turn[False]),
        "ratio": round(a_turn[True] / a_turn[False], 4),
        "record_of_a_turn_us": round(record_us(), 2),
    }


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--turns", type=int)
    parser.add_argument("--bank", type=Path)
    parser.add_argument("--without", action="store_true")
    options = parser.parse_args()
    if options.turns:
        print(play(options.bank, options.turns, kept=not options.without))
    else:
        with tempfile.TemporaryDirectory() as name:
            print(json.dumps(measure(Path(name)), indent=1))
