"""Transfer functions to learned responses in time, each with its noise, and where they come from."""

from pathlib import Path

import numpy as np

from controller.arrays import Floats, Reals
from controller.device.board.board import Board
from controller.workshop.calibration.checking.checks import NOISY_COHERENCE
from controller.workshop.calibration.learned import LearnedResponses
from controller.workshop.calibration.records.measurements import Measurement
from controller.workshop.calibration.transfer_functions.deconvolution import Deconvolution
from controller.workshop.calibration.transfer_functions.transfers import Transfers
from controller.workshop.physics.responses.response_source import Provenance, SourceFile

EARLY_S = 0.4e-3, 0.9e-3  # before the pulse: noise alone, as the filter has rung out; as long before the end: what is left


def responses_in_time(
    measurement: Measurement,
    board: Board,
    deconvolution: Deconvolution,
    results: dict[int, Transfers],  # number of a point to its transfer functions
    samples: int,  # of a response, if records are that long
    delay_s: float,  # taken out
    files: dict[Path, str],  # SHA-256 of each file
) -> tuple[LearnedResponses, float]:
    """Responses in time, with the noise of each: from the variance of its transfer function, else from what precedes the pulse.

    Also returns what is left of responses where the records end, beyond noise, over their rms; median.
    """
    bins, count = deconvolution.bins, len(measurement.names)
    samples = min(samples, bins.length - round(EARLY_S[1] * bins.bit_clock_hz))
    responses = np.zeros((count, samples, board.channels), np.float32)
    known = np.zeros((count, board.channels), bool)
    coherence, noise = (np.full((count, board.channels), np.nan) for _ in range(2))
    early = slice(*(bins.length - round(time_s * bins.bit_clock_hz) for time_s in reversed(EARLY_S)))
    ringing = [0.0]
    end = slice(*(max(deconvolution.covered - round(time_s * bins.bit_clock_hz), 0) for time_s in reversed(EARLY_S)))
    for point, found in results.items():
        whole = bins.response(found.transfer, delay_s)
        noise[point], coherence[point] = _noise(deconvolution, found, whole, early)
        known[point] = found.resolved & ~(coherence[point] < NOISY_COHERENCE)
        left = np.maximum((whole[:, end] ** 2).mean(axis=1) - noise[point] ** 2, 0) if end.stop else np.zeros(board.channels)
        shares = np.sqrt(left[known[point]] / np.maximum((whole[known[point], :samples] ** 2).mean(axis=1), 1e-300))
        ringing += shares[np.isfinite(shares)].tolist()
        responses[point] = np.where(known[point], whole[:, :samples].T, 0)
    settings = measurement.settings
    low_hz, high_hz = deconvolution.excited_hz
    provenance = Provenance(
        kind="measured",
        model=f"deconvolved from {low_hz / 1e3:.0f} to {high_hz / 1e3:.0f} kHz",
        files=tuple(SourceFile(str(file.relative_to(measurement.folder)), sha256) for file, sha256 in sorted(files.items())),
        date=settings.date,
        temperature_c=settings.temperature_c,
        points=len(results),
        panel=settings.panel,
    )
    found_all = LearnedResponses(measurement.points_m, responses, known, coherence, noise, board.waveform.bit_clock_hz, provenance)
    return found_all, float(np.median(ringing))


def _noise(deconvolution: Deconvolution, found: Transfers, whole: Reals, early: slice) -> tuple[Floats, Floats]:
    """Standard deviation of the noise in each of a point's responses, and their coherence, (channel,) both.

    `whole` are the responses (channel, sample); `early` are samples of noise alone, for responses whose variance is not known.
    """
    bins = deconvolution.bins
    noise: Floats = np.sqrt(2 * found.variance * (bins.gain**2).sum()) * bins.step_hz
    if np.isfinite(noise[found.resolved]).any() or not deconvolution.spreads_noise:
        return noise, found.coherence
    noise = np.where(found.resolved, whole[:, early].std(axis=1), np.nan).astype(np.float64)
    with np.errstate(invalid="ignore", divide="ignore"):
        return noise, np.maximum(1 - noise**2 / (whole**2).mean(axis=1), 0)
