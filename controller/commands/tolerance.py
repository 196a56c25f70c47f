"""`haptic-panel tolerance`: what yield production will have, before tools are ordered."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Any

from controller.commands.common.arguments import Declare, natural, require_within
from controller.commands.common.named_board import named_board
from controller.commands.common.output import picture_path, show
from controller.commands.common.worker_options import add_worker_options, workers_of
from controller.console import tell
from controller.device.board.board import load_board, of_one_fpga
from controller.device.board.lookup import find_board

if TYPE_CHECKING:
    from controller.workshop.tolerance.tolerances import Tolerances

ROWS = {
    "relative": "amplitude, over the design's",
    "weakest": "at the weakest place",
    "amplitude_um": "amplitude (µm)",
    "contrast": "contrast",
    "spot_mm": "spot (mm)",
}
TITLES = {"model": "model's bank", "clock": "best bit clock", "calibrated": "calibrated"}


def add(declare: Declare, common: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    command = declare(
        example="haptic-panel tolerance --board simulated --plates 1000 --plot build/yield.png",
        parents=[common],
        description="Draw plates from production tolerances and play three banks on each: that of the board's model, the same at "
        "the bit clock that suits the plate best, and one calibrated on the plate. Prints distributions of amplitude, contrast and "
        "spot, the share of good plates, and what each tolerance costs alone. What is done is kept: more plates go on from fewer.",
    )
    command.add_argument("--plates", type=natural, default=40, metavar="N", help="plates to draw (default: 40)")
    command.add_argument("--seed", type=natural, default=1, help="of the plates and of the places on them (default: 1)")
    command.add_argument("--tolerances", type=Path, metavar="FILE", help="what varies, and how (default: those shipped)")
    command.add_argument(
        "--least", type=float, default=0.7, metavar="A", help="a plate is good if its weakest place has this share (default: 0.7)"
    )
    command.add_argument("--places", type=natural, default=9, metavar="N", help="places at which a plate is evaluated (default: 9)")
    command.add_argument("--points", type=natural, default=250, metavar="N", help="points of a calibration (default: 250)")
    command.add_argument("--snr-db", type=float, default=40.0, metavar="DB", help="of its records (default: 40)")
    command.add_argument(
        "--alone",
        type=natural,
        default=6,
        metavar="N",
        help="of --plates, on which each tolerance varies alone; 0: none (default: 6)",
    )
    command.add_argument("--plot", metavar="FILE", help="draw it (.png, .svg, .pdf)")
    command.add_argument(
        "--intervals",
        type=natural,
        metavar="N",
        help="instead: measure and play N plates of a corner of the simulated board, with other edges and Mindlin's theory, and"
        " count how often the truth lies within the interval that the bank states",
    )
    command.add_argument(
        "--whole", action="store_true", help="with --intervals: of the whole board, some 10 s each, and no banks of other plates"
    )
    add_worker_options(command)
    command.set_defaults(command=tolerance)


def tolerance(options: argparse.Namespace) -> int:
    """Print the figures of many drawn plates."""
    from controller.device.board.records import load_toml
    from controller.workshop.tolerance.figures import PLATES_MAX, study_figures
    from controller.workshop.tolerance.study import Study
    from controller.workshop.tolerance.tolerances import SHIPPED, Tolerances

    ranges = {"places": (1, 100), "points": (100, 10_000), "snr_db": (0, 100), "least": (0, 2)}
    require_within(options, ranges | dict.fromkeys(("plates", "intervals"), (1, PLATES_MAX)))
    tolerances = load_toml(options.tolerances or SHIPPED, Tolerances)
    if options.intervals is not None:
        return _intervals(options, tolerances)
    picture = picture_path(options)
    study = Study(
        of_one_fpga(named_board(options.board)),
        tolerances,
        options.seed,
        options.places,
        options.points,
        options.snr_db,
    )
    try:
        figures = study_figures(study, options.plates, min(options.alone, options.plates), options.least, workers_of(options))
    except KeyboardInterrupt:
        tell("what is done is kept: the same command goes on from there")
        raise
    if picture:
        from controller.workshop.tolerance.plot_tolerance import plot_tolerance

        plot_tolerance(picture, figures)
    show(options, figures, _table)
    return 0


def _intervals(options: argparse.Namespace, tolerances: Tolerances) -> int:
    """Print how often intervals hold the truth."""
    from controller.workshop.tolerance.coverage import interval_figures

    board = load_board(find_board("simulated"))
    figures = interval_figures(board, tolerances, options.intervals, workers_of(options), whole=options.whole)
    show(options, figures, _interval_table)
    return 0


def _interval_table(figures: dict[str, Any]) -> str:
    lines = [f"{figures['plates']} plates of seed {figures['seed']}: how often the truth lies within what the bank states, in %"]
    for name, kinds in figures["intervals"].items():
        for kind, found in kinds.items():
            within = f"{100 * found['within']:6.1f}  (95 %: {100 * found['within_from']:.1f} to {100 * found['within_to']:.1f})"
            wide = f"most over least {found['width']:.2f}" if found["width"] else "no least"
            lines.append(f"{name if kind == 'all' else '':<36}{kind:<18}{within}  {wide}")
    return "\n".join(lines)


def _table(figures: dict[str, Any]) -> str:
    nominal = figures["nominal"]
    lines = [
        f"board {figures['board']}: {figures['plates']} plates of seed {figures['seed']}, evaluated at {figures['places']} places; "
        f"the design has {nominal['amplitude_um']:.2f} µm, contrast {nominal['contrast']:.1f}, spot {nominal['spot_mm']:.2f} mm",
        "",
        f"{'':<46}{'p5':>8}{'p50':>8}{'p95':>8}{'worst':>8}",
    ]
    for name, title in ROWS.items():
        for bank, of_bank in figures["banks"].items():
            values = "".join(f"{of_bank[name][key]:>8.3g}" for key in ("p5", "p50", "p95", "worst"))
            lines.append(f"{title if bank == 'model' else '':<30}{TITLES[bank]:<16}{values}")
    lines.append("")
    for bank, of_bank in figures["banks"].items():
        title = f"good, weakest from {figures['least']:g} on (%)" if bank == "model" else ""
        shares = [100 * of_bank[name] for name in ("good", "good_from", "good_to")]
        lines.append(f"{title:<30}{TITLES[bank]:<16}{shares[0]:>8.3g}  (95 %: {shares[1]:.3g} to {shares[2]:.3g})")
    if figures["alone"]:
        head = f"each alone, {figures['alone_plates']} plates: mean, worst"
        lines += ["", f"{head:<46}" + "".join(f"{title:>16}" for title in TITLES.values())]
    for name, banks in sorted(figures["alone"].items(), key=lambda found: found[1]["model"]["mean"]):
        lines.append(f"{name:<46}" + "".join(f"{banks[bank]['mean']:>8.3f}{banks[bank]['worst']:>8.3f}" for bank in TITLES))
    return "\n".join(lines)
