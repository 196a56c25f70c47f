"""Energy of an emission at the surface that can be heard: below 16 kHz.

It is the mean over the plate of the squared velocity spectrum, integrated from 0 to 16 kHz and
over all time, in (m/s)^2 s: steps into the emission and back to the idle word included, decay after
T included. In closed form per mode, whose shapes are orthogonal: the mean over the plate is the sum of the modes' own.

A spectrum of what lasts a time t is known from samples closer than 1 / t (sampling theorem, time and
frequency exchanged), so a long ramp is sampled more finely than an emission, and what begins above an
overdamped mode's frequency less finely than what contains its slow return.
"""

import numpy as np
from numpy.typing import NDArray

from controller.arrays import Floats
from controller.device.bank.packing import channel_bits, framed
from controller.device.board.board import Board
from controller.workshop.physics.modes.modes import Modes
from controller.workshop.physics.modes.plate_modes import modes_of
from controller.workshop.physics.responses.driver import DriverResponse
from controller.workshop.physics.responses.step_response import StepResponse, channel_forces

AUDIBLE_HZ = 16e3
REST_TAUS = 10.0  # of ringing after the last step: e^-10 of the slowest amplitude is left
BLOCK = 64  # frequencies at once
TRANSFORMED = 16_384  # the same of the transform: 8 MB


def surface_energy(
    board: Board,
    words: NDArray[np.uint32],  # (sample,): played with the plate at rest before; empty: a step from `before_word` to `idle_word`
    idle_word: int,  # played afterwards, and before unless `before_word` is given
    low_hz: float = 0.0,  # low_hz, high_hz: limits of frequency
    high_hz: float = AUDIBLE_HZ,
    *,
    before_word: int | None = None,
    modes: Modes | None = None,  # those of the board's plate by default
) -> float:
    """Mean over the plate of the squared velocity between two frequencies, over all time, in (m/s)^2 s."""
    _, density, step_hz = surface_spectrum(board, words, idle_word, low_hz, high_hz, before_word=before_word, modes=modes)
    return float(density.sum()) * step_hz


def surface_spectrum(
    board: Board,
    words: NDArray[np.uint32],
    idle_word: int,
    low_hz: float = 0.0,
    high_hz: float = AUDIBLE_HZ,
    *,
    before_word: int | None = None,
    modes: Modes | None = None,
) -> tuple[Floats, Floats, float]:
    """Density of `surface_energy` over frequency.

    The arguments are as there. Returns the frequencies (n,) in Hz, evenly spaced, half a step from both limits; the density (n,) in
    (m/s)^2 s / Hz, both signs of frequency together; and the step in Hz.
    """
    from scipy.signal import zoom_fft  # noqa: PLC0415 - a second of imports, which a build of a bank does without

    modes = modes_of(board) if modes is None else modes
    forces = channel_forces(board, modes)
    first = idle_word if before_word is None else before_word
    levels = channel_bits(framed(first, words, idle_word)).astype(np.float64)
    steps = np.diff(levels, axis=0) * board.driver.supply_v
    driver = DriverResponse.of(board.driver)
    poles = StepResponse.of(modes, driver).poles
    slowest_s = 1 / float(np.min(-poles.real[abs(poles) >= 2 * np.pi * low_hz], initial=modes.decay_rate.min()))
    count = int(np.ceil((high_hz - low_hz) * (len(words) * board.waveform.bit_period_s + REST_TAUS * slowest_s)))
    step_hz = (high_hz - low_hz) / count
    frequency: Floats = low_hz + step_hz * (np.arange(count, dtype=np.float64) + 0.5)
    density = np.empty(count)
    weights = modes.mean_square / modes.mass_kg**2
    for start in range(0, count, BLOCK):
        if start % TRANSFORMED == 0:  # a plate that rings for 10 s has a million frequencies
            some = min(count - start, TRANSFORMED)
            ends_hz = [low_hz + step_hz * (start + 0.5), low_hz + step_hz * (start + some + 0.5)]
            slopes = zoom_fft(steps, ends_hz, some, fs=board.waveform.bit_clock_hz, axis=0)  # of dV/dt: (frequency, channel)
        omega = 2 * np.pi * frequency[start : start + BLOCK]
        slope = slopes[start % TRANSFORMED :][:BLOCK] * driver.transfer(1j * omega)[:, None]
        force2 = (forces @ slope.real.T) ** 2 + (forces @ slope.imag.T) ** 2  # (mode, frequency), as all below
        stiffness2 = (modes.angular_frequency[:, None] ** 2 - omega**2) ** 2 + (2 * modes.decay_rate[:, None] * omega) ** 2
        density[start : start + BLOCK] = 2 * weights @ (force2 / stiffness2)
    return frequency, density, step_hz
