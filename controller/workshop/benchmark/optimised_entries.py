"""What optimising a bank's entries gains: plain, contrast, quiet and balanced at random cells, on a plate that drifts.

`python -m controller.workshop.benchmark.optimised_entries` prints the table of `workshop/bank_builder/methods/README.md`. The
plate that plays is the plate twin; a drifted one has all its frequencies higher or lower by as much, what is worse counts.
"""

from __future__ import annotations

import argparse
import json
import time
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from threadpoolctl import threadpool_limits
from tqdm import tqdm

from controller.console import program, say
from controller.device.bank.grid import Grid
from controller.device.bank.packing import drive_words, edges
from controller.device.board.board import Board, load_board
from controller.device.board.lookup import find_board
from controller.workshop.bank_builder.methods.descent import AIMS, Descent
from controller.workshop.bank_builder.methods.plain import SignOfSum
from controller.workshop.benchmark.focus.focus_figures import emit, random_points
from controller.workshop.benchmark.plot_optimised import plot_optimised
from controller.workshop.physics.audible import surface_energy
from controller.workshop.physics.modes.plate_modes import modes_of
from controller.workshop.physics.modes.retuned import drifted
from controller.workshop.physics.plate import mode_cut_hz
from controller.workshop.physics.plate_twin import PlateTwin
from controller.workshop.physics.responses.impulse_response import ResponseModel

DRIFTS = (0.0, 0.001, 0.005)
Figures = dict[str, Any]


def figures(board: Board, cells: int, seed: int) -> Figures:
    """Evaluate optimised entries at random cells of the board's grid, drawn without repetition.

    For each method its processor time a cell, and for each drift min and median of amplitude and contrast; audible energy and edges
    relative to plain, on the plate without drift.
    """
    grid = Grid.of(board.plate, board.bank.pitch_mm * 1e-3)
    points_m = grid.points()[np.sort(np.random.default_rng(seed).choice(grid.cells, min(cells, grid.cells), replace=False))]
    twins = [[PlateTwin(board, modes=drifted(modes_of(board), sign * by)) for sign in ((1, -1) if by else (1,))] for by in DRIFTS]
    model = ResponseModel(board, mode_cut_hz(board.waveform))
    methods: Figures = {}
    plain: list[NDArray[np.uint32]] = []
    with tqdm(total=(1 + len(AIMS)) * len(points_m), unit="entry", disable=None) as bar, threadpool_limits(1, "blas"):
        for name in ("plain", *AIMS):
            method = Descent(board, model, AIMS[name]) if name in AIMS else None
            before = time.process_time()
            if method:
                found = list(method.entries(points_m))
            else:
                found = [drive_words(model.drive_order_responses(p, dtype=np.float64)[0], board.idle_word) for p in points_m]
                plain = found
            seconds = (time.process_time() - before) / len(points_m)
            rows = []
            for words, before_words, (x_m, y_m) in zip(found, plain, points_m.tolist(), strict=True):
                fields = [[emit(twin, words).focus_metrics(x_m, y_m) for twin in both] for both in twins]
                rows.append(
                    [
                        *(min(field.amplitude_m for field in both) for both in fields),
                        *(min(field.contrast for field in both) for both in fields),
                        surface_energy(board, words, board.idle_word) / surface_energy(board, before_words, board.idle_word),
                        edges(words).sum() / edges(before_words).sum(),
                        edges(words).max() / board.waveform.duration_s,
                    ]
                )
                bar.update()
            methods[name] = {"seconds_a_cell": seconds, "rows": np.array(rows)}
    of_plain = methods["plain"]["rows"][:, 0]
    return {"cells": len(points_m), "of": grid.cells, "seed": seed} | {
        name: {"seconds_a_cell": found["seconds_a_cell"], **_summary(found["rows"], of_plain)} for name, found in methods.items()
    }


def picture(board: Board, path: Path) -> None:
    """Draw the plate at T with a focus away from patches and edges: plain, and for most contrast."""
    x_m, y_m = random_points(board, 1, 1, board.plate.width_m / 3)[0].tolist()
    model, twin = ResponseModel(board, mode_cut_hz(board.waveform)), PlateTwin(board)
    fields = []
    for name, method in (("plain", SignOfSum(board, model)), ("contrast", Descent(board, model, AIMS["contrast"]))):
        field = emit(twin, method.design([(x_m, y_m, 1.0)]).words)
        fields.append((f"{name}: {field.focus_metrics(x_m, y_m).contrast:.0f} outside the circle", field))
    plot_optimised(path, board, (x_m, y_m), fields)


def _summary(rows: NDArray[np.float64], of_plain: NDArray[np.float64]) -> Figures:
    reported: Figures = {}
    count = len(DRIFTS)
    for index, by in enumerate(DRIFTS):
        share, contrast = rows[:, index] / of_plain, rows[:, count + index]
        reported[f"drift_{by * 100:g}_percent"] = {
            "amplitude": {"min": share.min(), "median": float(np.median(share)), "max": share.max()},
            "contrast": {"min": contrast.min(), "median": float(np.median(contrast))},
        }
    decibels = 10 * np.log10(rows[:, 2 * count])
    reported["audible_db"] = {"median": float(np.median(decibels)), "max": decibels.max()}
    reported["edges"] = {"median": float(np.median(rows[:, 2 * count + 1])), "busiest_hz": rows[:, 2 * count + 2].max()}
    return reported


def table(reported: Figures) -> str:
    """Rows of Markdown."""
    lines = [
        f"| {reported['cells']} of {reported['of']:,} cells, seed {reported['seed']} | {' | '.join(['plain', *AIMS])} |",
        f"|---{'|---' * (1 + len(AIMS))}|",
    ]

    def line(title: str, of: Any) -> None:
        lines.append(f"| {title} | {' | '.join(of(reported[name]) for name in ('plain', *AIMS))} |")

    for by in DRIFTS:
        key, when = f"drift_{by * 100:g}_percent", f", frequencies off by {by * 100:g} %" if by else ""

        def spread(found: Figures, key: str = key) -> str:
            return " / ".join(f"{found[key]['amplitude'][name]:.3f}" for name in ("min", "median", "max"))

        def contrasts(found: Figures, key: str = key) -> str:
            return " / ".join(f"{found[key]['contrast'][name]:.1f}" for name in ("min", "median"))

        line(f"amplitude over plain{when} (min / median / max)", spread)
        line(f"contrast{when} (min / median)", contrasts)
    line(
        "energy below 16 kHz over plain (median / worst)",
        lambda f: f"{f['audible_db']['median']:.1f} / {f['audible_db']['max']:.1f} dB",
    )
    line(
        "edges over plain (median); of the busiest channel",
        lambda f: f"{f['edges']['median']:.2f}; {f['edges']['busiest_hz']:,.0f} Hz",
    )
    line("processor time a cell", lambda f: f"{f['seconds_a_cell']:.2f} s")
    return "\n".join(lines)


@program
def main() -> int:
    """Print the table, or the figures as JSON."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--board", default="simulated")
    parser.add_argument("--cells", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--json", action="store_true")
    parser.add_argument("--plot", type=Path, metavar="F", help="draw the plate at T instead, to a .png, .svg or .pdf")
    options = parser.parse_args()
    if options.plot:
        picture(load_board(find_board(options.board)), options.plot)
        return 0
    reported = figures(load_board(find_board(options.board)), options.cells, options.seed)
    say(json.dumps(reported) if options.json else table(reported))
    return 0


if __name__ == "__main__":
    main()
