"""The plate's own wavenumbers, from measurements: those with which points left out are best foreseen by the others.

The error of points left out has a sharp minimum: half a percent off costs as much as all else. It is searched in several parts of
the band, by points away from the edges, which gives a factor on the board's wavenumbers, how it changes over the band, and how sure
both are.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from controller.arrays import Bools, Floats, Indices
from controller.device.board.board import Board
from controller.errors import CalibrationError
from controller.workshop.calibration.dispersion import Dispersion
from controller.workshop.calibration.interpolation.kriging import Waves, krige
from controller.workshop.calibration.interpolation.spectra import Bins, Spectra

POINTS = 400  # at most, of those there are
PARTS = 6  # of the band
BINS = 3  # of each part
MOST_UNFORESEEN = 0.8  # of the energy of a point left out
ROUGH_NOISE = 0.03  # variance of the noise, in that of the field, while wavenumbers are searched
NOISES = (0.003, 0.01, 0.03, 0.1, 0.3)
ALIKE = 1.5  # of the least error: of noises by which points left out are foreseen alike the least is right between points
EDGE_WAVES = 0.75  # nearer to an edge than this many wavelengths a point does not judge
EDGE_VARIANCES = (0.0, 0.3)
COARSE: Floats = np.linspace(0.93, 1.07, 15)
FINE: Floats = np.linspace(-0.0075, 0.0075, 7)
SOLVES = PARTS * (len(COARSE) + len(NOISES) + (len(EDGE_VARIANCES) + BINS) * len(FINE))  # frequencies, over all errors of a fit


@dataclass(frozen=True)
class WaveFit:
    """Wavenumbers as measured."""

    dispersion: Dispersion  # with the factor found in the middle of the band, and its slope
    edge_variance: float  # of waves that fade from the edges, in that of the field
    factor_error: float  # factor_error, slope_error_per_hz: standard deviations, from the scatter between parts of the band
    slope_error_per_hz: float
    frequency_hz: tuple[float, ...]  # frequency_hz, factors: middle of each part of the band, and the factor found there
    factors: tuple[float, ...]
    scatter: float  # standard deviation of one of them
    noise: float  # variance of noise and of what positions and gains are wrong by, in that of the field

    @property
    def frequency_scale(self) -> float:
        """Frequencies of waves of a length, over those of the board's plate, in the middle of the band."""
        return self.dispersion.factor**-2

    @property
    def stiffness_scale(self) -> float:
        """Bending stiffness for the board's mass per area, over the board's."""
        return self.dispersion.factor**-4


def fit_waves(
    board: Board,  # what its plate's constants say is where the search begins
    points_m: Floats,  # (point, 2)
    spectra: Spectra,  # (bin, point, channel)
    known: Bools,  # (point, channel)
    bins: Bins,
    progress: Callable[[int, int], None] = lambda _done, _total: None,  # called with the work done and all of it
) -> WaveFit:
    """Fit wavenumbers, and what edges add.

    Raises CalibrationError if no wavenumber within 7 % of the board's explains the field.
    """
    dispersion = Dispersion.of(board.plate)
    whole, channels = of_one_pattern(known)
    low, high = np.searchsorted(bins.frequency_hz, (board.waveform.band_low_hz, board.waveform.band_high_hz))
    inside = _inside(board, points_m[whole])
    parts = np.linspace(low, high - 1, PARTS * BINS + 2)[1:-1].round().astype(int).reshape(PARTS, BINS)
    steps = len(COARSE) + len(NOISES) + (len(EDGE_VARIANCES) + PARTS) * len(FINE)

    done = 0

    def error(factor: float, chosen: Indices, edge_variance: float, noise: float) -> float:
        nonlocal done
        prior = Waves.of(replace(dispersion, factor=factor), bins.part(chosen), board, edge_variance)
        found = _unforeseen(points_m[whole], spectra[np.ix_(chosen, whole, channels)], inside, prior, noise)
        done += 1
        progress(done, steps)
        return found

    middles = parts[:, BINS // 2]
    coarse = np.array([error(factor, middles, EDGE_VARIANCES[-1], ROUGH_NOISE) for factor in COARSE.tolist()])
    best = int(coarse.argmin())
    fine = np.array([[error(COARSE[best] + off, middles, edge, ROUGH_NOISE) for off in FINE.tolist()] for edge in EDGE_VARIANCES])
    edge_variance, around = min(zip(EDGE_VARIANCES, fine, strict=True), key=lambda one: float(one[1].min()))
    nearest = float(COARSE[best] + lowest(FINE, around))
    by_noise = [error(nearest, middles, edge_variance, noise) for noise in NOISES]
    least = min(by_noise)
    noise = next(noise for noise, error_of in zip(NOISES, by_noise, strict=True) if error_of <= ALIKE * least)
    if best in (0, len(COARSE) - 1) or least > MOST_UNFORESEEN:
        raise CalibrationError(
            f"no waves within 7 % of the board's wavelengths explain what was measured at {len(whole)} points (of one left out,"
            f" {least:.0%} of the energy is not foreseen): too few points, places off by 1 mm and more, or another [plate]"
        )
    factors = []
    for part in parts:
        errors = [error(COARSE[best] + off, part, edge_variance, noise) for off in FINE.tolist()]
        factors.append(float(COARSE[best] + lowest(FINE, np.array(errors))))
    return _line(dispersion, edge_variance, noise, bins.frequency_hz[parts].mean(axis=1), factors)


def of_one_pattern(known: Bools) -> tuple[Indices, Indices]:
    """Points, and channels that are known at every one of them, as most are."""
    whole = np.flatnonzero(known.any(axis=1))
    if len(whole) > POINTS:
        whole = np.sort(np.random.default_rng(1).choice(whole, POINTS, replace=False))
    channels = np.flatnonzero(known[whole].mean(axis=0) > 0.5)
    return whole[known[np.ix_(whole, channels)].all(axis=1)], channels


def _inside(board: Board, points_m: Floats) -> Bools:
    """Which points judge: those away from the edges, or all if few are."""
    from_edge_m = np.minimum(points_m, (board.plate.length_m, board.plate.width_m) - points_m).min(axis=1)
    inside: Bools = from_edge_m > EDGE_WAVES * Dispersion.of(board.plate).wavelength_m(board.waveform.band_high_hz)
    if inside.sum() < len(points_m) / 5:
        inside[:] = True
    return inside


def _unforeseen(points_m: Floats, spectra: Spectra, inside: Bools, prior: Waves, noise: float) -> float:
    """Energy of points inside, each left out, that the others do not foresee, over all."""
    _, foreseen = krige(points_m, spectra, np.ones(spectra.shape[1:], bool), prior, noise)
    scale = (np.abs(spectra[:, inside]) ** 2).mean(axis=(1, 2), keepdims=True)
    return float((np.abs(foreseen[:, inside] - spectra[:, inside]) ** 2 / scale).mean())


def _line(dispersion: Dispersion, edge_variance: float, noise: float, frequency: Floats, factors: list[float]) -> WaveFit:
    """The straight line through the factors of the parts of the band."""
    middle_hz = float(frequency.mean())
    design = np.column_stack([np.ones(PARTS), frequency - middle_hz])
    found, *_ = np.linalg.lstsq(design, np.array(factors), rcond=None)
    scatter = np.sum((design @ found - factors) ** 2) / (PARTS - 2)
    errors_of = np.sqrt(np.diag(np.linalg.inv(design.T @ design)) * scatter)
    return WaveFit(
        replace(dispersion, factor=float(found[0]), slope_per_hz=float(found[1]), reference_hz=middle_hz),
        edge_variance,
        float(errors_of[0]),
        float(errors_of[1]),
        tuple(frequency.tolist()),
        tuple(factors),
        float(np.sqrt(scatter)),
        noise,
    )


def lowest(places: Floats, values: Floats) -> float:
    """Lowest place of the parabola through the lowest value and its neighbours."""
    at = int(np.clip(np.argmin(values), 1, len(values) - 2))
    left, middle, right = values[at - 1 : at + 2].tolist()
    bend = left - 2 * middle + right
    return float(places[at] + (0.5 * (left - right) / bend * (places[1] - places[0]) if bend > 0 else 0.0))
