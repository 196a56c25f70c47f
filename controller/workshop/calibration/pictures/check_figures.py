"""Figures of a measurement: what `haptic-panel calibrate check` prints."""

from typing import Any

import numpy as np

from controller.arrays import Floats
from controller.device.board.board import Board
from controller.workshop.calibration.checking.checks import FATAL
from controller.workshop.calibration.learning.learning import Learned
from controller.workshop.calibration.transfer_functions.deconvolution import REGULARISATION


def snr_db(learned: Learned) -> Floats:
    """Of each response, its rms over that of its noise in dB, (point, 32); NaN where unknown."""
    found = learned.responses
    rms = np.sqrt((found.responses.astype(np.float64) ** 2).mean(axis=1))
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(np.where(found.known, 20 * np.log10(rms / found.noise), np.nan))


def check_figures(board: Board, learned: Learned) -> dict[str, Any]:
    """All figures as plain numbers and texts; None where the records do not tell."""
    measurement, found, waves = learned.measurement, learned.responses, learned.waves
    channels = sorted(a.channel for a in board.actuators)
    snr = snr_db(learned)
    return {
        "folder": str(measurement.folder),
        "board": board.name,
        "board_sha256": board.digest().hex(),
        "date": measurement.settings.date,
        "temperature_c": measurement.settings.temperature_c,
        "points": len(measurement.names),
        "missing": len(measurement.missing),
        "emissions": measurement.drive.emissions,
        "repetitions": measurement.repetitions,
        "known_share": round(float(found.known[:, channels].mean()), 4),
        "excited_khz": [round(edge_hz / 1e3, 1) for edge_hz in learned.excited_hz],
        "regularisation": REGULARISATION,
        "residual": _number(np.nanmedian, learned.residual, 6),
        "noise_pm_per_v": _number(np.nanmedian, found.noise[:, channels] * 1e12, 4),
        "snr_db": _number(np.nanmedian, snr[:, channels], 1),
        "least_snr_db": _number(np.nanmin, snr[:, channels], 1),
        "coherence": _number(np.nanmedian, found.coherence[:, channels], 4),
        "least_coherence": _number(np.nanmin, found.coherence[:, channels], 4),
        "clock_ppm": learned.clock.ppm if learned.clock.reported else None,
        "clock_error_ppm": round(learned.clock.error_ppm, 2) if learned.clock.reported else None,
        "delay_us": None if waves is None else round(waves.delay_s * 1e6, 1),
        "strength": None if waves is None else _number(np.nanmedian, np.diag(waves.strength)[channels], 2),
        "frame": None if learned.frame is None else learned.frame.in_words(),
        "sensor_mass": None if learned.chain is None else learned.chain.in_words(),
        "channels": [
            {
                "channel": channel,
                "known": int(found.known[:, channel].sum()),
                "coherence": _number(np.nanmedian, found.coherence[:, channel], 4),
                "snr_db": _number(np.nanmedian, snr[:, channel], 1),
                "strength": None if waves is None else _number(np.nanmedian, waves.strength[channel, channel : channel + 1], 2),
            }
            for channel in channels
        ],
        "findings": [
            {
                "kind": one.kind,
                "fatal": one.kind in FATAL,
                "channels": list(one.channels),
                "points": list(one.points),
                "message": one.message,
            }
            for one in learned.findings
        ],
        "learned_anew": learned.learned_anew,
    }


def _number(of: Any, values: Floats, digits: int) -> float | None:
    reported = values[np.isfinite(values)]
    return round(float(of(reported)), digits) if len(reported) else None
