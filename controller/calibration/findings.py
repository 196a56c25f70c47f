"""All checks of a measurement, in order: a channel that is dead is not called swapped too."""

from __future__ import annotations

import numpy as np

from controller.board.board import Board
from controller.board.panel import CHANNELS
from controller.calibration.checks import (
    Finding,
    clipped_records,
    dead_channels,
    listed,
    misplaced_channels,
    noisy_records,
    wrong_strength,
)
from controller.calibration.clock import Clock
from controller.calibration.deconvolution import Deconvolution, Transfers
from controller.calibration.direct_wave import DirectWaves
from controller.calibration.learned import LearnedResponses
from controller.calibration.measurements import Measurement

CLOCK_TOLERANCE_PPM = 5.0
STILL = 0.03  # of a response's rms that may be left where the records end, beyond its noise


def findings_of(
    measurement: Measurement,
    board: Board,
    deconvolution: Deconvolution,
    results: dict[int, Transfers],
    responses: LearnedResponses,
    waves: DirectWaves | None,
) -> list[Finding]:
    """What is wrong with channels and points.

    Parameters
    ----------
    measurement : Measurement
    board : Board
    deconvolution : Deconvolution
    results : dict
        Number of a point to its transfer functions.
    responses : LearnedResponses
    waves : DirectWaves or None
    """
    names = measurement.names
    points = list(results)
    channels = sorted(a.channel for a in board.actuators)
    power = np.stack([(abs(found.transfer) ** 2).sum(axis=1) for found in results.values()]).astype(np.float64)
    taken_off = np.stack([np.nan_to_num(found.variance) for found in results.values()]) * len(deconvolution.bins.gain)
    resolved = np.stack([found.resolved for found in results.values()])
    power = np.where(resolved, np.maximum(power - taken_off, 0), np.nan)
    findings = dead_channels(power, responses.coherence[points], channels, deconvolution.driven)
    dead = {channel for finding in findings for channel in finding.channels}
    alive = [channel for channel in channels if channel not in dead]
    if waves is not None:
        findings += misplaced_channels(waves, alive) + wrong_strength(waves, alive)
    findings += clipped_records({names[point]: found.clipped for point, found in results.items() if found.clipped})
    if missing := [names[point] for point in measurement.missing]:
        findings.append(Finding("missing", f"no records of point {listed(missing)}: left unknown", points=tuple(missing)))
    of_living = np.array([channel in alive for channel in range(CHANNELS)])
    findings += noisy_records(responses.coherence, np.array([[p in results] for p in range(len(names))]) & of_living, names)
    return findings


def remarks_on(
    measurement: Measurement, board: Board, clock: Clock, delay_s: float, ringing: float, excited_hz: tuple[float, float]
) -> list[Finding]:
    """What was corrected, and what is worth knowing.

    Parameters
    ----------
    measurement : Measurement
    board : Board
    clock : Clock
    delay_s : float
        That was corrected.
    ringing : float
        What is left of responses where the records end.
    excited_hz : (float, float)
        What was played reaches so far.
    """
    settings, findings = measurement.settings, list[Finding]()
    if delay_s and settings.records.first_sample_us is not None:
        right_us = settings.records.first_sample_us - delay_s * 1e6
        late = f"{abs(delay_s) * 1e6:.1f} us {'later' if delay_s > 0 else 'earlier'}"
        text = f"waves arrive {late} than records.first_sample_us says, which should be {right_us:.0f}: corrected"
        findings.append(Finding("delay", text))
    low_hz, high_hz = excited_hz
    if low_hz > board.waveform.band_low_hz or high_hz < board.waveform.band_high_hz:
        text = (
            f"what was played reaches from {low_hz / 1e3:.1f} to {high_hz / 1e3:.1f} kHz only, of the band from"
            f" {board.waveform.band_low_hz / 1e3:g} to {board.waveform.band_high_hz / 1e3:g} kHz"
        )
        findings.append(Finding("band", text))
    if abs(clock.ppm) > CLOCK_TOLERANCE_PPM:
        text = f"the recorder's clock is {abs(clock.ppm):.1f} ppm {'fast' if clock.ppm > 0 else 'slow'}: corrected"
        findings.append(Finding("clock", text))
    if settings.board_sha256 is not None and settings.board_sha256 != board.digest().hex():
        findings.append(
            Finding("board", f"measured with another board.toml than {board.name} has now ({settings.board_sha256[:12]}…)")
        )
    if ringing > STILL:
        text = f"the plate still moves when records end, by {ringing:.0%} of a response's rms: record for longer"
        findings.append(Finding("short", text))
    return findings
