"""`haptic-panel calibrate bank`: a bank from the measurements of a plate."""

import argparse
from pathlib import Path
from typing import Any

from controller.commands.calibrate.check import declare_accept
from controller.commands.common.named_board import board_of
from controller.commands.common.output import picture_path, progress_bar, show
from controller.commands.common.worker_options import UNLESS_OPTIMISED, add_worker_options, workers_of_bank
from controller.console import tell
from controller.device.bank.lookup import find_bank

OF_RECORDS = {"measuring frame": "frame", "mass of the sensor": "sensor_mass"}


def add(step: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    step.add_argument("folder", metavar="FOLDER", help="with a measurement.toml")
    step.add_argument(
        "--out", metavar="FILE", help="file to write (default: where run looks for the board's bank, which is printed)"
    )
    declare_bank(step)
    add_worker_options(step, UNLESS_OPTIMISED)
    step.add_argument("--also", metavar="FOLDER", help="the same plate at another temperature: determines coefficient_per_k")
    step.add_argument("--plot", metavar="FILE", help="draw what points left out keep, and the fits (.png, .svg, .pdf)")
    step.set_defaults(command=calibrate_bank)


def declare_bank(step: argparse.ArgumentParser) -> None:
    """Declare what a measured bank is to be like."""
    step.add_argument(
        "--pitch-mm", type=float, metavar="P", help="distance of the cells in mm (default: the board's bank.pitch_mm)"
    )
    step.add_argument("--compact", action="store_true", help="a compact bank, of some MB (default: as compose.method says)")
    step.add_argument("--memory-mb", type=float, metavar="M", help="memory that the bank's build may take, in MB (default: 1500)")
    step.add_argument(
        "--model",
        action="store_true",
        help="let the board's plate model fill gaps between scattered points, if its edges prove right",
    )
    step.add_argument(
        "--optimise",
        choices=("contrast", "quiet", "balanced", "loud", "cool"),
        help="optimise every entry by the field that the measurements foresee: more contrast, less sound, both, a fifth more"
        " amplitude, or less heat in the stages; about half a second of a core a cell (default: none)",
    )
    declare_accept(step)


def calibrate_bank(options: argparse.Namespace) -> int:
    """Read, check, interpolate, and build; nothing is written if anything is refused."""
    from threadpoolctl import threadpool_limits

    from controller.workshop.bank_builder.own_bank import pitch_of
    from controller.workshop.calibration.banks.plate_bank import PlateBank, build, fit
    from controller.workshop.calibration.duration import foreseen

    picture = picture_path(options)
    board, folder = board_of(options), Path(options.folder)
    out, also = (Path(name) if name else None for name in (options.out, options.also))
    wanted = PlateBank(board, folder, out, also=also, **bank_options(options))
    workers = workers_of_bank(options)
    bars: dict[str, Any] = {}

    def progress(what: str, done: int, total: int) -> None:
        bars.setdefault(what, progress_bar(what))(done, total)

    with threadpool_limits(1, "blas"):
        if work := foreseen(board, folder, pitch_of(board, options.pitch_mm) * 1e-3):
            tell(work.in_words())
    fitted = fit(wanted, progress)
    if picture:
        from controller.workshop.calibration.pictures.plot_leave_out import plot_leave_out

        plot_leave_out(picture, board, fitted.source, fitted.waves, fitted.decays)
    built = build(wanted, fitted, workers)
    for note in built.notes:
        tell(note)
    report = {name: getattr(built.report, name) for name in ("cells", "bytes", "optimised", "workers")}
    show(options, {"path": str(built.path), **report, **fitted.figures, "notes": built.notes}, _table)
    if built.path != (played := find_bank(board)).path:
        tell(f"run plays from {played.path} ({played.why}) unless given --bank {built.path}")
    return 0


def bank_options(options: argparse.Namespace) -> dict[str, Any]:
    """What `declare_bank` declares, as fields of `PlateBank`."""
    from controller.workshop.bank_builder.methods.aims import AIMS

    fields = {name: getattr(options, name) for name in ("pitch_mm", "compact", "memory_mb", "model")}
    return fields | {"accept": tuple(options.accept), "aim": AIMS.get(options.optimise)}


def _table(figures: dict[str, Any]) -> str:
    from controller.workshop.calibration.banks.bank_figures import with_error

    def reported(pair: list[float | None]) -> str:
        return f"{pair[0]:g}" if pair[1] is None else f"{pair[0]:g} ± {pair[1]:g}"

    left = figures["left_out_kept"]
    lines = [f"{title:<28}{figures[name] or 'not found'}" for title, name in OF_RECORDS.items()]
    if points := figures["errors_of_points"]:
        lines += [
            f"{'errors of points':<28}{', '.join(points['corrected']) or 'none'} corrected; of a point left out"
            f" {points['unforeseen'][1]:.1%} of the energy is not foreseen, {points['unforeseen'][0]:.1%} before",
            f"{'  places, each axis':<28}{reported(points['places_mm'])} mm",
            f"{'  sensitivity':<28}{reported(points['sensitivity_percent'])} %",
            f"{'  drift, first to last':<28}{reported(points['drift_percent'])} %",
        ]
    lines += [
        f"{'interpolation':<28}{figures['interpolation']}",
        f"{'points left out keep':<28}{left['median']:g} at the median, {left['worst_5_percent']:g} of the worst 5 %,"
        f" {left['least']:g} at least; {left['points']} were",
        f"{'wavenumbers':<28}{reported(figures['wavenumber_factor'])} of board.toml's by Mindlin's theory",
        f"{'frequencies, stiffness':<28}{reported(figures['frequency_scale'])}, {reported(figures['stiffness_scale'])}",
    ]
    for one in figures["decays"]:
        between = f"decay, {one['low_khz']:g} to {one['high_khz']:g} kHz"
        lines.append(f"{between:<28}{reported(one['time_ms'])} ms")
    if drift := figures["drift"]:
        kelvin = "" if drift["kelvin"] is None else f" after {drift['kelvin']:+g} K"
        lines.append(f"{'frequencies, other set':<28}{reported(drift['frequency_ratio'])}{kelvin}, {drift['alike']:g} alike")
        if drift["coefficient_per_k"]:
            lines.append(f"{'coefficient_per_k':<28}{reported(with_error(*drift['coefficient_per_k']))}")
    if optimised := figures["optimised"]:
        over = optimised["contrast_of_plain"]
        lines.append(
            f"{'optimised':<28}{optimised['aim']}: {over['by_responses']:g} times the contrast of plain entries"
            f" by the responses, {over['with_error']:g} with their error"
        )
    return "\n".join([*lines, f"{figures['responses']}", f"bank: {figures['path']}, {figures['cells']:,} cells"])
