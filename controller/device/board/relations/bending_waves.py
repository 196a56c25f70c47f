"""Bending waves of a plate by both plate theories: stiffness, wavelength, wavenumber, frequency.

Kirchhoff's theory leaves out shear and rotary inertia, Mindlin's counts them. Its shear coefficient 5 / (6 - nu) is within
1.2e-5 of Rayleigh and Lamb up to 100 kHz in 0.5 mm of glass. A layered plate has the shear flexibility and the rotary inertia of
its layers.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeVar

from controller.device.board.plate.layers import laminate
from controller.device.board.plate.plate import Plate

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Numbers = TypeVar("Numbers", float, NDArray[np.float64])


@dataclass(frozen=True)
class MindlinPlate:
    """Constants of a plate per unit of its area."""

    mass_kg_m2: float  # mass
    stiffness_nm: float  # bending stiffness D
    rotation_kg: float  # rotary inertia, rho h^3 / 12 of one layer
    shear_n_m: float  # shear stiffness, kappa G h of one layer

    @classmethod
    def of(cls, plate: Plate) -> MindlinPlate:
        """Constants of a board's plate."""
        thickness_m, poisson, mass = plate.thickness_m, plate.poisson_ratio, plate.density_kg_m3 * plate.thickness_m
        rotation, flexibility = mass * thickness_m**2 / 12, 1.0
        if plate.layers:
            whole = laminate(plate.layers)
            rotation, flexibility = whole.rotation_kg, whole.shear_flexibility
        return cls(
            mass_kg_m2=mass,
            stiffness_nm=bending_stiffness(plate),
            rotation_kg=rotation,
            shear_n_m=5 / (6 - poisson) * plate.young_modulus_pa / (2 * (1 + poisson)) * thickness_m / flexibility,
        )

    def angular_frequency(self, wavenumber: Numbers) -> Numbers:
        """Of the bending wave with `wavenumber` in rad/m, a number or an array of any shape, in rad/s."""
        square = wavenumber**2
        # m J w^4 - (m S + (J S + m D) k^2) w^2 + D S k^4 = 0; the lower root, without a difference of near numbers
        linear = self.mass_kg_m2 * self.shear_n_m + self._mixed * square
        last = self.stiffness_nm * self.shear_n_m * square**2
        found: Numbers = (2 * last / (linear + (linear**2 - 4 * self.mass_kg_m2 * self.rotation_kg * last) ** 0.5)) ** 0.5
        return found

    def wavenumber(self, angular_frequency: Numbers) -> Numbers:
        """Of the propagating bending wave of `angular_frequency` in rad/s, a number or an array of any shape, in rad/m."""
        square = angular_frequency**2
        half = self._mixed * square / 2
        last = self.stiffness_nm * self.shear_n_m * self.mass_kg_m2 * square * (self.shear_n_m - self.rotation_kg * square)
        found: Numbers = ((half + (half**2 + last) ** 0.5) / (self.stiffness_nm * self.shear_n_m)) ** 0.5
        return found

    @property
    def kirchhoff(self) -> float:
        """Angular frequency over squared wavenumber without shear and rotary inertia."""
        return math.sqrt(self.stiffness_nm / self.mass_kg_m2)

    def without_correction_hz(self, frequency_hz: float) -> float:
        """Frequency that Kirchhoff's theory gives the wave whose frequency is `frequency_hz`."""
        return self.kirchhoff * self.wavenumber(2 * math.pi * frequency_hz) ** 2 / (2 * math.pi)

    @property
    def _mixed(self) -> float:
        return self.rotation_kg * self.shear_n_m + self.mass_kg_m2 * self.stiffness_nm


def bending_stiffness(plate: Plate) -> float:
    """D = E h^3 / (12 (1 - nu^2)) in N m."""
    return plate.young_modulus_pa * plate.thickness_m**3 / (12 * (1 - plate.poisson_ratio**2))


def kirchhoff_wavelength_m(plate: Plate, frequency_hz: float) -> float:
    """Wavelength of a bending wave in the free plate at a frequency, in m, without shear and rotary inertia (paper, eq. 5)."""
    per_area = plate.density_kg_m3 * plate.thickness_m
    return float((bending_stiffness(plate) / per_area) ** 0.25 * (2 * math.pi / frequency_hz) ** 0.5)


def mindlin_wavelength_m(plate: Plate, frequency_hz: float) -> float:
    """The same with shear and rotary inertia."""
    return 2 * math.pi / MindlinPlate.of(plate).wavenumber(2 * math.pi * frequency_hz)


def bending_wavelength_m(plate: Plate, frequency_hz: float) -> float:
    """The same by the plate's theory."""
    return (mindlin_wavelength_m if plate.theory == "mindlin" else kirchhoff_wavelength_m)(plate, frequency_hz)


def mindlin_shift(plate: Plate, frequency_hz: float) -> float:
    """How much lower a wave lies than Kirchhoff's `frequency_hz`, as a share of it: same wavelength, by Mindlin's theory."""
    wavenumber = 2 * math.pi / kirchhoff_wavelength_m(plate, frequency_hz)
    return 1 - MindlinPlate.of(plate).angular_frequency(wavenumber) / (2 * math.pi * frequency_hz)
