"""Energy at the surface that is heard as a quadratic form of the drive bits: A-weighted, up to 20 kHz.

It is that of `workshop/physics/audible.py`, weighted by `workshop/physics/sound.py`.

The spectrum of the levels is taken in bins narrow against one over an emission's length; in each bin the energy is a quadratic
form of the 32 channels, positive by construction. Samples that are close in time are joined by the form's lags instead.
"""

import numpy as np

from controller.arrays import Floats
from controller.device.board.board import Board
from controller.device.board.panel import CHANNELS, Waveform
from controller.workshop.bank_builder.methods.exact import rounded
from controller.workshop.bank_builder.methods.measured_plate import MeasuredPlate
from controller.workshop.physics.responses.driver import DriverResponse
from controller.workshop.physics.responses.impulse_response import ResponseModel
from controller.workshop.physics.sound import HEARD_HZ, a_weighting

BINS_PER_LINE = 4  # bins for each line of a spectrum of an emission's length: its power is known from two
FINE = 10  # frequencies averaged over a bin: a mode may be narrower
PHASE_BITS, FORM_BITS, STATE_BITS = 14, 15, 28


def bins_hz(waveform: Waveform) -> Floats:
    """Frequencies up to 20 kHz of which `FINE` make a bin: (bin, fine)."""
    count = int(np.ceil(HEARD_HZ * waveform.duration_s * BINS_PER_LINE))
    fine_hz: Floats = HEARD_HZ / count / FINE * (np.arange(count * FINE, dtype=np.float64) + 0.5)
    return fine_hz.reshape(count, FINE)


def heard(board: Board, model: ResponseModel) -> Floats:
    """Energy at the surface of each bin as a form of the channels, before it is weighted: (bin, 32, 32)."""
    fine_hz, modes, driver = bins_hz(board.waveform), model.plate_modes, DriverResponse.of(board.driver)
    rate = np.maximum(modes.decay_rate, 2 * np.pi * (fine_hz[0, 1] - fine_hz[0, 0]))  # a narrower mode is not met by chance
    form = np.empty((len(fine_hz), CHANNELS, CHANNELS))
    for index, some_hz in enumerate(fine_hz):
        s = 2j * np.pi * some_hz
        stiffness = modes.mass_kg[:, None] * (modes.angular_frequency[:, None] ** 2 + 2 * rate[:, None] * s + s**2)
        gain = np.abs(driver.transfer(s) * (1 - np.exp(-s * board.waveform.bit_period_s)) / stiffness)
        form[index] = (model.forces * (modes.mean_square * np.sum(gain**2, axis=1))[:, None]).T @ model.forces
    return form


class AudibleForm:
    """Audible energy of many emissions at once, in a unit of this class. `longest_lag` is in samples."""

    def __init__(self, board: Board, plate: ResponseModel | MeasuredPlate, longest_lag: int) -> None:
        fine_hz, period_s, samples = bins_hz(board.waveform), board.waveform.bit_period_s, plate.samples
        form = heard(board, plate) if isinstance(plate, ResponseModel) else plate.heard
        form = form * (a_weighting(fine_hz) ** 2).mean(axis=1)[:, None, None]
        count, hz = len(fine_hz), fine_hz.mean(axis=1)
        self._form = rounded(form / form.max(), FORM_BITS, (1, 2))
        turns = 2 * np.pi * np.outer(np.arange(samples), hz * period_s)
        self._phases: Floats = np.rint(np.concatenate([np.cos(turns), np.sin(turns)], axis=1) * 2.0**PHASE_BITS) * 2.0**-PHASE_BITS
        lag_turns = 2 * np.pi * np.outer(np.arange(longest_lag + 1), hz * period_s)
        lags = np.cos(lag_turns) @ self._form.reshape(count, -1)
        # (lag, 32, 32): half the derivative of a sample's bits' energy by those of a sample this many samples away
        self.lags = rounded(lags.reshape(-1, CHANNELS, CHANNELS), 20)
        self.largest = self._largest(samples)  # largest eigenvalue of the form, rounded up

    def spectrum(self, levels: Floats, first: int = 0) -> Floats:
        """Spectrum of levels above idle, (sample, cell, 32), of which the first is sample `first`: (2 bin, cell, 32)."""
        samples, cells = levels.shape[:2]
        found = self._phases[first : first + samples].T @ levels.reshape(samples, -1)
        return found.reshape(-1, cells, CHANNELS)

    def forces(self, spectrum: Floats) -> Floats:
        """The form of each bin times a spectrum: half the derivative of the energy by the spectrum."""
        halves = spectrum.reshape(2, len(self._form), -1, CHANNELS)
        found: Floats = np.matmul(halves, self._form).reshape(spectrum.shape)
        return found

    def gradient(self, forces: Floats, first: int, samples: int) -> Floats:
        """Half the derivative of the energy by the levels of `samples` samples from `first` on: (sample, cell, 32)."""
        coarse = rounded(forces, STATE_BITS, (0, 2))
        return (self._phases[first : first + samples] @ coarse.reshape(len(coarse), -1)).reshape(samples, -1, CHANNELS)

    def energy(self, levels: Floats) -> Floats:
        """Energy of levels above idle, (sample, cell, 32): (cell,)."""
        spectrum = self.spectrum(levels)
        product = rounded(spectrum, 20, (0, 2)) * rounded(self.forces(spectrum), 20, (0, 2))
        found: Floats = product.sum(axis=(0, 2))
        return found

    def _largest(self, samples: int) -> float:
        levels: Floats = np.random.default_rng(1).standard_normal((samples, 1, CHANNELS))
        size = 0.0
        for _ in range(20):
            levels = self.gradient(self.forces(self.spectrum(np.rint(levels * 1024) / 1024)), 0, samples)
            size = float(np.sqrt(np.sum(levels**2)))
            levels *= np.sqrt(levels.size) / size
        return float(f"{size / np.sqrt(levels.size) * 1.02:.2g}") * 1.05
