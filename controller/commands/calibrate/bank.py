"""`haptic-panel calibrate bank`: a bank from the measurements of a plate."""

from __future__ import annotations

import argparse
import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from controller.commands.calibrate.check import calibration_cache, declare_accept
from controller.commands.common.output import picture_path, progress_bar, show
from controller.console import tell
from controller.device.bank.lookup import find_bank
from controller.device.board.board import Board, load_board
from controller.device.board.lookup import find_board
from controller.device.scene.scene import load_scene
from controller.device.scene.scene_file import find_scene
from controller.errors import CalibrationError, ConfigError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from controller.workshop.bank_builder.build import BuildReport
    from controller.workshop.calibration.decay_fit import Decay
    from controller.workshop.calibration.drift_fit import FittedDrift
    from controller.workshop.calibration.interpolated import InterpolatedResponses
    from controller.workshop.calibration.learned import LearnedResponses
    from controller.workshop.calibration.learning import Learned
    from controller.workshop.calibration.point_fit import PointFit
    from controller.workshop.calibration.wave_fit import WaveFit

SAID_FREQUENCY = 0.002  # by which the plate's frequencies differ from board.toml's: costs a tenth of the amplitude
SAID_DECAY = 0.2
SAID_KELVIN = 0.5
OF_RECORDS = {"measuring frame": "frame", "mass of the sensor": "sensor_mass"}


def add(step: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    step.add_argument("folder", metavar="FOLDER", help="with a measurement.toml")
    step.add_argument(
        "--out", metavar="FILE", help="file to write (default: where run looks for the board's bank, which is printed)"
    )
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
    step.add_argument("--also", metavar="FOLDER", help="the same plate at another temperature: determines coefficient_per_k")
    step.add_argument("--plot", metavar="FILE", help="draw what points left out keep, and the fits (.png, .svg, .pdf)")
    declare_accept(step)
    step.set_defaults(command=calibrate_bank)


def calibrate_bank(options: argparse.Namespace) -> int:
    """Read, check, interpolate, and build; nothing is written if anything is refused."""
    from threadpoolctl import threadpool_limits

    from controller.workshop.bank_builder.own_bank import SMALLEST_PITCH_MM, pitch_of
    from controller.workshop.calibration.decay_fit import fit_decays
    from controller.workshop.calibration.drift_fit import fit_drift
    from controller.workshop.calibration.duration import foreseen
    from controller.workshop.calibration.interpolate import interpolate
    from controller.workshop.calibration.stage_fit import stage_notes
    from controller.workshop.physics.modes.plate_modes import modes_of

    picture = picture_path(options)
    board = load_board(find_board(options.board))
    if not pitch_of(board, options.pitch_mm) >= SMALLEST_PITCH_MM:  # NaN too
        raise ConfigError(f"--pitch-mm: pitch_mm = {options.pitch_mm:g} is not {SMALLEST_PITCH_MM:g} or more")
    bars: dict[str, Any] = {}

    def progress(what: str, done: int, total: int) -> None:
        bars.setdefault(what, progress_bar(what))(done, total)

    with threadpool_limits(1, "blas"):  # many small matrices
        if work := foreseen(board, Path(options.folder), pitch_of(board, options.pitch_mm) * 1e-3):
            tell(work.in_words())
        found, dead = _learn(board, Path(options.folder), options)
        learned, findings = found.responses, [finding.message for finding in found.findings]
        drift = fit_drift(board, learned, _learn(board, Path(options.also), options)[0].responses) if options.also else None
        source, waves = interpolate(board, learned, progress, dead, modes_of if options.model else None)
        decays = fit_decays(learned.responses, learned.known, learned.noise, board.waveform, learned.bit_clock_hz)
        if picture:
            from controller.workshop.calibration.checking.plot_leave_out import plot_leave_out

            plot_leave_out(picture, board, source, waves, decays)
        path, cells, report = _build(board, source, options)
    notes = [*findings, *stage_notes(board, learned), *_notes(board, learned, waves, decays, drift)]
    if source.size is not None and found.frame is not None:
        source.size = source.size.in_frame(found.frame.offset_error_m)
    notes += _of_bank(options, source, cells, report)
    for note in notes:
        tell(note)
    figures = _figures(board, learned, source, waves, decays, drift)
    figures |= {"frame": found.frame and found.frame.in_words(), "sensor_mass": found.chain and found.chain.in_words()}
    show(options, {"path": str(path), "cells": report.cells, "bytes": report.bytes} | figures | {"notes": notes}, _table)
    if path != (played := find_bank(board)).path:
        tell(f"run plays from {played.path} ({played.why}) unless given --bank {path}")
    return 0


def _build(board: Board, source: InterpolatedResponses, options: argparse.Namespace) -> tuple[Path, NDArray[np.bool_], BuildReport]:
    """Build the bank of what was measured: its path, and the cells that are near enough to measured points."""
    from controller.workshop.bank_builder.compact.design import compact_pitch_m
    from controller.workshop.bank_builder.interpolation_error import refuse_coarse
    from controller.workshop.bank_builder.own_bank import Order, chosen, pitch_of

    pitch_mm, choice, compact = pitch_of(board, options.pitch_mm), None, options.compact
    if compact and options.pitch_mm is None:
        pitch_mm = 1e3 * compact_pitch_m(board)
    refuse_coarse(board, pitch_mm * 1e-3)
    if board.compose.method != "bank" and not compact and options.pitch_mm is None:
        scene_file = find_scene(board)
        choice = chosen(board, load_scene(scene_file, board), scene_file, source)
        pitch_mm, compact = choice["pitch_mm"], choice["compact"]
        tell(f"{scene_file.name}: {choice['why']}")
    wanted = Order(board, pitch_mm * 1e-3, choice=choice, compact=compact)
    cells = source.near_enough(wanted.grid.points())
    if not cells.any():
        raise CalibrationError(f"{options.folder}: no cell of the bank lies near the measured points")
    path = Path(options.out) if options.out else wanted.own_path
    return path, cells, wanted.build(path, cells, memory_mb=options.memory_mb, source=source)


def _of_bank(options: argparse.Namespace, source: InterpolatedResponses, cells: NDArray[np.bool_], built: BuildReport) -> list[str]:
    """What of the bank is less than was asked for."""
    from controller.workshop.bank_builder.interpolation_error import interpolation_warning

    notes = []
    if source.size is not None:
        notes.append(
            f"the glass is {source.size.in_words()} than board.toml says, if its edges are as that says: measure it, and set"
            " length_mm and width_mm in [plate]; a measured bank has it as it is"
        )
    elif options.model and source.provenance.kind == "measured":
        notes.append(
            "the board's model foresees points left out no better than waves do, and was not used: its edges are not the plate's"
        )
    if not cells.all():
        notes.append(f"{int((~cells).sum()):,} of {cells.size:,} cells are too far from the measured points, and not in the bank")
    if warning := interpolation_warning(built.interpolation_error):
        notes.append(warning)
    return notes


def _learn(board: Board, folder: Path, options: argparse.Namespace) -> tuple[Learned, list[int]]:
    """What a measurement folder gives, and channels accepted as dead; raises CalibrationError if anything is refused."""
    from controller.workshop.calibration.learning import learn

    found = learn(folder, board, cache=calibration_cache(board, folder), progress=progress_bar(f"points of {folder.name}"))
    found.require(options.accept)
    return found, [channel for finding in found.findings if finding.kind == "dead" for channel in finding.channels]


def _notes(board: Board, learned: LearnedResponses, waves: WaveFit, decays: list[Decay], drift: FittedDrift | None) -> list[str]:
    """What of the board's description does not fit the plate."""
    notes = []
    scale = waves.frequency_scale
    if board.plate.theory == "kirchhoff":
        scale *= waves.dispersion.slowed_by_shear((board.waveform.band_low_hz + board.waveform.band_high_hz) / 2)
    if abs(scale - 1) > SAID_FREQUENCY + 2 * waves.factor_error:
        notes.append(
            f"the plate's frequencies are {100 * (scale - 1):+.2f} % off those of board.toml's {board.plate.theory.capitalize()}"
            " plate: a bank of that model misses this plate, this one does not"
        )
    if decays:
        time_ms = float(np.median([decay.time_s for decay in decays])) * 1e3
        if abs(time_ms / board.plate.decay_time_ms - 1) > SAID_DECAY:
            notes.append(f"the plate decays in {time_ms:.2f} ms, decay_time_ms is {board.plate.decay_time_ms:g} in board.toml")
    there_c = learned.provenance.temperature_c
    if board.temperature is not None:
        if there_c is None:
            notes.append("the measurement does not tell the plate's temperature: reference_c of [temperature] cannot be checked")
        elif abs(there_c - board.temperature.reference_c) > SAID_KELVIN:
            notes.append(
                f"the plate had {there_c:g} °C: set reference_c = {there_c:g} in [temperature] of board.toml,"
                f" which is {board.temperature.reference_c:g}"
            )
        if drift is not None and (found := drift.coefficient_per_k) is not None:
            off = abs(found[0] - board.temperature.coefficient_per_k)
            if off > 3 * found[1]:
                notes.append(
                    f"set coefficient_per_k = {found[0]:.3g} in [temperature], which is {board.temperature.coefficient_per_k:g}"
                )
    if drift is not None and drift.coefficient_per_k is None:
        notes.append("coefficient_per_k needs two measurements that tell their temperatures, 1 K apart or more")
    return notes


def _figures(
    board: Board,
    learned: LearnedResponses,
    source: InterpolatedResponses,
    waves: WaveFit,
    decays: list[Decay],
    drift: FittedDrift | None,
) -> dict[str, Any]:
    kept = source.leave_out.kept
    return {
        "board": board.name,
        "points": source.provenance.points,
        "interpolation": source.provenance.model,
        "left_out_kept": {
            "median": round(float(np.nanmedian(kept)), 4),
            "worst_5_percent": round(float(np.nanquantile(kept, 0.05)), 4),
            "least": round(float(np.nanmin(kept)), 4),
            "points": int((~np.isnan(kept)).sum()),
        },
        "size_of_glass": source.size and source.size._asdict(),
        "errors_of_points": source.errors and _of_points(source.errors),
        "noise_variance": waves.noise,
        "wavenumber_factor": _with_error(waves.dispersion.factor, waves.factor_error),
        "frequency_scale": _with_error(waves.frequency_scale, 2 * waves.factor_error),
        "stiffness_scale": _with_error(waves.stiffness_scale, 4 * waves.factor_error),
        "decays": [
            {
                "low_khz": one.low_hz * 1e-3,
                "high_khz": one.high_hz * 1e-3,
                "time_ms": _with_error(one.time_s * 1e3, one.error_s * 1e3),
            }
            for one in decays
        ],
        "temperature_c": learned.provenance.temperature_c,
        "drift": drift
        and {
            "frequency_ratio": _with_error(drift.frequency_ratio, drift.error),
            "alike": round(drift.alike, 4),
            "kelvin": drift.kelvin,
            "coefficient_per_k": drift.coefficient_per_k and list(drift.coefficient_per_k),
        },
        "responses": source.provenance.in_words(),
    }


def _of_points(errors: PointFit) -> dict[str, Any]:
    """Standard deviations over the points, each with that of the fit; the drift with its own."""
    spread = [float(np.sqrt((errors.errors[:, some] ** 2).mean())) for some in ([0, 1], [2], [3])]
    return {
        "corrected": list(errors.corrected),
        "places_mm": _with_error(1e3 * spread[0], 1e3 * float(errors.deviation[0])),
        "sensitivity_percent": _with_error(100 * spread[1], 100 * float(errors.deviation[2])),
        "drift_percent": _with_error(*(100 * value for value in errors.drift())),
        "unforeseen": [round(value, 4) for value in errors.unforeseen],
    }


def _with_error(value: float, error: float) -> list[float | None]:
    """Value and standard deviation, rounded to two digits of the latter."""
    if not (math.isfinite(error) and error > 0):
        return [value, None]
    digits = 1 - math.floor(math.log10(error))
    return [round(value, digits), round(error, digits)]


def _table(figures: dict[str, Any]) -> str:
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
            lines.append(f"{'coefficient_per_k':<28}{reported(_with_error(*drift['coefficient_per_k']))}")
    return "\n".join([*lines, f"{figures['responses']}", f"bank: {figures['path']}, {figures['cells']:,} cells"])
