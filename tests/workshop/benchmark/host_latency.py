"""Host time of an upload and of a resident play, from the read of a touch report to the trigger call, beside that of C twins.

    python -m tests.workshop.benchmark.host_latency [--bank FILE] [--emissions N] [--runs 3] [--alone] [--instructions]
        [--json] [--plot F]

The product's own loop plays recordings round and round on a scene of many emissions, over a link whose far end costs
nothing (`null_link.py`; time within the link is not the host's). Time is virtual: the loop never sleeps, and both go the
same way every time. In each run the twin first goes beside the loop, which shows that both send the same bytes; then the
twins alone and the loop alone are measured, on one core, with real-time priority if that is allowed, while another
process keeps the other core busy (`--alone`: it does not). The twin that decides has 128-bit vectors (SSE4.2, NEON); the one by
plain `cc -O2` is information. Required: an upload's p50 <= the twin's + 30 us, its p99 <= 4 p50; a resident play: p50 <= the
twin's + 15 us. `--instructions` counts them instead (`instructions.py`; times under it mean nothing).
"""

from __future__ import annotations

import argparse
import contextlib
import gc
import importlib
import json
import os
import statistics
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator, Sequence
from importlib.machinery import EXTENSION_SUFFIXES
from pathlib import Path
from typing import Any

from controller.clocks import VirtualClock
from controller.device.bank.reader import Bank
from controller.device.board.board import Board, load_board
from controller.device.board.lookup import find_board
from controller.device.loop.context import LoopContext, Watch
from controller.device.loop.wiring import assemble
from controller.device.scene.scene import load_scene
from controller.device.service.drivers import open_session
from controller.device.touch.live_source import LiveSource
from controller.device.touch.tracker import Tracker
from controller.metrics import STAGES, Counters
from tests.workshop.benchmark.looped_panel import LoopedPanel
from tests.workshop.benchmark.null_link import NullLink
from tests.workshop.benchmark.twin import PLAIN, VECTORS_128, Twin, Watched

HERE = Path(__file__).parent
RECORDINGS = sorted((HERE.parents[1] / "device/touch/recordings").glob("*.ev*"))
BUSY = """
import numpy, os
os.sched_setscheduler(0, os.SCHED_OTHER, os.sched_param(0))
os.sched_setaffinity(0, {%d})
a = numpy.ones((400, 400))
while True: a @ a
"""
FIGURES = ("p50", "p99", "worst", "resident_p50", "resident_p99", "twin_p50", "twin_resident_p50", "plain_twin_p50")
MOST_MORE_US, MOST_MORE_RESIDENT_US = 30, 15
MOST_RATIO = 4


def configuration() -> dict[str, bool]:
    """What is compiled here: the kernel (else its numpy twin runs), and the loop's own modules (mypyc)."""
    kernel = None
    with contextlib.suppress(ImportError):
        kernel = importlib.import_module("controller.device.kernel")
    source = importlib.import_module("controller.device.loop.playing.playback").__file__ or ""
    return {"kernel": getattr(kernel, "COMPILED", False), "mypyc": source.endswith(tuple(EXTENSION_SUFFIXES))}


def play(
    board: Board, bank: Bank, emissions: int, twin_folder: Path | None = None, turn: Callable[[], None] = lambda: None
) -> tuple[Counters, Twin | None]:
    """One run of the loop, with the twin beside it or alone; `turn` is called when a turn begins."""
    scene = load_scene(HERE / "scene.toml", board)
    clock = VirtualClock()
    hooks: list[Twin] = []

    def sent(message: memoryview, lengths: Sequence[int]) -> None:
        hooks[0].sent(message, lengths)

    def given(*report: Any) -> None:
        hooks[0].given(*report)

    link = NullLink(board, clock.now_s, sent if twin_folder else None)
    session = open_session(link, board, clock.now_s)
    panel = LoopedPanel([board.folder / "demo.evemu", *RECORDINGS], clock.now_s() + 0.1, given if twin_folder else None)
    source: Any = Tracker(LiveSource(panel, board), board.touch, board.plate.length_m, board.plate.width_m)
    if twin_folder:
        hooks.append(Twin(twin_folder, board, scene, bank, panel.descriptions))
        source = Watched(source, hooks[0])

    def progress(_: float) -> None:
        if counters.emissions >= emissions:
            panel.stopped = True
        for twin in hooks:
            twin.turn()
        turn()

    assembly = assemble(LoopContext(board, clock, session, source), scene, bank, watch=Watch(progress))
    counters = assembly.counters
    assembly.selection.prepare()
    assembly.loop.run(link.answer_alone)
    return counters, hooks[0] if hooks else None


@contextlib.contextmanager
def one_core(*, busy: bool = True) -> Iterator[int]:
    """This process on one core, before all others; with `busy`, another process keeps the other core so. Gives the core."""
    mine, *others = sorted(os.sched_getaffinity(0), reverse=True)
    os.sched_setaffinity(0, {mine})
    with contextlib.suppress(PermissionError):
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(40))
    children = [subprocess.Popen([sys.executable, "-c", BUSY % other]) for other in others[:1] if busy]
    try:
        yield mine
    finally:
        for child in children:
            child.kill()
            child.wait()


def measure(bank_path: Path, emissions: int, runs: int, *, busy: bool = True) -> dict[str, Any]:
    """Everything, ready for JSON; in us."""
    board = load_board(find_board("simulated"))
    figures = []
    with tempfile.TemporaryDirectory() as folder, Bank.open(bank_path, board) as bank, one_core(busy=busy):
        for _ in range(runs):
            gc.collect()
            _, twin = play(board, bank, emissions, Path(folder))
            assert twin is not None
            vectors, plain = twin.replay(VECTORS_128), twin.replay(PLAIN)
            counters, _ = play(board, bank, emissions)
            uploads, resident = counters.upload_latency, counters.resident_latency
            run: dict[str, Any] = {"emissions": counters.emissions, "uploads": counters.uploads, "load": os.getloadavg()[0]}
            for name, histogram in (
                ("", uploads.host),
                ("resident_", resident.host),
                ("twin_", vectors["uploads"]),
                ("twin_resident_", vectors["resident"]),
                ("plain_twin_", plain["uploads"]),
                ("plain_twin_resident_", plain["resident"]),
            ):
                summary = histogram.summary_us()
                run |= {name + figure: float(summary[figure] or 0) for figure in ("p50", "p99", "worst")}
            figures.append(
                run
                | {
                    "stages": {name: getattr(uploads, name).summary_us() for name in STAGES},
                    "resident_stages": {name: getattr(resident, name).summary_us() for name in STAGES},
                    "histogram": uploads.host.buckets_us(),
                    "twin_histogram": vectors["uploads"].buckets_us(),
                    "twin_checked": twin.checked,
                    "twin_played": twin.played,
                    "twin_composed": twin.composed,
                }
            )
    medians = {name: statistics.median(run[name] for run in figures) for name in FIGURES}
    medians["more_than_twin"] = statistics.median(run["p50"] - run["twin_p50"] for run in figures)
    medians["resident_more_than_twin"] = statistics.median(run["resident_p50"] - run["twin_resident_p50"] for run in figures)
    medians["p99_over_p50"] = statistics.median(run["p99"] / run["p50"] for run in figures)
    goals = {
        f"upload: p50 <= 128-bit twin + {MOST_MORE_US} us": medians["more_than_twin"] <= MOST_MORE_US,
        f"upload: p99 <= {MOST_RATIO} p50": medians["p99_over_p50"] <= MOST_RATIO,
        f"resident: p50 <= 128-bit twin + {MOST_MORE_RESIDENT_US} us": medians["resident_more_than_twin"] <= MOST_MORE_RESIDENT_US,
    }
    rounded = {name: round(value, 3) for name, value in medians.items()}
    return {"configuration": configuration(), "medians": rounded, "goals": goals, "met": all(goals.values()), "runs": figures}


def plot(figures: dict[str, Any], path: Path) -> None:
    """Histograms of the last run."""
    import matplotlib.pyplot as plt

    run = figures["runs"][-1]
    plot_, axes = plt.subplots(figsize=(7, 4))
    for name, label in (("histogram", "loop"), ("twin_histogram", "C twin")):
        bounds, counts = zip(*run[name], strict=True)
        axes.step(bounds, counts, where="pre", label=label)
    axes.set(xscale="log", yscale="log", xlabel="host time of an upload / us", ylabel="uploads")
    axes.legend()
    plot_.savefig(path)


def show(figures: dict[str, Any]) -> None:
    """Print the figures of `measure`."""
    for run in figures["runs"]:
        print(f"{run['emissions']} emissions, load {run['load']:.1f}; all messages of the 128-bit twin compared:", end=" ")
        print(f"{run['twin_checked']} uploads ({run['twin_composed']} of several fingers), ", end="")
        print(f"{run['twin_played']} resident plays; p50 / p99 / worst in us:")
        for kind, name, stages in (("upload", "", run["stages"]), ("resident", "resident_", run["resident_stages"])):
            columns = [("loop", name), ("128-bit twin", f"twin_{name}"), ("plain twin", f"plain_twin_{name}")]
            times = [f"{who} {run[f'{of}p50']:.1f} / {run[f'{of}p99']:.1f} / {run[f'{of}worst']:.0f}" for who, of in columns]
            parts = ", ".join(f"{part} {stages[part]['p50']:.1f}" for part in ("decide", "frame", "trigger"))
            print(f"  {kind:8}  {';  '.join(times)};  p50 of {parts}")
    for what, met in figures["goals"].items():
        print(f"{what}: {'met' if met else 'NOT met'}")
    print(f"medians: {figures['medians']}")


def main() -> int:
    """The command."""
    parser = argparse.ArgumentParser(prog="python -m tests.workshop.benchmark.host_latency", description=__doc__.partition("\n")[0])
    parser.add_argument("--bank", type=Path, help="of board 'simulated'; default: one is built as the board says (some seconds)")
    parser.add_argument("--emissions", type=int, help="of each run; default: 20000, and 500 where instructions are counted")
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--alone", action="store_true", help="leave the other core alone")
    parser.add_argument("--instructions", action="store_true", help="count instructions instead, by valgrind")
    parser.add_argument("--json", action="store_true")
    parser.add_argument("--plot", type=Path)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        bank = options.bank
        if bank is None:
            from controller.workshop.bank_builder.build import build_bank
            from controller.workshop.bank_builder.request import BankRequest

            bank = Path(folder) / "simulated.bank"
            board = load_board(find_board("simulated"))
            build_bank(BankRequest(board, bank, board.bank.pitch_mm * 1e-3))
        if options.instructions:
            from tests.workshop.benchmark.instructions import count

            counted = {"configuration": configuration(), **count(bank, options.emissions or 500, Path(folder))}
            print(json.dumps(counted) if options.json else counted)
            return 0
        figures = measure(bank, options.emissions or 20_000, options.runs, busy=not options.alone)
    if options.plot:
        plot(figures, options.plot)
    if options.json:
        print(json.dumps(figures))
        return 0
    print(f"kernel: {'compiled' if figures['configuration']['kernel'] else 'numpy'}; ", end="")
    print(f"loop: {'mypyc' if figures['configuration']['mypyc'] else 'interpreted'}")
    show(figures)
    return 0 if figures["met"] else 1


if __name__ == "__main__":
    sys.exit(main())
