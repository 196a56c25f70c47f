"""Plate and driver together: response of every mode to a unit step of voltage, as a sum of exponentials.

A mode obeys M (q'' + 2/tau q' + w^2 q) = force, the driver's low-pass comes before it. The step
response of the chain is a static part and one exponential for each pole, exactly:

    q(t) = static + Re sum_p residue_p exp(pole_p t) + Re sum_d driver_residue_d exp(driver_pole_d t)

per newton of force on the mode at 1 V. Modes slower than their decay (w tau < 1; one on the paper's
plate) have two real poles instead of a conjugate pair, so poles are listed with the mode they belong to.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from controller.arrays import Complex, Floats
from controller.device.board.board import Board
from controller.workshop.physics.modes.modes import Modes
from controller.workshop.physics.responses.driver import DriverResponse

Number = TypeVar("Number", np.float64, np.complex128)


@dataclass(frozen=True, eq=False)
class StepResponse:
    """Static part, poles and residues of all modes."""

    static: Floats  # (mode,): displacement at rest in m per N
    # poles, residues: (pole,): of the plate; the first `mode` of them are in the order of the modes, those after are the second
    # poles of overdamped modes. A conjugate pair is one entry with twice the residue
    poles: Complex
    residues: Complex
    mode_of_pole: NDArray[np.int64]  # (pole,)
    driver_poles: Complex  # (2,)
    driver_residues: Complex  # (mode, 2)

    @classmethod
    def of(cls, modes: Modes, driver: DriverResponse) -> StepResponse:
        """Partial fractions of plate and driver."""
        omega, rate = modes.angular_frequency, modes.decay_rate
        root = np.sqrt((rate**2 - omega**2).astype(np.complex128))
        root = np.where(abs(root) < 1e-5 * rate, 1e-5 * rate, root)  # as in the driver: no double poles
        first, second = -rate + root, -rate - root
        overdamped = np.flatnonzero(root.imag == 0)
        strength = driver.transfer(first) / (modes.mass_kg * first * (first - second))
        pair = np.ones(modes.count)
        pair[root.imag != 0] = 2
        other = driver.transfer(second) / (modes.mass_kg * second * (second - first))
        d = driver.poles
        plate_at_d = 1 / (modes.mass_kg[:, None] * (d[None, :] - first[:, None]) * (d[None, :] - second[:, None]))
        return cls(
            static=1 / (modes.mass_kg * omega**2),
            poles=np.concatenate([first, second[overdamped]]),
            residues=np.concatenate([pair * strength, other[overdamped]]),
            mode_of_pole=np.concatenate([np.arange(modes.count), overdamped]),
            driver_poles=d,
            driver_residues=driver.residues[None, :] * plate_at_d,
        )

    def part(self, modes: slice) -> StepResponse:
        """The same for some modes, by their numbers from `modes.start` to `modes.stop`."""
        count = self.static.size
        owner = self.mode_of_pole[count:]
        seconds = np.flatnonzero((owner >= modes.start) & (owner < modes.stop))
        chosen = np.concatenate([np.arange(count)[modes], count + seconds])
        return StepResponse(
            static=self.static[modes],
            poles=self.poles[chosen],
            residues=self.residues[chosen],
            mode_of_pole=self.mode_of_pole[chosen] - modes.start,
            driver_poles=self.driver_poles,
            driver_residues=self.driver_residues[modes],
        )

    def by_mode(self, of_poles: NDArray[Number]) -> NDArray[Number]:
        """Add up the poles of each mode: (pole, ...) to (mode, ...)."""
        count = self.static.size
        total = of_poles[:count].copy()
        np.add.at(total, self.mode_of_pole[count:], of_poles[count:])
        return total


def channel_forces(board: Board, modes: Modes) -> Floats:
    """Force on each mode in N per V on each channel: (mode, channel), zero where a channel has no actuator.

    Positive moments bend the plate towards +z at the patch; `moment_n_per_v` times the patch
    integral of the Laplacian, with its sign.
    """
    force = np.zeros((modes.count, board.channels))
    for a in board.actuators:
        force[:, a.channel] = -board.driver.moment_n_per_v * modes.coupling(a)
    return force
