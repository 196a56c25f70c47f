"""The plate: a simply supported Kirchhoff plate, solved in closed form.

Mode (m, n) has the shape sin(m pi x / a) sin(n pi y / b), the angular frequency
sqrt(D / (rho h)) ((m pi / a)^2 + (n pi / b)^2) (Leissa, Vibration of Plates, NASA SP-160, eq. 4.20)
and the modal mass rho h a b / 4. A patch of piezo pulls a constant bending moment per length along
its edges; the work it does on a mode is that moment times the patch integral of the Laplacian of
the shape (divergence theorem).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import msgspec
import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from controller.board.panel import Plate, Waveform
from controller.errors import ConfigError

Floats = NDArray[np.float64]

MAX_MODES = 30_000  # 15 times the paper's plate
LEAST_CUT_HZ = 100e3  # bits of a low band still excite what lies far above it: their corners pass the driver up to here


def mode_cut_hz(waveform: Waveform) -> float:
    """Frequency up to which modes are taken, for banks, foci and the twin alike.

    The upper edge of the band and three sevenths more, 100 kHz at least: modes beyond it change the
    amplitude of a focus by less than 0.4 % (24 foci in bands from 1 to 400 kHz, modes up to 2.5 times this).
    """
    return max(LEAST_CUT_HZ, waveform.band_high_hz * 10 / 7)


@dataclass(frozen=True, eq=False)
class PlateModes:
    """Modes of a plate up to a frequency, lowest first.

    Attributes
    ----------
    x_order, y_order : (mode,) int array
        Half waves along the length and along the width, from 1.
    angular_frequency : (mode,) array
        Undamped, in rad/s.
    mass_kg : float
        Modal mass, the same for all.
    decay_rate : float
        1 / tau in 1/s: a free displacement falls as exp(-t / tau).
    """

    length_m: float
    width_m: float
    x_order: NDArray[np.int64]
    y_order: NDArray[np.int64]
    angular_frequency: Floats
    mass_kg: float
    decay_rate: float

    @classmethod
    def of(cls, plate: Plate, highest_hz: float) -> PlateModes:
        """All modes of `plate` up to `highest_hz`.

        Raises
        ------
        ConfigError
            If there is none, or more than can be computed with; if another edge than "simply_supported" is asked for.
        """
        if set(msgspec.structs.astuple(plate.sides)) != {"simply_supported"}:
            raise ConfigError('plate.edges: modes in closed form are those of a plate with edges = "simply_supported"')
        length, width = plate.length_m, plate.width_m
        stiffness = bending_stiffness(plate)
        per_area = plate.density_kg_m3 * plate.thickness_m
        speed = np.sqrt(stiffness / per_area)  # omega = speed * wavenumber^2
        longest = np.sqrt(2 * np.pi * highest_hz / speed) / np.pi
        if longest**2 * length * width * np.pi / 4 > MAX_MODES:  # orders within a quarter of an ellipse
            raise ConfigError(f"the plate has more than {MAX_MODES} modes below {highest_hz:g} Hz: too large or too thin")
        m, n = np.meshgrid(np.arange(1, int(longest * length) + 1), np.arange(1, int(longest * width) + 1), indexing="ij")
        omega = speed * np.pi**2 * ((m / length) ** 2 + (n / width) ** 2)
        chosen = omega <= 2 * np.pi * highest_hz
        order = np.argsort(omega[chosen], kind="stable")
        if not order.size:
            raise ConfigError(f"the plate has no mode below {highest_hz:g} Hz: too small or too thick to focus on")
        return cls(
            length_m=length,
            width_m=width,
            x_order=m[chosen][order],
            y_order=n[chosen][order],
            angular_frequency=omega[chosen][order],
            mass_kg=per_area * length * width / 4,
            decay_rate=1 / plate.decay_time_s,
        )

    @property
    def count(self) -> int:
        """Number of modes."""
        return self.x_order.size

    def x_sines(self, x_m: ArrayLike) -> Floats:
        """sin(m pi x / a) of all m from 1: (point, m)."""
        return np.sin(
            np.multiply.outer(np.asarray(x_m, np.float64), np.arange(1, self.x_order.max() + 1) * (np.pi / self.length_m))
        )

    def y_sines(self, y_m: ArrayLike) -> Floats:
        """sin(n pi y / b) of all n from 1: (point, n)."""
        return np.sin(np.multiply.outer(np.asarray(y_m, np.float64), np.arange(1, self.y_order.max() + 1) * (np.pi / self.width_m)))

    def mode_shapes(self, points_m: ArrayLike, dtype: DTypeLike = np.float64) -> NDArray[np.floating[Any]]:
        """Shapes at points.

        Parameters
        ----------
        points_m : (point, 2) array
            x and y in m.

        Returns
        -------
        (point, mode) array
        """
        points = np.asarray(points_m, np.float64).reshape(-1, 2)
        along_x = self.x_sines(points[:, 0]).astype(dtype, copy=False)
        along_y = self.y_sines(points[:, 1]).astype(dtype, copy=False)
        shapes: NDArray[np.floating[Any]] = along_x[:, self.x_order - 1] * along_y[:, self.y_order - 1]
        return shapes

    def patch_curvature(self, x_m: float, y_m: float, size_m: float) -> Floats:
        """Integral of the Laplacian of each shape over a square patch centred at (x, y).

        By the divergence theorem this is what a unit line moment on the four edges drives.

        Returns
        -------
        (mode,) array
            Dimensionless.
        """
        kx = self.x_order * (np.pi / self.length_m)
        ky = self.y_order * (np.pi / self.width_m)
        mean_x = 2 / kx * np.sin(kx * x_m) * np.sin(kx * size_m / 2)
        mean_y = 2 / ky * np.sin(ky * y_m) * np.sin(ky * size_m / 2)
        curvature: Floats = -(kx**2 + ky**2) * mean_x * mean_y
        return curvature


def bending_stiffness(plate: Plate) -> float:
    """D = E h^3 / (12 (1 - nu^2)) in N m."""
    return plate.young_modulus_pa * plate.thickness_m**3 / (12 * (1 - plate.poisson_ratio**2))


def bending_wavelength_m(plate: Plate, frequency_hz: float) -> float:
    """Wavelength of a bending wave in the free plate at a frequency, in m."""
    per_area = plate.density_kg_m3 * plate.thickness_m
    return float((bending_stiffness(plate) / per_area) ** 0.25 * (2 * np.pi / frequency_hz) ** 0.5)
