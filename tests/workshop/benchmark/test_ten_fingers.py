"""Ten fingers composed live: all feel the same share of what each would feel alone, next to the largest that all can have."""

import numpy as np
import pytest
from scipy.optimize import linprog

from controller.device.bank.grid import Grid
from controller.device.bank.reader import Bank
from controller.device.waveforms.composition import Composer
from controller.workshop.bank_builder.build import build_bank
from controller.workshop.bank_builder.methods.dual import likely_polarities
from controller.workshop.bank_builder.methods.exact_composition import ExactComposition
from controller.workshop.bank_builder.methods.prediction import FocusPrediction
from controller.workshop.bank_builder.request import BankRequest, cells_around
from controller.workshop.benchmark.fingers_scenes import scenes
from controller.workshop.physics.responses.impulse_response import ResponseModel

FINGERS = 10
CUTS = 400
GAP = 4e-3  # between the bounds from above and below at which cutting planes end
POLARITIES = 2


def linear_bound(rows, signs):
    """Largest share that all can have with these polarities: of a linear program in the weights, one cut after the other.

    min over weights w, of sum 1, of |sum w s h|_1, whose slope at each w tried is a plane below it.
    """
    planes, least = [], np.inf
    weights = np.full(len(rows), 1 / len(rows))
    for _ in range(CUTS):
        signed = np.sign((weights * signs) @ rows)
        planes.append(rows @ signed * signs)
        least = min(least, planes[-1] @ weights)
        found = linprog(
            np.append(np.zeros(len(rows)), 1.0),
            A_ub=np.column_stack([planes, -np.ones(len(planes))]),
            b_ub=np.zeros(len(planes)),
            A_eq=[[1.0] * len(rows) + [0.0]],
            b_eq=[1.0],
            bounds=[(0, 1)] * len(rows) + [(None, None)],
        )
        if least - found.fun < GAP * least:
            return least
        weights = 0.5 * (weights + found.x[:-1])  # half-way: planes far from the least one say little
    raise AssertionError(f"no bound after {CUTS} cuts")


@pytest.fixture(scope="module")
def played(board, tmp_path_factory):
    """Of a scene: responses in the band over their sizes, and each finger's share, by the device and by exact composition."""
    model = ResponseModel(board)
    grid = Grid.of(board.plate, board.bank.pitch_mm * 1e-3)
    drawn = [scene.points for scene in scenes(board, 1, each=1, random_scenes=0) if scene.family == "10 off grid"]
    path = tmp_path_factory.mktemp("bank") / "bank"
    build_bank(BankRequest(board, path, grid.pitch_m, cells_around(grid, [place for points in drawn for place in points])))
    found, prediction = [], FocusPrediction(board, model)
    with Bank.open(path, board) as bank:
        composer, exact = Composer(bank, board.idle_word), ExactComposition(board, model)
        for places in drawn:
            rows = model.drive_order_responses(places, dtype=np.float64).reshape(FINGERS, -1)
            sizes = np.abs(rows).sum(axis=1)
            points = [(x_m, y_m, 1.0) for x_m, y_m in places]
            words = np.frombuffer(composer.compose(points), "<u4"), exact.design(points).words
            shares = [np.abs(prediction.at_focus(some, np.array(places))) / (sizes * board.driver.supply_v / 2) for some in words]
            found.append((rows / sizes[:, None], *shares))
    return found


def test_the_worst_of_ten_fingers_gets_what_a_linear_program_says_that_all_can_have(played):
    for rows, live, _ in played:
        most = max(linear_bound(rows, signs) for signs in likely_polarities(rows, POLARITIES))
        assert 0.98 * most < live.min() < 1.08 * most  # bits outside the band add to it


def test_live_and_exact_composition_equalise_the_same(played):
    for _, live, exact in played:
        assert np.ptp(exact) < 2e-3 * exact.mean()
        assert live == pytest.approx(exact, rel=0.04)
        assert np.ptp(live) < 0.035 * live.mean()
