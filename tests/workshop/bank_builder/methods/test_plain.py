import numpy as np
import pytest
from tables import each_row

from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.workshop.bank_builder.methods.plain import SignOfSum
from controller.workshop.bank_builder.methods.prediction import Prediction
from controller.workshop.physics.plate_twin import PlateTwin
from controller.workshop.physics.responses.impulse_response import ResponseModel
from controller.workshop.physics.word_capture import capture_of_words

BOARD = load_board(find_board("simulated"))
POINTS = [(0.06, 0.05, 1.0), (0.14, 0.09, 1.0)]
SETTLED_TICKS = round(0.25 * BOARD.link.clock_hz)  # from 0 V to the idle word: 40 time constants of the slowest pole


@pytest.fixture(scope="module")
def model():
    return ResponseModel(BOARD)


@pytest.fixture(scope="module")
def designed(model):
    return SignOfSum(BOARD, model).design(POINTS)


def test_what_it_expects_is_what_the_plate_twin_measures(designed):
    capture = capture_of_words(designed.words, BOARD.bit_ticks, BOARD.idle_word, SETTLED_TICKS)
    field = next(PlateTwin(BOARD).fields(capture, BOARD.bit_ticks * BOARD.waveform.bit_clock_hz))
    measured_m = [field.focus_metrics(x_m, y_m, [(x, y) for x, y, _ in POINTS]).amplitude_m for x_m, y_m, _ in POINTS]
    # the twin superposes steps from 0 V on, the prediction multiplies pulses: what is left of responses longer than T differs
    assert designed.displacement_m == pytest.approx(measured_m, rel=1e-3)


def test_near_the_focus_it_passes_through_the_displacement_at_it(model, designed):
    near_m = Prediction(BOARD, model).near_focus(designed.words, [(x, y) for x, y, _ in POINTS])
    middle = 13
    assert near_m.shape == (2, 2 * middle + 1)  # 26 us before and after T
    assert near_m[:, middle] == pytest.approx(designed.displacement_m, rel=1e-12)
    assert np.all(np.abs(near_m).max(axis=1) < 1.1 * designed.displacement_m)


@each_row(
    ("points", "nulls", "said"),
    [
        ([], [], "no point"),
        ([(np.nan, 0.05, 1.0)], [], "not finite"),
        ([(0.06, np.inf, 1.0)], [], "not finite"),
        ([(0.06, 0.05, 0.5)], [], "less than full"),
        ([(0.06, 0.05, 1.0)], [(0.1, 0.1)], "nulls"),
    ],
)
def test_refuses(model, points, nulls, said):
    with pytest.raises(ValueError, match=said):
        SignOfSum(BOARD, model).design(points, nulls)
