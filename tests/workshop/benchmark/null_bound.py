"""How still any bits could keep pads if the foci lose no more than a share: `python -m tests.workshop.benchmark.null_bound`.

A bound, not a method. Bits are relaxed to 0 <= d <= 1; of all d that leave each focus 1 - loss of what exact composition gives it
in the band, none moves the pads less (mean over pads, places and times of the squares). By Lagrange's dual, for any y and l >= 0:

    |R d|^2 / 2  >=  -|y|^2 / 2 + sum of min(0, R' y - F' l) + (1 - loss) sum of l

R: rows of the pads, F: rows of the foci. So what the search for y and l ends with is a bound, however far it came. The rms of the
worst pad, of which the figures of `exact_waveforms` are, is no less than that of the mean.
"""

import argparse

import numpy as np
from scipy.optimize import minimize
from threadpoolctl import threadpool_limits

from controller.device.board.board import Board, load_board
from controller.device.board.lookup import find_board
from controller.workshop.bank_builder.methods.dual import farthest
from controller.workshop.bank_builder.methods.exact_composition import ExactComposition
from controller.workshop.bank_builder.methods.prediction import Prediction
from controller.workshop.physics.responses.impulse_response import ResponseModel
from tests.workshop.benchmark.exact_waveforms import PAD_M, full, scene

LOSSES = (0.01, 0.03, 0.05, 0.1, 0.15)
SMALLEST = 1e-5  # of the largest square: directions of a pad's motion that are left out, which can only loosen the bound
SILENCE = 1e-6  # a smaller square is as good


def least_square(pads: np.ndarray, foci: np.ndarray, loss: float, start: np.ndarray) -> tuple[float, np.ndarray]:
    """A bound from below of |pads d|^2, and where it was found; `foci` are 1 each where nothing is lost."""
    count = len(pads)

    def negative(at: np.ndarray) -> tuple[float, np.ndarray]:
        y, weights = at[:count].astype(np.float32), at[count:].astype(np.float32)
        sums = y @ pads - weights @ foci
        bits = (sums < 0).astype(np.float32)
        value = 0.5 * float(y @ y) - float(sums[sums < 0].sum(dtype=np.float64)) - (1 - loss) * float(weights.sum())
        return value, np.concatenate([y - pads @ bits, foci @ bits - (1 - loss)]).astype(np.float64)

    within = [(None, None)] * count + [(0, None)] * len(foci)
    found = minimize(negative, start, jac=True, method="L-BFGS-B", bounds=within, options={"maxiter": 150, "maxcor": 30})
    return max(-2 * float(found.fun), 0.0), found.x


class Bounds:
    """Of scenes on a board."""

    def __init__(self, board: Board) -> None:
        self._model = ResponseModel(board)
        self._exact, self._said = ExactComposition(board, self._model), Prediction(board, self._model)

    def of(self, points: np.ndarray, places: np.ndarray) -> list[float]:
        """At most so many dB is the worst pad better, for each loss."""
        words = self._exact.design(full(points)).words
        foci = self._exact.deviations(self._model.drive_order_responses(points, dtype=np.float64))
        foci *= np.sign(self._said.at_focus(words, points))[:, None] / np.abs(foci).sum(axis=1, keepdims=True)
        weights, _ = farthest(foci, np.ones(len(foci)))
        foci /= (foci * (weights @ foci > 0)).sum(axis=1, keepdims=True)
        loudest = max(float((self._said.near_focus(words, place + PAD_M) ** 2).mean()) for place in places)
        pads = np.concatenate([self._directions(place) for place in places]) / np.sqrt(len(places) * loudest)
        at, bounds = np.append(np.zeros(len(pads)), np.full(len(foci), 0.3)), []
        for loss in LOSSES:
            square, at = least_square(pads.astype(np.float32), foci.astype(np.float32), loss, at)
            bounds.append(-10 * np.log10(max(square, SILENCE)))
        return bounds

    def _directions(self, place: np.ndarray) -> np.ndarray:
        """Rows whose squares sum to the mean square of a pad."""
        near = np.concatenate([self._exact.deviations(self._said.near_responses(spot)) for spot in place + PAD_M])
        squares, directions = np.linalg.eigh(near @ near.T)
        kept: np.ndarray = directions[:, squares > SMALLEST * squares[-1]].T @ near / np.sqrt(len(near))
        return kept


def main() -> None:
    """Print the bounds in dB of the rms without nulls: median and least of the scenes, for each loss."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--scenes", type=int, default=6)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    board = load_board(find_board("simulated"))
    bounds = Bounds(board)
    for foci, pads in ((1, 1), (1, 2), (2, 2), (1, 3)):
        rng = np.random.default_rng(options.seed)
        found = np.array([bounds.of(*scene(rng, board, foci, pads)) for _ in range(options.scenes)])
        each = zip(LOSSES, np.median(found, axis=0), found.min(axis=0), strict=True)
        said = "; ".join(f"{loss:.0%} {median:.1f} ({least:.1f})" for loss, median, least in each)
        print(f"foci {foci}, pads {pads}: better by at most, in dB, at a loss of {said}", flush=True)


if __name__ == "__main__":
    with threadpool_limits(1, "blas"):
        main()
