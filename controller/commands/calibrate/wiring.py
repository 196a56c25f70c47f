"""`haptic-panel calibrate wiring`: which patch each channel drives, with which sign, from a few measured points."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from controller.commands.common.named_board import board_of
from controller.commands.common.output import progress_bar, show
from controller.console import tell
from controller.device.board.board import Board

if TYPE_CHECKING:
    from controller.workshop.calibration.learning.learning import Learned

WRONG, UNDECIDED = 1, 75  # exit codes; 75: EX_TEMPFAIL, try again
KINDS = ("dead", "swapped", "inverted", "unit", "mass", "undecided")


def add(step: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    step.add_argument("folder", metavar="FOLDER", help="of the measurement; without one, --points writes the first points")
    step.add_argument("--points", metavar="FILE", help="write the points to measure for a verdict, those that are there among them")
    step.set_defaults(command=wiring)


def wiring(options: argparse.Namespace) -> int:
    """Print the verdict: 0 if every channel drives its own patch, 1 if not, 75 if the points are too few to say."""
    from threadpoolctl import threadpool_limits

    from controller.workshop.calibration.checking.wiring import FIRST_POINTS
    from controller.workshop.calibration.learning.learning import learn
    from controller.workshop.calibration.records.measurement_file import NAME
    from controller.workshop.calibration.transfer_functions.point_cache import calibration_cache

    board, folder = board_of(options), Path(options.folder)
    if options.points and not (folder / NAME).exists():
        _write(board, Path(options.points), (), np.empty((0, 2)), FIRST_POINTS)
        tell(f"next: haptic-panel calibrate measure {folder} --points {options.points} --board {options.board}, with the sensor")
        return UNDECIDED
    with threadpool_limits(1, "blas"):
        learned = learn(folder, board, cache=calibration_cache(board, folder), progress=progress_bar("points"))
    figures = _figures(board, learned)
    show(options, figures, _table)
    if options.points and figures["undecided"]:
        measurement = learned.measurement
        more = learned.wiring.points_needed - learned.wiring.points
        _write(board, Path(options.points), measurement.names, measurement.points_m, more)
    if figures["wrong"]:
        return WRONG
    return UNDECIDED if figures["undecided"] else 0


def _write(board: Board, file: Path, names: tuple[str, ...], points_m: Any, more: int) -> None:
    """The points that were measured and as many more as are needed."""
    from controller.workshop.calibration.point_plan import wiring_points
    from controller.workshop.calibration.records.points import write_points

    added_m = wiring_points(board, more, points_m)
    fresh = [name for name in map(str, range(len(names) + more + len(names))) if name not in names][:more]
    write_points(file, (*names, *fresh), np.concatenate([points_m, added_m]))
    tell(f"{file}: {len(names) + more} points, {more} of them to measure")


def _figures(board: Board, learned: Learned) -> dict[str, Any]:
    found, waves = learned.wiring, learned.waves
    strength = {} if waves is None else {str(one): waves.strength[one, one] for one in sorted(a.channel for a in board.actuators)}
    said = [one for one in learned.findings if one.kind in KINDS]
    return {
        "board": board.name,
        "points": found.points,
        "points_needed": found.points_needed,
        "strength": {channel: round(float(value), 2) for channel, value in strength.items()},
        "wrong": [one.message for one in said if one.kind != "undecided"],
        "undecided": [one.message for one in said if one.kind == "undecided"],
        "channels": {kind: [list(one.channels) for one in said if one.kind == kind] for kind in KINDS},
    }


def _table(figures: dict[str, Any]) -> str:
    count = len(figures["strength"])
    passed = f"PASS: each of {count} channels drives its own patch, the right way round ({figures['points']} points)"
    return "\n".join([*(f"WRONG: {one}" for one in figures["wrong"]), *figures["undecided"]] or [passed])
