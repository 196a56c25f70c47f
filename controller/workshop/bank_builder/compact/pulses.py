"""Pulses of which responses are sums: so few that each sample meets only some of them, and learned from responses.

A response between 20 and 70 kHz needs no 500,000 samples a second. It is a sum of pulses, in pairs, on a carrier in the middle of
the band. Each output (a sample, or a mean of the rest) meets `taps` neighbouring pulses. Starting from windowed carriers, outputs
and weights are fitted to responses in turns (alternating least squares), as if the weights had the noise of their rounding.
"""

from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from controller.arrays import Floats, Indices
from controller.device.bank.file_format import REST_SAMPLES
from controller.device.board.panel import Waveform
from controller.device.kernel import compact_twin
from controller.errors import ConfigError

TURNS: Final = 50
RELAXATION: Final = 1.7  # of what changes in a turn
ROUNDING_NOISE: Final = 0.006  # of four bits, over the power of what is rounded
RIDGE: Final = 0.003
PAIRS_TO_BAND: Final = 1.08  # complex weights a second, over the width of the band
MET: Final = 4  # pulses, or pairs of them, that an output meets
REACH: Final = 2.5  # of a window, in pulses
LOWERED: Final = 0.04  # of the band's width: the carrier lies below its middle, where responses are stronger
REST_TO_BAND: Final = 2.4  # weights a second of the rest, over the lower end of the band
STRENGTH_SAMPLES: Final = 64  # over which the strength of responses is taken
LEAST_STRENGTH: Final = 1e-2
LARGEST_ODD_ERROR: Final = 0.1  # of a wave in the band, between two samples of the even ones
WHOLE: Final = 1 << compact_twin.TAP_BITS


@dataclass(frozen=True, eq=False)
class Pulses:
    """How responses become weights, and weights whole numbers of a response again."""

    first: NDArray[np.int16]  # (output,): first weight that an output meets
    taps: NDArray[np.int16]  # (output, tap)
    odd: tuple[int, int]  # taps of odd samples: of the sum of the two even neighbours, beside a half; of the next two, negative
    analysis: NDArray[np.float32]  # (weight, row of a response)
    together: Floats  # (weight, weight): how much the errors of two count together
    error: float  # square error over the power of responses, before rounding, as a loss counts it

    @property
    def weights(self) -> int:
        """Weights of a response, for each channel."""
        return len(self.analysis)


def in_band_pulses(waveform: Waveform, responses: Floats) -> Pulses:
    """Pulses learned from responses in drive order (response, sample, 32). Raises ConfigError if the band is too high for them."""
    width_hz, samples = waveform.band_high_hz - waveform.band_low_hz, waveform.samples
    carrier_hz = waveform.middle_hz - LOWERED * width_hz
    even = 2 * np.arange(samples // 2 + compact_twin.EVEN_BEYOND)
    first, envelope = _envelopes(even, max(waveform.bit_clock_hz / (PAIRS_TO_BAND * width_hz), 1.0))
    phase = (2 * np.pi * carrier_hz / waveform.bit_clock_hz * even)[:, None]
    pairs = np.stack([envelope * np.cos(phase), envelope * np.sin(phase)], axis=2).reshape(len(even), -1)
    near, far = _odd_taps(waveform)
    to_samples = np.zeros((samples, len(even)))
    to_samples[even[even < samples], np.flatnonzero(even < samples)] = 1
    for odd in range(1, samples, 2):
        for at, tap in ((odd // 2 - 1, -far), (odd // 2, near), (odd // 2 + 1, near), (odd // 2 + 2, -far)):
            if at >= 0:
                to_samples[odd, at] = tap
    return _learned(2 * first, pairs, responses, to_samples, (near - 0.5, far))


def rest_pulses(waveform: Waveform, rests: Floats) -> Pulses:
    """Pulses learned from what the band leaves out (response, row, 32), means over `REST_SAMPLES` samples."""
    rows = rests.shape[1]
    apart = max(waveform.bit_clock_hz / REST_SAMPLES / (REST_TO_BAND * waveform.band_low_hz), 1.0)
    return _learned(*_envelopes(np.arange(rows), apart), rests, np.eye(rows), (0.0, 0.0))


def _envelopes(at: NDArray[Any], apart: float) -> tuple[Indices, Floats]:
    """For each output the first of the pulses that it meets, which are `apart`, and a windowed sinc around their middles."""
    position = at / apart + 1
    first = position.astype(int) - (MET - 1) // 2
    away = position[:, None] - (first[:, None] + np.arange(MET))
    envelope: Floats = np.sinc(away) * np.i0(np.sqrt(np.clip(1 - (away / REACH) ** 2, 0, None)))
    return first, envelope


def _odd_taps(waveform: Waveform) -> tuple[float, float]:
    """Taps of odd samples that leave the least error of waves in the band."""
    phase = np.pi * np.linspace(waveform.band_low_hz, waveform.band_high_hz, 51) * 2 / waveform.bit_clock_hz
    waves = np.stack([2 * np.cos(phase), -2 * np.cos(3 * phase)], axis=1)
    (near, far), *_ = np.linalg.lstsq(waves, np.ones(51))
    if np.abs(waves @ (near, far) - 1).max() > LARGEST_ODD_ERROR:
        raise ConfigError(
            f"waveform.band_high_hz = {waveform.band_high_hz:g} is too near to half of bit_clock_hz = {waveform.bit_clock_hz:g} for"
            " a compact bank: build a plain one"
        )
    return float(near), float(far)


def _learned(first: Indices, start: Floats, responses: Floats, to_rows: Floats, odd: tuple[float, float]) -> Pulses:
    """Fit pulses, which begin as `start` (output, tap), and weights to responses in turns; `to_rows` (row, output) of outputs."""
    (outputs, taps), weights = start.shape, int(first[-1]) + start.shape[1]
    met, rows = first[:, None] + np.arange(taps), responses[:, :, ::4].transpose(1, 0, 2).reshape(len(to_rows), -1)
    kept = (to_rows == 1).argmax(axis=0)
    fitted = np.array([(output, row) for output, row in enumerate(kept.tolist()) if to_rows[row, output] == 1])
    strength = _strength(responses)
    rise = np.full(outputs, strength[-1] ** 0.5)
    rise[fitted[:, 0]] = strength[fitted[:, 1]] ** 0.5
    pulses = np.zeros((outputs, weights))
    np.put_along_axis(pulses, met, start * rise[:, None], 1)
    flat = strength[:, None] ** -0.5  # what is lost goes with the square of an error over the strength there
    for turn in range(TURNS):
        weighed = (to_rows @ pulses) * flat
        square = weighed.T @ weighed
        analysis = np.linalg.solve(square + RIDGE * square.diagonal().mean() * np.eye(weights), weighed.T) * flat.T
        if turn == TURNS - 1:
            break
        found = analysis @ rows
        here = found[met[fitted[:, 0]]]
        inner = here @ here.transpose(0, 2, 1)
        sizes = np.einsum("oii->oi", inner)  # a view
        sizes += ROUNDING_NOISE * sizes + 1e-12 * sizes.sum(axis=1, keepdims=True) + 1e-300
        new = np.linalg.solve(inner, here @ rows[fitted[:, 1], :, None])[:, :, 0]
        before = np.take_along_axis(pulses[fitted[:, 0]], met[fitted[:, 0]], 1)
        pulses[fitted[:, :1], met[fitted[:, 0]]] = before + RELAXATION * (new - before)
    values = np.take_along_axis(pulses, met, 1)
    gain = (WHOLE / 2 - taps) / np.abs(values).sum(axis=1).max()
    near, far = (round(tap * WHOLE) for tap in odd)
    whole_taps = np.rint(values * gain).astype(np.int16)
    error = (((to_rows @ (pulses @ (analysis @ rows)) - rows) * flat) ** 2).sum() / max(((rows * flat) ** 2).sum(), 1e-300)
    return Pulses(
        first.astype(np.int16), whole_taps, (near, far), (analysis * (WHOLE / gain)).astype(np.float32), square, float(error)
    )


def _strength(responses: Floats) -> Floats:
    """Root mean square of each row of responses, over its neighbours too."""
    power = (responses**2).mean(axis=(0, 2))
    size = min(STRENGTH_SAMPLES, len(power))
    smooth = np.convolve(np.pad(power, size, mode="edge"), np.ones(2 * size + 1) / (2 * size + 1), "valid")
    strength: Floats = np.sqrt(smooth)
    largest = strength.max()
    return np.maximum(strength / largest, LEAST_STRENGTH) if largest > 0 else np.ones(len(power))
