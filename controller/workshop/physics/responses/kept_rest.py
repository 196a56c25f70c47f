"""What a bank keeps of the part of a response that the band's filter leaves out: a number for each 2 samples of the bits.

A bank multiplies each with the number of bits in its 2 samples. Without a slope that is the mean: what is left out then lies beside
the band, where bits are noise. A slope leaves out something in the band, where means over 2 samples lose 8 % at 45 kHz and 18 %
at 70. There the numbers are those of least squares: of all that could be kept they give what bits move with the least error, if
bits have the spectrum of the band's filter, and a tenth of that at all other frequencies.

The device interpolates between cells, which takes more from the shorter waves, and holds a row for two samples. A bank's rows are
lifted by what both take on average.
"""

import itertools
import math
from typing import Final

import numpy as np

from controller.arrays import Complex, Floats, Reals
from controller.device.bank.file_format import REST_SAMPLES
from controller.device.board.board import Board
from controller.device.board.panel import Waveform
from controller.device.board.relations.bending_waves import bending_wavelength_m
from controller.device.kernel.bank_twin import Shares, row_shares
from controller.workshop.physics.plate import band_lost, lost_between
from controller.workshop.physics.responses.modal_response import band_gain

BESIDE: Final = 0.1  # power of the bits beside the band, over the most within it
ROWS: Final = 64  # that are solved for together; the middle one is taken
TAPS: Final = 26  # samples that it is made from: further ones have less than a hundredth of the largest weight
TRANSFORM: Final = 4096
FREQUENCIES: Final = 100  # of waves for which rows are lifted, up to what rows can follow
PLACES: Final = (np.arange(8) + 0.5) / 16  # of them, along each axis, in a quarter of a cell
DIRECTIONS: Final = (np.arange(24) + 0.5) / 48 * math.pi  # in which they run


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


def rest_lift(board: Board, pitch_m: float) -> tuple[float, float]:
    """What a row of the rest is multiplied with in a bank, and what is taken of the rows beside it.

    So lifted, then interpolated from four or six cells, relative to the band beside it, and held, rows give what bits move with the
    least error, over all places and directions of waves: if bits have the power of the band up to three sevenths above it, and a
    tenth of that far beyond. Images of what is held count too.
    """
    waveform = board.waveform
    period_s, taps = waveform.bit_period_s, rest_taps(waveform)
    hz = (np.arange(FREQUENCIES, dtype=np.float64) + 0.5) / (2 * REST_SAMPLES * period_s * FREQUENCIES)
    apart = np.arange(len(taps)) - (len(taps) - 1) / 2
    outside = 1 - band_gain(hz, waveform.band_hz, waveform.slope)
    rows, held = outside * (np.cos(2 * np.pi * period_s * np.outer(hz, apart)) @ taps), np.cos(np.pi * period_s * hz)
    kept, energy = _interpolated(board, pitch_m, hz)
    edge_hz = waveform.band_high_hz * 10 / 7

    def power(hz: Floats) -> Floats:
        return BESIDE + (1 - BESIDE) / (1 + (hz / edge_hz) ** 4)

    met = energy * rows**2 * (power(hz) * held**2 + power(1 / (REST_SAMPLES * period_s) - hz) * (1 - held**2))
    lifts = np.stack([np.ones_like(hz), -2 * np.cos(2 * np.pi * REST_SAMPLES * period_s * hz)])
    wanted = kept * rows * outside * held * power(hz)
    own, beside = np.linalg.lstsq((lifts * met) @ lifts.T, lifts @ wanted)[0].tolist()
    return own, beside


def _interpolated(board: Board, pitch_m: float, hz: Floats) -> tuple[Floats, Floats]:
    """What is left of waves of the rest between cells over what is left of the band: its part that is right, and all its power."""
    along = [2 * math.pi * pitch_m / bending_wavelength_m(board.plate, frequency) for frequency in hz.tolist()]
    along_x, along_y = np.outer(np.cos(DIRECTIONS), along), np.outer(np.sin(DIRECTIONS), along)
    weighed, lost = band_lost(board, pitch_m), lost_between(board, pitch_m)
    kept, energy = np.zeros_like(hz), np.zeros_like(hz)
    for x, y in itertools.product(PLACES.tolist(), repeat=2):
        from_x, from_y = x * (1 - x), y * (1 - y)
        for more in (0.0, abs(from_x - from_y) / 2):
            between = from_x + from_y + 2 * more
            found = _along(row_shares(0, x, more * (from_y > from_x)), along_x, x) * _along(
                row_shares(0, y, more * (from_x > from_y)), along_y, y
            )
            found *= (1 - weighed * between) / (1 - lost * between)
            kept += found.real.mean(axis=0)
            energy += (np.abs(found) ** 2).mean(axis=0)
    return kept, energy


def _along(shares: Shares, turned: Floats, beyond: float) -> Complex:
    """A wave interpolated along one axis, over what it is at the place."""
    found: Complex = sum(share * np.exp(1j * turned * (index - beyond)) for index, share in shares)
    return found
