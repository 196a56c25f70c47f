"""Interpolation between scattered points, frequency by frequency.

Away from its edges a field of one frequency is a sum of waves of one length in all directions. If nothing more is known of it, the
covariance of the displacements at two points a distance r apart is J0(k r) (Berry, J. Phys. A 10, 1977), and the best linear
estimate of any other point follows from it. A little noise, and a little of what edges and patches add within half a wavelength, is
allowed for. One Cholesky factor serves all channels measured at the same points.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import LinAlgError, cho_factor, cho_solve, lapack
from scipy.special import j0

from controller.calibration.dispersion import Dispersion
from controller.calibration.spectra import Bins, Spectra

Floats = NDArray[np.float64]
Covariance = Callable[[int], Floats]

NOISE = 0.003  # of the variance of the field, as is what is only near
NEAR = 0.003
NEAR_WAVES = 0.478  # wavelengths at the upper edge of the band: 4 mm on the paper's plate
POINTS_AT_ONCE = 64


class Prior(Protocol):
    """What is known of a field before any measurement: how displacements at two points depend on each other."""

    def between(self, targets_m: Floats, points_m: Floats) -> Covariance:
        """Function of a bin: covariances (target, point), on the scale of a field of variance one."""


@dataclass(frozen=True, eq=False)
class Waves:
    """Waves of one length a frequency in all directions.

    Attributes
    ----------
    wavenumber : (bin,) array
        In rad/m.
    near_m : float
        Distance over which displacements are alike for other reasons.
    """

    wavenumber: Floats
    near_m: float

    @classmethod
    def of(cls, dispersion: Dispersion, bins: Bins, highest_hz: float) -> Waves:
        """For bins of a band up to `highest_hz`."""
        return cls(dispersion.wavenumber(bins.frequency_hz), NEAR_WAVES * dispersion.wavelength_m(highest_hz))

    def between(self, targets_m: Floats, points_m: Floats) -> Covariance:
        """As `Prior` says."""
        distance_m = np.hypot(*(targets_m[:, None] - points_m).transpose(2, 0, 1))
        near = NEAR * np.exp(-((distance_m / self.near_m) ** 2))
        return lambda bin_: j0(self.wavenumber[bin_] * distance_m) + near


@dataclass(frozen=True, eq=False)
class Kriged:
    """A field known at points, and estimated everywhere from them.

    Attributes
    ----------
    points_m : (point, 2) array
    weights : (bin, point, channel) array
        Zero where a channel was not measured.
    prior : Prior
    """

    points_m: Floats
    weights: Spectra
    prior: Prior

    def at(self, targets_m: Floats) -> Spectra:
        """Estimate at other points: (bin, target, channel)."""
        bins, points, channels = self.weights.shape
        found = np.empty((bins, len(targets_m), channels), np.complex64)
        plain = self.weights.view(np.float32).reshape(bins, points, 2 * channels)
        for first in range(0, len(targets_m), POINTS_AT_ONCE):
            some = slice(first, first + POINTS_AT_ONCE)
            covariance = self.prior.between(targets_m[some], self.points_m)
            for bin_ in range(bins):
                found[bin_, some] = (covariance(bin_).astype(np.float32) @ plain[bin_]).view(np.complex64)
        return found


def krige(
    points_m: Floats,
    spectra: Spectra,
    known: NDArray[np.bool_],
    prior: Prior,
    noise: float = NOISE,
    progress: Callable[[int, int], None] = lambda _done, _total: None,
) -> tuple[Kriged, Spectra]:
    """Solve for the weights, and for the estimate at each point from all others.

    Parameters
    ----------
    points_m : (point, 2) array
    spectra : (bin, point, channel) array
    known : (point, channel) bool array
        What of it was measured.
    prior : Prior
    noise : float
        Variance of the noise, in that of the field.
    progress : callable
        Called with the number of bins done and of all.

    Returns
    -------
    Kriged
    (bin, point, channel) complex array
        Left out, each point by itself: w_i / (K^-1)_ii beside the measured value, exactly. Zero where nothing was measured.
    """
    weights, left_out = np.zeros_like(spectra), np.zeros_like(spectra)
    covariance = prior.between(points_m, points_m)
    groups = list(alike(known))
    for bin_ in range(len(spectra)):
        whole = covariance(bin_)
        whole[np.diag_indices_from(whole)] += noise
        for points, channels in groups:
            inverse = _inverse(whole[np.ix_(points, points)])
            values = spectra[bin_][np.ix_(points, channels)]
            of_values = (inverse @ values.view(np.float32).astype(np.float64)).view(np.complex128)
            weights[bin_][np.ix_(points, channels)] = of_values
            left_out[bin_][np.ix_(points, channels)] = values - of_values / np.diag(inverse)[:, None]
        progress(bin_ + 1, len(spectra))
    return Kriged(points_m, weights, prior), left_out


def foreseen_shares(prior: Prior, points_m: Floats, targets_m: Floats, bins: NDArray[np.intp], noise: float = NOISE) -> Floats:
    """Share of the amplitude that estimates at targets will keep, from the places of the points alone: (target,).

    The correlation between the estimate and the field, mean over some bins: drive words are the estimate's sign, which keeps of a
    Gaussian variable what both have in common.
    """
    explained = np.zeros(len(targets_m))
    among, between = prior.between(points_m, points_m), prior.between(targets_m, points_m)
    for bin_ in bins.tolist():
        whole = among(bin_)
        whole[np.diag_indices_from(whole)] += noise
        to_points = between(bin_)
        explained += np.einsum("tp,tp->t", to_points, cho_solve(cho_factor(whole), to_points.T).T) / len(bins)
    return np.sqrt(np.clip(explained, 0, 1))


def alike(known: NDArray[np.bool_]) -> Iterator[tuple[NDArray[np.intp], NDArray[np.intp]]]:
    """Points, and channels that were all measured at just these points."""
    patterns, owner = np.unique(known, axis=1, return_inverse=True)
    for index in range(patterns.shape[1]):
        points = np.flatnonzero(patterns[:, index])
        if points.size:
            yield points, np.flatnonzero(owner.reshape(-1) == index)


def _inverse(symmetric: Floats) -> Floats:
    """Inverse of a positive definite matrix by its Cholesky factor."""
    factor, failed = lapack.dpotrf(symmetric, lower=True, overwrite_a=False)
    inverse, failed_too = lapack.dpotri(factor, lower=True, overwrite_c=True)
    if failed or failed_too:
        raise LinAlgError("covariances are not positive definite")
    found: Floats = np.tril(inverse) + np.tril(inverse, -1).T
    return found
