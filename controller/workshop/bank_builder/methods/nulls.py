"""Drive words that move some points and leave others still near T: for fingers that shall feel nothing.

The displacement of a null at each sample near T is linear in the bits, so a null is exact composition
(`exact_composition.py`) with one more goal, to stay zero, for each of these samples. The plate's band makes 27 of them about 20
independent goals, of which the strongest eight matter most; rounding to bits misses them by about a bit, and flips of bits that
decide little bring the rest down.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np

from controller.device.board.board import Board
from controller.device.board.panel import CHANNELS
from controller.device.kernel import Point
from controller.workshop.bank_builder.methods.design import Place, WaveformDesign
from controller.workshop.bank_builder.methods.dual import Floats
from controller.workshop.bank_builder.methods.exact_composition import ExactComposition, checked_points
from controller.workshop.bank_builder.methods.prediction import Prediction
from controller.workshop.physics.responses.impulse_response import ResponseModel

HEARD: Final = 1e-4  # of the largest: directions of displacement near T that are weaker are left as they are


class ExactNulls:
    """As `ExactComposition`, with places that stay still within 25 us of T."""

    name = "exact composition, nulls"

    def __init__(self, board: Board, model: ResponseModel) -> None:
        self._composition = ExactComposition(board, model)
        self._model = model
        self._prediction = Prediction(board, model)

    def design(self, points: Sequence[Point], nulls: Sequence[Place] = ()) -> WaveformDesign:
        """As `DesignMethod.design`."""
        places_m, asked = checked_points(points)
        nulls_m = np.array(nulls, np.float64).reshape(-1, 2)
        if not np.isfinite(nulls_m).all():
            raise ValueError("a null is not finite")
        words = self._composition.words(places_m, asked, independent(self.near_focus(nulls_m)))
        near_m = self._prediction.near_focus(words, nulls_m)
        return WaveformDesign(words, self._prediction.at_focus(words, places_m), np.abs(near_m).max(axis=1, initial=0.0))

    def near_focus(self, places_m: Floats) -> Floats:
        """What each bit that deviates adds to places, (place, 2), at each sample within 25 us of T: (place * time, bit) in m."""
        rows = [self._composition.deviations(self._prediction.near_responses(place_m)) for place_m in places_m]
        return np.concatenate(rows) if rows else np.zeros((0, self._model.samples * CHANNELS))


def independent(rows: Floats) -> Floats:
    """Orthogonal rows, (fewer, bit), of which `rows`, (row, bit), are made; combinations that are next to zero are left out."""
    if not len(rows):
        return rows
    squares, directions = np.linalg.eigh(rows @ rows.T)
    kept: Floats = directions[:, squares > HEARD**2 * squares[-1]].T @ rows
    return kept
