"""Response of each mode to a pulse of one bit period: as it is, and band-limited.

A drive word is held for one bit period, so the response of a mode to a pulse of 1 V of that length
is the difference of two step responses, taken at the ends of the bit periods: exact, without a
time step. Sample j is the displacement (j + 1) bit periods after the start of the pulse.

The band-limited response is the response for all times (zero before the pulse, decaying for ever
after T) through a real, even gain over frequency (zero phase), then cut to the samples of one
emission, [0, T]. It is applied to the modes, so it costs nothing per point. The gain is a half at the
band's edges and goes from 0 to 1 over `edge_width_hz` as a raised cosine: with the paper's 20 kHz nothing
is left below 16 kHz. Sharper edges ring for longer and lose contrast (28.0 at 0.1 kHz, 30.7 at 8 kHz).
A `slope` multiplies it by a power of the frequency over the band's middle.
"""

from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from controller.arrays import Complex, Floats
from controller.workshop.physics.responses.step_response import StepResponse

EDGE_HZ = 8e3
SETTLED = 14  # decay times after which the rest of a response is below 1e-6
FILTER_PERIODS = 50  # of the width of its edges, after which the rest of the filter's own response is below 1e-6
LONGEST = 1 << 15  # samples of a transform; responses that ring for longer are split
WORKING_BYTES = 64e6


def pulse_response(step: StepResponse, bit_period_s: float, samples: int) -> Floats:
    """Displacement of each mode after a pulse of 1 V of one bit period.

    Returns (mode, sample) in m per N; sample j is (j + 1) bit periods after the start of the pulse.
    """
    since = (
        np.arange(samples) * bit_period_s
    )  # sample 0 ends the pulse; only times after it, as a fast driver's past is beyond range
    first = step.residues * np.expm1(step.poles * bit_period_s)  # two steps a bit period apart
    modal = step.by_mode((first[:, None] * np.exp(np.outer(step.poles, since))).real)
    driver_first = step.driver_residues * np.expm1(step.driver_poles * bit_period_s)
    modal += (driver_first @ np.exp(np.outer(step.driver_poles, since))).real
    return modal


def band_limited_response(
    step: StepResponse, bit_period_s: float, samples: int, band_hz: tuple[float, float], decay_time_s: float, slope: float = 0.0
) -> Floats:
    """`pulse_response` of all times through a zero-phase band-pass, cut to the samples of an emission.

    Returns (mode, sample) in m per N; `decay_time_s` is the plate's, inf without damping. The spectrum of a sampled exponential is
    a geometric series, so nothing is cut off at T before filtering. An inverse transform of this many bins is right for what decays
    within this many samples. Most responses do, and then only the bins of the band are computed. One that rings for longer is
    split: of each pole the part that passes the filter unchanged but for a factor, the gain at the pole's complex frequency, is
    known in closed form, and what is left is as short as the filter's own response.
    """
    length, whole = transform_length(bit_period_s, samples, band_hz, _slowest_s(step, decay_time_s))
    frequency: Floats = np.fft.rfftfreq(length, bit_period_s).astype(np.float64, copy=False)
    gain = band_gain(frequency, band_hz, slope)
    bins = np.flatnonzero(gain) if whole else np.arange(len(frequency))
    per_hz: Floats = band_gain(frequency[bins] + 0.5, band_hz, slope) - band_gain(frequency[bins] - 0.5, band_hz, slope)
    per_bin = (per_hz / (2j * np.pi * bit_period_s)).astype(np.complex128, copy=False)
    filtered = _Filter(np.exp(-2j * np.pi * frequency[bins] * bit_period_s), gain[bins], per_bin)
    passed, driver_passed = (
        _passed(poles, (length - samples) * bit_period_s, band_hz, slope) for poles in (step.poles, step.driver_poles)
    )
    first = (0.5 * step.residues * np.expm1(step.poles * bit_period_s))[:, None]
    positive, negative = filtered.series(np.exp(step.poles * bit_period_s), passed)
    positive *= first
    negative *= first.conj()
    positive += negative
    total = step.by_mode(positive)
    count = len(total)
    driver_first = 0.5 * step.driver_residues * np.expm1(step.driver_poles * bit_period_s)  # all modes share the drivers' poles
    positive, negative = filtered.series(np.exp(step.driver_poles * bit_period_s), driver_passed)
    total += driver_first @ positive + driver_first.conj() @ negative
    block = np.zeros((count, frequency.size), np.complex128)
    block[:, bins] = total
    modal: Floats = np.fft.irfft(block, length, axis=1)[:, :samples].astype(np.float64, copy=False)
    if whole:
        return modal
    through = replace(step, residues=step.residues * passed, driver_residues=step.driver_residues * driver_passed)
    return modal + pulse_response(through, bit_period_s, samples)


def _passed(pole: Complex, rest_s: float, band_hz: tuple[float, float], slope: float) -> Complex:
    """Gain at the frequencies of poles; none where the response has decayed in `rest_s`, the transform beyond the emission."""
    at = np.zeros(pole.shape, np.complex128)
    rings = -pole.real * rest_s < SETTLED
    gain_at = _gain(np.where(pole.imag < 0, pole.conj(), pole)[rings] / 2j / np.pi, band_hz, slope)
    at[rings] = np.where(pole[rings].imag < 0, gain_at.conj(), gain_at)
    return at


class _Filter(NamedTuple):
    """The band's filter at the bins that are computed."""

    turn: Complex  # (bin,): what a delay of one bit period is in the spectrum
    gain: Floats  # (bin,)
    slope: Complex  # (bin,): of the gain, for a bin on a pole

    def series(self, root: Complex, passed: Complex) -> tuple[Complex, Complex]:
        """Spectrum of each pole's exponential and of its conjugate, filtered, without what is `passed`: (pole, bin) both.

        `root` (pole,) is the change of the exponential in one bit period.
        """
        return self._series(root[:, None], passed[:, None]), self._series(root[:, None].conj(), passed[:, None].conj())

    def _series(self, root: Complex, at: Complex) -> Complex:
        below = 1 - root * self.turn
        on_it = below == 0  # a bin on a pole without damping
        below[on_it] = 1
        of_poles: Complex = (self.gain - at) / below
        if on_it.any():
            of_poles[on_it] = np.broadcast_to(self.slope, on_it.shape)[on_it]
        return of_poles


def modes_at_once(step: StepResponse, bit_period_s: float, samples: int, band_hz: tuple[float, float], decay_time_s: float) -> int:
    """How many modes' responses are computed at once in `WORKING_BYTES`; parameters as in `band_limited_response`."""
    length, whole = transform_length(bit_period_s, samples, band_hz, _slowest_s(step, decay_time_s))
    bins = length // 2 if not whole else min(length * bit_period_s * (band_hz[1] - band_hz[0] + EDGE_HZ), length // 2)
    each_bytes = 16 * 6 * bins + 24 * length + 16 * 4 * samples  # spectra, their transform, times
    return int(min(max(WORKING_BYTES // each_bytes, 1), 256))


def _slowest_s(step: StepResponse, decay_time_s: float) -> float:
    return max(decay_time_s, float(np.max(-1 / step.driver_poles.real)))


def transform_length(bit_period_s: float, samples: int, band_hz: tuple[float, float], slowest_s: float) -> tuple[int, bool]:
    """Length of the transform for responses that decay in `slowest_s`, and whether all of a response is within it."""
    filtered = samples + FILTER_PERIODS / edge_width_hz(band_hz) / bit_period_s
    if slowest_s < np.inf:
        needed = max(samples + SETTLED * slowest_s / bit_period_s, filtered)
        if needed <= LONGEST:
            return 1 << int(np.ceil(np.log2(needed))), True
    return 1 << int(np.ceil(np.log2(max(LONGEST, filtered)))), False


def band_gain(frequency_hz: Floats, band_hz: tuple[float, float], slope: float = 0.0) -> Floats:
    """Real gain at `frequency_hz`, (n,): 1 in `band_hz`, 0 outside, a raised cosine `edge_width_hz` wide centred on each edge.

    Times the frequency over the band's middle to the power of `slope`.
    """
    return _gain(frequency_hz, band_hz, slope)


def _gain(frequency_hz: NDArray[Any], band_hz: tuple[float, float], slope: float) -> NDArray[Any]:
    """`band_gain` and its analytic continuation from the real frequency below or above each of `frequency_hz`."""
    low, high = band_hz
    edge_hz = edge_width_hz(band_hz)

    def risen(part: NDArray[Any]) -> NDArray[Any]:
        return np.where(part.real <= 0, 0, np.where(part.real >= 1, 1, part))

    rise, fall = risen((frequency_hz - low) / edge_hz + 0.5), risen((high - frequency_hz) / edge_hz + 0.5)
    gain: NDArray[Any] = np.sin(np.pi / 2 * rise) ** 2 * np.sin(np.pi / 2 * fall) ** 2
    if slope:
        gain *= np.where(gain == 0, 1, frequency_hz * 2 / (low + high)) ** slope
    return gain


def edge_width_hz(band_hz: tuple[float, float]) -> float:
    """Width of the filter's edges: `EDGE_HZ`, narrower in a band that is low, so that it has no content at rest, or narrow."""
    low, high = band_hz
    return min(EDGE_HZ, 0.4 * low, high - low)
