"""One emission at its focus over frequency: what the free plate does there, and how far it gives way to a force."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from controller.benchmark.paper_panel import PaperPanel
from controller.physics.driver import DriverResponse

Floats = NDArray[np.float64]
Complex = NDArray[np.complex128]

AFTER_S = 10e-3  # of T: displacement has decayed to 5e-5 before the series of times begins again
HIGHEST = 1.2  # of the highest mode: above, nothing is left
AT_ONCE = 256


@dataclass(frozen=True, eq=False)
class FocusSpectrum:
    """Spectrum of a series of `bits` bit periods.

    Attributes
    ----------
    omega : (frequency,) array
        In rad/s, evenly from 0.
    displacement : (frequency,) complex array
        Fourier transform of the free plate's displacement from rest at the idle word, in m s.
    receptance : (frequency,) complex array
        Displacement over force, in m/N.
    bits : int
    bit_period_s : float
    """

    omega: Floats
    displacement: Complex
    receptance: Complex
    bits: int
    bit_period_s: float

    def over_time(self, of: Complex, parts: int) -> Floats:
        """A spectrum, (frequency,), as a function of time from the emission's start on, `parts` times in a bit: (time,)."""
        count = self.bits * parts
        spread = np.zeros(count // 2 + 1, np.complex128)
        spread[: len(of)] = of
        return np.asarray(np.fft.irfft(spread, count) * (parts / self.bit_period_s), np.float64)


def focus_spectrum(panel: PaperPanel, index: int) -> FocusSpectrum:
    """Spectrum of the emission of one of a panel's foci, there."""
    modes, period_s = panel.modes, panel.board.waveform.bit_period_s
    shape = np.asarray(modes.shapes(panel.points_m[index : index + 1]), np.float64)[0]
    volts = panel.volts(panel.words[index])
    steps = np.diff(volts, axis=0, prepend=0.0, append=0.0)
    bits = len(volts) + round(AFTER_S / period_s)
    omega = 2 * np.pi * np.fft.rfftfreq(bits, period_s)
    omega = omega[omega <= HIGHEST * modes.angular_frequency.max()]
    slope = np.fft.rfft(steps, bits, axis=0)[: len(omega)]
    slope[1:] /= 1j * omega[1:, None]
    slope[0] = volts.sum(axis=0) * period_s
    slope *= DriverResponse.of(panel.board.driver).transfer(1j * omega)[:, None]
    displacement, receptance = np.empty(len(omega), np.complex128), np.empty(len(omega), np.complex128)
    for first in range(0, len(omega), AT_ONCE):
        some = slice(first, first + AT_ONCE)
        w = omega[some, None]
        gives = shape / (modes.mass_kg * (modes.angular_frequency**2 - w**2 + 2j * w * modes.decay_rate))
        displacement[some] = np.einsum("fn,fn->f", gives, slope[some] @ panel.twin.forces.T)
        receptance[some] = gives @ shape
    return FocusSpectrum(omega, displacement, receptance, bits, period_s)
