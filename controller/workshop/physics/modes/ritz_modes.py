"""Modes of a plate with any edges (`modes.Modes`), from their coefficients in products of one-dimensional functions.

Rigid motions of a plate that nothing holds are left out: a patch bends the plate with moments that balance each other, so it does
not drive them, and beside the hundreds of modes that a finger feels in the band their three do not count.
"""

from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from controller.arrays import Floats, Reals
from controller.device.board.panel import Actuator
from controller.device.board.plate.plate import Plate
from controller.device.board.relations.bending_waves import bending_stiffness
from controller.errors import ConfigError
from controller.workshop.physics.modes.closed_form import MAX_MODES
from controller.workshop.physics.modes.mode_cache import solved
from controller.workshop.physics.modes.mode_count import mode_count
from controller.workshop.physics.modes.modes import TensorFactors
from controller.workshop.physics.modes.ritz import ModeClass, PlateShape, longest_matrix

LONGEST_MATRIX = 6_500  # functions of a class of modes: 0.34 GB a matrix, two of which are needed, and a minute
AT_ONCE = 4_000_000  # numbers in use between the two sums of a shape: 32 MB


@dataclass(frozen=True, eq=False)
class RitzModes:
    """Modes of a plate up to a frequency, lowest first, without rigid motions."""

    length_m: float
    width_m: float
    angular_frequency: Floats  # angular_frequency, decay_rate, mass_kg, mean_square: (mode,): as in `modes.Modes`
    decay_rate: Floats
    mass_kg: Floats
    mean_square: Floats
    foam_share: Floats  # (mode,): share of a shape's square on the strips of foam
    condition: float  # of the energy's matrices: the largest eigenvalue over the lowest
    # each (ModeClass, (mode of the class,) int array): the modes of each symmetry, and the numbers that they have here
    classes: tuple[tuple[ModeClass, NDArray[np.int64]], ...]

    @classmethod
    def of(cls, plate: Plate, highest_hz: float) -> Self:
        """All modes of `plate` up to `highest_hz`.

        Raises ConfigError if there is none, or more than can be computed with, which says up to which frequency there are not too
        many.
        """
        shape = plate_shape(plate)
        per_area = plate.density_kg_m3 * plate.thickness_m
        speed = (bending_stiffness(plate) / per_area) ** 0.5  # angular frequency over k^2
        highest_k = (2 * np.pi * highest_hz / speed) ** 0.5
        if mode_count(shape.lengths_m, shape.ends, shape.poisson_ratio, highest_k) > MAX_MODES:
            raise ConfigError(f"the plate has more than {MAX_MODES} modes below {highest_hz:g} Hz: too large or too thin")
        if longest_matrix(shape, highest_k) > LONGEST_MATRIX:
            limit_hz = _limit(shape, highest_k) ** 2 * speed / (2 * np.pi)
            raise ConfigError(
                f"modes with these plate.edges are computed up to {limit_hz:.3g} Hz on this plate, not to {highest_hz:g} Hz:"
                ' take edges = "simply_supported", or a thicker or smaller plate'
            )
        solution = solved(shape, highest_k)
        wavenumber4 = np.concatenate([found.wavenumber4 for found in solution.classes])
        if not wavenumber4.size:
            raise ConfigError(f"the plate has no mode below {highest_hz:g} Hz: too small or too thick to focus on")
        order = np.argsort(wavenumber4, kind="stable")
        number = np.empty(order.size, np.int64)
        number[order] = np.arange(order.size)
        numbers = np.split(number, np.cumsum([found.wavenumber4.size for found in solution.classes])[:-1])
        return cls(
            length_m=plate.length_m,
            width_m=plate.width_m,
            angular_frequency=speed * np.sqrt(wavenumber4[order]),
            decay_rate=np.full(order.size, 1 / plate.decay_time_s),
            mass_kg=np.full(order.size, per_area * plate.length_m * plate.width_m),
            mean_square=np.ones(order.size),
            foam_share=np.concatenate([found.foam_share for found in solution.classes])[order],
            condition=solution.condition,
            classes=tuple(zip(solution.classes, numbers, strict=True)),
        )

    @property
    def count(self) -> int:
        """Number of modes."""
        return self.angular_frequency.size

    @property
    def factors(self) -> TensorFactors | None:
        """None: a shape is a sum of products."""
        return None

    def shapes(self, points_m: ArrayLike, dtype: DTypeLike = np.float64) -> Reals:
        """Shapes at `points_m`, (point, 2) in m: (point, mode); fastest where points share their y."""
        points = np.asarray(points_m, np.float64).reshape(-1, 2)
        rows_m, row_of = np.unique(points[:, 1], return_inverse=True)
        members = np.split(np.argsort(row_of, kind="stable"), np.cumsum(np.bincount(row_of))[:-1])
        shapes = np.empty((len(points), self.count), dtype)
        for found, numbers in self.classes:
            along_x, along_y = found.x.values(points[:, 0]), found.y.values(rows_m)
            flat = found.coefficients.reshape(found.y.count, -1)
            step = max(AT_ONCE // max(flat.shape[1], 1), 1)
            for first in range(0, len(rows_m), step):
                summed = (along_y[first : first + step] @ flat).reshape(-1, numbers.size, found.x.count)
                for of_row, some in zip(summed, members[first : first + step], strict=True):
                    shapes[some[:, None], numbers] = along_x[some] @ of_row.T
        return shapes

    def on_grid(self, amplitudes: Floats, x_m: ArrayLike, y_m: ArrayLike) -> Floats:
        """Sum of the shapes with `amplitudes`, (mode,), at all points of a grid of `x_m`, (nx,), and `y_m`, (ny,): (ny, nx)."""
        total = np.zeros((np.size(y_m), np.size(x_m)))
        for found, numbers in self.classes:
            summed = (amplitudes[numbers] @ found.coefficients).reshape(found.y.count, found.x.count)
            total += found.y.values(y_m) @ summed @ found.x.values(x_m).T
        return total

    def coupling(self, actuator: Actuator) -> Floats:
        """Integral of the Laplacian of each shape over an actuator's patch, dimensionless: (mode,)."""
        half = actuator.size_mm * 0.5e-3
        coupling = np.empty(self.count)
        for found, numbers in self.classes:
            (x_mean, x_bent), (y_mean, y_bent) = (
                tuple(np.diff(basis.values([at_mm * 1e-3 - half, at_mm * 1e-3 + half], order), axis=0)[0] for order in (-1, 1))
                for basis, at_mm in ((found.x, actuator.x_mm), (found.y, actuator.y_mm))
            )
            mean, bent = np.tensordot([y_mean, y_bent], found.coefficients, (1, 0))
            coupling[numbers] = mean @ x_bent + bent @ x_mean
        return coupling


def plate_shape(plate: Plate) -> PlateShape:
    """What modes of a plate depend on."""
    sides, foam = plate.sides, plate.foam
    ends = ((sides.x0, sides.x1), (sides.y0, sides.y1))
    if foam is None or "foam" not in (*ends[0], *ends[1]):
        return PlateShape((plate.length_m, plate.width_m), ends, plate.poisson_ratio)
    stiffness = foam.stiffness_n_m3 / bending_stiffness(plate)
    return PlateShape((plate.length_m, plate.width_m), ends, plate.poisson_ratio, stiffness, foam.width_mm * 1e-3)


def _limit(shape: PlateShape, highest_k: float) -> float:
    """Largest wavenumber below `highest_k` up to which the classes are small enough, within a percent."""
    while longest_matrix(shape, highest_k) > LONGEST_MATRIX:
        highest_k *= 0.99
    return highest_k
