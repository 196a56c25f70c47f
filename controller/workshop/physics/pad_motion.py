"""Pads of fingers that rest on a plate: how they move by voltages, and how they yield to the fingers.

As in `finger.py`, of forces that are spread over pads and displacements that are means over them, by the same pressure. The plate
yields to pads in waves no shorter than those of its modes: none is added for the modes above, and frequencies end a little above
the highest (4e-7 of a felt amplitude, at pads of 8 mm). Fingers are part of the linear map from voltages to pads, so
that many emissions at the same places cost a matrix product.
"""

from collections.abc import Sequence

import numpy as np
from numpy import fft
from numpy.typing import ArrayLike

from controller.arrays import Floats, blocks
from controller.device.board.board import Board
from controller.workshop.physics.finger import DYING, MODES_AT_ONCE, WINDOW_LENGTHS, Finger, modal_receptance
from controller.workshop.physics.modes.modes import Modes
from controller.workshop.physics.responses.driver import DriverResponse
from controller.workshop.physics.responses.step_response import channel_forces

RINGS, PER_RING = 3, 12  # points of a pad
HIGHEST = 1.25  # frequency, over that of the highest mode


class PadMotion:
    """Motion of some pads in emissions of some length, with a finger on each, from rest at the idle word."""

    def __init__(
        self,
        board: Board,
        modes: Modes,  # of its plate
        fingers_m: ArrayLike,  # (finger, 2): x and y in m
        finger: Finger | Sequence[Finger],  # the same on all, or one for each
        pad_m: float,  # diameter
        samples: int,  # of an emission
        after_s: float,  # last time after T that is asked for
    ) -> None:
        self._period_s = board.waveform.bit_period_s
        self._bits = int(np.ceil(WINDOW_LENGTHS * (samples + after_s / self._period_s)))
        window_s = self._bits * self._period_s
        count = min(self._bits // 2, int(HIGHEST * modes.angular_frequency.max() / (2 * np.pi) * window_s)) + 1
        s = np.asarray(DYING / window_s + 2j * np.pi / window_s * np.arange(count), np.complex128)
        shapes = pad_shapes(modes, fingers_m, pad_m)
        pads, forces = len(shapes), channel_forces(board, modes)
        both = np.zeros((2 * count, pads * (forces.shape[1] + pads)))  # real above imaginary
        for some in blocks(modes.count, MODES_AT_ONCE):
            gives = modal_receptance(modes, s, some)
            driven = shapes[:, some, None] * np.concatenate([forces[some], shapes[:, some].T], axis=1)
            both += np.concatenate([gives.real, gives.imag]) @ driven.transpose(1, 0, 2).reshape(gives.shape[1], -1)
        to_pads = (both[:count] + 1j * both[count:]).reshape(count, pads, -1)
        of_steps = (DriverResponse.of(board.driver).transfer(s) / s)[:, None, None]
        fingers = [finger] * pads if isinstance(finger, Finger) else finger
        stiffness = np.stack([one.dynamic_stiffness(s) for one in fingers], axis=1)
        loop = np.eye(pads) + to_pads[..., forces.shape[1] :] * stiffness[:, None]
        self._map = np.linalg.solve(loop, to_pads[..., : forces.shape[1]] * of_steps)

    def history(self, volts: Floats) -> Floats:
        """Displacement at every bit period from the start on, (time, finger, emission) in m, by (emission, sample, 32) in V.

        Voltages are those above rest.
        """
        steps = np.diff(volts, axis=1, prepend=0, append=0)
        dying = np.exp(-DYING / self._bits * np.arange(steps.shape[1]))
        spectrum = fft.rfft(steps * dying[:, None], self._bits, axis=1)[:, : len(self._map)]
        moved = fft.irfft(self._map @ spectrum.transpose(1, 2, 0), self._bits, axis=0)
        times = int(self._bits / WINDOW_LENGTHS) + 1
        found: Floats = moved[:times] * (np.exp(DYING / self._bits * np.arange(times)) / self._period_s)[:, None, None]
        return found


def pad_points(diameter_m: float) -> tuple[Floats, Floats]:
    """Points of a pad from its middle, (point, 2) in m, and the share of the pressure that each stands for, (point,).

    The pressure is an inverted paraboloid (Pawluk and Howe, J. Biomech. Eng. 121, 1999).
    """
    squares, of_ring = np.polynomial.legendre.leggauss(RINGS)
    squares = (squares + 1) / 2  # of the radius over the pad's
    of_ring = of_ring * (1 - squares)
    turns = 2 * np.pi * (np.arange(PER_RING) + np.arange(RINGS)[:, None] / RINGS) / PER_RING
    radii = diameter_m / 2 * np.sqrt(squares)[:, None]
    offsets: Floats = np.stack([radii * np.cos(turns), radii * np.sin(turns)], axis=-1).reshape(-1, 2)
    shares: Floats = np.repeat(of_ring / of_ring.sum() / PER_RING, PER_RING)
    return offsets, shares


def pad_shapes(modes: Modes, points_m: ArrayLike, pad_m: float) -> Floats:
    """Means of mode shapes over pads around points, (point, mode); what of a pad is off the plate rests on nothing."""
    offsets, shares = pad_points(pad_m)
    places = np.asarray(points_m, np.float64).reshape(-1, 1, 2) + offsets
    there = np.all((places >= 0) & (places <= (modes.length_m, modes.width_m)), axis=2)
    shapes = np.asarray(modes.shapes(places.reshape(-1, 2)), np.float64).reshape(*there.shape, -1)
    found: Floats = np.einsum("pom,po->pm", shapes, there * shares)
    return found
