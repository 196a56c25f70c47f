"""Drive words that move some points and leave others still near T: for fingers that shall feel nothing.

A finger feels with a pad that is almost a wavelength wide: a null of one point leaves the rest of it as it was. So seven places of
the pad are kept still. Their displacement at each sample near T is linear in the bits, so a null is exact composition
(`exact_composition.py`) with one more goal, to stay zero, for each place and sample. The plate's band makes these 189 about 40
independent goals that matter; rounding to bits misses them by about a bit, and flips of bits that decide little bring the rest
down.
"""

from collections.abc import Sequence
from typing import Final

import numpy as np

from controller.arrays import Reals
from controller.device.board.board import Board
from controller.device.board.panel import CHANNELS
from controller.device.kernel import Point
from controller.device.waveforms.pad import OFFSETS, PAD_M, pad_places
from controller.workshop.bank_builder.methods.design import Place, WaveformDesign
from controller.workshop.bank_builder.methods.exact_composition import ExactComposition, checked_points
from controller.workshop.bank_builder.methods.prediction import Prediction
from controller.workshop.physics.responses.impulse_response import ResponseModel

HEARD: Final = 0.1  # of the largest: directions of displacement near T that are weaker are left as they are


class ExactNulls:
    """As `ExactComposition`, with places that stay still within 25 us of T, each with the pad of a finger around it."""

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
        if (np.linalg.norm(places_m[:, None] - nulls_m, axis=2) < PAD_M / 2).any():
            raise ValueError("a point to compose is where the plate shall stay still: on the pad of a null")
        pads_m = [place for null in nulls_m.tolist() for place in pad_places(*null)]
        words, reached_m = self._composition.words(places_m, asked, independent(self.near_focus(pads_m)))
        most_m = np.abs(self._prediction.near_focus(words, pads_m)).max(axis=1, initial=0.0)
        each_m = most_m.reshape(len(nulls_m), len(OFFSETS)).max(axis=1, initial=0.0)
        return WaveformDesign(words, reached_m, each_m)

    def near_focus(self, places_m: Sequence[Place]) -> Reals:
        """What each bit that deviates adds to places, (place, 2), at each sample within 25 us of T: (place * time, bit) in m."""
        rows = [self._composition.deviations(self._prediction.near_responses(place_m)) for place_m in places_m]
        return np.concatenate(rows) if rows else np.zeros((0, self._model.samples * CHANNELS))


def independent(rows: Reals) -> Reals:
    """Orthogonal rows, (fewer, bit), of which `rows`, (row, bit), are made; combinations that are next to zero are left out."""
    if not len(rows):
        return rows
    squares, directions = np.linalg.eigh(rows @ rows.T)
    return directions[:, squares > HEARD**2 * squares[-1]].T @ rows
