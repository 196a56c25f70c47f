"""How loud an emission of a design is: statistics of its bits and modes, and the efficiency with which bent plates radiate.

Bits are the sign of a random signal of the band: what of them can be heard is the noise of that sign. Modes answer it as they do in
the band (`focal_spectrum`). What they radiate is Leppington, Broadbent and Heron's mean over modes (Proc. R. Soc. A 382 (1982) 245)
for a plate in a baffle, at most that of the critical frequency.
"""

import numpy as np
from scipy.integrate import trapezoid

from controller.arrays import Floats
from controller.device.board.panel import Driver
from controller.device.board.plate.plate import Plate
from controller.device.board.relations.bending_waves import kirchhoff_wavelength_m
from controller.workshop.physics.design.design_inputs import DesignInputs
from controller.workshop.physics.focal_spectrum import FocalSpectrum
from controller.workshop.physics.sound import AIR_KG_M3, DISTANCE_M, HEARD_HZ, SOUND_M_S, a_weighting

LOWEST_HZ = 50.0  # below, weighting A leaves nothing


def surface_density(spectrum: FocalSpectrum, driver: Driver, given: DesignInputs) -> tuple[Floats, Floats]:
    """Squared velocity of an emission, mean over the plate, over all time: frequencies (n,), density (n,) in (m/s)^2 s / Hz."""
    patch_m, duration_s, decay_s = given.size_mm * 1e-3, given.duration_ms * 1e-3, given.decay_time_ms * 1e-3
    heard = FocalSpectrum.of(spectrum.plate, driver, patch_m, (LOWEST_HZ, HEARD_HZ), given.bit_clock_hz)
    frequency = heard.frequency_hz
    per_channel = duration_s * driver.supply_v**2 / 4 * np.maximum(spectrum.bit_density_s(frequency, given.bit_clock_hz), 0)
    answer = (2 * np.pi * frequency * heard.response_m_per_vs) ** 2 * heard.weight_s * decay_s / 2
    return frequency, given.channels * per_channel * answer


def exposure_pa2_s(plate: Plate, frequency: Floats, density: Floats) -> float:
    """A-weighted exposure at 0.3 m, mean over a half sphere, of a plate with this `surface_density`."""
    area_m2 = plate.length_m * plate.width_m
    heard = radiation_efficiency(plate, frequency) * density * a_weighting(frequency) ** 2
    return float(trapezoid(heard, frequency)) * (AIR_KG_M3 * SOUND_M_S) ** 2 * area_m2 / (2 * np.pi * DISTANCE_M**2)


def radiation_efficiency(plate: Plate, frequency: Floats) -> Floats:
    """Power that modes near a frequency radiate, over rho c times area and mean square velocity."""
    long_m, short_m = max(plate.length_m, plate.width_m), min(plate.length_m, plate.width_m)
    k = 2 * np.pi * frequency / SOUND_M_S
    slower = SOUND_M_S / (kirchhoff_wavelength_m(plate, 1.0) * np.sqrt(frequency))  # squared: the critical frequency over this one
    most = np.sqrt(k * short_m) * (0.5 - 0.15 * short_m / long_m)
    with np.errstate(divide="ignore", invalid="ignore"):
        below = (np.log((slower + 1) / (slower - 1)) + 2 * slower / (slower**2 - 1)) * (long_m + short_m)
        below /= np.pi * slower * k * long_m * short_m * np.sqrt(slower**2 - 1)
        above = 1 / np.sqrt(1 - slower**2)
    return np.where(slower > 1, np.minimum(below, most), np.minimum(above, most))
