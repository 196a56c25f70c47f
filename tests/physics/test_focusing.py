import numpy as np
import pytest

from controller.bank.packing import channel_bits
from controller.board.board import load_board
from controller.board.lookup import find_board
from controller.physics.focusing import focus
from controller.physics.impulse_response import ResponseModel

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


def test_where_the_sum_is_zero_the_channel_idles(responses):
    words = focus(responses[:1], [0.0], BOARD.idle_word)
    assert np.all(words == BOARD.idle_word)


@pytest.mark.parametrize("weights", [[], [1.0], [1.0, 1.0, 1.0]])
def test_refuses_weights_that_do_not_fit(responses, weights):
    with pytest.raises(ValueError, match="weights do not fit"):
        focus(responses, weights, 0)


def test_refuses_a_weight_that_is_no_number(responses):
    with pytest.raises(ValueError, match="not finite"):
        focus(responses, [1.0, float("nan")], 0)
