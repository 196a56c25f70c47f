"""Modes with other frequencies or other decay, and the same shapes: another theory, another damping, another temperature."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from controller.device.board.panel import Actuator
from controller.workshop.physics.modes.modes import Modes, TensorFactors

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Retuned:
    """Shapes and masses of `base`, and frequencies and rates of their own (`modes.Modes`)."""

    base: Modes
    angular_frequency: Floats  # angular_frequency, decay_rate: (mode,)
    decay_rate: Floats

    @property
    def length_m(self) -> float:
        """As in `Modes`."""
        return self.base.length_m

    @property
    def width_m(self) -> float:
        """As in `Modes`."""
        return self.base.width_m

    @property
    def count(self) -> int:
        """As in `Modes`."""
        return self.base.count

    @property
    def mass_kg(self) -> Floats:
        """As in `Modes`."""
        return self.base.mass_kg

    @property
    def mean_square(self) -> Floats:
        """As in `Modes`."""
        return self.base.mean_square

    @property
    def factors(self) -> TensorFactors | None:
        """As in `Modes`."""
        return self.base.factors

    def shapes(self, points_m: ArrayLike, dtype: DTypeLike = np.float64) -> NDArray[np.floating[Any]]:
        """As in `Modes`."""
        return self.base.shapes(points_m, dtype)

    def on_grid(self, amplitudes: Floats, x_m: ArrayLike, y_m: ArrayLike) -> Floats:
        """As in `Modes`."""
        return self.base.on_grid(amplitudes, x_m, y_m)

    def coupling(self, actuator: Actuator) -> Floats:
        """As in `Modes`."""
        return self.base.coupling(actuator)


def retuned(modes: Modes, angular_frequency: Floats | None = None, decay_rate: Floats | None = None) -> Modes:
    """`modes` with other frequencies or rates, (mode,); None: as they are."""
    base = modes.base if isinstance(modes, Retuned) else modes
    frequency = modes.angular_frequency if angular_frequency is None else angular_frequency
    return Retuned(base, frequency, modes.decay_rate if decay_rate is None else decay_rate)


def drifted(modes: Modes, drift: float) -> Modes:
    """`modes` with all frequencies higher by the share `drift`: what another temperature does to glass."""
    return retuned(modes, modes.angular_frequency * (1 + drift))
