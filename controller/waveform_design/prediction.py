"""What drive words give at points of the plate: inner products of bits with the whole response, not only its band."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from controller.bank.packing import channel_bits
from controller.board.board import Board
from controller.physics.impulse_response import ResponseModel

NEAR_S = 25e-6  # a quiet place is judged this long before and after T


class Prediction:
    """Displacements that drive words cause, from rest at the idle word.

    Parameters
    ----------
    board : Board
    model : ResponseModel
        Of this board or another, whose plate then is the one that plays.
    """

    def __init__(self, board: Board, model: ResponseModel) -> None:
        self._model = model
        self._supply_v = board.driver.supply_v
        self._idle_bits = channel_bits(np.array([board.idle_word], np.uint32))[0].astype(np.float64)
        self._near_samples = round(NEAR_S / board.waveform.bit_period_s)

    def at_focus(self, words: NDArray[np.uint32], points_m: ArrayLike) -> NDArray[np.floating[Any]]:
        """Displacement at T of each of `points_m`, (point, 2): (point,) in m."""
        reached: NDArray[np.floating[Any]] = self._whole(points_m) @ self._volts(words).ravel()
        return reached

    def near_focus(self, words: NDArray[np.uint32], points_m: ArrayLike) -> NDArray[np.floating[Any]]:
        """Displacement of each of `points_m`, (point, 2), at every sample within 25 us of T: (point, time) in m.

        The channels return to the idle word at T. What the first samples still do `NEAR_S` after their response's end is left out.
        """
        volts, near = self._volts(words), self._near_samples
        whole = self._whole(points_m).reshape(-1, *volts.shape)
        late = range(-near, near + 1)
        found = np.empty((len(whole), len(late)))
        for index, by in enumerate(late):  # by samples later, a sample adds what one played by samples earlier adds at T
            played, response = (volts[by:], whole[:, : len(volts) - by]) if by >= 0 else (volts[:by], whole[:, -by:])
            found[:, index] = np.tensordot(response, played, 2)
        return found

    def _whole(self, points_m: ArrayLike) -> NDArray[np.floating[Any]]:
        responses = self._model.responses(points_m)[:, ::-1]
        return responses.reshape(len(responses), -1)

    def _volts(self, words: NDArray[np.uint32]) -> NDArray[np.floating[Any]]:
        """Voltage of each channel above that at rest: (sample, 32)."""
        above: NDArray[np.floating[Any]] = (channel_bits(words) - self._idle_bits) * self._supply_v
        return above
