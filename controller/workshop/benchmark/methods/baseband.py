"""Responses as complex baseband at a reduced rate: what lies between 20 and 70 kHz needs no 500,000 samples a second.

A response is the sum of pulses, low-passed by a windowed sinc, on a carrier in the middle of the band; their complex weights are
stored, in 8 or 4 bits, in place of samples. The weights are those of least squares. Interpolating and summing is done on weights;
one matrix product then gives the samples.
"""

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from controller.arrays import Floats, Words
from controller.device.bank.packing import CHANNELS, drive_words
from controller.device.board.panel import Waveform
from controller.device.kernel import Point
from controller.workshop.benchmark.methods.candidate import Candidate, wire_bytes
from controller.workshop.benchmark.methods.interpolation import BandInterpolation, bilinear
from controller.workshop.benchmark.methods.laboratory import Laboratory
from controller.workshop.benchmark.methods.responses import FromTable

DECIMATIONS = (5, 7, 8, 10)  # samples of the bit clock to a complex one
REACH = 4  # complex samples before and after a pulse's middle
KAISER_BETA = 4.0


def candidates(laboratory: Laboratory) -> Iterator[Candidate]:
    """All of them."""
    board = laboratory.board
    four = BandInterpolation(board, laboratory.model.plate_modes, 4)
    for bits, name, interpolation, pitch_mm in (
        (8, "baseband, 8 bits, bilinear", bilinear, 2.5),
        (8, "baseband, 8 bits, band 4 × 4", four, 3.5),
        (4, "baseband, 4 bits, band 4 × 4", four, 3.5),
    ):
        for decimation in DECIMATIONS:
            pulses = pulse_matrix(board.waveform, decimation)
            table = laboratory.table(pitch_mm * 1e-3, bits, interpolation, np.linalg.pinv(pulses).astype(np.float32))
            yield Candidate(
                curve=name,
                setting=f"{pitch_mm:g} mm, 1/{decimation}",
                compose=FromBaseband(FromTable(table, interpolation, board.idle_word), pulses.astype(np.float32), board.idle_word),
                memory_bytes=table.memory_bytes + 4 * pulses.size,
                wire_bytes=wire_bytes(board.waveform.samples),
                tabled=True,
            )


class FromBaseband:
    """Drive words from a table of complex weights, and `pulses` (sample, weight)."""

    def __init__(self, weights: FromTable, pulses: NDArray[np.float32], idle_word: int) -> None:
        self._weights, self._pulses, self._idle_word = weights, pulses, idle_word

    def __call__(self, points: Sequence[Point]) -> Words:
        """Drive words for points of full amplitude."""
        return drive_words(self._pulses @ self._weights.sum(points).reshape(-1, CHANNELS), self._idle_word)


def pulse_matrix(waveform: Waveform, decimation: int) -> Floats:
    """Pulses on the carrier, real and imaginary: (sample, 2 * pulses)."""
    samples = np.arange(waveform.samples)
    middles = np.arange(-1, -(-waveform.samples // decimation) + 2) * decimation
    away = (samples[:, None] - middles) / decimation
    inside = np.clip(1 - (away / REACH) ** 2, 0, None)
    envelope = np.where(np.abs(away) < REACH, np.sinc(away) * np.i0(KAISER_BETA * np.sqrt(inside)) / np.i0(KAISER_BETA), 0)
    phase = 2 * np.pi * waveform.middle_hz * waveform.bit_period_s * samples[:, None]
    return np.concatenate([envelope * np.cos(phase), envelope * np.sin(phase)], axis=1)
