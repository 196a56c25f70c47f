"""Sound of a plate: pressure at microphones above it from the motion of its modes, by Rayleigh's integral, and A-weighted levels.

The plate is taken to lie in a rigid wall of its own height (a baffle), and the air not to hold it back: p = j w rho / (2 pi) times
the integral of velocity exp(-j k R) / R over the plate. Without a wall less is heard of what is long beside the plate.

Modes move as in `audible`; every mode of the board is counted. All is taken at lines of frequency one over a period apart: of an
endless train these are all that there is, and what has died away within a period is known from them (sampling theorem).
"""

import numpy as np
from numpy.polynomial.chebyshev import chebpts1, chebvander
from numpy.polynomial.legendre import leggauss

from controller.arrays import Complex, Floats, Words, blocks
from controller.device.bank.packing import channel_bits, framed
from controller.device.board.board import Board
from controller.workshop.physics.audible import REST_TAUS
from controller.workshop.physics.modes.modes import Modes
from controller.workshop.physics.modes.plate_modes import modes_of
from controller.workshop.physics.responses.driver import DriverResponse
from controller.workshop.physics.responses.step_response import channel_forces

AIR_KG_M3, SOUND_M_S = 1.204, 343.2  # at 20 degrees Celsius
THRESHOLD_PA = 20e-6
HEARD_HZ = 20e3  # as far as A is defined
DISTANCE_M = 0.3  # of the microphones from the plate's middle
LONGEST_S = 0.1  # of ringing: a plate that rings for longer is heard as if it were played so often
SPARE_NODES = 14  # of quadrature and interpolation, beyond the phase between their ends
PLACES = 10
KEPT = 4  # periods
AT_ONCE = 500_000  # complex numbers in use together: 8 MB


class PlateSound:
    """What microphones hear of the emissions of a board's plate: ten, spread evenly over a half sphere about its middle."""

    def __init__(self, board: Board, modes: Modes | None = None, places_m: Floats | None = None) -> None:
        """`places_m`, (place, 3), are others, above the plate's plane; `modes` those of the board's plate by default."""
        self._board, self._modes = board, modes_of(board) if modes is None else modes
        middle = self._modes.length_m / 2, self._modes.width_m / 2
        self._radiation = Radiation(self._modes, around(*middle) if places_m is None else places_m)
        self._forces, self._driver = channel_forces(board, self._modes), DriverResponse.of(board.driver)
        self._per_slope: dict[tuple[float, int], Complex] = {}

    def exposure_pa2_s(self, words: Words, idle_word: int, before_word: int | None = None) -> float:
        """A-weighted sound exposure of words (sample,), played once, mean over the microphones, in Pa^2 s.

        `before_word` is played before, by default the `idle_word`, which is played afterwards.
        """
        rings_s = REST_TAUS / float(self._modes.decay_rate.min())
        period_s = min(len(words) * self._board.waveform.bit_period_s + rings_s, LONGEST_S)
        frequency, pressure2 = self.lines(words, idle_word, period_s, before_word)
        return float(2 * pressure2 @ a_weighting(frequency) ** 2) / period_s

    def repeated_db(self, words: Words, idle_word: int, rate_hz: float) -> float:
        """A-weighted level (LAeq) of words played again and again, `rate_hz` times a second, the idle word between."""
        frequency, pressure2 = self.lines(words, idle_word, 1 / rate_hz)
        return decibels(2 * float(pressure2 @ a_weighting(frequency) ** 2) * rate_hz**2)

    def lines(self, words: Words, idle_word: int, period_s: float, before_word: int | None = None) -> tuple[Floats, Floats]:
        """Spectrum of the pressure up to `HEARD_HZ`: frequencies (n,) one over `period_s` apart, squares (n,) in (Pa s)^2."""
        from scipy.signal import zoom_fft  # noqa: PLC0415 - a second of imports, which a build of a bank does without

        count = int(HEARD_HZ * period_s)
        frequency: Floats = np.arange(1, count + 1) / period_s
        first = idle_word if before_word is None else before_word
        levels = channel_bits(framed(first, words, idle_word)).astype(np.float64)
        steps = np.diff(levels, axis=0) * self._board.driver.supply_v
        ends_hz = [1 / period_s, (count + 1) / period_s]
        slopes = zoom_fft(steps, ends_hz, count, fs=self._board.waveform.bit_clock_hz, axis=0)
        pressure = np.einsum("pfq,fq->pf", self._pressure_per_slope(frequency), slopes)
        return frequency, (np.abs(pressure) ** 2).mean(axis=0)

    def _pressure_per_slope(self, frequency: Floats) -> Complex:
        """Spectrum of the pressure over that of a channel's slope of voltage, in Pa s / V: (place, frequency, 32); kept."""
        key = (float(frequency[0]), len(frequency))
        if key not in self._per_slope:
            modes, found = self._modes, np.empty((self._radiation.places, len(frequency), self._forces.shape[1]), np.complex128)
            step = max(AT_ONCE // (self._radiation.places * modes.count), 1)
            for some in blocks(len(frequency), step):
                s = 2j * np.pi * frequency[some, None]
                moved = self._driver.transfer(s) / (modes.mass_kg * (modes.angular_frequency**2 + 2 * modes.decay_rate * s + s**2))
                found[:, some] = (self._radiation.pressure(frequency[some]) * moved) @ self._forces
            if len(self._per_slope) >= KEPT:
                self._per_slope.clear()
            self._per_slope[key] = found
        return self._per_slope[key]


class Radiation:
    """Pressure at places (place, 3), above the plane of a plate with a corner at the origin, by the velocity of its modes.

    The integral of a mode with exp(-j k (R - d)) / R, d in the middle of all R, is a smooth function of frequency: it is computed
    at Chebyshev's nodes.
    """

    def __init__(self, modes: Modes, places_m: Floats, highest_hz: float = HEARD_HZ) -> None:
        self.places, self._highest_hz = len(places_m), highest_hz
        sides = np.array([modes.length_m, modes.width_m])
        highest_k = 2 * np.pi * highest_hz / SOUND_M_S
        beside = np.maximum(np.abs(places_m[:, :2] - sides / 2) - sides / 2, 0)
        nearest = np.hypot(np.hypot(*beside.T), places_m[:, 2])
        farthest = np.linalg.norm(np.column_stack([np.abs(places_m[:, :2] - sides / 2) + sides / 2, places_m[:, 2]]), axis=1)
        self._middle_m = (nearest + farthest) / 2
        self._nodes = int(np.ceil(highest_k * float(np.ptp([nearest, farthest], axis=0).max()) / 4)) + SPARE_NODES
        k = highest_k * (chebpts1(self._nodes) + 1) / 2
        (x_m, x_weights), (y_m, y_weights) = (
            _gauss(side, (_shortest_k(modes) + highest_k) * side / 4 + 3 * side / float(nearest.min())) for side in sides
        )
        of_nodes = np.zeros((modes.count, self.places * self._nodes, 2))
        rows = max(AT_ONCE // (len(x_m) * max(modes.count, 2 * self._nodes * self.places)), 1)
        for some in blocks(len(y_m), rows):
            points = np.stack(np.meshgrid(x_m, y_m[some]), axis=-1).reshape(-1, 2)
            weights = np.outer(y_weights[some], x_weights).ravel()
            apart = np.hypot(np.linalg.norm(points[:, None] - places_m[:, :2], axis=2), places_m[:, 2])  # (point, place)
            waves = (weights[:, None] / apart)[..., None] * np.exp(-1j * (apart - self._middle_m)[..., None] * k)
            flat = waves.reshape(len(points), -1).view(np.float64)
            of_nodes += (modes.shapes(points).T @ flat).reshape(of_nodes.shape)
        integrals = of_nodes.view(np.complex128).reshape(modes.count, self.places, self._nodes)
        vander = chebvander(chebpts1(self._nodes), self._nodes - 1)
        self._coefficients = np.empty((self.places, self._nodes, 2 * modes.count))  # real and imaginary part of each mode
        for place, found in enumerate(self._coefficients):
            found[:] = np.linalg.solve(vander, np.ascontiguousarray(integrals[:, place].T).view(np.float64))

    def pressure(self, frequency: Floats) -> Complex:
        """Pressure at `frequency`, (n,), up to the highest, in Pa for a mode that moves with 1 m/s: (place, n, mode)."""
        k = 2 * np.pi * frequency / SOUND_M_S
        turned = np.exp(-1j * np.outer(self._middle_m, k)) * (1j * frequency * AIR_KG_M3)
        nodes = chebvander(2 * frequency / self._highest_hz - 1, self._nodes - 1)
        smooth: Complex = (nodes @ self._coefficients).view(np.complex128)
        smooth *= turned[..., None]
        return smooth


def radiation_bytes(modes: Modes, places: int = PLACES) -> float:
    """Bytes that `Radiation` takes at most."""
    nodes = 2 * np.pi * HEARD_HZ / SOUND_M_S * float(np.hypot(modes.length_m, modes.width_m)) / 4 + SPARE_NODES
    return 3 * 16.0 * places * nodes * modes.count + 6 * 16.0 * AT_ONCE


def around(x_m: float, y_m: float, distance_m: float = DISTANCE_M, count: int = PLACES) -> Floats:
    """Places at a distance from a point of the plate, (count, 3), each with the same share of the half sphere above it (a spiral).

    Ten tell the mean over the half sphere within 0.3 dB on the paper's plate, within 2 dB on a third of it.
    """
    height = (np.arange(count) + 0.5) / count
    turned = np.arange(count) * np.pi * (3 - 5**0.5)
    aside = np.sqrt(1 - height**2)
    return np.array([x_m, y_m, 0.0]) + distance_m * np.column_stack([aside * np.cos(turned), aside * np.sin(turned), height])


def a_weighting(frequency_hz: Floats) -> Floats:
    """Gain of weighting A at `frequency_hz`, (n,): IEC 61672-1:2013, equation (E.6), one at 1 kHz."""
    low, one, two, high = 20.598997, 107.65265, 737.86223, 12194.217  # Hz
    square = frequency_hz**2
    gain: Floats = high**2 * square**2 / ((square + low**2) * np.sqrt((square + one**2) * (square + two**2)) * (square + high**2))
    return gain * 10 ** (2.000 / 20)


def decibels(pressure2: float) -> float:
    """Level of a mean square pressure in Pa^2, or of an exposure in Pa^2 s, in dB re 20 uPa (and 1 s)."""
    return 10 * float(np.log10(max(pressure2, 1e-30) / THRESHOLD_PA**2))


def _shortest_k(modes: Modes) -> float:
    """About the largest wavenumber of the modes, by their number (Weyl's law)."""
    return float(np.sqrt(4 * np.pi * modes.count / (modes.length_m * modes.width_m))) + 2 * np.pi / min(
        modes.length_m, modes.width_m
    )


def _gauss(side_m: float, half_phase: float) -> tuple[Floats, Floats]:
    """Nodes and weights on a side, for a phase of twice `half_phase`, twice, between its middle and an end."""
    nodes, weights = leggauss(int(np.ceil(half_phase)) + SPARE_NODES)
    return (nodes + 1) * side_m / 2, weights * side_m / 2
