"""The driver of one channel: a series R and L from the push-pull stage into the capacitance of the piezo.

From the voltage of the stage to that on the piezo it is a low-pass of second order
(paper, fig. 4): H(s) = w0^2 / (s^2 + R/L s + w0^2), w0^2 = 1 / (L C).
"""

from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from controller.arrays import Complex
from controller.device.board.panel import Driver


@dataclass(frozen=True, eq=False)
class DriverResponse:
    """Exact response of one driver. After a unit step of the stage the piezo is at 1 + Re sum(residues * exp(poles * t)) volts."""

    poles: Complex  # (2,): in 1/s
    residues: Complex  # (2,): of the step response
    gain: float  # w0^2 in 1/s^2

    @classmethod
    def of(cls, driver: Driver) -> Self:
        """Poles and residues of a board's driver."""
        half = driver.resistance_ohm / (2 * driver.inductance_h)
        gain = 1 / (driver.inductance_h * driver.capacitance_f)
        root = np.sqrt(complex(half**2 - gain))
        if abs(root) < 1e-5 * half:
            root = 1e-5 * half  # a double pole has no partial fractions: split it by 1e-5, an error of 1e-10
        fast = -half - root
        poles = np.array([gain / fast if root.real else -half + root, fast])  # a difference of near numbers would lose the slow one
        residues = gain / (poles * (poles - poles[::-1]))
        return cls(poles=poles, residues=residues, gain=gain)

    def transfer(self, s: ArrayLike) -> Complex:
        """H(s): piezo voltage over stage voltage, at complex frequencies s in 1/s of any shape."""
        s = np.asarray(s, np.complex128)
        value: Complex = self.gain / ((s - self.poles[0]) * (s - self.poles[1]))
        return value
