"""`haptic-panel focus`: focus on points of the plate model, and measure the focus."""

import argparse
from pathlib import Path
from typing import Any

from controller.commands.common.arguments import Declare, natural, require_within
from controller.commands.common.named_board import board_of
from controller.commands.common.output import picture_path, show
from controller.commands.common.tables import amplitude_table, plain_table
from controller.commands.focus.movie import add_movie, film, movie_path
from controller.device.board.board import Board, of_one_fpga
from controller.errors import ConfigError, UsageError

FINGER_MOST = (10e3, 1e3, 1e7)  # mg, N s/m, N/m


def add(declare: Declare, common: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    point = declare(
        example="haptic-panel focus --at 100 70 --at 60 90 --plot focus.png",
        parents=[common],
        description="Compute the waveform for one or several points without a bank, and measure the focus on the plate model.",
    )
    point.add_argument("--at", nargs=2, type=float, action="append", metavar=("X_MM", "Y_MM"), help="a point; may be repeated")
    point.add_argument("--figures", action="store_true", help="measure the figures of the README at random points instead")
    point.add_argument(
        "--idle-figures", action="store_true", help="measure what the idle word and its ramp are worth instead; --plot draws it"
    )
    point.add_argument(
        "--amplitude-figures",
        action="store_true",
        help="measure what composing from a bank reaches instead: amplitudes, places between cells, edges; --plot draws it",
    )
    point.add_argument("--pitch-mm", type=float, metavar="MM", help="of that bank (default: the board's)")
    point.add_argument(
        "--scenes", type=natural, default=20, metavar="N", help="of each number of fingers that it evaluates (default: 20)"
    )
    point.add_argument("--seed", type=natural, default=1, help="of the random points (default: 1)")
    point.add_argument(
        "--memory-mb", type=float, metavar="M", help="memory that --at may take, in MB (default: 1500); refused if it needs more"
    )
    point.add_argument(
        "--period-ms",
        type=float,
        metavar="MS",
        help="time from emission to emission for what repeating costs (default: their length)",
    )
    point.add_argument(
        "--finger-load",
        type=_finger_load,
        metavar="MASS_MG[,C,K]",
        help="also the amplitudes with a finger on each focus, and with one elsewhere: mass, damping in N s/m, stiffness in N/m",
    )
    point.add_argument("--plot", metavar="FILE", help="draw the plate at T, and the first focus over time (.png, .svg, .pdf)")
    point.add_argument(
        "--field-out", metavar="FILE", help="write the file from which the live page shows the field of any point, instead"
    )
    add_movie(point)
    point.set_defaults(command=focus)


def focus(options: argparse.Namespace) -> int:
    """Focus on points of the plate and print figures of merit; or measure the figures of the README."""
    from controller.workshop.benchmark.focus.focus_figures import figures

    require_within(options, {"scenes": (1, 1e4)})
    picture, movie = picture_path(options), movie_path(options)
    if options.finger_load and not options.at:
        raise UsageError("--finger-load is of a focus: give --at X_MM Y_MM too")
    board = board_of(options)
    if options.field_out:
        return _write_field(options, board)
    if options.figures:
        show(options, figures(board, options.seed), plain_table)
    elif options.idle_figures:
        _idle(options, of_one_fpga(board), picture)
    elif options.amplitude_figures:
        _amplitudes(options, of_one_fpga(board), picture)
    elif options.at:
        _points(options, board, picture, movie)
    else:
        raise ConfigError(
            "focus where? give --at X_MM Y_MM once for each point, or --figures, --idle-figures, --amplitude-figures, --field-out"
        )
    return 0


def _idle(options: argparse.Namespace, board: Board, picture: Path | None) -> None:
    from controller.workshop.benchmark.device.idle import idle_figures

    found = idle_figures(board, options.seed)
    if picture:
        from controller.workshop.benchmark.device.idle import plot_idle

        plot_idle(picture, board, found)
    show(options, found, plain_table)


def _amplitudes(options: argparse.Namespace, board: Board, picture: Path | None) -> None:
    from controller.workshop.benchmark.focus.amplitude import amplitude_figures

    pitch_mm = board.bank.pitch_mm if options.pitch_mm is None else options.pitch_mm
    found = amplitude_figures(board, options.seed, options.scenes, pitch_mm * 1e-3)
    if picture:
        from controller.workshop.benchmark.focus.amplitude import plot_amplitude

        plot_amplitude(picture, found)
    show(options, found, amplitude_table)


def _points(options: argparse.Namespace, board: Board, picture: Path | None, movie: Path | None) -> None:
    from controller.workshop.benchmark.focus.focus_emission import emission_at, emission_figures, evaluated_foci

    points_m = [(_on_plate(x_mm, board.plate.length_mm), _on_plate(y_mm, board.plate.width_mm)) for x_mm, y_mm in options.at]
    period_s = _period_s(options.period_ms, board.waveform.duration_s)
    emission = emission_at(board, points_m, options.memory_mb)
    found: dict[str, Any] = {
        "board": board.name,
        "foci": evaluated_foci(emission, period_s),
        "emission": emission_figures(emission, period_s),
    }
    if options.finger_load:
        from controller.workshop.benchmark.focus.focus_emission import finger_figures
        from controller.workshop.physics.finger import Finger

        mass_mg, damping_n_s_m, stiffness_n_m = options.finger_load
        finger = Finger(mass_mg * 1e-6, damping_n_s_m, stiffness_n_m)
        on_foci, found["finger_elsewhere"] = finger_figures(emission, finger, options.seed)
        for row, of_finger in zip(found["foci"], on_foci, strict=True):
            row["finger_on_it"] = of_finger
    if picture:
        from controller.workshop.physics.pictures.focus_series import focus_series
        from controller.workshop.physics.pictures.plot import plot_focus

        title = f"focus on {len(points_m)} point{'s' * (len(points_m) != 1)}"
        series = focus_series(emission.twin, emission.words, points_m[0])
        plot_focus(picture, board, emission.field, points_m, title, series)
    if movie:
        film(options, movie, emission, points_m)
    show(options, found, _table)


def _write_field(options: argparse.Namespace, board: Board) -> int:
    from controller.workshop.physics.pictures.field_file import write_field

    file = Path(options.field_out).absolute()
    found = {"file": str(file), "bytes": write_field(board, file), "setting": f'field = "{file}"'}
    show(options, found, lambda rows: f"{plain_table(rows)}\nthe setting goes into page.toml: `haptic-panel page --settings FILE`")
    return 0


def _table(found: dict[str, Any]) -> str:
    """Each focus, then the emission; its channels one by one are only in --json."""
    emission = {name: value for name, value in found["emission"].items() if name != "channels"}
    elsewhere = [{name: found[name]} for name in ("finger_elsewhere",) if name in found]
    return "\n\n".join(map(plain_table, [*found["foci"], {"emission": emission}, *elsewhere]))


def _period_s(period_ms: float | None, duration_s: float) -> float:
    """Time in s from one emission to the next; raises ConfigError if emissions would overlap."""
    if period_ms is None:
        return duration_s
    if not duration_s <= period_ms * 1e-3 + 1e-9 < 1e3:  # NaN too
        raise ConfigError(f"--period-ms {period_ms:g}: from {duration_s * 1e3:g} ms, the length of an emission, to 1000000")
    return period_ms * 1e-3


def _on_plate(position_mm: float, extent_mm: float) -> float:
    """Position in m of a focus; raises ConfigError if nothing can move there."""
    if not 0 < position_mm < extent_mm:  # NaN too
        raise ConfigError(f"--at {position_mm:g}: not inside the plate (0 to {extent_mm:g} mm)")
    return position_mm * 1e-3


def _finger_load(text: str) -> tuple[float, float, float]:
    """Mass in mg, damping in N s/m and stiffness in N/m of a finger, the last two 0 where they are left out."""
    try:
        values = [float(part) for part in text.split(",")]
    except ValueError:
        values = []
    if len(values) not in {1, 3} or not all(0 <= value <= most for value, most in zip(values, FINGER_MOST, strict=False)):
        most = "{:g} mg, {:g} N s/m and {:g} N/m".format(*FINGER_MOST)
        raise argparse.ArgumentTypeError(f"{text!r} is not a mass, or a mass, damping and stiffness, from 0 to {most}")
    mass_mg, damping_n_s_m, stiffness_n_m = (*values, 0.0, 0.0)[:3]
    return mass_mg, damping_n_s_m, stiffness_n_m
