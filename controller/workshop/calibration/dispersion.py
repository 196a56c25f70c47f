"""Bending waves of a plate: wavenumber against frequency by Mindlin's theory.

A little away from its edges, every field of one frequency is made of waves of one length, whatever holds the edges: all that
interpolation has to know of a plate.
"""

from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from controller.arrays import Floats
from controller.device.board.plate.plate import Plate
from controller.device.board.relations.bending_waves import MindlinPlate


@dataclass(frozen=True)
class Dispersion:
    """Wavenumbers of a plate."""

    mass_kg_m2: float  # mass per area
    stiffness_nm: float  # bending stiffness D
    rotation_kg: float  # rotary inertia per area, rho h^3 / 12
    shear_n_m: float  # shear stiffness kappa G h
    factor: float = 1.0  # on all wavenumbers at the frequency `reference_hz`: 1 as in the board, others by measurement
    slope_per_hz: float = 0.0  # change of that factor per Hz
    reference_hz: float = 0.0

    @classmethod
    def of(cls, plate: Plate) -> Self:
        """Of a board's plate, whatever its `theory`: measured waves are those of the real one (`MindlinPlate`)."""
        constants = MindlinPlate.of(plate)
        return cls(constants.mass_kg_m2, constants.stiffness_nm, constants.rotation_kg, constants.shear_n_m)

    def wavenumber(self, frequency_hz: ArrayLike) -> Floats:
        """Wavenumbers of the propagating bending wave in rad/m at `frequency_hz`, of any shape."""
        frequency = np.asarray(frequency_hz, np.float64)
        square = (2 * np.pi * frequency) ** 2
        # D k^4 - (rotation + D mass / shear) w^2 k^2 + (rotation w^2 / shear - 1) mass w^2 = 0
        half = (self.rotation_kg + self.stiffness_nm * self.mass_kg_m2 / self.shear_n_m) * square / 2
        last = self.stiffness_nm * self.mass_kg_m2 * square * (self.rotation_kg * square / self.shear_n_m - 1)
        factor = self.factor + self.slope_per_hz * (frequency - self.reference_hz)
        return np.sqrt((half + np.sqrt(half**2 - last)) / self.stiffness_nm) * factor

    def wavelength_m(self, frequency_hz: float) -> float:
        """Length of a wave in m."""
        return float(2 * np.pi / self.wavenumber(frequency_hz))

    def slowed_by_shear(self, frequency_hz: float) -> float:
        """Frequency of a wave over that by Kirchhoff's theory, which knows no shear and no rotation, of the same length."""
        wavenumber = float(self.wavenumber(frequency_hz)) / (self.factor + self.slope_per_hz * (frequency_hz - self.reference_hz))
        return 2 * np.pi * frequency_hz / (wavenumber**2 * float(np.sqrt(self.stiffness_nm / self.mass_kg_m2)))
