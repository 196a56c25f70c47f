"""Equations (1) to (7) of the paper, each as a function of its numbers, and what is exact where one of them simplifies.

Numbers of equations are those of Hudin, Lozada, Hayward, IEEE Trans. Haptics 8(2), 2015. All lengths in m, times in s.
"""

import math

from controller.device.board.plate.plate import Plate
from controller.device.board.relations.bending_waves import bending_stiffness


def characteristic_time_s(plate: Plate) -> float:
    """Eq. (2): Tc, which is also the number of modes per hertz (asymptotically, at any edges)."""
    area_m2 = plate.length_m * plate.width_m
    slowness = math.sqrt(plate.density_kg_m3 * (1 - plate.poisson_ratio**2) / plate.young_modulus_pa)
    return math.sqrt(3) * area_m2 / plate.thickness_m * slowness


def contrast_bound(bandwidth_hz: float, tc_s: float) -> float:
    """Largest contrast that eq. (1) allows: the square root of the number of modes in the band."""
    return math.sqrt(bandwidth_hz * tc_s)


def contrast(bandwidth_hz: float, tc_s: float, channels: int, duration_s: float, decay_s: float) -> float:
    """Eq. (1), as facts and the paper's own numbers fix it (the text's print is garbled): amplitude over rms of all points."""
    gained_s = channels * decay_s * linear_share(duration_s, decay_s)
    return contrast_bound(bandwidth_hz, tc_s) * math.sqrt(gained_s / (gained_s + gained_s / channels + tc_s))


def linear_share(duration_s: float, decay_s: float) -> float:
    """Section III-B: what T gives of the amplitude of an endless emission in linear time reversal, 1 - exp(-2 T / tau)."""
    return -math.expm1(-2 * duration_s / decay_s)


def one_bit_share(duration_s: float, decay_s: float) -> float:
    """The same for 1-bit drive, which plays the late part of a response as loud as the early part: 1 - exp(-T / tau)."""
    return -math.expm1(-duration_s / decay_s)


def half_wave_m(wavelength_m: float) -> float:
    """Eq. (3): resolution, and the pitch of points to learn (section II-B)."""
    return wavelength_m / 2


def gate_duration_s(highest_hz: float) -> float:
    """Eq. (4): Rt, half a period of the highest frequency."""
    return 1 / (2 * highest_hz)


def repetition_factor(period_s: float, decay_s: float) -> float:
    """Section III-D and appendix A: what repeating every Tr leaves of the contrast, sqrt(1 - exp(-2 Tr / tau))."""
    return math.sqrt(-math.expm1(-2 * period_s / decay_s))


def energy_j(plate: Plate, amplitude_m: float, resolution_m: float) -> float:
    """Eq. (6): mechanical energy at T of modes from 0 Hz on, all alike, if the resolution is that of eq. (3)."""
    modulus = plate.young_modulus_pa / (1 - plate.poisson_ratio**2)
    return math.pi**3 / 18 * modulus * plate.thickness_m**3 * (amplitude_m / resolution_m) ** 2


def point_impedance_kg_s(plate: Plate) -> float:
    """Appendix C: 8 sqrt(D rho h), force over velocity at a point of an infinite plate; real, the same at all frequencies."""
    return 8 * math.sqrt(bending_stiffness(plate) * plate.density_kg_m3 * plate.thickness_m)


def gate_attenuation(plate: Plate, finger_kg: float, resolution_m: float) -> float:
    """Eq. (7): share of the amplitude that a lumped mass leaves of a gate as long as eq. (4), which has a part at 0 Hz."""
    if finger_kg == 0:
        return 1.0
    return -math.expm1(-8 * resolution_m**2 * plate.density_kg_m3 * plate.thickness_m / (math.pi * finger_kg))


def gate_mass_kg(plate: Plate, left: float, resolution_m: float) -> float:
    """Section V: the mass that eq. (7) reads from the share of the amplitude that a finger left."""
    return -8 * resolution_m**2 * plate.density_kg_m3 * plate.thickness_m / (math.pi * math.log1p(-left))


def learning_points(plate: Plate, wavelength_m: float) -> int:
    """Section II-B: 4 S / lambda^2."""
    return math.ceil(4 * plate.length_m * plate.width_m / wavelength_m**2)


def learning_grid(plate: Plate, wavelength_m: float) -> tuple[int, int]:
    """Cells along x and y of the coarsest grid whose pitch is nowhere above half a wavelength."""
    pitch_m = half_wave_m(wavelength_m)
    return math.ceil(plate.length_m / pitch_m - 1e-9), math.ceil(plate.width_m / pitch_m - 1e-9)
