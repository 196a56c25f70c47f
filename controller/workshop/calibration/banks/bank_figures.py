"""What a calibration found, as plain values, and what of the board's description does not fit the plate."""

import math
from typing import Any, Final

import numpy as np

from controller.device.board.board import Board
from controller.workshop.calibration.fits.decay_fit import Decay
from controller.workshop.calibration.fits.drift_fit import FittedDrift
from controller.workshop.calibration.interpolation.interpolated import InterpolatedResponses
from controller.workshop.calibration.interpolation.point_fit import PointFit
from controller.workshop.calibration.interpolation.wave_fit import WaveFit
from controller.workshop.calibration.learned import LearnedResponses

SAID_FREQUENCY: Final = 0.002  # by which the plate's frequencies differ from board.toml's: costs a tenth of the amplitude
SAID_DECAY: Final = 0.2
SAID_KELVIN: Final = 0.5


def plate_notes(
    board: Board, learned: LearnedResponses, waves: WaveFit, decays: list[Decay], drift: FittedDrift | None
) -> list[str]:
    """What of the board's description does not fit the plate."""
    notes = []
    scale = waves.frequency_scale
    if board.plate.theory == "kirchhoff":
        scale *= waves.dispersion.slowed_by_shear(board.waveform.middle_hz)
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


def plate_figures(
    board: Board,
    learned: LearnedResponses,
    source: InterpolatedResponses,
    waves: WaveFit,
    decays: list[Decay],
    drift: FittedDrift | None,
) -> dict[str, Any]:
    """What was found of a plate, each figure with its standard deviation."""
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
        "wavenumber_factor": with_error(waves.dispersion.factor, waves.factor_error),
        "frequency_scale": with_error(waves.frequency_scale, 2 * waves.factor_error),
        "stiffness_scale": with_error(waves.stiffness_scale, 4 * waves.factor_error),
        "decays": [
            {
                "low_khz": one.low_hz * 1e-3,
                "high_khz": one.high_hz * 1e-3,
                "time_ms": with_error(one.time_s * 1e3, one.error_s * 1e3),
            }
            for one in decays
        ],
        "temperature_c": learned.provenance.temperature_c,
        "drift": drift
        and {
            "frequency_ratio": with_error(drift.frequency_ratio, drift.error),
            "alike": round(drift.alike, 4),
            "kelvin": drift.kelvin,
            "coefficient_per_k": drift.coefficient_per_k and list(drift.coefficient_per_k),
        },
        "responses": source.provenance.in_words(),
    }


def with_error(value: float, error: float) -> list[float | None]:
    """Value and standard deviation, rounded to two digits of the latter."""
    if not (math.isfinite(error) and error > 0):
        return [value, None]
    digits = 1 - math.floor(math.log10(error))
    return [round(value, digits), round(error, digits)]


def _of_points(errors: PointFit) -> dict[str, Any]:
    """Standard deviations over the points, each with that of the fit; the drift with its own."""
    spread = [float(np.sqrt((errors.errors[:, some] ** 2).mean())) for some in ([0, 1], [2], [3])]
    return {
        "corrected": list(errors.corrected),
        "places_mm": with_error(1e3 * spread[0], 1e3 * float(errors.deviation[0])),
        "sensitivity_percent": with_error(100 * spread[1], 100 * float(errors.deviation[2])),
        "drift_percent": with_error(*(100 * value for value in errors.drift())),
        "unforeseen": [round(value, 4) for value in errors.unforeseen],
    }
