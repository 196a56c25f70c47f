"""What the modes of a plate are, however they were found: closed form, Ritz, or fitted to measurements.

Everything above (responses, field at T, energy at the surface, twin) takes modes through this interface only.
"""

from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from controller.arrays import Floats, Reals, blocks
from controller.device.board.panel import Actuator

POINTS_AT_ONCE = 256  # half a megabyte of a grid


class TensorFactors(Protocol):
    """Shapes that are products: the shape of mode k is along_x(x)[x_index[k]] * along_y(y)[y_index[k]].

    Sums over such modes are taken along one axis first, which saves most of the work on a grid.
    """

    @property
    def x_index(self) -> NDArray[np.int64]:
        """Factor along x of each mode: (mode,)."""

    @property
    def y_index(self) -> NDArray[np.int64]:
        """Factor along y of each mode: (mode,)."""

    def along_x(self, x_m: ArrayLike) -> Floats:
        """Factors along x at `x_m`, (point,): (point, factor)."""

    def along_y(self, y_m: ArrayLike) -> Floats:
        """Factors along y at `y_m`, (point,): (point, factor)."""


class Modes(Protocol):
    """Modes of a plate up to a frequency, lowest first.

    Mode k obeys M (q'' + 2 r q' + w^2 q) = force, with M = `mass_kg`, r = `decay_rate` and w = `angular_frequency`,
    each (mode,); its complex poles are -r +- sqrt(r^2 - w^2). The displacement of a point is the sum of shape times q.
    """

    @property
    def length_m(self) -> float:
        """Extent of the plate along x."""

    @property
    def width_m(self) -> float:
        """Extent of the plate along y."""

    @property
    def count(self) -> int:
        """Number of modes."""

    @property
    def angular_frequency(self) -> Floats:
        """Undamped, in rad/s: (mode,)."""

    @property
    def decay_rate(self) -> Floats:
        """Of free displacement, in 1/s, which falls as exp(-rate t): (mode,)."""

    @property
    def mass_kg(self) -> Floats:
        """Modal mass: (mode,)."""

    @property
    def mean_square(self) -> Floats:
        """Mean over the plate of each shape squared: (mode,)."""

    @property
    def factors(self) -> TensorFactors | None:
        """Factors of the shapes, where they are products."""

    def shapes(self, points_m: ArrayLike, dtype: DTypeLike = np.float64) -> Reals:
        """Shapes at `points_m`, (point, 2) in m: (point, mode)."""

    def on_grid(self, amplitudes: Floats, x_m: ArrayLike, y_m: ArrayLike) -> Floats:
        """Sum of the shapes with `amplitudes`, (mode,), at all points of a grid of `x_m`, (nx,), and `y_m`, (ny,): (ny, nx)."""

    def coupling(self, actuator: Actuator) -> Floats:
        """Integral of the Laplacian of each shape over an actuator's patch, dimensionless: (mode,).

        What a unit bending moment per length on the edges of the patch drives (divergence theorem).
        """


def by_factor(factors: TensorFactors, amplitudes: Floats) -> Floats:
    """Amplitudes of modes, (mode,), by the factors of their shapes: (factor along x, factor along y)."""
    matrix = np.zeros((int(factors.x_index.max()) + 1, int(factors.y_index.max()) + 1))
    matrix[factors.x_index, factors.y_index] = amplitudes
    return matrix


def at_points(modes: Modes, amplitudes: Floats, points_m: ArrayLike) -> Floats:
    """Sum of the shapes with `amplitudes`, (mode,), at `points_m`, (point, 2) in m: (point,)."""
    points = np.asarray(points_m, np.float64).reshape(-1, 2)
    if modes.factors is not None:
        along_x = modes.factors.along_x(points[:, 0]) @ by_factor(modes.factors, amplitudes)
        values: Floats = np.einsum("pn,pn->p", along_x, modes.factors.along_y(points[:, 1]))
        return values
    values = np.empty(len(points))
    for some in blocks(len(points), POINTS_AT_ONCE):  # the grid's diagonal: modes are summed before there are points
        values[some] = np.diagonal(modes.on_grid(amplitudes, points[some, 0], points[some, 1]))
    return values


def slowest_decay_s(modes: Modes) -> float:
    """Time in which the mode that rings longest falls to 1/e; inf without damping."""
    rate = float(modes.decay_rate.min())
    return 1 / rate if rate > 0 else float("inf")
