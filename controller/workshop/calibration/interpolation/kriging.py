"""Interpolation between scattered points, frequency by frequency.

Away from its edges a field of one frequency is a sum of waves of one length in all directions. If nothing more is known of it, the
covariance of the displacements at two points a distance r apart is J0(k r) (Berry, J. Phys. A 10, 1977), and the best linear
estimate of any other point follows from it. A little noise, and a little of what edges and patches add within half a wavelength, is
allowed for. One Cholesky factor serves all channels measured at the same points.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Protocol, Self

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import LinAlgError, cho_factor, cho_solve, lapack
from scipy.special import j0, j1

from controller.arrays import Bools, Floats, Indices, blocks
from controller.device.board.board import Board
from controller.workshop.calibration.cores import cores, on_all_cores
from controller.workshop.calibration.dispersion import Dispersion
from controller.workshop.calibration.interpolation.spectra import Bins, Spectra

Covariance = Callable[[int], Floats]

NOISE = 0.003  # of the variance of the field, as is what is only near
NEAR = 0.003
NEAR_WAVES = 0.478  # wavelengths at the upper edge of the band: 4 mm on the paper's plate
DIRECTIONS = 12  # of waves that meet an edge, each way
POINTS_AT_ONCE = 128
DIFFERENCE_M = 1e-6  # by which slopes of what fades are found
BESSEL_PER_UNIT = 512


class SpectralField(Protocol):
    """A field that is known everywhere, by bins."""

    def at(self, targets_m: Floats) -> Spectra:
        """Spectra at points, (target, 2) in m: (bin, target, channel)."""


class Prior(Protocol):
    """What is known of a field before any measurement: how displacements at two points depend on each other."""

    def between(self, targets_m: Floats, points_m: Floats) -> Covariance:
        """Function of a bin: covariances (target, point), on the scale of a field of variance one."""

    def field(self, points_m: Floats, weights: Spectra) -> SpectralField:
        """Sum of the covariances with points, (point, 2) in m, times their `weights`, (bin, point, channel)."""


@dataclass(frozen=True, eq=False)
class Waves:
    """Waves of one length a frequency in all directions, and what edges add: waves along them that fade within a wavelength."""

    wavenumber: Floats  # (bin,): in rad/m
    near_m: float  # distance over which displacements are alike for other reasons
    extents_m: tuple[float, float]  # length and width of the plate
    # Of what fades from each edge, there, in the variance of the field: none at simple supports, which reflect all
    edge_variance: float

    @classmethod
    def of(cls, dispersion: Dispersion, bins: Bins, board: Board, edge_variance: float) -> Self:
        """For bins of a board's band."""
        near_m = NEAR_WAVES * dispersion.wavelength_m(board.waveform.band_high_hz)
        extents_m = (board.plate.length_m, board.plate.width_m)
        return cls(dispersion.wavenumber(bins.frequency_hz), near_m, extents_m, edge_variance)

    def between(self, targets_m: Floats, points_m: Floats) -> Covariance:
        """As `Prior` says."""
        distance_m = np.hypot(*(targets_m[:, None] - points_m).transpose(2, 0, 1))
        near = NEAR * np.exp(-((distance_m / self.near_m) ** 2))

        def covariance(bin_: int) -> Floats:
            inside: Floats = bessel(self.wavenumber[bin_] * distance_m) + near
            if self.edge_variance:
                inside += self.fading(targets_m, bin_) @ self.fading(points_m, bin_).T
            return inside

        return covariance

    def slopes(self, points_m: Floats) -> Callable[[int], Floats]:
        """Function of a bin: slopes of the covariances between points, (axis, point, point), as the former point moves."""
        away_m = (points_m[:, None] - points_m).transpose(2, 0, 1)
        distance_m = np.hypot(*away_m)
        toward = away_m / np.maximum(distance_m, 1e-12)
        near = -2 * NEAR * distance_m / self.near_m**2 * np.exp(-((distance_m / self.near_m) ** 2))
        nearby_m = [points_m + move_m for move_m in (np.array([DIFFERENCE_M, 0.0]), np.array([0.0, DIFFERENCE_M]))]

        def slope(bin_: int) -> Floats:
            k = self.wavenumber[bin_]
            inside: Floats = toward * (near - k * j1(k * distance_m))
            if self.edge_variance:
                here = self.fading(points_m, bin_)
                inside += [(self.fading(there_m, bin_) - here) / DIFFERENCE_M @ here.T for there_m in nearby_m]
            return inside

        return slope

    def fading(self, points_m: Floats, bin_: int) -> Floats:
        """Waves that run along an edge and fade from it, in all directions from which waves meet the edge: (point, wave).

        Along the edge they have the part k sin(a) of the wavenumber of the wave that meets it, across the edge they fade with
        k sqrt(1 + sin(a)^2) (Kirchhoff's equation).
        """
        sines = np.sin((np.arange(DIRECTIONS) + 0.5) * (np.pi / 2 / DIRECTIONS))
        along, across = self.wavenumber[bin_] * sines, self.wavenumber[bin_] * np.sqrt(1 + sines**2)
        waves = []
        for axis in (0, 1):
            phase = np.outer(points_m[:, axis], along)
            running = np.cos(phase), np.sin(phase)
            from_edge_m = points_m[:, 1 - axis]
            for edge_m in (from_edge_m, self.extents_m[1 - axis] - from_edge_m):
                fades = np.exp(-np.outer(edge_m, across))
                waves += [fades * one for one in running]
        found: Floats = np.concatenate(waves, axis=1) * np.sqrt(self.edge_variance / DIRECTIONS)
        return found

    def field(self, points_m: Floats, weights: Spectra) -> SpectralField:
        """As `Prior` says."""
        bins, points, channels = weights.shape
        plain = weights.view(np.float32).reshape(bins, points, 2 * channels)
        fading = [self.fading(points_m, bin_).T @ plain[bin_] for bin_ in range(bins if self.edge_variance else 0)]
        return WaveField(self, points_m, plain, fading)


@dataclass(frozen=True, eq=False)
class WaveField:
    """The field that `Waves` estimate."""

    waves: Waves
    points_m: Floats  # (point, 2)
    weights: NDArray[np.float32]  # (bin, point, 2 * channel): real and imaginary parts in turn
    fading: list[Floats]  # amplitudes of the waves that fade from the edges, of each bin; empty without any

    def at(self, targets_m: Floats) -> Spectra:
        """As `SpectralField` says."""
        bins, _, columns = self.weights.shape
        found = np.empty((bins, len(targets_m), columns // 2), np.complex64)
        inside = replace(self.waves, edge_variance=0.0)
        for some in blocks(len(targets_m), POINTS_AT_ONCE):
            covariance = inside.between(targets_m[some], self.points_m)

            def fill(bins: Indices, some: slice = some, covariance: Covariance = covariance) -> None:
                for bin_ in bins.tolist():
                    plain = covariance(bin_).astype(np.float32) @ self.weights[bin_]
                    if self.fading:
                        plain += self.waves.fading(targets_m[some], bin_) @ self.fading[bin_]
                    found[bin_, some] = plain.view(np.complex64)

            list(on_all_cores(fill, np.array_split(np.arange(bins), cores())))
        return found


def krige(
    points_m: Floats,  # (point, 2)
    spectra: Spectra,  # (bin, point, channel)
    known: Bools,  # (point, channel): what of it was measured
    prior: Prior,
    noise: float = NOISE,  # variance of the noise, in that of the field
    progress: Callable[[int, int], None] = lambda _done, _total: None,  # called with the number of bins done and of all
) -> tuple[SpectralField, Spectra]:
    """Solve for the weights, and for the estimate at each point from all others.

    The estimate (bin, point, channel) leaves each point out by itself: w_i / (K^-1)_ii beside the measured value, exactly. Zero
    where nothing was measured.
    """
    weights, left_out = np.zeros_like(spectra), np.zeros_like(spectra)
    covariance = prior.between(points_m, points_m)
    groups = list(alike(known))

    def solve(bin_: int) -> None:
        whole = covariance(bin_)
        whole[np.diag_indices_from(whole)] += noise
        for points, channels in groups:
            solved = inverse(whole[np.ix_(points, points)])
            values = spectra[bin_][np.ix_(points, channels)]
            of_values = (solved @ values.view(np.float32).astype(np.float64)).view(np.complex128)
            weights[bin_][np.ix_(points, channels)] = of_values
            left_out[bin_][np.ix_(points, channels)] = values - of_values / np.diag(solved)[:, None]

    for done, _ in enumerate(on_all_cores(solve, range(len(spectra)))):
        progress(done + 1, len(spectra))
    return prior.field(points_m, weights), left_out


def foreseen_shares(prior: Prior, points_m: Floats, targets_m: Floats, bins: Indices, noise: float = NOISE) -> Floats:
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


def alike(known: Bools) -> Iterator[tuple[Indices, Indices]]:
    """Points, and channels that were all measured at just these points."""
    patterns, owner = np.unique(known, axis=1, return_inverse=True)
    for index in range(patterns.shape[1]):
        points = np.flatnonzero(patterns[:, index])
        if points.size:
            yield points, np.flatnonzero(owner.reshape(-1) == index)


def bessel(places: Floats) -> Floats:
    """J0 at places from 0, of any shape, between values 1/512 apart: within 5e-7, and much faster."""
    scaled = places * BESSEL_PER_UNIT
    whole = scaled.astype(np.intp)
    values, slopes = _bessel_table(1 << max(int(whole.max(initial=0) + 2).bit_length(), 16))
    scaled -= whole
    scaled *= slopes.take(whole, mode="clip")  # nothing is beyond: faster than to look
    scaled += values.take(whole, mode="clip")
    return scaled


@lru_cache(maxsize=8)
def _bessel_table(count: int) -> tuple[Floats, Floats]:
    values: Floats = j0(np.arange(count + 1) / BESSEL_PER_UNIT)
    return values[:-1], np.diff(values)


def inverse(symmetric: Floats) -> Floats:
    """Inverse of a positive definite matrix by its Cholesky factor."""
    factor, failed = lapack.dpotrf(symmetric, lower=True, overwrite_a=False)
    inverse, failed_too = lapack.dpotri(factor, lower=True, overwrite_c=True)
    if failed or failed_too:
        raise LinAlgError("covariances are not positive definite")
    found: Floats = np.tril(inverse) + np.tril(inverse, -1).T
    return found
