"""What a bank keeps of the part of a response that the band's filter leaves out: a number for each 2 samples of the bits.

A bank multiplies each with the number of bits in its 2 samples. Without a slope that is the mean: what is left out then lies beside
the band, where bits are noise. A slope leaves out something in the band, where means over 2 samples lose 8 % at 45 kHz and 18 %
at 70. There the numbers are those of least squares: of all that could be kept they give what bits move with the least error, if
bits have the spectrum of the band's filter, and a tenth of that at all other frequencies.
"""

from typing import Final

import numpy as np

from controller.arrays import Floats, Reals
from controller.device.bank.file_format import REST_SAMPLES
from controller.device.board.panel import Waveform
from controller.workshop.physics.responses.modal_response import band_gain

BESIDE: Final = 0.1  # power of the bits beside the band, over the most within it
ROWS: Final = 64  # that are solved for together; the middle one is taken
TAPS: Final = 26  # samples that it is made from: further ones have less than a hundredth of the largest weight
TRANSFORM: Final = 4096


def rest_taps(waveform: Waveform) -> Floats:
    """Weights of a row's own samples, and of as many before them as behind, (tap,)."""
    if not waveform.slope:
        return np.full(REST_SAMPLES, 1 / REST_SAMPLES)
    gain = band_gain(np.fft.rfftfreq(TRANSFORM, waveform.bit_period_s).astype(np.float64), waveform.band_hz, waveform.slope)
    alike = np.fft.irfft(gain**2 / np.max(gain**2) + BESIDE)  # bits at two times
    samples = np.arange(ROWS * REST_SAMPLES)
    by_row = alike[np.abs(samples[:, None] - samples)].reshape(ROWS, REST_SAMPLES, -1).sum(axis=1)
    solved = np.linalg.solve(by_row.reshape(ROWS, ROWS, REST_SAMPLES).sum(axis=2), by_row)
    first = ROWS // 2 * REST_SAMPLES - (TAPS - REST_SAMPLES) // 2
    return solved[ROWS // 2, first : first + TAPS]


def rest_rows(outside: Reals, taps: Floats) -> Reals:
    """Rows to keep, (n, row, ...), of what is left out, in drive order, (n, sample, ...); there is nothing beyond its ends."""
    samples, beyond = outside.shape[1], (len(taps) - REST_SAMPLES) // 2
    rows = -(-samples // REST_SAMPLES)
    padded = np.zeros((len(outside), rows * REST_SAMPLES + 2 * beyond, *outside.shape[2:]), outside.dtype)
    padded[:, beyond : beyond + samples] = outside
    kept = np.zeros((len(outside), rows, *outside.shape[2:]), outside.dtype)
    for first, tap in enumerate(taps.tolist()):
        kept += tap * padded[:, first : first + rows * REST_SAMPLES : REST_SAMPLES]
    return kept
