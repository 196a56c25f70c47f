"""All checks of a measurement, in order: a channel that is dead is not called swapped too."""

import numpy as np

from controller.device.board.board import Board
from controller.workshop.calibration.checking.checks import (
    Objection,
    clipped_records,
    dead_channels,
    listed,
    noisy_records,
    wrong_strength,
    wrong_wires,
)
from controller.workshop.calibration.checking.wiring import Wiring, wiring_of
from controller.workshop.calibration.learned import LearnedResponses
from controller.workshop.calibration.records.measurements import Measurement
from controller.workshop.calibration.transfer_functions.clock import RecorderClock
from controller.workshop.calibration.transfer_functions.deconvolution import Deconvolution
from controller.workshop.calibration.transfer_functions.direct_wave import DirectWaves
from controller.workshop.calibration.transfer_functions.transfers import Transfers

CLOCK_TOLERANCE_PPM = 5.0
STILL = 0.03  # of a response's rms that may be left where the records end, beyond its noise


def findings_of(
    measurement: Measurement,
    board: Board,
    deconvolution: Deconvolution,
    results: dict[int, Transfers],  # number of a point to its transfer functions
    responses: LearnedResponses,
    waves: DirectWaves | None,
) -> tuple[list[Objection], Wiring]:
    """What is wrong with channels and points, and the verdict on the wires."""
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
    wiring = wiring_of(waves, channels, alive, len(points))
    findings += wrong_wires(wiring, alive)
    if waves is not None:
        findings += wrong_strength(waves, alive)
    findings += clipped_records({names[point]: found.clipped for point, found in results.items() if found.clipped})
    if missing := [names[point] for point in measurement.missing]:
        findings.append(Objection("missing", f"no records of point {listed(missing)}: left unknown", points=tuple(missing)))
    of_living = np.array([channel in alive for channel in range(board.channels)])
    findings += noisy_records(responses.coherence, np.array([[p in results] for p in range(len(names))]) & of_living, names)
    return findings, wiring


def remarks_on(
    measurement: Measurement, board: Board, clock: RecorderClock, delay_s: float, ringing: float, excited_hz: tuple[float, float]
) -> list[Objection]:
    """What was corrected, and what is worth knowing.

    `delay_s` was corrected; `ringing` is what is left of responses where the records end; `excited_hz` is how far what was played
    reaches.
    """
    settings, findings = measurement.settings, list[Objection]()
    if delay_s and settings.records.first_sample_us is not None:
        right_us = settings.records.first_sample_us - delay_s * 1e6
        late = f"{abs(delay_s) * 1e6:.1f} us {'later' if delay_s > 0 else 'earlier'}"
        text = f"waves arrive {late} than records.first_sample_us says, which should be {right_us:.0f}: corrected"
        findings.append(Objection("delay", text))
    low_hz, high_hz = excited_hz
    if low_hz > board.waveform.band_low_hz or high_hz < board.waveform.band_high_hz:
        text = (
            f"what was played reaches from {low_hz / 1e3:.1f} to {high_hz / 1e3:.1f} kHz only, of the band from"
            f" {board.waveform.band_low_hz / 1e3:g} to {board.waveform.band_high_hz / 1e3:g} kHz"
        )
        findings.append(Objection("band", text))
    if abs(clock.ppm) > CLOCK_TOLERANCE_PPM:
        text = f"the recorder's clock is {abs(clock.ppm):.1f} ppm {'fast' if clock.ppm > 0 else 'slow'}: corrected"
        findings.append(Objection("clock", text))
    if settings.board_sha256 is not None and settings.board_sha256 != board.digest().hex():
        findings.append(
            Objection("board", f"measured with another board.toml than {board.name} has now ({settings.board_sha256[:12]}…)")
        )
    if ringing > STILL:
        text = f"the plate still moves when records end, by {ringing:.0%} of a response's rms: record for longer"
        findings.append(Objection("short", text))
    return findings
