"""What the loop's trace costs: `python -m tests.workshop.benchmark.trace_cost`, processor time of a turn with it by that without.

The device's loop, on a link that says yes and in virtual time, plays recordings over and over. Before each turn it is drawn by
lot whether its trace is kept, so that what differs from turn to turn, and what disturbs the machine, disturbs both alike; a third
lot, which keeps it too, shows what the lot alone does. Turns are compared by quantiles: they differ by orders of magnitude.

And what writing a full ring takes between two turns: the copy, and each part.
"""

import argparse
import json
import random
import tempfile
import time
from pathlib import Path
from types import SimpleNamespace

import numpy as np

from controller.clocks import VirtualClock
from controller.device.bank.reader import Bank
from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.device.loop.context import LoopContext, Watch
from controller.device.loop.rings.trace_ring import RECORDS, TraceRing
from controller.device.loop.wiring import assemble
from controller.device.scene.scene import load_scene
from controller.device.service.drivers import open_session, tracked
from controller.device.service.tracing.trace_file import AFTER_S, SPARE_S, TraceFile
from controller.device.touch.live_source import LiveSource
from controller.workshop.bank_builder.build import build_bank
from controller.workshop.bank_builder.request import BankRequest
from tests.device.loop.steady_loop import RECORDINGS
from tests.workshop.benchmark.looped_panel import LoopedPanel
from tests.workshop.benchmark.null_link import NullLink

SCENE = Path(__file__).with_name("scene.toml")
BOARD = load_board(find_board("simulated"))
PITCH_M = 10e-3
TURNS = 60_000
WARM_UP = 2_000  # turns
LOTS = ("with", "without", "with again")
QUANTILES = (0.25, 0.5, 0.75, 0.9)
CALLS = 20_000


def nothing(*_, **__):
    """In place of a record."""


class Lots:
    """Draws a lot before each turn, and adds up what turns took: to be called as the loop's `progress`."""

    def __init__(self, trace, panel, turns):
        self.taken_ns = [[] for _ in LOTS]
        self._kept = trace.turn, trace.started
        self._trace, self._panel, self._turns = trace, panel, turns
        self._random = random.Random(0)
        self._lot, self._begun_ns, self._count = 0, 0, 0

    def __call__(self, _now_s):
        ended_ns = time.thread_time_ns()
        self._count += 1
        if self._count > WARM_UP:
            self.taken_ns[self._lot].append(ended_ns - self._begun_ns)
        self._panel.stopped = self._count >= WARM_UP + self._turns
        self._lot = self._random.randrange(len(LOTS))
        self._trace.turn, self._trace.started = (nothing, nothing) if LOTS[self._lot] == "without" else self._kept
        self._begun_ns = time.thread_time_ns()


def play(bank_path, turns):
    """One run; what its turns took, by lot, in ns."""
    clock = VirtualClock()
    link = NullLink(BOARD, clock.now_s)
    session = open_session(link, BOARD, clock.now_s)
    panel = LoopedPanel([BOARD.folder / "demo.evemu", *RECORDINGS], clock.now_s() + 0.1)
    context = LoopContext(BOARD, clock, session, tracked(LiveSource(panel, BOARD), BOARD))
    lots = Lots(context.trace, panel, turns)
    with Bank.open(bank_path, BOARD) as bank:
        assembly = assemble(context, load_scene(SCENE, BOARD), bank, watch=Watch(lots))
        assembly.selection.prepare()
        assembly.loop.run(link.answer_alone)
    return [np.array(taken) for taken in lots.taken_ns]


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


def writing_ms(folder):
    """What `TraceFile.use` takes between two turns that are near to each other, of a full ring: its copy, then 16 records each."""
    ring = TraceRing()
    emission = SimpleNamespace(time_s=100.05, pulse=3)
    plan = SimpleNamespace(batch=SimpleNamespace(emissions=[emission]), resident=None, start_ticks=None)
    accepted = SimpleNamespace(plan=plan, ready_s=100.053, decide_ns=20_000, frame_ns=80_000, wire_ns=1_400_000)
    for number in range(RECORDS // 2):
        ring.turn(100 + number * 1e-3, 100 + number * 1e-3 + 2e-4, 50_000, 1, started=True)
        ring.started(accepted, 100.0505, 0.0)
    trace = TraceFile(folder, BOARD.name, 2e-3)
    trace.watch(ring)
    trace.ask("measured")
    trace.use(0.0, 1.0)
    taken_ns, now_s = [], AFTER_S
    while trace.due_s <= now_s:
        begun_ns = time.thread_time_ns()
        trace.use(now_s, now_s + 2 * SPARE_S)
        taken_ns.append(time.thread_time_ns() - begun_ns)
        now_s += SPARE_S
    (file,) = folder.glob("trace-*.json")
    parts = np.array(taken_ns[1:]) * 1e-6
    figures = dict(zip(("p50", "p99", "longest"), np.quantile(parts, (0.5, 0.99, 1.0)).round(3).tolist(), strict=True))
    return {"copy": round(taken_ns[0] * 1e-6, 3), "parts": len(parts), "file_bytes": file.stat().st_size} | figures


def measure(turns):
    """Everything, ready for JSON."""
    with tempfile.TemporaryDirectory() as name:
        bank_path = Path(name) / "simulated.bank"
        build_bank(BankRequest(BOARD, bank_path, PITCH_M))
        taken = play(bank_path, turns)
        (Path(name) / "traces").mkdir()
        writing = writing_ms(Path(name) / "traces")
    of = [np.quantile(one, QUANTILES) * 1e-3 for one in taken]
    of = [
        np.append(quantiles, np.minimum(one, np.quantile(one, 0.99)).mean() * 1e-3)
        for quantiles, one in zip(of, taken, strict=True)
    ]
    names = [*(f"p{round(100 * q)}" for q in QUANTILES), "mean up to p99"]
    return {
        "turns": [len(one) for one in taken],
        "a_turn_us": {lot: dict(zip(names, values.round(2).tolist(), strict=True)) for lot, values in zip(LOTS, of, strict=True)},
        "with_by_without": dict(zip(names, (of[0] / of[1]).round(4).tolist(), strict=True)),
        "with_again_by_with": dict(zip(names, (of[2] / of[0]).round(4).tolist(), strict=True)),
        "record_of_a_turn_us": round(record_us(), 2),
        "writing_ms": writing,
    }


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--turns", type=int, default=TURNS)
    print(json.dumps(measure(parser.parse_args().turns), indent=1))
