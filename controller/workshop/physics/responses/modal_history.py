"""Displacement and velocity of every mode at the end of each bit of an emission, and of the time after it.

Between steps of voltage each pole only turns and decays, so a bit is one multiplication of the state: exact, and as long as there
are bits, whatever was played. `plate_twin` gives one focus time at less cost; this gives all times: the energy as it builds up,
the focus passing by, the velocity that a finger feels.
"""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from controller.arrays import Complex, Floats
from controller.workshop.physics.modes.modes import Modes
from controller.workshop.physics.responses.step_response import StepResponse

STATES_AT_ONCE = 500_000  # of poles, at some times: 8 MB an array, six of them


class ModalMotion(NamedTuple):
    """Displacement in m and velocity in m/s of each mode at the ends of some bits: (time, mode) each."""

    displacement: Floats
    velocity: Floats


def modal_history(step: StepResponse, forces: Floats, volts: Floats, bit_period_s: float) -> Iterator[ModalMotion]:
    """Motion from rest, in blocks of bits of at most `STATES_AT_ONCE`.

    `forces` (mode, 32) are in N per V, `volts` (bit, 32) above the level at rest, each held for one bit period, zero before: give
    each bit n times, and an n-th of its period, to see what happens within it. Yields the motion from rest at the idle word, bit
    after bit.
    """
    of_poles = forces[step.mode_of_pole]
    turn, driver_turn = np.exp(step.poles * bit_period_s), np.exp(step.driver_poles * bit_period_s)[:, None]
    state, driver = np.zeros(step.poles.size, np.complex128), np.zeros((2, forces.shape[1]), np.complex128)
    steps = np.diff(volts, axis=0, prepend=np.zeros((1, forces.shape[1])))
    at_once = max(1, STATES_AT_ONCE // step.poles.size)
    for first in range(0, len(volts), at_once):
        some = steps[first : first + at_once]
        states = (some @ of_poles.T) * step.residues
        drivers = np.empty((len(some), *driver.shape), np.complex128)
        for k, step_v in enumerate(some):
            states[k] += state
            states[k] *= turn
            state = states[k]
            driver = drivers[k] = (driver + step_v) * driver_turn
        level = (volts[first : first + at_once] @ forces.T) * step.static
        settling = _of_drivers(step, forces, drivers)
        sinking = _of_drivers(step, forces, drivers * step.driver_poles[:, None])
        yield ModalMotion(level + step.by_mode(states.T.real).T + settling, step.by_mode((states * step.poles).T.real).T + sinking)


def _of_drivers(step: StepResponse, forces: Floats, drivers: Complex) -> Floats:
    """Part of each mode that follows the drivers: (time, mode), from (time, 2, 32)."""
    moved = sum((drivers[:, pole] @ forces.T * step.driver_residues[:, pole]).real for pole in range(2))
    return np.asarray(moved, np.float64)


class Energy(NamedTuple):
    """Mechanical energy of the plate in J, from rest at the idle word: kinetic and potential."""

    kinetic_j: Floats
    potential_j: Floats


def modal_energy(modes: Modes, motion: ModalMotion) -> Energy:
    """Energy at each time, (time,) each; the modes share none, so it is the sum over them."""
    velocity_squared, squared = motion.velocity**2, motion.displacement**2
    return Energy(0.5 * velocity_squared @ modes.mass_kg, 0.5 * squared @ (modes.mass_kg * modes.angular_frequency**2))
