"""What is wrong with single points: place, sensitivity, the plate's frequencies at that time, by how all other points foresee each.

Of a point at x + d, measured with e^g times the sensitivity while all frequencies of the plate were higher by s, the spectrum is

    U(f) + d . grad U + g U - s f dU/df,    U: the field at x, with the plate as it was on the average.

The other points foresee U with its slopes: some ten thousand numbers for four unknowns. Each step of Gauss and Newton's method
moves all points at once. Waves in all directions are the same in every frame: offset, rotation and scale of all places together
are left to `frame`, and sensitivity and frequencies that all points have in common are no error here.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations
from typing import Final

import numpy as np
from numpy.typing import NDArray

from controller.arrays import Bools, Floats, Indices
from controller.device.board.board import Board
from controller.workshop.calibration.cores import on_all_cores
from controller.workshop.calibration.interpolation.kriging import Waves, inverse
from controller.workshop.calibration.interpolation.spectra import Bins, Spectra
from controller.workshop.calibration.interpolation.wave_fit import WaveFit, of_one_pattern

BINS: Final = 24  # of the band; as many others say what is corrected
STEPS: Final = 6
NOISE: Final = 0.1, 0.03  # variance of the noise, in that of the field: in the first two steps, and in the others
LIMITS: Final = np.array([0.4e-3, 0.4e-3, 0.3, 2e-3])  # of a step
SPREAD: Final = np.array([1e-3, 1e-3, 0.5, 5e-3])  # among points, before anything is known
KINDS: Final = {"places": slice(0, 2), "sensitivity": slice(2, 3), "frequencies": slice(3, 4)}  # of errors
SUBSETS: Final = tuple(kinds for count in range(len(KINDS) + 1) for kinds in combinations(KINDS, count))
SOLVES: Final = BINS * (STEPS + len(SUBSETS))  # frequencies, over all steps of a fit
BETTER: Final = 0.9  # of the energy not foreseen: a kind of error that explains less is not corrected


@dataclass(frozen=True, eq=False)
class PointFit:
    """What is wrong with each point, as far as it explains the records better."""

    errors: Floats  # (point, 4): of x and y in m, logarithm of the sensitivity, relative change of all frequencies; 0 if left
    deviation: Floats  # (4,): standard deviations of these, of the median point
    corrected: tuple[str, ...]  # of `KINDS`
    unforeseen: tuple[float, float]  # share of the energy of a point left out that is not foreseen, before and after

    def drift(self) -> tuple[float, float]:
        """Change of all frequencies from the first point to the last, along a straight line, and its standard deviation."""
        order = np.linspace(-0.5, 0.5, len(self.errors))
        slope = float(order @ self.errors[:, 3] / (order @ order))
        left = self.errors[:, 3] - self.errors[:, 3].mean() - slope * order
        return slope, float(np.sqrt((left @ left / len(left) + self.deviation[3] ** 2) / (order @ order)))


def fit_points(
    board: Board,
    points_m: Floats,  # (point, 2): as stated
    responses: NDArray[np.floating],  # (point, sample, channel)
    known: Bools,  # (point, channel)
    bins: Bins,
    waves: WaveFit,
    progress: Callable[[int, int], None] = lambda _done, _total: None,  # called with the work done and all of it
) -> PointFit:
    """Fit the errors of points that are known as a whole; others are left as they are."""
    whole, channels = of_one_pattern(known)
    low_hz, high_hz = board.waveform.band_hz
    inside = np.flatnonzero((bins.frequency_hz > low_hz) & (bins.frequency_hz < high_hz))
    of_fit, others = inside[np.linspace(0, len(inside) - 1, 2 * BINS).astype(int)].reshape(-1, 2).T  # in turn
    records, judges = (
        _Records(board, points_m[whole], responses[whole][:, :, channels], bins, some, waves) for some in (of_fit, others)
    )
    found, deviation, done = np.zeros((len(whole), 4)), np.zeros(4), 0
    for step in range(STEPS):
        change, deviation = records.step(found, NOISE[step >= 2])
        found = records.without_common(found + np.clip(change, -LIMITS, LIMITS))
        progress(done := done + 1, STEPS + len(SUBSETS))
    left = {}
    for kinds in SUBSETS:
        left[kinds] = judges.unforeseen(_only(found, kinds))
        progress(done := done + 1, STEPS + len(SUBSETS))
    corrected = min(SUBSETS, key=lambda kinds: left[kinds] / BETTER ** len(kinds))
    errors = np.zeros((len(points_m), 4))
    errors[whole] = _only(found, corrected)
    return PointFit(errors, deviation, corrected, (left[()], left[corrected]))


def _only(errors: Floats, kinds: tuple[str, ...]) -> Floats:
    """Errors of some kinds."""
    found = np.zeros_like(errors)
    for name in kinds:
        found[:, KINDS[name]] = errors[:, KINDS[name]]
    return found


@dataclass(frozen=True, eq=False)
class _Records:
    """Records of some points and channels, as spectra in some bins."""

    board: Board
    points_m: Floats
    responses: NDArray[np.floating]
    bins: Bins
    chosen: Indices
    waves: WaveFit

    def step(self, errors: Floats, noise: float) -> tuple[Floats, Floats]:
        """Change of `errors` that explains the records better, (point, 4), and the standard deviations that are left, (4,)."""
        places_m, (spectra, slopes) = self.points_m + errors[:, :2], self._spectra(errors)
        prior = self._prior()
        among, toward = prior.between(places_m, places_m), prior.slopes(places_m)

        def of_bin(bin_: int) -> tuple[Floats, Floats]:
            frequency_hz = float(self.bins.frequency_hz[self.chosen[bin_]])
            whole = among(bin_)
            whole[np.diag_indices_from(whole)] += noise
            solved = inverse(whole)
            values = np.concatenate([spectra[bin_], slopes[bin_]], axis=1)
            weights = solved @ values
            left = weights / np.diag(solved)[:, None]  # what the others do not foresee
            foreseen, channels = values - left, spectra.shape[2]
            unknown, weights = left[:, :channels], weights[:, :channels]
            moved = [one @ weights - np.einsum("pj,jp->p", one, solved)[:, None] * unknown for one in toward(bin_)]
            by = np.stack([*moved, foreseen[:, :channels], -frequency_hz * foreseen[:, channels:]], axis=1)
            scale = float((np.abs(unknown) ** 2).mean())
            normal: Floats = np.einsum("pac,pbc->pab", by.conj(), by, optimize=True).real / scale
            return normal, np.einsum("pac,pc->pa", by.conj(), unknown, optimize=True).real / scale

        normal, right = map(sum, zip(*on_all_cores(of_bin, range(len(self.chosen))), strict=True))
        covariance = np.linalg.inv(normal + np.diag(SPREAD**-2))
        found: Floats = np.einsum("pab,pb->pa", covariance, right)
        return found, np.sqrt(np.median(np.einsum("paa->pa", covariance), axis=0))

    def unforeseen(self, errors: Floats) -> float:
        """Share of the energy that is not foreseen."""
        among, spectra = self._prior().between(*[self.points_m + errors[:, :2]] * 2), self._spectra(errors)[0]

        def share(bin_: int) -> float:
            values = spectra[bin_]
            solved = inverse(among(bin_) + NOISE[1] * np.eye(len(values)))
            left = (solved @ values) / np.diag(solved)[:, None]
            return float((np.abs(left) ** 2).sum() / (np.abs(values) ** 2).sum())

        return float(np.mean(list(on_all_cores(share, range(len(spectra))))))

    def without_common(self, errors: Floats) -> Floats:
        """Errors without what all points have in common."""
        errors = errors - errors.mean(axis=0)
        x, y = (self.points_m - self.points_m.mean(axis=0)).T
        turned, larger = np.concatenate([-y, x]), np.concatenate([x, y])
        moved = errors[:, :2].T.reshape(-1)
        for common in (turned, larger):
            moved = moved - common * (common @ moved) / (common @ common)
        return np.column_stack([moved.reshape(2, -1).T, errors[:, 2:]])

    def _prior(self) -> Waves:
        return Waves.of(self.waves.dispersion, self.bins.part(self.chosen), self.board, self.waves.edge_variance)

    def _spectra(self, errors: Floats) -> tuple[Spectra, Spectra]:
        """Corrected spectra and their slopes df, (bin, point, channel) both."""
        found = self._transformed(errors[:, 3].tobytes()) * np.exp(-errors[:, 2:3]).astype(np.float32)
        return found[0], found[1]

    @lru_cache(maxsize=2)  # noqa: B019 - records live as long as the fit
    def _transformed(self, all_higher: bytes) -> Spectra:
        """Spectra and slopes where frequencies were higher, (2, bin, point, channel)."""
        period_s, higher = self.board.waveform.bit_period_s, np.frombuffer(all_higher)
        time_s = np.arange(self.responses.shape[1]) * period_s
        found = np.empty((2, len(self.chosen), len(higher), self.responses.shape[2]), np.complex64)

        def transform(point: int) -> None:
            late_s = time_s * (1 + higher[point]) + period_s * higher[point]
            turn = np.exp(-2j * np.pi * np.outer(self.bins.frequency_hz[self.chosen], late_s))
            turns = np.stack([turn, -2j * np.pi * time_s * turn])
            found.real[:, :, point] = turns.real.astype(np.float32) @ self.responses[point]
            found.imag[:, :, point] = turns.imag.astype(np.float32) @ self.responses[point]

        list(on_all_cores(transform, range(len(higher))))
        return found
