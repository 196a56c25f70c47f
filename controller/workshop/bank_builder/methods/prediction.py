"""What drive words give at points of the plate: inner products of bits with the whole response, not only its band."""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from controller.arrays import Floats, Reals
from controller.device.board.board import Board
from controller.workshop.physics.responses.impulse_response import ResponseModel
from controller.workshop.physics.responses.modal_response import pulse_response
from controller.workshop.physics.responses.response_source import ResponseSource
from controller.workshop.physics.word_capture import volts_above_idle

NEAR_S = 25e-6  # a null is evaluated this long before and after T


class FocusPrediction:
    """Displacements at T that drive words cause, from rest at the idle word.

    The source is of this board or another, whose plate then is the one that plays.
    """

    def __init__(self, board: Board, source: ResponseSource) -> None:
        self._source, self._board = source, board

    def at_focus(self, words: NDArray[np.uint32], points_m: ArrayLike) -> Reals:
        """Displacement at T of each of `points_m`, (point, 2): (point,) in m."""
        responses = self._source.responses(points_m)[:, ::-1]
        return responses.reshape(len(responses), -1) @ volts_above_idle(self._board, words).ravel()


class Prediction(FocusPrediction):
    """The same, and before and after T, which takes a model: responses that go on after an emission."""

    def __init__(self, board: Board, model: ResponseModel) -> None:
        super().__init__(board, model)
        self._model = model
        self._bit_period_s = board.waveform.bit_period_s
        self._modal: Floats | None = None  # of each mode, longer than an emission
        # samples before T, and as many after it, at which a null is evaluated
        self.near_samples = math.ceil(NEAR_S / self._bit_period_s)

    def near_focus(self, words: NDArray[np.uint32], points_m: ArrayLike) -> Reals:
        """Displacement of each of `points_m`, (point, 2), at every sample within 25 us of T: (point, time) in m.

        The channels return to the idle word at T.
        """
        volts = volts_above_idle(self._board, words)
        places_m = np.asarray(points_m, np.float64).reshape(-1, 2)
        found = np.empty((len(places_m), 2 * self.near_samples + 1))
        for index, place_m in enumerate(places_m):
            found[index] = np.tensordot(self.near_responses(place_m), volts, 2)
        return found

    def near_responses(self, place_m: ArrayLike) -> Reals:
        """Responses of one place in drive order, as they are met at each sample within 25 us of T: (time, sample, 32) in m per V.

        After T what the first words still do is in it; before T the last words have not been played yet.
        """
        samples, near = self._model.samples, self.near_samples
        if self._modal is None:
            self._modal = pulse_response(self._model.step, self._bit_period_s, samples + near).T
        response = (self._modal * self._model.plate_modes.shapes(place_m)) @ self._model.forces
        drive_order = np.zeros((samples + 2 * near, response.shape[1]))
        drive_order[: len(response)] = response[::-1]
        return np.array([drive_order[near - late : near - late + samples] for late in range(-near, near + 1)])
