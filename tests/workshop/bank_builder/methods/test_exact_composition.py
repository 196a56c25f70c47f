from itertools import product

import numpy as np
import pytest
from scipy.optimize import linprog
from tables import each_row

from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.workshop.bank_builder.methods.dual import cheapest, farthest, flip, likely_polarities
from controller.workshop.bank_builder.methods.exact_composition import ExactComposition
from controller.workshop.bank_builder.methods.plain import SignOfSum
from controller.workshop.physics.plate_twin import PlateTwin
from controller.workshop.physics.responses.impulse_response import ResponseModel
from controller.workshop.physics.word_capture import capture_of_words

BOARD = load_board(find_board("simulated"))
POINTS = [(0.06, 0.05, 1.0), (0.14, 0.09, 1.0), (0.055, 0.11, 1.0), (0.16, 0.03, 1.0)]
SETTLED_TICKS = round(0.25 * BOARD.link.clock_hz)  # from 0 V to the idle word


@pytest.fixture(scope="module")
def model():
    return ResponseModel(BOARD)


def played_m(words, points):
    """Displacement of points at T on the plate twin."""
    capture = capture_of_words(words, BOARD.bit_ticks, BOARD.idle_word, SETTLED_TICKS)
    field = next(PlateTwin(BOARD).fields(capture, BOARD.bit_ticks * BOARD.waveform.bit_clock_hz))
    return field.at([(x_m, y_m) for x_m, y_m, _ in points])


@each_row("seed", range(4))
def test_the_bound_is_that_of_a_linear_program(seed):
    rng = np.random.default_rng(seed)
    rows, proportions = rng.normal(size=(4, 400)), rng.choice([-1.0, 0.0, 0.4, 1.0], 4)
    proportions[0] = 1.0
    objective = np.append(np.zeros(400), -1.0)
    found = linprog(objective, A_eq=np.column_stack([rows, -proportions]), b_eq=np.zeros(4), bounds=[(0, 1)] * 400 + [(0, None)])
    weights, bound = farthest(rows, proportions)
    assert bound == pytest.approx(-found.fun, rel=2e-3)
    assert proportions @ weights == pytest.approx(1)


def test_the_cheapest_bits_are_those_of_a_linear_program():
    rng = np.random.default_rng(1)
    rows, cost, wanted = rng.normal(size=(3, 400)), rng.uniform(0.5, 1, 400), np.array([30.0, -20.0, 10.0])
    found = linprog(cost, A_eq=rows, b_eq=wanted, bounds=[(0, 1)] * 400)
    bits = cheapest(rows, wanted, cost, np.array([1.0, -1.0, 0.5])) @ rows > cost
    assert rows @ bits == pytest.approx(wanted, abs=3)  # some bits of about 1
    assert cost @ bits == pytest.approx(found.fun, rel=0.05)


def test_flips_reach_what_is_wanted_and_cost_little():
    rng = np.random.default_rng(2)
    rows = rng.normal(size=(3, 4000))
    weights, bound = farthest(rows, np.ones(3))
    sums = weights @ rows
    bits = sums > 0
    missed = np.linalg.norm(rows @ bits - bound)
    flip(bits, sums, rows, np.full(3, bound), 1e-2)
    assert np.linalg.norm(rows @ bits - bound) < min(0.25, missed)  # of bits of about 1
    assert np.abs(sums[bits != (sums > 0)]).max() < np.quantile(np.abs(sums), 0.25)


@each_row("seed", range(3))
def test_the_likely_polarities_have_the_largest_bound(seed):
    rows = np.random.default_rng(seed).normal(size=(4, 600)) @ np.diag(np.linspace(0.2, 2, 600))
    rows[1] += 0.6 * rows[0]
    rows[2] -= 0.4 * rows[3]
    bounds = {signs: farthest(rows, np.array((1.0, *signs)))[1] for signs in product((1.0, -1.0), repeat=3)}
    first, *others = likely_polarities(rows, 3)
    assert first[0] == 1
    assert len(others) == 2
    assert bounds[tuple(first[1:])] > 0.99 * max(bounds.values())


def test_four_points_get_the_bound_and_all_the_same(model):
    words = ExactComposition(BOARD, model).design(POINTS).words
    reached_m = played_m(words, POINTS)
    rows = model.drive_order_responses([(x, y) for x, y, _ in POINTS], dtype=np.float64).reshape(4, -1)
    alone = np.abs(rows).sum(axis=1, keepdims=True)
    share = np.abs(reached_m) / (alone[:, 0] * BOARD.driver.supply_v / 2)
    weights, _ = farthest(rows / alone, np.sign(reached_m))
    bound = np.abs(weights @ (rows / alone)).sum()  # of any weights whose product with the directions is 1
    assert np.sign(reached_m) @ weights == pytest.approx(1)
    assert np.ptp(share) < 0.005 * share.mean()
    assert share.min() > 0.995 * bound
    assert np.ptp(np.abs(reached_m)) > 0.02 * np.abs(reached_m).mean()  # not all move as far alone
    plain_m = played_m(SignOfSum(BOARD, model).design(POINTS).words, POINTS)
    assert np.abs(reached_m).min() > 1.02 * np.abs(plain_m).min()


def test_each_point_gets_the_amplitude_that_was_asked_for(model):
    method = ExactComposition(BOARD, model)
    full_m = np.abs(method.design(POINTS).displacement_m)
    asked = np.array([0.25, 1.0, 0.6, 0.33])
    some = [(x_m, y_m, amplitude) for (x_m, y_m, _), amplitude in zip(POINTS, asked, strict=True)]
    design = method.design(some)
    assert np.abs(played_m(design.words, some)) == pytest.approx(asked * full_m, rel=5e-3)
    assert np.abs(design.displacement_m) == pytest.approx(asked * full_m, rel=1e-3)


def test_points_7_mm_apart_are_pushed_opposite_ways(model):
    design = ExactComposition(BOARD, model).design([(0.100, 0.07, 1.0), (0.107, 0.07, 1.0)])
    assert np.prod(design.displacement_m) < 0
    together = SignOfSum(BOARD, model).design([(0.100, 0.07, 1.0), (0.107, 0.07, 1.0)])
    assert np.abs(design.displacement_m).min() > 1.2 * np.abs(together.displacement_m).min()


def test_points_at_one_place_are_one(model):
    method = ExactComposition(BOARD, model)
    alone, twice = method.design(POINTS[:1]), method.design([POINTS[0], POINTS[0]])
    assert twice.displacement_m == pytest.approx(np.full(2, alone.displacement_m[0]), rel=1e-3)


@each_row(
    ("points", "nulls", "said"),
    [
        ([], [], "0 points"),
        ([(0.01 * n, 0.05, 1.0) for n in range(1, 12)], [], "11 points"),
        ([(np.nan, 0.05, 1.0)], [], "not finite"),
        ([(0.06, 0.05, 0.0)], [], "not above 0"),
        ([(0.06, 0.05, 1.5)], [], "at most 1"),
        ([(0.06, 0.05, 1.0)], [(0.1, 0.1)], "nulls"),
        ([(0.06, 0.05, 1.0), (0.06, 0.05, 0.5)], [], "one place"),
        ([(0.0, 0.05, 1.0)], [], "nothing can move"),
    ],
)
def test_refuses(model, points, nulls, said):
    with pytest.raises(ValueError, match=said):
        ExactComposition(BOARD, model).design(points, nulls)
