"""`haptic-panel calibrate plan`: where to measure the plate, in what order, and how long it takes."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from controller.board.board import load_board
from controller.board.lookup import find_board
from controller.commands.output import show
from controller.errors import ConfigError, UsageError


def add(step: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    how = step.add_mutually_exclusive_group()
    how.add_argument("--points", type=int, metavar="N", help="scattered points (default: as many as the plate needs)")
    how.add_argument("--grid", action="store_true", help="the whole grid of half a wavelength instead of scattered points")
    step.add_argument("--margin-mm", type=float, default=0.0, metavar="MM", help="scattered points keep off the edges (default: 0)")
    step.add_argument("--avoid-actuators", action="store_true", help="scattered points keep off the patches")
    step.add_argument("--record-ms", type=float, default=100.0, metavar="MS", help="one record with its pause (default: 100)")
    step.add_argument("--repetitions", type=int, default=1, metavar="N", help="records of each channel (default: 1)")
    step.add_argument("--speed-mm-s", type=float, default=50.0, metavar="V", help="of the scanning head (default: 50)")
    step.add_argument("--settle-ms", type=float, default=200.0, metavar="MS", help="until the head is still (default: 200)")
    step.add_argument("--seed", type=int, default=1, help="of the scattered points (default: 1)")
    step.add_argument("--out", metavar="FILE", help="write the positions, in the order of the path: points.csv")
    step.set_defaults(command=plan)


def plan(options: argparse.Namespace) -> int:
    """Print how many points to measure and how long that takes; write them."""
    from controller.calibration.point_plan import Timing, grid_points, half_wave_m, path_m, scattered_count, scattered_points

    board = load_board(find_board(options.board))
    if options.grid and (options.margin_mm or options.avoid_actuators):
        raise UsageError("--grid covers the whole plate: --margin-mm and --avoid-actuators are for scattered points")
    for name, least in (("record_ms", 1e-3), ("repetitions", 1), ("speed_mm_s", 1e-3), ("settle_ms", 0.0)):
        if not least <= getattr(options, name) <= 1e6:  # NaN too
            raise UsageError(f"--{name.replace('_', '-')} {getattr(options, name):g}: not from {least:g} to 1e6")
    if options.grid:
        points_m = grid_points(board)
    else:
        count = scattered_count(board) if options.points is None else options.points
        points_m = scattered_points(board, count, options.margin_mm * 1e-3, options.avoid_actuators, options.seed)
    timing = Timing(
        options.record_ms * 1e-3, len(board.actuators) * options.repetitions, options.settle_ms * 1e-3, options.speed_mm_s * 1e-3
    )
    if options.out:
        _write(Path(options.out), points_m * 1e3)
    figures = {
        "board": board.name,
        "points": len(points_m),
        "half_wave_mm": round(half_wave_m(board) * 1e3, 3),
        "path_m": round(path_m(points_m), 3),
        "records": len(points_m) * timing.records,
        "minutes": round(timing.whole_s(path_m(points_m), len(points_m)) / 60, 1),
        "written": options.out,
    }
    show(options, figures, _table)
    return 0


def _write(file: Path, points_mm: Any) -> None:
    """Positions as CSV: number, x and y in mm.

    Raises
    ------
    ConfigError
        If it cannot be written.
    """
    lines = [f"{number},{x_mm:.3f},{y_mm:.3f}\n" for number, (x_mm, y_mm) in enumerate(points_mm.tolist())]
    try:
        file.write_text("".join(["point,x_mm,y_mm\n", *lines]), encoding="utf-8")
    except OSError as error:
        raise ConfigError(f"{file}: the positions cannot be written ({error.strerror})") from error


def _table(figures: dict[str, Any]) -> str:
    from controller.commands.tables import plain_table

    return plain_table({name: value for name, value in figures.items() if value is not None})
