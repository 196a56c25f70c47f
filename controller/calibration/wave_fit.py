"""The plate's own wavenumbers, from measurements: those with which points left out are best foreseen by the others.

The error of points left out has a sharp minimum: half a percent off costs as much as all else. It is searched in several parts of
the band, which gives a factor on the board's wavenumbers, how it changes over the band, and how sure both are.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from controller.calibration.dispersion import Dispersion
from controller.calibration.kriging import Waves, krige
from controller.calibration.spectra import Bins, Spectra
from controller.errors import CalibrationError

Floats = NDArray[np.float64]

POINTS = 150  # at most, of those there are
PARTS = 6  # of the band
BINS = 3  # of each part
COARSE: Floats = np.linspace(0.9, 1.1, 21)
FINE: Floats = np.linspace(-0.0075, 0.0075, 7)


@dataclass(frozen=True)
class WaveFit:
    """Wavenumbers as measured.

    Attributes
    ----------
    dispersion : Dispersion
        With the factor found in the middle of the band, and its slope.
    factor_error, slope_error_per_hz : float
        Standard deviations, from the scatter between parts of the band.
    """

    dispersion: Dispersion
    factor_error: float
    slope_error_per_hz: float

    @property
    def frequency_scale(self) -> float:
        """Frequencies of waves of a length, over those of the board's plate, in the middle of the band."""
        return self.dispersion.factor**-2

    @property
    def stiffness_scale(self) -> float:
        """Bending stiffness for the board's mass per area, over the board's."""
        return self.dispersion.factor**-4


def fit_waves(
    points_m: Floats,
    spectra: Spectra,
    known: NDArray[np.bool_],
    bins: Bins,
    dispersion: Dispersion,
    band_hz: tuple[float, float],
    progress: Callable[[int, int], None] = lambda _done, _total: None,
) -> WaveFit:
    """Fit wavenumbers.

    Parameters
    ----------
    points_m : (point, 2) array
    spectra : (bin, point, channel) array
    known : (point, channel) bool array
    bins : Bins
    dispersion : Dispersion
        The board's.
    band_hz : (float, float)
    progress : callable
        Called with the work done and all of it.

    Raises
    ------
    CalibrationError
        If no wavenumber within 10 % of the board's explains the field.
    """
    whole = np.flatnonzero(known.any(axis=1))
    if len(whole) > POINTS:
        whole = np.sort(np.random.default_rng(1).choice(whole, POINTS, replace=False))
    # one pattern only: points where every channel of them is known, as most are
    channels = np.flatnonzero(known[whole].mean(axis=0) > 0.5)
    whole = whole[known[np.ix_(whole, channels)].all(axis=1)]
    low, high = np.searchsorted(bins.frequency_hz, band_hz)
    parts = np.linspace(low, high - 1, PARTS * BINS + 2)[1:-1].round().astype(int).reshape(PARTS, BINS)
    steps = len(COARSE) + PARTS * len(FINE)

    def error(factor: float, chosen: NDArray[np.intp], done: int) -> float:
        some = replace(bins, frequency_hz=bins.frequency_hz[chosen], gain=bins.gain[chosen])
        of_bins = spectra[np.ix_(chosen, whole, channels)]
        prior = Waves.of(replace(dispersion, factor=factor), some, band_hz[1])
        _, left_out = krige(points_m[whole], of_bins, np.ones((len(whole), 1), bool).repeat(len(channels), axis=1), prior)
        progress(done, steps)
        scale = (np.abs(of_bins) ** 2).mean(axis=(1, 2), keepdims=True)
        return float((np.abs(left_out - of_bins) ** 2 / scale).mean())

    middles = parts[:, BINS // 2]
    coarse = [error(factor, middles, done) for done, factor in enumerate(COARSE.tolist(), 1)]
    best = int(np.argmin(coarse))
    if best in (0, len(COARSE) - 1) or coarse[best] > 0.5 * float(np.median(coarse)):
        raise CalibrationError(
            f"no waves within 10 % of the board's wavelengths explain what was measured at {len(whole)} points (of one left out,"
            f" {min(coarse):.0%} of the energy is not foreseen): too few points, or check positions, channels, [plate]"
        )
    done, factors = len(COARSE), []
    for part in parts:
        errors = []
        for off in FINE.tolist():
            done += 1
            errors.append(error(COARSE[best] + off, part, done))
        factors.append(COARSE[best] + _lowest(FINE, np.array(errors)))
    frequency = bins.frequency_hz[parts].mean(axis=1)
    middle_hz = float(frequency.mean())
    design = np.column_stack([np.ones(PARTS), frequency - middle_hz])
    found, *_ = np.linalg.lstsq(design, np.array(factors), rcond=None)
    scatter = np.sum((design @ found - factors) ** 2) / (PARTS - 2)
    errors_of = np.sqrt(np.diag(np.linalg.inv(design.T @ design)) * scatter)
    return WaveFit(
        replace(dispersion, factor=float(found[0]), slope_per_hz=float(found[1]), reference_hz=middle_hz),
        float(errors_of[0]),
        float(errors_of[1]),
    )


def _lowest(places: Floats, values: Floats) -> float:
    """Lowest place of the parabola through the lowest value and its neighbours."""
    at = int(np.clip(np.argmin(values), 1, len(values) - 2))
    left, middle, right = values[at - 1 : at + 2].tolist()
    bend = left - 2 * middle + right
    return float(places[at] + (0.5 * (left - right) / bend * (places[1] - places[0]) if bend > 0 else 0.0))
