"""What of an emission can be heard: energy below 16 kHz at the surface.

Defined as the mean over the plate of the squared velocity spectrum, integrated from 0 to 16 kHz and
over all time, in (m/s)^2 s: steps into the emission and back to the idle word included, decay after
T included. In closed form per mode; the mean over the plate of a squared mode shape is 1/4.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from controller.bank.packing import channel_bits
from controller.board import Board
from controller.offline.driver import DriverResponse
from controller.offline.plate import PlateModes
from controller.offline.step_response import channel_forces

AUDIBLE_HZ = 16e3
HIGHEST_HZ = 100e3
STEP_HZ = 80.0  # a mode's resonance is 1 / (pi tau) = 318 Hz wide at half power


def surface_energy(
    board: Board, words: NDArray[np.uint32], idle_word: int, low_hz: float = 0.0, high_hz: float = AUDIBLE_HZ
) -> float:
    """Mean over the plate of the squared velocity between two frequencies, over all time, in (m/s)^2 s.

    Parameters
    ----------
    words : (sample,) uint32 array
        One emission, from and back to `idle_word`, the plate at rest before.
    """
    modes = PlateModes.of(board.plate, HIGHEST_HZ)
    forces = channel_forces(board, modes)
    levels = channel_bits(np.concatenate([[idle_word], words, [idle_word]]).astype("<u4")).astype(np.float64)
    steps = np.diff(levels, axis=0) * board.driver.supply_v
    times = np.arange(len(steps)) * board.waveform.bit_period_s
    driver = DriverResponse.of(board.driver)
    energy = 0.0
    for first_hz in np.arange(low_hz + STEP_HZ / 2, high_hz, 64 * STEP_HZ):
        frequency = np.arange(first_hz, min(first_hz + 63.5 * STEP_HZ, high_hz), STEP_HZ)
        s = 2j * np.pi * frequency
        slope = np.exp(-np.outer(s, times)) @ steps  # spectrum of dV/dt: (frequency, channel)
        slope *= driver.transfer(s)[:, None]
        stiffness = modes.mass_kg * (modes.angular_frequency[:, None] ** 2 + 2 * modes.decay_rate * s + s**2)
        velocity = (forces @ slope.T) / stiffness
        energy += float(np.sum(velocity.real**2 + velocity.imag**2)) * 0.25 * 2 * STEP_HZ  # both signs of frequency
    return energy
