"""The sign of the sum of responses, each divided by the sum of its absolute values (paper, section III-A)."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from controller.board.board import Board
from controller.kernel import Point
from controller.physics.focusing import focus
from controller.physics.impulse_response import ResponseModel
from controller.waveform_design.prediction import Prediction
from controller.waveforms.design import Place, WaveformDesign


class SignOfSum:
    """Full amplitude at one or several points; nobody is kept still.

    Parameters
    ----------
    board : Board
    model : ResponseModel
        Of this board.
    """

    name = "sign of the sum"

    def __init__(self, board: Board, model: ResponseModel) -> None:
        self._idle_word, self._model = board.idle_word, model
        self._prediction = Prediction(board, model)

    def design(self, points: Sequence[Point], quiet: Sequence[Place] = ()) -> WaveformDesign:
        """As `DesignMethod.design`."""
        if not points or not all(map(math.isfinite, np.ravel(points))):
            raise ValueError("no point to focus on, or one that is not finite")
        if quiet or any(amplitude != 1 for _, _, amplitude in points):
            raise ValueError(f"{self.name} keeps no place quiet and has no less than full amplitude")
        places_m = np.array(points)[:, :2]
        responses = self._model.drive_order_responses(places_m, dtype=np.float64)
        sizes = np.abs(responses).sum(axis=(1, 2))
        weights = np.divide(1, sizes, out=np.zeros_like(sizes), where=sizes > 0)
        words = focus(responses, weights.tolist(), self._idle_word)
        return WaveformDesign(words, self._prediction.at_focus(words, places_m), np.zeros(0))
