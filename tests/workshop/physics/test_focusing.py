import numpy as np
import pytest
from tables import each_row

from controller.device.bank.packing import channel_bits
from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.workshop.physics.focusing import balanced_weights, focus
from controller.workshop.physics.responses.impulse_response import ResponseModel

BOARD = load_board(find_board("simulated"))


@pytest.fixture(scope="module")
def responses():
    return ResponseModel(BOARD).drive_order_responses([(0.06, 0.05), (0.14, 0.09)], dtype=np.float64)


def reached(words, response):
    return np.vdot(channel_bits(words) - 0.5, response)


def test_one_point_reaches_half_the_supply_times_the_sum_of_its_response(responses):
    words = focus(responses[:1], [1.0], BOARD.idle_word)
    assert reached(words, responses[0]) == pytest.approx(0.5 * np.abs(responses[0]).sum(), rel=1e-12)
    assert reached(focus(responses[1:], [1.0], BOARD.idle_word), responses[0]) < 0.1 * np.abs(responses[0]).sum()


def test_two_points_share_and_a_weight_moves_the_share(responses):
    alone = [reached(focus(responses[i : i + 1], [1.0], 0), responses[i]) for i in (0, 1)]
    shares = [[reached(focus(responses, [1.0, w], 0), responses[i]) / alone[i] for i in (0, 1)] for w in (1.0, 0.5, -1.0)]
    assert shares[0] == pytest.approx([0.69, 0.69], abs=0.1)  # independent responses: 1 / sqrt(2) each
    assert shares[1][0] > shares[0][0]
    assert shares[1][1] < shares[0][1]
    assert shares[2][1] < -0.5


def shares_of(responses, weights):
    """Of what each point would get alone, in the band."""
    flat = responses.reshape(len(responses), -1)
    return flat @ np.sign(weights @ flat) / np.abs(flat).sum(axis=1)


def test_balanced_weights_give_all_points_the_largest_share_that_the_worst_can_have():
    """The bound: no bits give the worst point more than `sum |sum w h|`, whatever the weights, of the best polarities."""
    places = [(0.06, 0.05), (0.1, 0.09), (0.14, 0.06), (0.066, 0.054)]
    responses = ResponseModel(BOARD).drive_order_responses(places, dtype=np.float64)
    weights = balanced_weights(responses)
    shares = np.abs(shares_of(responses, weights))
    bounds = []
    for signs in (
        (1, 1, 1, 1),
        (1, 1, 1, -1),
        (1, 1, -1, 1),
        (1, 1, -1, -1),
        (1, -1, 1, 1),
        (1, -1, 1, -1),
        (1, -1, -1, 1),
        (1, -1, -1, -1),
    ):
        relative = np.abs(weights) * np.abs(responses).sum(axis=(1, 2))
        each = np.array(signs) * np.abs(weights) / relative.sum()
        bounds.append(np.abs(np.tensordot(each, responses, 1)).sum())
    assert shares == pytest.approx(shares.mean(), rel=0.005)
    assert shares.min() > 0.99 * max(bounds)
    assert shares.min() > 1.1 * np.abs(shares_of(responses, 1 / np.abs(responses).sum(axis=(1, 2)))).min()


@each_row(("apart_m", "alike", "least"), [(1e-3, 1, 0.97), (4e-3, 1, 0.72), (7e-3, -1, 0.79), (9e-3, -1, 0.75)])
def test_near_points_are_kicked_the_way_that_serves_both(apart_m, alike, least):
    responses = ResponseModel(BOARD).drive_order_responses([(0.08, 0.06), (0.08 + apart_m, 0.06)], dtype=np.float64)
    weights = balanced_weights(responses)
    shares = shares_of(responses, weights)
    assert weights[0] > 0, "of two ways that are as good the first point goes up"
    assert np.sign(shares[0] * shares[1]) == alike
    assert np.abs(shares).min() > least


def test_a_point_that_cannot_move_has_no_weight(responses):
    nothing = np.zeros_like(responses[:1])
    assert balanced_weights(np.concatenate([nothing, responses[:1]]))[0] == 0
    assert shares_of(responses[:1], balanced_weights(np.concatenate([responses[:1], nothing]))[:1]) == pytest.approx([1.0])
    assert balanced_weights(nothing).tolist() == [0.0]


def test_where_the_sum_is_zero_the_channel_idles(responses):
    words = focus(responses[:1], [0.0], BOARD.idle_word)
    assert np.all(words == BOARD.idle_word)


@each_row("weights", [[], [1.0], [1.0, 1.0, 1.0]])
def test_refuses_weights_that_do_not_fit(responses, weights):
    with pytest.raises(ValueError, match="weights do not fit"):
        focus(responses, weights, 0)


def test_refuses_a_weight_that_is_no_number(responses):
    with pytest.raises(ValueError, match="not finite"):
        focus(responses, [1.0, float("nan")], 0)
