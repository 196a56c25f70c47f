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


def add(declare: Declare, common: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    benchmark = declare(
        parents=[common],
        description="Compare methods of finding drive words on the plate model: work-precision diagrams (PNG, SVG) and their "
        "figures (JSON). Takes about 10 minutes; --quick: 1 minute.",
    )
    benchmark.add_argument("--quick", action="store_true", help="fewer scenes and repetitions")
    benchmark.add_argument(
        "--out", metavar="FOLDER", default="benchmark-results", help="for diagrams and figures (default: benchmark-results)"
    )
    benchmark.add_argument("--seed", type=_natural, default=1, metavar="N", help="of the random scenes (default: 1)")
    benchmark.add_argument("--no-timing", action="store_true", help="errors only, without times")
    benchmark.add_argument("--no-pictures", action="store_true", help="figures only, without diagrams")
    benchmark.set_defaults(command=run)


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


def _natural(text: str) -> int:
    """Argument that is a whole number from 0."""
    if not text.isascii() or not text.isdigit():
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number from 0")
    return int(text)
