"""Responses of points under a finger: those of the bare plate times 1 / (1 + A z); A: receptance of the point, z: stiffness.

The sign of a bare plate's response is right for a plate that nobody touches. Under a finger the plate's motion is later and weaker,
by the same factor for all channels: words made for it arrive at T, and put their energy where the finger lets it through. The
factor is causal, so a response up to T is enough to load it up to T, and what is band-limited stays so. One finger is on each
point alone.

Receptances come from modes: of the board's plate model, for measured responses too; `finger.receptance = "plate"` takes the same
for all points, that of an endless plate, which needs no modes. Fingers are point loads here (`finger.py`).
"""

import msgspec
import numpy as np
from numpy.typing import ArrayLike
from scipy import fft

from controller.arrays import Complex, Floats, Reals, blocks
from controller.device.board.board import Board
from controller.device.board.relations.bending_waves import bending_stiffness
from controller.workshop.physics.finger import DYING, Finger, modal_receptance, of_modes_above
from controller.workshop.physics.memory import POINTS_LOADED, loaded_bytes
from controller.workshop.physics.modes.modes import Modes
from controller.workshop.physics.modes.plate_modes import modes_of
from controller.workshop.physics.responses.drifting_responses import DriftingResponses
from controller.workshop.physics.responses.response_source import ResponseSource
from controller.workshop.physics.responses.transformed_responses import TransformedResponses


class LoadedResponses(TransformedResponses):
    """A `ResponseSource` of points of a board's plate under its `[finger]`, from one of the bare plate.

    Receptances are of `modes`, by default of the board's plate model.
    """

    def __init__(self, board: Board, source: ResponseSource, modes: Modes | None = None) -> None:
        assert board.finger is not None
        given = board.finger
        where = " on an endless plate" if given.receptance == "plate" else ""
        super().__init__(source, f"under a finger of {given.mass_mg:g} mg{where}")
        self._board = board
        self._modes = None if given.receptance == "plate" else modes_of(board) if modes is None else modes
        self._given: dict[float, _Receptances] = {}  # by the period of samples
        self._finger = Finger(given.mass_mg * 1e-6, given.damping_n_s_m, given.stiffness_n_m)

    @property
    def working_bytes(self) -> float:
        """As `TransformedResponses.working_bytes`."""
        return 0.0 if self._modes is None else loaded_bytes(self._modes, self.samples, self.bit_clock_hz)

    def _transform(self, free: Reals, points_m: ArrayLike, period_s: float) -> None:
        count = free.shape[1]
        length = fft.next_fast_len(2 * count, real=True)
        sigma = DYING / (length * period_s)
        s = np.asarray(sigma + 2j * np.pi * fft.rfftfreq(length, period_s), np.complex128)
        if period_s not in self._given:
            self._given[period_s] = _Receptances(self._board, self._modes, s)
        points, stiffness = np.asarray(points_m, np.float64).reshape(-1, 2), self._finger.dynamic_stiffness(s)[:, None]
        dying = np.exp(-sigma * period_s * np.arange(count)).astype(free.dtype)[:, None]
        for some in blocks(len(points), POINTS_LOADED):
            spectrum = fft.rfft(free[some] * dying, length, axis=1)
            spectrum *= (1 / (1 + self._given[period_s].of(points[some]) * stiffness)).T[:, :, None].astype(spectrum.dtype)
            free[some] = fft.irfft(spectrum, length, axis=1)[:, :count] / dying


class _Receptances:
    """Receptances of points at complex frequencies `s`; above the highest mode, and without modes, those of an endless plate."""

    def __init__(self, board: Board, modes: Modes | None, s: Complex) -> None:
        plate = board.plate
        self._endless = 1 / (8 * np.sqrt(bending_stiffness(plate) * plate.density_kg_m3 * plate.thickness_m) * s)
        self._modes, self._of_modes = modes, 0
        if modes is None:
            return
        self._of_modes = int(np.searchsorted(s.imag, modes.angular_frequency.max()))
        s = s[: self._of_modes]
        gives = modal_receptance(modes, s)
        self._gives = np.concatenate([gives.real, gives.imag])  # a product of real numbers takes half the time
        self._above = of_modes_above(board, modes, s[:, None])

    def of(self, points_m: Floats) -> Complex:
        """Displacement of each of `points_m` over a force there, (frequency, point) in m/N."""
        found = np.repeat(self._endless[:, None], len(points_m), axis=1)
        if self._modes is not None:
            squares = np.asarray(self._modes.shapes(points_m), np.float64) ** 2
            real, imaginary = np.split(self._gives @ squares.T, 2)
            found[: self._of_modes] = real + 1j * imaginary + self._above
        return found


def words_source(board: Board, source: ResponseSource, modes: Modes | None = None) -> ResponseSource:
    """The responses that drive words of a board are made from: those of `source`, under its `[finger]`, with its drift."""
    source = source if board.finger is None else LoadedResponses(board, source, modes)
    percent = board.waveform.drift_percent
    return DriftingResponses(source, percent) if percent else source


def yielding_alike(board: Board) -> Board:
    """The board, all points of which yield to its `[finger]` as an endless plate does.

    Its responses vary between points as waves do, while the receptance of a point has parts half as long.
    """
    if board.finger is None:
        return board
    return msgspec.structs.replace(board, finger=msgspec.structs.replace(board.finger, receptance="plate"))
