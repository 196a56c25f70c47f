"""What the snap distance costs and saves: a lone finger that plays the nearest cell's entry instead of composed words.

    python -m controller.workshop.benchmark.device.snapping

Places are drawn all over the plate. Amplitude lost is that of the words that the device plays, places rounded to its lattice,
against the sign of the exact response at the very place. Time is that of the host's work for an upload, from the place to
finished frames. Memory is what of the bank is resident after a finger was at all places. Times and memory are those of a process
of its own for each setting.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import time
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray
from threadpoolctl import threadpool_limits

from controller.console import program, say
from controller.device.bank.packing import WORD, drive_words
from controller.device.bank.reader import Bank
from controller.device.board.board import Board, load_board
from controller.device.board.lookup import find_board
from controller.device.board.paths import bank_path
from controller.device.fpga.exchange import COMMANDS
from controller.device.fpga.frames import FRAME_BYTES, UPLOAD_BYTES, Play, ReadyFrames
from controller.device.fpga.play_messages import PlayMessages
from controller.device.kernel import unpack_loads
from controller.device.waveforms.selection import Selection
from controller.workshop.bank_builder.methods.prediction import FocusPrediction
from controller.workshop.benchmark.focus.focus_figures import random_points
from controller.workshop.physics.responses.impulse_response import ResponseModel

SNAPS_MM: Final = (0.0, 0.25, 0.5, 1.0)
Array = NDArray[Any]
KERNELS: Final = ("compiled", "numpy")
PLACES, SEED, ROUNDS = 400, 1, 5


def amplitude_lost(board: Board, bank: Bank, places_m: Array) -> dict[float, Array]:
    """Share of the amplitude lost at each place, (place,), for each snap distance in mm."""
    model = ResponseModel(board)
    prediction = FocusPrediction(board, model)
    selections = {snap_mm: Selection(bank, snap_mm * 1e-3, board.idle_word) for snap_mm in SNAPS_MM}
    lost = {snap_mm: np.empty(len(places_m)) for snap_mm in SNAPS_MM}
    for index, place_m in enumerate(places_m):
        exact_m = _reached_m(prediction, drive_words(model.drive_order_responses([place_m])[0], board.idle_word), place_m)
        for snap_mm, selection in selections.items():
            lost[snap_mm][index] = 1 - _reached_m(prediction, _words(board, selection, place_m), place_m) / exact_m
    return lost


def _reached_m(prediction: FocusPrediction, words: Array, place_m: Array) -> float:
    return float(prediction.at_focus(words, [place_m])[0])


def _words(board: Board, selection: Selection, place_m: Array) -> Array:
    waveform = selection.waveform(selection.key([(float(place_m[0]), float(place_m[1]), 1.0)]))
    words = bytearray(4 * board.waveform.samples)
    if isinstance(waveform, ReadyFrames):
        unpack_loads(words, waveform.frames)
    else:
        words[:] = waveform
    return np.frombuffer(words, WORD).astype(np.uint32)


def cost(board: Board, bank: Bank, snap_mm: float, places_m: Array) -> dict[str, float]:
    """Host time of an upload at each place, and what is resident of the bank afterwards; to be called in a fresh process."""
    selection = Selection(bank, snap_mm * 1e-3, board.idle_word)
    selection.prepare()
    messages = PlayMessages(memoryview(bytearray(UPLOAD_BYTES + COMMANDS * FRAME_BYTES)), board)
    points = [((float(x_m), float(y_m), 1.0),) for x_m, y_m in places_m]
    took_ns = np.empty((ROUNDS, len(points)))
    for taken_ns in took_ns:
        for index, point in enumerate(points):
            begun_ns = time.thread_time_ns()
            waveform = selection.waveform(selection.key(point))
            messages.upload_and_play(0, Play(0), waveform, stop=False)
            taken_ns[index] = time.thread_time_ns() - begun_ns
    us = took_ns[1:] * 1e-3  # the first round reads the file
    return {"median_us": float(np.median(us)), "p99_us": float(np.quantile(us, 0.99)), "resident_mb": _resident_mb(bank.path)}


def _resident_mb(path: Path) -> float:
    """Of the mappings of a file in this process, what is resident."""
    kilobytes, ours = 0, False
    for line in Path("/proc/self/smaps").read_text(encoding="utf-8").splitlines():
        name, _, rest = line.partition(" ")
        if not name.endswith(":"):
            ours = line.endswith(str(path))
        elif ours and name == "Rss:":
            kilobytes += int(rest.split()[0])
    return kilobytes * 1024e-6


def snapping_figures(board: Board, places: int = PLACES, seed: int = SEED) -> dict[str, Any]:
    """Amplitude lost, host time and resident memory for each snap distance, ready for JSON.

    Raises BankError if the board's bank is missing or damaged.
    """
    path = bank_path(board)
    places_m = np.array(random_points(board, seed, places))
    with threadpool_limits(1, "blas"), Bank.open(path, board) as bank:
        lost = amplitude_lost(board, bank, places_m)
    found: dict[str, Any] = {"board": board.name, "places": places, "seed": seed, "snaps": {}}
    for snap_mm in SNAPS_MM:
        percent = 100 * lost[snap_mm]
        costs = {kernel: _in_process(board, snap_mm, places, seed, kernel) for kernel in KERNELS}
        found["snaps"][f"{snap_mm:g}"] = {
            "lost_median_percent": float(np.median(percent)),
            "lost_p95_percent": float(np.quantile(percent, 0.95)),
            "lost_worst_percent": float(percent.max()),
            "kernels": costs,
        }
    return found


def _in_process(board: Board, snap_mm: float, places: int, seed: int, kernel: str) -> dict[str, float]:
    command = [sys.executable, "-m", "controller.workshop.benchmark.device.snapping", "--board", str(board.folder)]
    command += ["--places", str(places), "--seed", str(seed), "--cost-of", str(snap_mm)]
    environment = os.environ | {"HAPTIC_PANEL_KERNEL": kernel, "OPENBLAS_NUM_THREADS": "1"}
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    costs: dict[str, float] = json.loads(done.stdout)
    return costs


def snapping_table(figures: dict[str, Any]) -> str:
    """The figures as the table of the README."""
    lines = [
        "| `snap_mm` | lost: median / 95 % / worst | kernel compiled: median / 99 % | NumPy alone | resident |",
        "|---|---|---|---|---|",
    ]
    for snap_mm, row in figures["snaps"].items():
        times = [f"{row['kernels'][kernel]['median_us']:.0f} / {row['kernels'][kernel]['p99_us']:.0f} µs" for kernel in KERNELS]
        lost = " / ".join(f"{row[f'lost_{name}_percent']:.2f}" for name in ("median", "p95", "worst"))
        lines.append(f"| {snap_mm} | {lost} % | {' | '.join(times)} | {row['kernels']['compiled']['resident_mb']:.0f} MB |")
    return "\n".join(lines)


@program
def main() -> int:
    """Measure, and print the table, or with --json the figures."""
    parser = argparse.ArgumentParser(prog="python -m controller.workshop.benchmark.device.snapping")
    parser.add_argument("--board", default="simulated")
    parser.add_argument("--places", type=int, default=PLACES)
    parser.add_argument("--seed", type=int, default=SEED)
    parser.add_argument("--json", action="store_true")
    parser.add_argument("--cost-of", type=float, help=argparse.SUPPRESS)  # in a process of its own
    options = parser.parse_args()
    board = load_board(find_board(options.board))
    if options.cost_of is not None:
        with Bank.open(bank_path(board), board) as bank:
            places_m = np.array(random_points(board, options.seed, options.places))
            say(json.dumps(cost(board, bank, options.cost_of, places_m)))
        return 0
    figures = snapping_figures(board, options.places, options.seed)
    say(json.dumps(figures, indent=1) if options.json else snapping_table(figures))
    return 0


if __name__ == "__main__":
    sys.exit(main())
