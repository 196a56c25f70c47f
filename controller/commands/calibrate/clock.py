"""`haptic-panel calibrate clock`: the bit clock at which the model's bank suits a plate best, from a few measured points."""

import argparse
from pathlib import Path
from typing import Any

from controller.commands.calibrate.check import declare_accept
from controller.commands.common.named_board import board_of
from controller.commands.common.output import progress_bar, show


def add(step: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    step.add_argument("folder", metavar="FOLDER", help="with a measurement.toml, of ten points or so")
    declare_accept(step)
    step.set_defaults(command=clock)


def clock(options: argparse.Namespace) -> int:
    """Print what to set in board.toml; 78 if the plate is not the model's at any bit clock."""
    from threadpoolctl import threadpool_limits

    from controller.workshop.calibration.fits.clock_fit import fit_clock
    from controller.workshop.calibration.learning.learning import learn
    from controller.workshop.calibration.transfer_functions.point_cache import calibration_cache

    board, folder = board_of(options), Path(options.folder)
    with threadpool_limits(1, "blas"):
        found = learn(folder, board, cache=calibration_cache(board, folder), progress=progress_bar("points"))
        fitted = fit_clock(board, found.require(options.accept))
    show(options, {"board": board.name} | fitted.figures(), _table)
    return 0


def _table(figures: dict[str, Any]) -> str:
    ratio, error = figures["frequency_ratio"]
    alike = f"{figures['alike']:.2f} alike at that bit clock, {figures['alike_before']:.2f} at the board's own"
    return (
        f"{figures['points']} points: the plate's frequencies are {ratio:.5f} ± {error:.5f} of those of board.toml's model\n"
        f"bit clock that suits the plate: {figures['bit_clock_hz']:,.0f} Hz; responses are {alike}\n"
        f"set young_modulus_pa = {figures['young_modulus_pa']:.5g} in [plate] of board.toml, and build the bank again: its words\n"
        "are then those of that bit clock, at the board's own"
    )
