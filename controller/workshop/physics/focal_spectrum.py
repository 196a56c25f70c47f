"""What a focus looks like that is made of the frequencies that patches and drivers really give, by statistics of the modes alone.

The paper takes the band's spectrum as flat. Patches and drivers weight it: of the amplitude at the focus the share w(f) df
comes from f, w as the power of the responses there. Then spot and pulse at T are the sums of w(f) J0(k r) and of
w(f) cos(2 pi f t), a plate has 1 / (integral of w^2) hertz of bandwidth, and mass at the focus acts on each frequency alone.
"""

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Self

import numpy as np
from scipy.integrate import trapezoid
from scipy.signal import czt
from scipy.special import j0, k0, y0

from controller.arrays import Floats
from controller.device.board.panel import Driver
from controller.device.board.plate.plate import Plate
from controller.device.board.relations.bending_waves import bending_stiffness
from controller.workshop.physics.design.design import characteristic_time_s, one_bit_share, point_impedance_kg_s
from controller.workshop.physics.felt import AROUND_S, SKIN_S, FeltLoad, felt_history
from controller.workshop.physics.pad_motion import pad_points
from controller.workshop.physics.responses.driver import DriverResponse

FREQUENCIES = 401
DIRECTIONS = 91
SAMPLED = 401  # radii of a spot, and times of a pulse
POINT_M = 1e-7  # apart: as one
SPARSE = 5  # of frequencies, those of which the mobility of a pad is computed
MEMORY = 12.0  # of a signal's bits, over one over its bandwidth
REMEMBERED = 5.0  # of the skin's filter, in its time
PER_PERIOD = 8  # times of a felt focus, in a period of the upper edge
REPEATED = 0.4  # of the time after which a sum over these frequencies repeats itself
HEARD_CLOCKS, HEARD_FREQUENCIES = 4.0, 4001  # frequencies of bits that heat, up to that many bit clocks


@dataclass(frozen=True, eq=False)
class FocalSpectrum:
    """Frequencies of a focus."""

    plate: Plate
    frequency_hz: Floats  # (n,): evenly from the lower to the upper edge of the band
    weight_s: Floats  # (n,): w: share of the amplitude per hertz, of integral 1
    # Root mean square over all points, times from 0 and channels of the response to 1 V s, at time 0 (it falls as exp(-t /
    # tau))
    response_m_per_vs: float

    @classmethod
    def of(cls, plate: Plate, driver: Driver, patch_m: float, band_hz: tuple[float, float], bit_clock_hz: float) -> Self:
        """Spectrum by a square patch with edges of `patch_m` and its driver; waves come to it from all directions alike.

        The length of the words is a filter too.
        """
        frequency_hz: Floats = np.linspace(*band_hz, FREQUENCIES)
        omega = 2 * np.pi * frequency_hz
        wavenumber = _wavenumber(plate, frequency_hz)
        turned = np.linspace(0, np.pi / 2, DIRECTIONS)
        phase = np.multiply.outer(wavenumber, patch_m / (2 * np.pi) * np.array([np.cos(turned), np.sin(turned)]))
        over_patch = np.mean(np.prod(np.sinc(phase), axis=1) ** 2, axis=1)
        force = (driver.moment_n_per_v * wavenumber**2 * patch_m**2) ** 2 * over_patch
        stage = np.abs(DriverResponse.of(driver).transfer(1j * omega)) ** 2 * np.sinc(frequency_hz / bit_clock_hz) ** 2
        mass_kg = plate.density_kg_m3 * plate.thickness_m * plate.length_m * plate.width_m
        power = force * stage * characteristic_time_s(plate) / (2 * (mass_kg * omega) ** 2)
        whole = float(trapezoid(power, frequency_hz))
        return cls(plate, frequency_hz, power / whole, whole**0.5)

    @cached_property
    def bandwidth_hz(self) -> float:
        """Width of a flat band with as many modes in the focus."""
        return 1 / float(trapezoid(self.weight_s**2, self.frequency_hz))

    @cached_property
    def crossings_hz(self) -> float:
        """Edges a second of the sign of a random signal with this spectrum (Rice)."""
        return 2 * math.sqrt(trapezoid(self.weight_s * self.frequency_hz**2, self.frequency_hz))

    def bit_density_s(self, at_hz: Floats, bit_clock_hz: float) -> Floats:
        """Power per hertz, at `at_hz` (n,) of either sign, of the sign, -1 or 1, of a random signal with this spectrum.

        Its autocorrelation is that of the signal by the arcsine law (Van Vleck and Middleton, Proc. IEEE 54 (1966) 2). That each
        bit is held for its period is not in it.
        """
        lags = np.arange(1, math.ceil(MEMORY / (self.frequency_hz[-1] - self.frequency_hz[0]) * bit_clock_hz) + 1)
        signal = self._sum(np.cos(2 * np.pi * np.multiply.outer(lags / bit_clock_hz, self.frequency_hz)))
        likeness = 2 / np.pi * np.arcsin(np.clip(signal, -1, 1))
        return (1 + 2 * np.cos(np.multiply.outer(2 * np.pi * at_hz / bit_clock_hz, lags)) @ likeness) / bit_clock_hz

    def resistor_w(self, driver: Driver, bit_clock_hz: float) -> float:
        """Heat in the series resistor of one stage that plays without end the sign of a random signal with this spectrum.

        At most V^2 / 4 R, whatever the capacitance.
        """
        at_hz: Floats = np.linspace(0, HEARD_CLOCKS * bit_clock_hz, HEARD_FREQUENCIES)
        angular = 2 * np.pi * at_hz
        of_bits = self.bit_density_s(at_hz, bit_clock_hz) * np.sinc(at_hz / bit_clock_hz) ** 2
        resistance, of_f = driver.resistance_ohm, driver.capacitance_f
        conductance = (
            resistance
            * (angular * of_f) ** 2
            / ((1 - angular**2 * driver.inductance_h * of_f) ** 2 + (angular * resistance * of_f) ** 2)
        )
        return driver.supply_v**2 / 4 * 2 * float(trapezoid(of_bits * conductance, at_hz))

    def amplitude_m(self, volts: float, channels: int, duration_s: float, decay_s: float) -> float:
        """Amplitude of a focus by 1-bit drive of `volts` from its middle: the sum of |h|, normally distributed."""
        gained_s = channels * decay_s * one_bit_share(duration_s, decay_s)
        return float(volts * np.sqrt(2 / np.pi) * self.response_m_per_vs * gained_s)

    def energy_j(self, amplitude_m: float) -> float:
        """Energy of the modes that make up the focus at T, as eq. (6) means it, with this spectrum instead of its flat one."""
        mass_kg = self.plate.density_kg_m3 * self.plate.thickness_m * self.plate.length_m * self.plate.width_m
        squared = float(trapezoid((2 * np.pi * self.frequency_hz * self.weight_s) ** 2, self.frequency_hz))
        return float(mass_kg / 2 * amplitude_m**2 * squared / characteristic_time_s(self.plate))

    def width_m(self, height: float = 0.5) -> float:
        """Full width of the spot at T where it is `height` of its crest; the -3 dB width at sqrt(1/2)."""
        radius_m = np.linspace(0, 0.6 * 2 * np.pi / _wavenumber(self.plate, self.frequency_hz)[0], SAMPLED)
        return 2 * _falls_to(height, radius_m, self._spot(radius_m))

    def pulse_s(self) -> float:
        """Time for which the focus is above half its height around T."""
        time_s: Floats = np.linspace(0, 0.5 / self.frequency_hz[0], SAMPLED)
        return 2 * _falls_to(0.5, time_s, self._sum(np.cos(np.multiply.outer(time_s, 2 * np.pi * self.frequency_hz))))

    @cached_property
    def curvature_per_m2(self) -> float:
        """Curvature of the spot at its crest along any direction, over its amplitude."""
        return float(self._sum(_wavenumber(self.plate, self.frequency_hz) ** 2)) / 2

    def share_within(self, radius_m: float) -> float:
        """Share of the spot's mean square, over the infinite plate, that lies within `radius_m` of it."""
        radii: Floats = np.linspace(0, radius_m, SAMPLED)
        inside = 2 * np.pi * float(trapezoid(self._spot(radii) ** 2 * radii, radii))
        area_m2 = self.plate.length_m * self.plate.width_m
        return inside * self.bandwidth_hz * characteristic_time_s(self.plate) / area_m2

    def mass_attenuation(self, finger_kg: float) -> float:
        """Share of the peak that a point mass at the focus leaves, on an infinite plate: eq. (7) without its gate."""
        impedance = point_impedance_kg_s(self.plate)
        left = impedance / (impedance + 2j * np.pi * self.frequency_hz * finger_kg)
        time_s = np.linspace(-0.5, 0.5, SAMPLED) / self.frequency_hz[0]  # the mass makes the peak late
        turning = np.exp(np.multiply.outer(time_s, 2j * np.pi * self.frequency_hz))
        return float(self._sum((left * turning).real).max())

    def felt_amplitude_m(self, amplitude_m: float, load: FeltLoad) -> float:
        """What a finger feels (`felt.py`) of a focus that has `amplitude_m` on the bare plate, by its pulse on an endless plate."""
        band_hz, omega = float(self.frequency_hz[-1] - self.frequency_hz[0]), 2 * np.pi * self.frequency_hz
        wavenumber = _wavenumber(self.plate, self.frequency_hz)[:, None]
        offsets, shares = pad_points(load.pad_mm * 1e-3)
        apart, which = np.unique(np.linalg.norm(offsets[:, None] - offsets, axis=2).round(7), return_inverse=True)
        pairs = np.bincount(which.ravel(), np.outer(shares, shares).ravel())
        phase = wavenumber[::SPARSE] * np.maximum(apart, POINT_M)
        waves = (j0(phase) - 1j * (y0(phase) + 2 / np.pi * k0(phase))) @ pairs  # from each point of the pad to each
        yields = np.interp(omega, omega[::SPARSE], waves) / (1j * omega * point_impedance_kg_s(self.plate))
        over_pad = j0(wavenumber * np.linalg.norm(offsets, axis=1)) @ shares
        moved = self.weight_s * over_pad / (1 + yields * load.dynamic_stiffness(np.asarray(1j * omega, np.complex128)))
        moved[[0, -1]] /= 2
        step_hz, step_s = band_hz / (FREQUENCIES - 1), 1 / (PER_PERIOD * self.frequency_hz[-1])
        first_s, last_s = (min(time_s, REPEATED / step_hz) for time_s in (AROUND_S + REMEMBERED * SKIN_S, AROUND_S))
        time_s = np.arange(-first_s, last_s, step_s)
        summed = czt(moved * step_hz, len(time_s), np.exp(2j * np.pi * step_hz * step_s), np.exp(2j * np.pi * step_hz * first_s))
        motion = (summed * np.exp(2j * np.pi * self.frequency_hz[0] * time_s)).real
        return amplitude_m * float(felt_history(motion, step_s)[time_s >= -AROUND_S].max())

    def _spot(self, radius_m: Floats) -> Floats:
        return self._sum(j0(np.multiply.outer(radius_m, _wavenumber(self.plate, self.frequency_hz))))

    def _sum(self, of_frequencies: Floats) -> Floats:
        """Sum with the weights over frequency, the last axis."""
        summed: Floats = trapezoid(of_frequencies * self.weight_s, self.frequency_hz, axis=-1)
        return summed


def _wavenumber(plate: Plate, frequency_hz: Floats) -> Floats:
    per_area = plate.density_kg_m3 * plate.thickness_m
    wavenumber: Floats = np.sqrt(2 * np.pi * frequency_hz) * (per_area / bending_stiffness(plate)) ** 0.25
    return wavenumber


def _falls_to(height: float, at: Floats, values: Floats) -> float:
    """Where `values`, from 1 on, first fall to `height`."""
    after = int(np.argmax(values <= height))
    return float(np.interp(-height, [-values[after - 1], -values[after]], [at[after - 1], at[after]]))
