"""`haptic-panel calibrate plan`: where to measure the plate, in what order, and how long it takes."""

import argparse
from pathlib import Path
from typing import Any

import numpy as np

from controller.commands.common.arguments import require_within
from controller.commands.common.named_board import board_of
from controller.commands.common.output import picture_path, show
from controller.console import tell
from controller.errors import ConfigError, UsageError

ENOUGH = 0.97  # of the amplitude, foreseen between the points


def add(step: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    how = step.add_mutually_exclusive_group()
    how.add_argument("--points", type=int, metavar="N", help="scattered points (default: as many as the plate needs)")
    how.add_argument("--grid", action="store_true", help="the whole grid of half a wavelength instead of scattered points")
    step.add_argument("--margin-mm", type=float, metavar="MM", help="scattered points keep off the edges (default: a quarter wave)")
    step.add_argument("--avoid-actuators", action="store_true", help="scattered points keep off the patches")
    step.add_argument("--record-ms", type=float, default=100.0, metavar="MS", help="one record with its pause (default: 100)")
    step.add_argument("--repetitions", type=int, default=1, metavar="N", help="records of each channel (default: 1)")
    step.add_argument("--speed-mm-s", type=float, default=50.0, metavar="V", help="of the scanning head (default: 50)")
    step.add_argument("--settle-ms", type=float, default=200.0, metavar="MS", help="until the head is still (default: 200)")
    step.add_argument("--seed", type=int, default=1, help="of the scattered points (default: 1)")
    step.add_argument(
        "--out", metavar="FILE", help="write the positions, in the order of the path: .csv, or .gcode for a head on axes"
    )
    step.add_argument("--plot", metavar="FILE", help="draw points, path and what they foresee (.png, .svg, .pdf)")
    step.set_defaults(command=plan)


def plan(options: argparse.Namespace) -> int:
    """Print how many points to measure, how long that takes and what is then foreseen; write them."""
    from threadpoolctl import threadpool_limits

    from controller.workshop.calibration.interpolation.foresight import foresee
    from controller.workshop.calibration.point_plan import (
        PlanTiming,
        grid_points,
        half_wave_m,
        path_m,
        scattered_count,
        scattered_points,
    )

    picture = picture_path(options)
    board = board_of(options)
    if options.grid and (options.margin_mm is not None or options.avoid_actuators):
        raise UsageError("--grid covers the whole plate: --margin-mm and --avoid-actuators are for scattered points")
    require_within(options, {"record_ms": (1e-3, 1e6), "repetitions": (1, 1e6), "speed_mm_s": (1e-3, 1e6), "settle_ms": (0, 1e6)})
    if options.grid:
        points_m = grid_points(board)
    else:
        margin_m = half_wave_m(board) / 2 if options.margin_mm is None else options.margin_mm * 1e-3
        count = scattered_count(board) if options.points is None else options.points
        points_m = scattered_points(board, count, margin_m, avoid_actuators=options.avoid_actuators, seed=options.seed)
    timing = PlanTiming(
        options.record_ms * 1e-3, len(board.actuators) * options.repetitions, options.settle_ms * 1e-3, options.speed_mm_s * 1e-3
    )
    with threadpool_limits(1, "blas"):
        places_m, shares = foresee(board, points_m)
    if options.out:
        _write(Path(options.out), points_m * 1e3, timing.records * timing.record_s + timing.settle_s)
    if picture:
        from controller.workshop.calibration.pictures.plot_plan import plot_plan

        plot_plan(picture, board, points_m, places_m, shares)
    figures = {
        "board": board.name,
        "points": len(points_m),
        "half_wave_mm": round(half_wave_m(board) * 1e3, 3),
        "path_m": round(path_m(points_m), 3),
        "records": len(points_m) * timing.records,
        "minutes": round(timing.whole_s(path_m(points_m), len(points_m)) / 60, 1),
        "foreseen_share": {
            "median": round(float(np.median(shares)), 3),
            "worst_5_percent": round(float(np.quantile(shares, 0.05)), 3),
        },
        "written": options.out,
    }
    show(options, figures, _table)
    if figures["foreseen_share"]["median"] < ENOUGH:
        advice = f"{scattered_count(board)} are proposed" if options.points is not None else "let them reach farther"
        tell(f"the points foresee less than {ENOUGH:g} of the amplitude between them: {advice}")
    return 0


def _write(file: Path, points_mm: Any, dwell_s: float) -> None:
    """Positions as CSV: number, x and y in mm; or as G-code with a pause at each; raises ConfigError if it cannot be written."""
    if file.suffix == ".gcode":
        lines = ["G21 ; mm", "G90 ; from the plate's corner"]
        for number, (x_mm, y_mm) in enumerate(points_mm.tolist()):
            lines += [f"G0 X{x_mm:.3f} Y{y_mm:.3f} ; point {number}", f"G4 P{dwell_s * 1e3:.0f} ; ms"]
    else:
        lines = [
            "point,x_mm,y_mm",
            *(f"{number},{x_mm:.3f},{y_mm:.3f}" for number, (x_mm, y_mm) in enumerate(points_mm.tolist())),
        ]
    try:
        file.write_text("\n".join([*lines, ""]), encoding="utf-8")
    except OSError as error:
        raise ConfigError(f"{file}: the positions cannot be written ({error.strerror})") from error


def _table(figures: dict[str, Any]) -> str:
    from controller.commands.common.tables import plain_table

    shares = figures["foreseen_share"]
    reported = {name: value for name, value in figures.items() if value is not None}
    return plain_table(
        reported | {"foreseen_share": f"{shares['median']:g} at the median, {shares['worst_5_percent']:g} of the worst 5 %"}
    )
