"""Modes of a plate whose frequencies have drifted, all by the same share: what warmth does to glass."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from controller.board.panel import Actuator
from controller.physics.modes import Modes, TensorFactors

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class DriftedModes:
    """`Modes` with the shapes, masses and decay rates of others, and frequencies higher by the share `drift`."""

    modes: Modes
    drift: float

    @property
    def length_m(self) -> float:
        """Extent of the plate along x."""
        return self.modes.length_m

    @property
    def width_m(self) -> float:
        """Extent of the plate along y."""
        return self.modes.width_m

    @property
    def count(self) -> int:
        """Number of modes."""
        return self.modes.count

    @property
    def angular_frequency(self) -> Floats:
        """Undamped, in rad/s: (mode,)."""
        return self.modes.angular_frequency * (1 + self.drift)

    @property
    def decay_rate(self) -> Floats:
        """In 1/s: (mode,)."""
        return self.modes.decay_rate

    @property
    def mass_kg(self) -> Floats:
        """Modal mass: (mode,)."""
        return self.modes.mass_kg

    @property
    def mean_square(self) -> Floats:
        """Mean over the plate of each shape squared: (mode,)."""
        return self.modes.mean_square

    @property
    def factors(self) -> TensorFactors | None:
        """Factors of the shapes, where they are products."""
        return self.modes.factors

    def shapes(self, points_m: ArrayLike, dtype: DTypeLike = np.float64) -> NDArray[np.floating[Any]]:
        """Shapes at `points_m`, (point, 2) in m: (point, mode)."""
        return self.modes.shapes(points_m, dtype)

    def on_grid(self, amplitudes: Floats, x_m: ArrayLike, y_m: ArrayLike) -> Floats:
        """Sum of the shapes with `amplitudes` at all points of a grid: (ny, nx)."""
        return self.modes.on_grid(amplitudes, x_m, y_m)

    def coupling(self, actuator: Actuator) -> Floats:
        """Integral of the Laplacian of each shape over an actuator's patch: (mode,)."""
        return self.modes.coupling(actuator)
