"""What a plate's model knows of its field: near a frequency only the modes near it move.

Right edges make it worth twice the points, wrong ones make it worse than knowing nothing: it is used if it foresees points left out
better than waves in all directions do. Its frequencies need not be right to more than a percent.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray

from controller.arrays import Bools, Floats, Indices
from controller.device.board.board import Board
from controller.workshop.calibration.interpolation.kriging import Covariance, SpectralField, Waves, krige
from controller.workshop.calibration.interpolation.spectra import Bins, Spectra
from controller.workshop.calibration.interpolation.wave_fit import WaveFit
from controller.workshop.physics.modes.modes import Modes

WIDENED_HZ = 600.0  # by which frequencies of the model may be wrong
NEGLIGIBLE = 1e-3  # of the strongest mode's variance
BINS_EVALUATED = 12


@dataclass(frozen=True, eq=False)
class ModalPrior:
    """Variances of the modes in each bin: a `Prior`."""

    modes: Modes
    variances: NDArray[np.float32]  # (bin, mode): a field of variance one together

    @classmethod
    def of(cls, board: Board, modes: Modes, waves: WaveFit, bins: Bins) -> Self:
        """For bins of a plate whose frequencies are those of its model, times what was measured."""
        scale = np.full(bins.frequency_hz.shape, waves.frequency_scale)
        if board.plate.theory == "kirchhoff":
            scale *= [waves.dispersion.slowed_by_shear(max(frequency_hz, 1.0)) for frequency_hz in bins.frequency_hz.tolist()]
        omega = (2 * np.pi * bins.frequency_hz / scale)[:, None]
        width = modes.decay_rate + 2 * np.pi * WIDENED_HZ
        variances = 1 / ((modes.angular_frequency**2 - omega**2) ** 2 + (2 * np.maximum(omega, 2 * np.pi) * width) ** 2)
        variances *= variances > NEGLIGIBLE * variances.max(axis=1, keepdims=True)
        variances /= (variances @ modes.mean_square)[:, None]
        return cls(modes, variances.astype(np.float32))

    def between(self, targets_m: Floats, points_m: Floats) -> Covariance:
        """As `Prior` says."""
        of_targets = self.modes.shapes(targets_m, np.float32)
        of_points = of_targets if targets_m is points_m else self.modes.shapes(points_m, np.float32)

        def covariance(bin_: int) -> Floats:
            some = np.flatnonzero(self.variances[bin_])
            found: Floats = ((of_targets[:, some] * self.variances[bin_, some]) @ of_points[:, some].T).astype(np.float64)
            return found

        return covariance

    def field(self, points_m: Floats, weights: Spectra) -> SpectralField:
        """As `Prior` says."""
        bins, points, channels = weights.shape
        plain = weights.view(np.float32).reshape(bins, points, 2 * channels)
        shapes = self.modes.shapes(points_m, np.float32)
        amplitudes: list[tuple[Indices, NDArray[np.float32]]] = []
        for bin_ in range(bins):
            some = np.flatnonzero(self.variances[bin_])
            amplitudes.append((some, self.variances[bin_, some][:, None] * (shapes[:, some].T @ plain[bin_])))
        return ModalField(self.modes, amplitudes)


@dataclass(frozen=True, eq=False)
class ModalField:
    """The field that `ModalPrior` estimates."""

    modes: Modes
    # Modes that move in each bin, and how: real and imaginary parts in turn
    amplitudes: list[tuple[Indices, NDArray[np.float32]]]

    def at(self, targets_m: Floats) -> Spectra:
        """As `SpectralField` says."""
        shapes = self.modes.shapes(targets_m, np.float32)
        return np.stack([(shapes[:, some] @ amplitudes).view(np.complex64) for some, amplitudes in self.amplitudes])


def unforeseen(
    points_m: Floats,
    spectra: Spectra,
    known: Bools,
    bins: Bins,
    prior_of: Callable[[Bins], Waves | ModalPrior],
) -> Floats:
    """Share of the energy of points left out that is not foreseen, in some bins of the band: (bin,)."""
    chosen = bins.in_band[:: max(len(bins.in_band) // BINS_EVALUATED, 1)]
    of_bins = spectra[chosen]
    _, foreseen = krige(points_m, of_bins, known, prior_of(bins.part(chosen)))
    power = (np.abs(of_bins) ** 2).sum(axis=(1, 2))
    return np.asarray((np.abs((foreseen - of_bins) * known) ** 2).sum(axis=(1, 2)) / power, np.float64)
