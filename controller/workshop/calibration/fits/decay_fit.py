"""How fast the plate's vibration decays, in parts of the band: from the power of the records against time."""

from dataclasses import dataclass

import numpy as np
from scipy.fft import irfft, rfft

from controller.arrays import Bools, Floats, Reals
from controller.device.board.panel import Waveform
from controller.workshop.physics.responses.modal_response import band_gain

PARTS = 5  # of the band
RECORDS = 400  # at most
WINDOWS = 24  # of time, in each of which power is averaged
SPREAD_PERIODS = 12  # of the middle of the band, after which waves have filled the plate
ABOVE_NOISE = 4.0  # in power


@dataclass(frozen=True)
class Decay:
    """Decay in a part of the band."""

    low_hz: float
    high_hz: float
    time_s: float  # in which displacement falls to 1/e
    error_s: float  # its standard deviation, from the scatter between channels


def fit_decays(responses: Reals, known: Bools, noise: Floats, waveform: Waveform, bit_clock_hz: float) -> list[Decay]:
    """Fit the decay in parts of the band; those in which nothing can be determined are left out.

    `responses` are (point, sample, channel), `known` and `noise` (point, channel): the standard deviation of a sample, NaN where it
    cannot be determined.
    """
    channels = np.flatnonzero(known.any(axis=0))
    chosen = np.random.default_rng(1).permutation(np.flatnonzero(known.any(axis=1)))[: max(RECORDS // max(channels.size, 1), 1)]
    records = np.where(known[chosen][:, None, channels], responses[chosen][:, :, channels], 0)
    samples = records.shape[1]
    length = 2 * samples  # what a filter spreads beyond both ends falls into silence
    frequency_hz: Floats = np.fft.rfftfreq(length, 1 / bit_clock_hz).astype(np.float64)
    spectra = rfft(records, length, axis=1)
    of_records = noise[np.ix_(chosen, channels)][known[np.ix_(chosen, channels)]]
    reported = of_records[np.isfinite(of_records)]
    floor = float((reported**2).mean()) if reported.size else 0.0
    edges = np.linspace(waveform.band_low_hz, waveform.band_high_hz, PARTS + 1)
    first = int(SPREAD_PERIODS / waveform.middle_hz * bit_clock_hz)
    found = []
    for low_hz, high_hz in zip(edges[:-1].tolist(), edges[1:].tolist(), strict=True):
        gain = band_gain(frequency_hz, (low_hz, high_hz))
        power = (irfft(spectra * gain[:, None], length, axis=1)[:, :samples] ** 2).mean(axis=0)  # (sample, channel)
        noise_power = floor * float((gain**2).mean())
        windows = np.array_split(np.arange(first, samples), WINDOWS)
        time_s = np.array([window.mean() for window in windows]) / bit_clock_hz
        levels = np.array([power[window].mean(axis=0) for window in windows]) - noise_power  # (window, channel)
        above = (levels > ABOVE_NOISE * noise_power).all(axis=1) & (levels > 0).all(axis=1)
        usable = above.argmin() if not above.all() else WINDOWS
        if usable < 4:
            continue
        rates = -np.polyfit(time_s[:usable], np.log(levels[:usable]), 1)[0] / 2  # of each channel; power falls twice as fast
        rate = float(rates.mean())
        if rate > 0:
            scatter = float(rates.std(ddof=1)) / np.sqrt(len(rates)) if len(rates) > 1 else np.inf
            found.append(Decay(low_hz, high_hz, 1 / rate, float(scatter / rate**2)))
    return found
