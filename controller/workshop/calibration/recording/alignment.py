"""When an emission begins in a recorder's track, by a second track that hears one of the channels: to a hundredth of a sample."""

from typing import Final

import numpy as np

from controller.arrays import Bools, Complex, Floats
from controller.errors import CalibrationError

BELOW: Final = 0.35  # of the rate: what lies above may be an alias
LEAST_CORRELATION: Final = 0.5  # of the second track with what the channel played
ALIKE: Final = 0.8  # of the largest correlation: emissions are alike up to their signs, and the first of them is meant


def begin_of(sync: Floats, rate_hz: float, levels: Bools, bit_clock_hz: float, nominal: float, slack: int) -> float:
    """Sample, with its fraction, at which the first word of an emission begins.

    `sync` (sample,) is the second track, in any unit and of either sign; `levels` (word,) are what the channel played. The emission
    is expected at `nominal`, up to `slack` samples earlier or later; of several that are alike the first is taken. Raises
    CalibrationError if it is not found there.
    """
    count = round(len(levels) / bit_clock_hz * rate_hz)
    first = max(round(nominal) - slack, 0)
    heard = sync[first : first + count + 2 * slack]
    if len(heard) < count:
        raise CalibrationError("the record ends before the last emission")
    length = 1 << (len(heard) + count).bit_length()
    frequency_hz: Floats = np.arange(length // 2 + 1, dtype=np.float64) * (rate_hz / length)
    expected = _spectrum(levels, bit_clock_hz, frequency_hz)
    cross = np.fft.rfft(heard - heard.mean(), length) * expected.conj()
    lags = np.abs(np.fft.irfft(cross, length)[: len(heard) - count + 1])
    first_alike = int(np.argmax(lags >= ALIKE * lags.max()))
    best = first_alike + int(np.argmax(lags[first_alike : first_alike + count // 2]))
    window = heard[best : best + count]
    loudest = np.sqrt(np.sum((window - window.mean()) ** 2) * np.sum(np.abs(np.fft.irfft(expected, length)) ** 2))
    if not loudest or lags[best] < LEAST_CORRELATION * loudest:
        raise CalibrationError(
            f"the track of the drive does not hear the emission ({lags[best] / (loudest or 1):.2f} of what it should correlate)"
        )
    turned = cross * np.exp(2j * np.pi * frequency_hz / rate_hz * best)
    turned *= np.sign(np.fft.irfft(cross, length)[best])
    weight = np.abs(cross) ** 2 * frequency_hz**2 * (frequency_hz < BELOW * rate_hz)
    slope = float(np.sum(weight * np.angle(turned) / np.maximum(frequency_hz, 1)) / np.sum(weight))
    return first + best - slope * rate_hz / (2 * np.pi)


def shifted(record: Floats, begin: float, before: int, count: int) -> Floats:
    """`count` samples of a record from `before` samples before the sample, with its fraction, `begin` on; zero outside the record.

    The fraction is a delay of the band: exact for what the recorder can hold.
    """
    whole = int(np.floor(begin))
    pad = 64  # samples in which the ends of the cut ring
    first = whole - before - pad
    cut = np.zeros(count + 2 * pad)
    low, high = max(first, 0), min(first + len(cut), len(record))
    if low < high:
        cut[low - first : high - first] = record[low:high]
    frequency = np.fft.rfftfreq(len(cut))
    moved: Floats = np.fft.irfft(np.fft.rfft(cut) * np.exp(2j * np.pi * frequency * (begin - whole)), len(cut))
    return moved[pad : pad + count]


def _spectrum(levels: Bools, bit_clock_hz: float, frequency_hz: Floats) -> Complex:
    """Spectrum of a channel's levels from 0 on, each held for a bit period, without their mean."""
    from scipy.signal import czt  # noqa: PLC0415 - takes 0.3 s

    values = levels - levels.mean()
    step = frequency_hz[1] / bit_clock_hz
    sampled = czt(values, len(frequency_hz), np.exp(-2j * np.pi * step))
    half = np.pi * frequency_hz / bit_clock_hz
    spectrum: Complex = sampled * np.sinc(half / np.pi) * np.exp(-1j * half)
    return spectrum
