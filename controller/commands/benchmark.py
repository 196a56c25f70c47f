"""`haptic-panel benchmark`: time, memory, bytes and energy of every method of finding drive words, against their errors."""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import TYPE_CHECKING

from controller.board.board import load_board
from controller.board.lookup import find_board
from controller.commands.output import progress_bar, show
from controller.commands.tables import benchmark_table
from controller.errors import ConfigError

if TYPE_CHECKING:
    from controller.commands.output import Declare

RESULTS = "work_precision.json"
SKIPS = ("idle", "resident", "repeated", "ahead", "near", "cells", "together")  # fields of `loop.skips.Skips`


def add(declare: Declare, common: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    benchmark = declare(
        parents=[common],
        description="Compare methods of finding drive words on the plate model: work-precision diagrams (PNG, SVG) and their "
        "figures (JSON). Takes about 11 minutes of one core; --quick: 2 minutes.",
    )
    benchmark.add_argument("--quick", action="store_true", help="fewer scenes and repetitions")
    benchmark.add_argument(
        "--out", metavar="FOLDER", default="benchmark-results", help="for diagrams and figures (default: benchmark-results)"
    )
    benchmark.add_argument("--seed", type=_natural, default=1, metavar="N", help="of the random scenes (default: 1)")
    benchmark.add_argument("--no-timing", action="store_true", help="errors only, without times")
    benchmark.add_argument("--no-pictures", action="store_true", help="figures only, without diagrams")
    benchmark.set_defaults(command=run)
    skips = benchmark.add_subparsers(title="actions", metavar="ACTION").add_parser(
        "skipping",
        parents=[common],
        help="what the loop leaves out in six scenes, and what that saves",
        description="Play six scenes on the simulated panel with all skipping and without, and print what that saves.",
    )
    skips.add_argument(
        "--no-skip",
        nargs="+",
        default=[],
        choices=SKIPS,
        metavar="WHAT",
        help=f"leave only this undone in the runs compared with: {', '.join(SKIPS)} (default: all of it)",
    )
    skips.add_argument("--repeats", type=_natural, default=5, metavar="N", help="runs of each for the least host time (default: 5)")
    skips.set_defaults(command=skipping)


def run(options: argparse.Namespace) -> int:
    """Measure, write figures and diagrams, and print the Pareto fronts."""
    from controller.benchmark.work_precision import FULL, QUICK, work_precision

    board = load_board(find_board(options.board))
    folder = Path(options.out)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        (folder / RESULTS).touch()
    except OSError as error:
        raise ConfigError(
            f"{folder}: results cannot be written there ({error.strerror}); give another folder with --out"
        ) from error
    effort = QUICK if options.quick else FULL
    figures = work_precision(board, effort, options.seed, timing=not options.no_timing, progress=progress_bar("benchmark"))
    (folder / RESULTS).write_text(json.dumps(figures, indent=1, allow_nan=False) + "\n", encoding="utf-8")
    if not options.no_pictures:
        from controller.benchmark.work_precision_diagrams import draw_all

        draw_all(folder, figures)
    show(options, figures, benchmark_table)
    return 0


def skipping(options: argparse.Namespace) -> int:
    """Print what skipping saves; 1 if it changes output bits that it must not change."""
    from controller.benchmark.skipping import all_cases, table

    found = all_cases(load_board(find_board(options.board)), options.no_skip, options.repeats, progress_bar("scenes"))
    show(options, found, lambda figures: "\n\n".join(map(table, figures["cases"])))
    return int(any(case["must_be_exact"] and not case["exact_bits"] for case in found["cases"]))


def _natural(text: str) -> int:
    """Argument that is a whole number from 0."""
    if not text.isascii() or not text.isdigit():
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number from 0")
    return int(text)
