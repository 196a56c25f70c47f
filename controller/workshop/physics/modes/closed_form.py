"""A simply supported Kirchhoff plate, solved in closed form.

Mode (m, n) has the shape sin(m pi x / a) sin(n pi y / b), the angular frequency
sqrt(D / (rho h)) ((m pi / a)^2 + (n pi / b)^2) (Leissa, Vibration of Plates, NASA SP-160, eq. 4.20)
and the modal mass rho h a b / 4. A patch of piezo pulls a constant bending moment per length along
its edges; the work it does on a mode is that moment times the patch integral of the Laplacian of
the shape (divergence theorem).
"""

from dataclasses import dataclass
from typing import Self

import msgspec
import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from controller.arrays import Floats, Reals
from controller.device.board.panel import Actuator
from controller.device.board.plate.plate import Plate
from controller.device.board.relations.bending_waves import bending_stiffness
from controller.errors import ConfigError
from controller.workshop.physics.modes.modes import by_factor

MAX_MODES = 30_000  # 15 times the paper's plate


@dataclass(frozen=True, eq=False)
class Sines:
    """Factors of the shapes: sines of all orders from 1."""

    length_m: float
    width_m: float
    x_index: NDArray[np.int64]  # x_index, y_index: (mode,): half waves along the length and along the width, less 1
    y_index: NDArray[np.int64]

    def along_x(self, x_m: ArrayLike) -> Floats:
        """sin(m pi x / a) of all m from 1: (point, m)."""
        return _sines(x_m, self.length_m, int(self.x_index.max()) + 1)

    def along_y(self, y_m: ArrayLike) -> Floats:
        """sin(n pi y / b) of all n from 1: (point, n)."""
        return _sines(y_m, self.width_m, int(self.y_index.max()) + 1)


def _sines(at_m: ArrayLike, extent_m: float, orders: int) -> Floats:
    sines: Floats = np.sin(np.multiply.outer(np.asarray(at_m, np.float64), np.arange(1, orders + 1) * (np.pi / extent_m)))
    return sines


@dataclass(frozen=True, eq=False)
class SimplySupported:
    """Modes of a plate up to a frequency, lowest first (`modes.Modes`)."""

    length_m: float
    width_m: float
    factors: Sines
    angular_frequency: Floats  # angular_frequency, decay_rate, mass_kg, mean_square: (mode,): as in `modes.Modes`
    decay_rate: Floats
    mass_kg: Floats
    mean_square: Floats

    @classmethod
    def of(cls, plate: Plate, highest_hz: float) -> Self:
        """All modes of `plate` up to `highest_hz`.

        Raises ConfigError if there is none, or more than can be computed with; if another edge than "simply_supported" is asked
        for.
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
            factors=Sines(length, width, m[chosen][order] - 1, n[chosen][order] - 1),
            angular_frequency=omega[chosen][order],
            decay_rate=np.full(order.size, 1 / plate.decay_time_s),
            mass_kg=np.full(order.size, per_area * length * width / 4),
            mean_square=np.full(order.size, 0.25),
        )

    @property
    def count(self) -> int:
        """Number of modes."""
        return self.angular_frequency.size

    def shapes(self, points_m: ArrayLike, dtype: DTypeLike = np.float64) -> Reals:
        """Shapes at `points_m`, (point, 2) in m: (point, mode)."""
        points = np.asarray(points_m, np.float64).reshape(-1, 2)
        along_x = self.factors.along_x(points[:, 0]).astype(dtype, copy=False)
        along_y = self.factors.along_y(points[:, 1]).astype(dtype, copy=False)
        shapes: Reals = along_x[:, self.factors.x_index] * along_y[:, self.factors.y_index]
        return shapes

    def on_grid(self, amplitudes: Floats, x_m: ArrayLike, y_m: ArrayLike) -> Floats:
        """Sum of the shapes with `amplitudes`, (mode,), on a grid: (ny, nx)."""
        return self.factors.along_y(y_m) @ (by_factor(self.factors, amplitudes).T @ self.factors.along_x(x_m).T)

    def coupling(self, actuator: Actuator) -> Floats:
        """Integral of the Laplacian of each shape over an actuator's patch, dimensionless: (mode,)."""
        size_m = actuator.size_mm * 1e-3
        kx = (self.factors.x_index + 1) * (np.pi / self.length_m)
        ky = (self.factors.y_index + 1) * (np.pi / self.width_m)
        mean_x = 2 / kx * np.sin(kx * (actuator.x_mm * 1e-3)) * np.sin(kx * size_m / 2)
        mean_y = 2 / ky * np.sin(ky * (actuator.y_mm * 1e-3)) * np.sin(ky * size_m / 2)
        curvature: Floats = -(kx**2 + ky**2) * mean_x * mean_y
        return curvature
