"""`haptic-panel calibrate simulate`: measurements of a simulated plate, with the faults of real ones."""

from __future__ import annotations

import argparse
import math
from pathlib import Path
from typing import TYPE_CHECKING

from controller.commands.common.arguments import require_within
from controller.commands.common.named_board import board_of
from controller.commands.common.output import progress_bar, show
from controller.commands.common.tables import plain_table
from controller.device.board.board import Board
from controller.errors import UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

MIRRORED = {None: "", "x": "x runs the other way", "y": "y runs the other way", "xy": "x and y run the other way"}


def add(step: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    step.add_argument("folder", metavar="FOLDER", help="of the measurement; one that was interrupted goes on where it was")
    step.add_argument(
        "--plate",
        metavar="B",
        action="append",
        default=[],
        help="whose plate is measured: another board by name, folder or file, or KEY=VALUE of [plate], such as edges=free; "
        "may be repeated (default: the board's own)",
    )
    points = step.add_mutually_exclusive_group()
    points.add_argument("--points", metavar="FILE", help="positions from `calibrate plan --out` (default: its scattered points)")
    points.add_argument("--grid", action="store_true", help="the grid of half a wavelength instead")
    points.add_argument("--scattered", type=int, metavar="N", help="N scattered points")
    step.add_argument("--drive", choices=["chirp", "noise"], default="chirp", help="1-bit sequence that is played (default: chirp)")
    step.add_argument("--quantity", choices=["m", "m/s", "m/s^2"], default="m/s", help="what the sensor measures (default: m/s)")
    step.add_argument("--rate-khz", type=float, default=250.0, metavar="F", help="of the recorder (default: 250)")
    step.add_argument("--record-ms", type=float, default=10.0, metavar="MS", help="length of a record (default: 10)")
    step.add_argument("--repetitions", type=int, default=1, metavar="N", help="of each emission (default: 1)")
    step.add_argument("--snr-db", type=float, default=40.0, metavar="DB", help="of the records (default: 40)")
    step.add_argument("--drift-percent", type=float, default=0.0, metavar="D", help="of all frequencies, first to last point")
    step.add_argument("--clock-ppm", type=float, default=0.0, metavar="P", help="the recorder's clock is faster than it states")
    step.add_argument("--delay-us", type=float, default=0.0, metavar="US", help="records begin late by an unknown time")
    step.add_argument("--clip", type=float, metavar="SHARE", help="full scale of the sensor, relative to the largest value found")
    step.add_argument("--missing", type=float, default=0.0, metavar="SHARE", help="of the points that have no record")
    step.add_argument("--dead", type=int, action="append", default=[], metavar="Q", help="channel that does nothing")
    step.add_argument("--inverted", type=int, action="append", default=[], metavar="Q", help="channel wired the other way round")
    step.add_argument(
        "--swapped", type=int, nargs=2, action="append", default=[], metavar=("P", "Q"), help="channels in each other's place"
    )
    step.add_argument("--offset-mm", type=float, nargs=2, default=(0.0, 0.0), metavar=("X", "Y"), help="of all places")
    step.add_argument("--rotation-deg", type=float, default=0.0, metavar="DEG", help="of all places about the plate's middle")
    step.add_argument("--scale", type=float, default=1.0, metavar="S", help="of all places from the plate's middle")
    step.add_argument("--mirror", choices=["x", "y", "xy"], help="axes that run the other way")
    step.add_argument("--position-mm", type=float, default=0.0, metavar="SD", help="by which each place is off, along each axis")
    step.add_argument("--gain-percent", type=float, default=0.0, metavar="SD", help="of the sensitivity, from point to point")
    step.add_argument("--sensor-mass-mg", type=float, default=0.0, metavar="M", help="of the sensor that stands on the plate")
    step.add_argument("--seed", type=int, default=1, help="of noise, of what is missing, of scattered points (default: 1)")
    step.set_defaults(command=simulate)


def simulate(options: argparse.Namespace) -> int:
    """Write the folder, and print what it holds."""
    from threadpoolctl import threadpool_limits

    from controller.workshop.calibration.recording.simulated_measurement import (
        Flaws,
        RecordingSettings,
        simulate_measurement,
    )
    from controller.workshop.simulation.other_plate import on_other_plate

    board = board_of(options)
    real = on_other_plate(board, options.plate)
    _check(options, board)
    names, points_m = _points(options, board)
    recording = RecordingSettings(
        kind=options.drive,
        rate_hz=options.rate_khz * 1e3,
        record_s=options.record_ms * 1e-3,
        repetitions=options.repetitions,
        quantity=options.quantity,
        seed=options.seed,
    )
    faults = Flaws(
        snr_db=options.snr_db,
        drift=options.drift_percent / 100,
        clock_ppm=options.clock_ppm,
        delay_s=options.delay_us * 1e-6,
        clip=float("inf") if options.clip is None else options.clip,
        missing=options.missing,
        dead=tuple(options.dead),
        inverted=tuple(options.inverted),
        swapped=tuple((a, b) for a, b in options.swapped),
        offset_m=(options.offset_mm[0] * 1e-3, options.offset_mm[1] * 1e-3),
        rotation=math.radians(options.rotation_deg),
        scale=options.scale,
        mirror=MIRRORED[options.mirror],
        position_m=options.position_mm * 1e-3,
        gain=options.gain_percent / 100,
        sensor_mass_kg=options.sensor_mass_mg * 1e-6,
    )
    with threadpool_limits(1, "blas"):
        figures = simulate_measurement(
            Path(options.folder), board, real, names, points_m, recording, faults, progress_bar("points")
        )
    show(options, {"board": board.name, "plate": real.name, "folder": options.folder} | figures, plain_table)
    return 0


def _points(options: argparse.Namespace, board: Board) -> tuple[tuple[str, ...], NDArray[np.float64]]:
    """Names and places of the points to measure."""
    from controller.workshop.calibration.point_plan import grid_points, scattered_count, scattered_points
    from controller.workshop.calibration.records.points import read_points

    if options.points:
        return read_points(Path(options.points), board)
    if options.grid:
        points_m = grid_points(board)
    else:
        count = scattered_count(board) if options.scattered is None else options.scattered
        points_m = scattered_points(board, count, 0.0, seed=options.seed)
    return tuple(map(str, range(len(points_m)))), points_m


def _check(options: argparse.Namespace, board: Board) -> None:
    """Raise for an option that makes no sense."""
    nyquist_khz = 2e-3 * board.waveform.band_high_hz
    ranges = {
        "rate_khz": (nyquist_khz, 1e5),
        "record_ms": (board.waveform.duration_ms, 1e3),
        "repetitions": (1, 1000),
        "snr_db": (-40, 200),
        "drift_percent": (-5, 5),
        "clock_ppm": (-1e4, 1e4),
        "delay_us": (-1e5, 1e5),
        "rotation_deg": (-10, 10),
        "scale": (0.9, 1.1),
        "position_mm": (0, 10),
        "gain_percent": (0, 100),
        "sensor_mass_mg": (0, 1e4),
        "missing": (0, 0.99),
        "seed": (0, 2**32),
        "clip": (1e-6, 1),
    }
    require_within(options, ranges)
    there = {actuator.channel for actuator in board.actuators}
    for name, channels in (
        ("dead", options.dead),
        ("inverted", options.inverted),
        ("swapped", [q for pair in options.swapped for q in pair]),
    ):
        for channel in channels:
            if channel not in there:
                raise UsageError(f"--{name} {channel}: board {board.name!r} has no such channel")
