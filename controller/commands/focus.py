"""`haptic-panel focus`: focus on points of the plate model, and measure the focus."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from controller.board.board import load_board
from controller.board.lookup import find_board
from controller.commands.output import picture_path, show
from controller.commands.tables import amplitude_table, plain_table
from controller.errors import ConfigError

if TYPE_CHECKING:
    from controller.commands.output import Declare


def add(declare: Declare, common: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    point = declare(
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
    point.add_argument("--seed", type=_natural, default=1, help="of the random points (default: 1)")
    point.add_argument(
        "--memory-mb", type=float, metavar="M", help="memory that --at may take, in MB (default: 1500); refused if it needs more"
    )
    point.add_argument("--plot", metavar="FILE", help="draw the plate at T (.png, .svg, .pdf)")
    point.set_defaults(command=focus)


def focus(options: argparse.Namespace) -> int:
    """Focus on points of the plate and print figures of merit; or measure the figures of the README."""
    from controller.benchmark.focus_figures import figures, focus_on

    picture = picture_path(options)
    board = load_board(find_board(options.board))
    if options.figures:
        show(options, figures(board, options.seed), plain_table)
        return 0
    if options.idle_figures:
        from controller.benchmark.idle import idle_figures

        found = idle_figures(board, options.seed)
        if picture:
            from controller.benchmark.plot_idle import plot_idle

            plot_idle(picture, board, found)
        show(options, found, plain_table)
        return 0
    if options.amplitude_figures:
        from controller.benchmark.amplitude import amplitude_figures

        pitch_mm = board.bank.pitch_mm if options.pitch_mm is None else options.pitch_mm
        found = amplitude_figures(board, options.seed, pitch_m=pitch_mm * 1e-3)
        if picture:
            from controller.benchmark.plot_amplitude import plot_amplitude

            plot_amplitude(picture, found)
        show(options, found, amplitude_table)
        return 0
    if not options.at:
        raise ConfigError("focus where? give --at X_MM Y_MM once for each point, or --figures, --idle-figures, --amplitude-figures")
    points_m = [(_on_plate(x_mm, board.plate.length_mm), _on_plate(y_mm, board.plate.width_mm)) for x_mm, y_mm in options.at]
    field, rows = focus_on(board, points_m, options.memory_mb)
    if picture:
        from controller.physics.plot import plot_focus

        plot_focus(picture, board, field, points_m, f"focus on {len(points_m)} point{'s' * (len(points_m) != 1)}")
    show(options, {"board": board.name, "foci": rows}, lambda shown: "\n\n".join(map(plain_table, shown["foci"])))
    return 0


def _on_plate(position_mm: float, extent_mm: float) -> float:
    """Position in m of a focus.

    Raises
    ------
    ConfigError
        If nothing can move there.
    """
    if not 0 < position_mm < extent_mm:  # NaN too
        raise ConfigError(f"--at {position_mm:g}: not inside the plate (0 to {extent_mm:g} mm)")
    return position_mm * 1e-3


def _natural(text: str) -> int:
    """Argument that is a whole number from 0."""
    if not text.isascii() or not text.isdigit():
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number from 0")
    return int(text)
