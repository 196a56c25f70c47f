"""`haptic-panel calibrate check`: read and deconvolve measurements, and name what is wrong with them."""

import argparse
from pathlib import Path
from typing import Any

from controller.commands.common.named_board import board_of
from controller.commands.common.output import picture_path, progress_bar, show

ACCEPTED = ("dead", "swapped", "inverted", "clipped", "unit", "mass", "strength")


def add(step: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    step.add_argument("folder", metavar="FOLDER", help="with a measurement.toml")
    step.add_argument("--plot", metavar="FILE", help="draw coherence over the plate and some responses (.png, .svg, .pdf)")
    declare_accept(step)
    step.set_defaults(command=check)


def declare_accept(step: argparse.ArgumentParser) -> None:
    """Declare --accept."""
    step.add_argument(
        "--accept",
        action="append",
        default=[],
        choices=ACCEPTED,
        metavar="KIND",
        help=f"go on although something is {', '.join(ACCEPTED[:-1])}, or of another strength than foreseen; may be repeated",
    )


def check(options: argparse.Namespace) -> int:
    """Print figures and findings of a measurement, and draw them; 78 if it would make a wrong bank."""
    from threadpoolctl import threadpool_limits

    from controller.workshop.calibration.learning.learning import learn
    from controller.workshop.calibration.pictures.check_figures import check_figures
    from controller.workshop.calibration.transfer_functions.point_cache import calibration_cache

    picture = picture_path(options)
    board = board_of(options)
    folder = Path(options.folder)
    with threadpool_limits(1, "blas"):
        learned = learn(folder, board, cache=calibration_cache(board, folder), progress=progress_bar("points"))
    if picture:
        from controller.workshop.calibration.pictures.plot_check import plot_check

        plot_check(picture, board, learned)
    show(options, check_figures(board, learned), _table)
    learned.require(options.accept)
    return 0


def _table(figures: dict[str, Any]) -> str:
    def reported(name: str, unit: str = "") -> str:
        return "not reported" if figures[name] is None else f"{figures[name]:g}{unit}"

    low_khz, high_khz = figures["excited_khz"]
    lines = [
        f"{figures['folder']}: {figures['points']} points, {figures['missing']} of them without records;"
        f" {figures['emissions']} emissions, {figures['repetitions']} times each",
        f"{'responses known':<26}{figures['known_share']:.1%}, from {low_khz:g} to {high_khz:g} kHz; nothing beyond",
        f"{'regularised by':<26}{figures['regularisation']:g} of the drive's power",
        f"{'coherence':<26}{reported('coherence')} (least {reported('least_coherence')})",
        f"{'signal over noise':<26}{reported('snr_db', ' dB')} (least {reported('least_snr_db', ' dB')})",
        f"{'noise of a sample':<26}{reported('noise_pm_per_v', ' pm per V')}",
        f"{'not explained':<26}{reported('residual')} of the records' power",
        f"{'recorder fast by':<26}{reported('clock_ppm', ' ppm')} (to {reported('clock_error_ppm', ' ppm')})",
        f"{'records late by':<26}{reported('delay_us', ' us')}",
        f"{'strength':<26}{reported('strength')} of what board.toml foresees",
        f"{'measuring frame':<26}{figures['frame'] or 'not found'}",
        f"{'mass of the sensor':<26}{figures['sensor_mass'] or 'not found'}",
        "",
        f"{'channel':>7}{'points':>8}{'coherence':>11}{'SNR (dB)':>10}{'strength':>10}",
    ]
    for row in figures["channels"]:
        shown = ["-" if row[name] is None else f"{row[name]:g}" for name in ("coherence", "snr_db", "strength")]
        lines.append(f"{row['channel']:>7}{row['known']:>8}{shown[0]:>11}{shown[1]:>10}{shown[2]:>10}")
    lines += ["", *(f"{'WRONG' if one['fatal'] else 'note'}: {one['message']}" for one in figures["findings"])]
    return "\n".join(lines if figures["findings"] else [*lines, "nothing found wrong"])
