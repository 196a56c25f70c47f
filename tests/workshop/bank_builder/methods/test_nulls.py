import dataclasses

import numpy as np
import pytest
from tables import each_row

from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.device.waveforms.pad import pad_places
from controller.workshop.bank_builder.methods.exact_composition import ExactComposition, best_bits
from controller.workshop.bank_builder.methods.nulls import ExactNulls, independent
from controller.workshop.bank_builder.methods.plain import SignOfSum
from controller.workshop.bank_builder.methods.prediction import Prediction
from controller.workshop.physics.plate_twin import PlateTwin
from controller.workshop.physics.responses.impulse_response import ResponseModel
from controller.workshop.physics.word_capture import capture_of_words

BOARD = load_board(find_board("simulated"))
POINT = (0.06, 0.05, 1.0)
NULL = [(0.075, 0.058), (0.05, 0.07)]
SETTLED_TICKS = round(0.25 * BOARD.link.clock_hz)  # from 0 V to the idle word
NEAR = range(-12, 13)  # samples of 2 us
_LINE_M = 1e-3 * np.arange(-4, 5)
PAD_M = [(x, y) for x in _LINE_M for y in _LINE_M if np.hypot(x, y) < 4.1e-3]  # every millimetre of a pad of 8 mm


@pytest.fixture(scope="module")
def model():
    return ResponseModel(BOARD)


def played_near_m(words, places):
    """Displacement of places within 25 us of T on the plate twin, (time, place)."""
    capture = capture_of_words(words, BOARD.bit_ticks, BOARD.idle_word, SETTLED_TICKS)
    focus_tick = int(capture.focus_ticks[0])
    times = np.array([focus_tick + late * BOARD.bit_ticks for late in NEAR], np.uint64)
    fields = PlateTwin(BOARD).fields(dataclasses.replace(capture, focus_ticks=times), BOARD.bit_ticks * BOARD.waveform.bit_clock_hz)
    return np.array([field.at(places) for field in fields])


def pad(place):
    return [(place[0] + x_m, place[1] + y_m) for x_m, y_m in PAD_M]


def below_db(values, others):
    return 20 * np.log10(np.abs(others).max() / np.abs(values).max())


def test_a_finger_beside_a_focus_feels_nothing(model):
    design = ExactNulls(BOARD, model).design([POINT], NULL[:1])
    plain, alone = SignOfSum(BOARD, model).design([POINT]), ExactComposition(BOARD, model).design([POINT])
    quiet, loud = (played_near_m(words, pad(NULL[0])) for words in (design.words, plain.words))
    assert below_db(quiet, loud) > 4
    assert below_db(quiet, design.displacement_m) > 21  # no point of the pad at any time
    assert 20 * np.log10(np.sqrt((loud**2).mean() / (quiet**2).mean())) > 9
    assert design.displacement_m[0] > 0.92 * alone.displacement_m[0]
    assert played_near_m(design.words, [POINT[:2]])[12, 0] == pytest.approx(design.displacement_m[0], rel=1e-3)


@pytest.mark.slow
def test_what_it_expects_at_nulls_is_what_the_plate_does(model):
    design = ExactNulls(BOARD, model).design([POINT], NULL)
    played_m = np.abs(played_near_m(design.words, [spot for place in NULL for spot in pad_places(*place)])).max(axis=0)
    most_m = played_m.reshape(len(NULL), -1).max(axis=1)
    assert np.all(most_m < 1.05 * design.nulls_m)  # which has a sample more to either side
    assert np.all(most_m > 0.5 * design.nulls_m)
    assert np.all(design.nulls_m < 500e-9)
    # of other words, too: those that keep nobody still have a displacement that is known to the twin's own precision
    plain = SignOfSum(BOARD, model).design([POINT])
    expected_m = Prediction(BOARD, model).near_focus(plain.words, NULL)
    assert pytest.approx(played_near_m(plain.words, NULL), abs=1e-9) == expected_m[:, 1:-1].T


def test_responses_with_noise_leave_a_null_of_25_db(model):
    rng = np.random.default_rng(5)
    nulls, composition = ExactNulls(BOARD, model), ExactComposition(BOARD, model)

    def noisy(rows):
        return rows + rng.normal(size=rows.shape) * np.sqrt((rows**2).mean()) * 10 ** (-30 / 20)

    points_m = np.array([POINT[:2]])
    in_band = composition.deviations(model.drive_order_responses(points_m, dtype=np.float64))
    whole = composition.deviations(model.responses(points_m)[:, ::-1])
    near = nulls.near_focus(np.array(NULL[:1]))
    plain = best_bits(in_band, whole, np.ones(1), np.zeros((0, near.shape[1])), 48)
    bits = best_bits(noisy(in_band), noisy(whole), np.ones(1), independent(noisy(near)), 48)
    assert below_db(near @ bits, near @ plain) > 15
    assert 20 * np.log10((whole @ bits)[0] / np.abs(near @ bits).max()) > 35  # below the focus


def test_less_than_full_amplitude_and_a_null(model):
    nulls = ExactNulls(BOARD, model)
    full, half = nulls.design([POINT], NULL[:1]), nulls.design([(*POINT[:2], 0.5)], NULL[:1])
    assert half.displacement_m == pytest.approx(0.5 * full.displacement_m, rel=5e-3)
    assert half.nulls_m[0] < 160e-9  # of 3.8 um


@each_row(
    ("nulls", "said"),
    [([(POINT[0], POINT[1] + 3.9e-3)], "shall stay still"), ([(np.nan, 0.05)], "not finite"), ([(0.05, np.inf)], "not finite")],
)
def test_refuses(model, nulls, said):
    with pytest.raises(ValueError, match=said):
        ExactNulls(BOARD, model).design([POINT], nulls)
