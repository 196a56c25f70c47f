"""`haptic-panel benchmark`: time, memory, bytes and energy of every method of finding drive words, against their errors."""

import argparse
import json
from pathlib import Path

from controller.commands.common.arguments import Declare, natural
from controller.commands.common.named_board import board_of
from controller.commands.common.output import picture_path, progress_bar, show
from controller.commands.common.tables import benchmark_table
from controller.commands.common.worker_options import add_worker_options, workers_of
from controller.console import tell
from controller.device.board.board import of_one_fpga
from controller.errors import ConfigError

RESULTS = "work_precision.json"
SKIPS = ("idle", "resident", "repeated", "ahead", "near", "cells", "together")  # fields of `loop.skips.Skips`


def add(declare: Declare, common: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    benchmark = declare(
        example="haptic-panel benchmark --quick --out results",
        parents=[common],
        description="Compare methods of finding drive words on the plate model: work-precision diagrams (PNG, SVG) and their "
        "figures (JSON). Takes about 10 minutes of one core, --quick 2.5 minutes; workers share all but the timing. "
        "The same command goes on from scenes that are done.",
    )
    benchmark.add_argument("--quick", action="store_true", help="fewer scenes and repetitions")
    benchmark.add_argument(
        "--out", metavar="FOLDER", default="benchmark-results", help="for diagrams and figures (default: benchmark-results)"
    )
    benchmark.add_argument("--seed", type=natural, default=1, metavar="N", help="of the random scenes (default: 1)")
    benchmark.add_argument("--no-timing", action="store_true", help="errors only, without times")
    benchmark.add_argument("--no-pictures", action="store_true", help="figures only, without diagrams")
    add_worker_options(benchmark)
    benchmark.set_defaults(command=run)
    actions = benchmark.add_subparsers(title="actions", metavar="ACTION")
    skips = actions.add_parser(
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
    skips.add_argument("--repeats", type=natural, default=5, metavar="N", help="runs of each for the least host time (default: 5)")
    skips.set_defaults(command=skipping)
    published = actions.add_parser(
        "paper",
        parents=[common],
        help="the figures of the paper, simulated: paper, here, ratio, and why they differ",
        description="Simulate every figure of Hudin, Lozada and Hayward (2015) that can be, at seeded foci, and print it beside "
        "theirs. Takes about 2 minutes of one core; --quick: 15 s.",
    )
    published.add_argument("--quick", action="store_true", help="fewer foci")
    published.add_argument("--seed", type=natural, default=1, metavar="N", help="of the foci (default: 1)")
    published.add_argument("--markdown", action="store_true", help="print the table of the README")
    published.add_argument("--plot", metavar="FILE", help="draw them (.png, .svg, .pdf)")
    published.set_defaults(command=paper)


def run(options: argparse.Namespace) -> int:
    """Measure, write figures and diagrams, and print the Pareto fronts."""
    from controller.workshop.benchmark.work_precision import FULL, KEPT, QUICK, work_precision

    board = of_one_fpga(board_of(options))
    folder = Path(options.out)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        (folder / RESULTS).touch()
    except OSError as error:
        raise ConfigError(
            f"{folder}: results cannot be written there ({error.strerror}); give another folder with --out"
        ) from error
    effort = QUICK if options.quick else FULL
    timing, workers, progress = not options.no_timing, workers_of(options), progress_bar("timing")
    try:
        figures = work_precision(board, effort, options.seed, kept=folder, timing=timing, workers=workers, progress=progress)
    except KeyboardInterrupt:
        tell("the scenes that are done are kept: the same command goes on from there")
        raise
    (folder / RESULTS).write_text(json.dumps(figures, indent=1, allow_nan=False) + "\n", encoding="utf-8")
    for kept in folder.glob(KEPT):
        kept.unlink(missing_ok=True)
    if not options.no_pictures:
        from controller.workshop.benchmark.work_precision_diagrams import draw_all

        draw_all(folder, figures)
    show(options, figures, benchmark_table)
    return 0


def skipping(options: argparse.Namespace) -> int:
    """Print what skipping saves; 1 if it changes output bits that it must not change."""
    from controller.workshop.benchmark.device.skipping import all_cases, table

    found = all_cases(of_one_fpga(board_of(options)), options.no_skip, options.repeats, progress_bar("scenes"))
    show(options, found, lambda figures: "\n\n".join(map(table, figures["cases"])))
    return int(any(case["must_be_exact"] and not case["exact_bits"] for case in found["cases"]))


def paper(options: argparse.Namespace) -> int:
    """Print the paper's figures beside ours, and draw them."""
    from controller.workshop.benchmark.paper.paper import FULL, QUICK, paper_figures
    from controller.workshop.benchmark.paper.paper_row import markdown, paper_table

    picture = picture_path(options)
    board = of_one_fpga(board_of(options))
    found = paper_figures(board, QUICK if options.quick else FULL, options.seed, progress_bar("paper"))
    if picture:
        from controller.workshop.benchmark.paper.plot_paper import plot_paper

        plot_paper(picture, found)
    show(options, found, markdown if options.markdown else paper_table)
    return 0
