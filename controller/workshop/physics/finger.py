"""Fingers on the plate: point loads, by Sherman and Morrison's formula, several at once by Woodbury's.

A finger pulls a point back with its dynamic stiffness z(s) = M s^2 + c s + k. With the free displacement U0 of the points and the
receptances A between them, displacement over force, both sums over the modes, the loaded plate moves by

    U = U0 - A Z (1 + A Z)^-1 U0    (Z: diagonal, nil where there is no finger)

This is exact for the modes that are there. Those above the cut are too stiff to ring, but a finger of some 10 mg feels that they
give: to the receptance of a point they add arctan(s / wc) / (4 pi sqrt(D m) s), what each of them gives, summed over as many as
there are per frequency above the cut wc. With it, modes to 100 kHz give the same as modes to 400 kHz within 0.001 of the free
amplitude; without it, 0.06 to 0.08 less at 20 mg: near a force the plate yields in waves much shorter than those of the band.

Displacements in time come from frequencies with a real part, s = sigma + 2 pi i k / W: what a window W repeats has died to e^-12,
and spectra end at the bit clock, where the driver lets nothing pass. Free motion found so is that of the twin within 2e-6.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from controller.arrays import Complex, Floats, blocks
from controller.device.bank.packing import channel_bits, framed
from controller.device.board.board import Board
from controller.device.board.relations.bending_waves import bending_stiffness
from controller.workshop.physics.modes.modes import Modes
from controller.workshop.physics.responses.driver import DriverResponse
from controller.workshop.physics.responses.step_response import channel_forces

WINDOW_LENGTHS = 2.0  # of the window, in times from the start to the last that is asked for
DYING = 12.0  # sigma W
MODES_AT_ONCE = 256  # 16 MB of resonances


@dataclass(frozen=True)
class Finger:
    """A finger's load at a point."""

    mass_kg: float  # of the pulp that moves with the plate: up to 1e-4 by the paper, 0.7e-4 to 2.3e-4 in the literature
    damping_n_s_m: float = 0.0  # damping_n_s_m, stiffness_n_m: to the rest of the finger
    stiffness_n_m: float = 0.0

    def dynamic_stiffness(self, s: Complex) -> Complex:
        """Force over displacement in N/m at complex frequencies `s` in 1/s, of any shape."""
        found: Complex = self.mass_kg * s**2 + self.damping_n_s_m * s + self.stiffness_n_m
        return found


@dataclass(frozen=True, eq=False)
class PointMotion:
    """What some points of the free plate do in an emission, and how they yield to forces at each other."""

    s: Complex  # (frequency,): in 1/s
    free: Complex  # (frequency, point): displacement without fingers, m s
    receptance: Complex  # (frequency, point, point): displacement over force, m/N
    window_s: float  # window_s, end_s: window of the transform; T, from the start of the emission
    end_s: float

    def displacement(self, fingers: Mapping[int, Finger], after_s: ArrayLike = 0.0) -> Floats:
        """Displacement of all points with fingers on some.

        Fingers go by the number of the point under each; none: the free plate. `after_s` (time,) is from T. Returns (time, point)
        in m, from the rest position at the idle word. Raises ValueError if a time is after what the motion was computed for.
        """
        time = self.end_s + np.atleast_1d(np.asarray(after_s, np.float64))
        if time.max() > self.window_s / WINDOW_LENGTHS * (1 + 1e-9):
            raise ValueError(f"{time.max() - self.end_s:g} s after T is later than the motion was computed for")
        found: Floats = (np.exp(np.outer(time, self.s)) @ self._spectrum(fingers)).real
        return found

    def history(self, fingers: Mapping[int, Finger]) -> Floats:
        """The same at every bit period from the start of the emission on, as far as it was computed for: (time, point) in m."""
        bits = len(self.s)
        grown = np.exp(self.s[0].real * self.window_s / bits * np.arange(int(bits / WINDOW_LENGTHS) + 1))
        found: Floats = np.fft.ifft(self._spectrum(fingers), axis=0).real[: len(grown)] * (bits * grown[:, None])
        return found

    def _spectrum(self, fingers: Mapping[int, Finger]) -> Complex:
        """Weights of exp(s t) in the displacement, (frequency, point): its real part is the displacement."""
        moved = self.free
        if fingers:
            under = list(fingers)
            stiffness = np.stack([finger.dynamic_stiffness(self.s) for finger in fingers.values()], axis=1)
            yielding = self.receptance[:, :, under]  # to each finger
            loop = np.eye(len(under)) + yielding[:, under] * stiffness[:, None, :]
            held = np.linalg.solve(loop, self.free[:, under, None])[..., 0]
            moved = self.free - np.einsum("fpq,fq->fp", yielding, stiffness * held)
        weighted: Complex = moved * (2 / self.window_s)
        weighted[0] /= 2
        return weighted


def point_motion(
    board: Board,
    modes: Modes,  # of its plate
    words: NDArray[np.uint32],  # (sample,)
    points_m: ArrayLike,  # (point, 2): x and y in m: where fingers are, and where displacements are wanted
    *,
    after_s: float = 20e-6,  # last time after T that will be asked for
    # Whether points under a finger yield by the modes above the highest of `modes` too. A point within half a wavelength of the
    # highest mode to an edge is taken to yield as others do
    modes_above: bool = True,
) -> PointMotion:
    """Motion of points of a board's plate that is at rest at the idle word, plays `words`, and idles again."""
    period_s = board.waveform.bit_period_s
    bits = int(np.ceil(WINDOW_LENGTHS * (len(words) + after_s / period_s)))
    window_s = bits * period_s
    s = np.asarray(DYING / window_s + 2j * np.pi / window_s * np.arange(bits), np.complex128)
    levels = channel_bits(framed(board.idle_word, words, board.idle_word)).astype(np.float64)
    steps = np.diff(levels, axis=0) * board.driver.supply_v
    dying = np.exp(-DYING / bits * np.arange(len(steps)))
    volts = np.fft.fft(steps * dying[:, None], bits, axis=0)
    volts *= (DriverResponse.of(board.driver).transfer(s) / s)[:, None]  # on the piezo
    forces = channel_forces(board, modes)
    shapes = np.asarray(modes.shapes(points_m), np.float64)
    count = len(shapes)
    free: Complex = np.zeros((len(s), count), np.complex128)
    pairs: Complex = np.zeros((len(s), count * count), np.complex128)
    for some in blocks(modes.count, MODES_AT_ONCE):
        gives = modal_receptance(modes, s, some)
        free += (gives * (volts @ forces[some].T)) @ shapes[:, some].T
        pairs += gives @ (shapes[:, None, some] * shapes[None, :, some]).reshape(count * count, -1).T
    receptance = pairs.reshape(len(s), count, count)
    if modes_above:
        receptance[:, range(count), range(count)] += of_modes_above(board, modes, s)[:, None]
    return PointMotion(s=s, free=free, receptance=receptance, window_s=window_s, end_s=len(words) * period_s)


def point_receptance(board: Board, modes: Modes, points_m: ArrayLike, s: Complex) -> Complex:
    """Displacement of each point over a force there, (frequency, point) in m/N, with what the modes above the highest give."""
    squares = np.asarray(modes.shapes(points_m), np.float64) ** 2
    found: Complex = np.repeat(of_modes_above(board, modes, s)[:, None], len(squares), axis=1)
    for some in blocks(modes.count, MODES_AT_ONCE):
        found += modal_receptance(modes, s, some) @ squares[:, some].T
    return found


def modal_receptance(modes: Modes, s: Complex, some: slice = slice(None)) -> Complex:
    """Displacement of some modes over a force on each, (frequency, mode) in m/N, at complex frequencies `s`, (frequency,)."""
    rates, squared = modes.decay_rate[some], modes.angular_frequency[some] ** 2
    return np.asarray(1 / (modes.mass_kg[some] * (s[:, None] * (s[:, None] + 2 * rates) + squared)), np.complex128)


def of_modes_above(board: Board, modes: Modes, s: Complex) -> Complex:
    """What the modes above the highest of `modes` add to the receptance of a point: (frequency,)."""
    plate = board.plate
    wave = 4 * np.pi * np.sqrt(bending_stiffness(plate) * plate.density_kg_m3 * plate.thickness_m)
    found: Complex = np.arctan(s / float(modes.angular_frequency.max())) / (wave * s)
    return found
