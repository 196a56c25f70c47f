"""The sign of the sum of responses, each divided by the sum of its absolute values (paper, section III-A)."""

import math
from collections.abc import Sequence

import numpy as np

from controller.device.board.board import Board
from controller.device.kernel import Point
from controller.workshop.bank_builder.methods.design import Place, WaveformDesign
from controller.workshop.bank_builder.methods.prediction import FocusPrediction
from controller.workshop.physics.focusing import focus
from controller.workshop.physics.responses.response_source import ResponseSource


class SignOfSum:
    """Full amplitude at one or several points; nobody is kept still."""

    name = "sign of the sum"

    def __init__(self, board: Board, source: ResponseSource) -> None:
        self._idle_word, self._source = board.idle_word, source
        self._prediction = FocusPrediction(board, source)

    def design(self, points: Sequence[Point], nulls: Sequence[Place] = ()) -> WaveformDesign:
        """As `DesignMethod.design`."""
        if not points or not all(map(math.isfinite, np.ravel(points))):
            raise ValueError("no point to focus on, or one that is not finite")
        if nulls or any(amplitude != 1 for _, _, amplitude in points):
            raise ValueError(f"{self.name} has no nulls and has no less than full amplitude")
        places_m = np.array(points)[:, :2]
        responses = self._source.drive_order_responses(places_m, dtype=np.float64)
        sizes = np.abs(responses).sum(axis=(1, 2))
        weights = np.divide(1, sizes, out=np.zeros_like(sizes), where=sizes > 0)
        words = focus(responses, weights.tolist(), self._idle_word)
        return WaveformDesign(words, self._prediction.at_focus(words, places_m), np.zeros(0))
