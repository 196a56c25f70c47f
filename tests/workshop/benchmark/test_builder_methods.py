"""What each method buys: on a small board, relative to the board's own words."""

import dataclasses

import msgspec
import numpy as np
import pytest
from small_plate import WHOLE, small_board

from controller.commands.bank import _methods_table
from controller.workshop.benchmark.builder_methods import COLUMNS, METHODS, OPTIMISED, OWN, MethodTrial, method_figures
from controller.workshop.physics.focusing import focus
from controller.workshop.physics.plate_twin import PlateTwin
from controller.workshop.physics.word_capture import capture_of_words


@pytest.mark.slow
def test_methods_are_evaluated_beside_the_boards_own_words():
    board = small_board()
    sloped = msgspec.structs.replace(board, waveform=msgspec.structs.replace(board.waveform, slope=-1.0))
    some = [OWN, "the paper's", "slope = -1", "[finger]", "--optimise cool"]
    found, of_sloped = (method_figures(one, 2, methods=some) for one in (board, sloped))
    assert found[OWN] == found["the paper's"]
    assert of_sloped[OWN] == of_sloped["slope = -1"] != of_sloped["the paper's"]
    over = [name for name, how in COLUMNS.items() if how == "over" and name != "off by 0.5 %"]
    assert [found[OWN][name] for name in over] == [1] * len(over)
    assert found["slope = -1"]["edges"] < 0.95 < found["slope = -1"]["amplitude"]
    assert found["slope = -1"]["light touch"] > 1.05
    assert found["[finger]"]["amplitude"] < 0.9
    assert found["[finger]"]["1 N"] > 1
    assert found["--optimise cool"]["heat"] < 0.9
    assert found["--optimise cool"]["dB(A)"] < 0
    assert "--optimise cool" in _methods_table({"foci": 2, "methods": found})


@pytest.mark.slow
def test_contrast_that_is_optimised_lasts_beyond_the_instant():
    """Amplitude at T over the rms outside the focus at other times."""
    trial, clock_hz = MethodTrial(WHOLE, 1, 6), WHOLE.bit_ticks * WHOLE.waveform.bit_clock_hz
    medians = {}
    for method in ("the paper's", "slope = -1", *OPTIMISED):
        rows = []
        for words, (x_m, y_m) in zip(trial._words(method), trial.places_m.tolist(), strict=True):
            capture = capture_of_words(words, WHOLE.bit_ticks, WHOLE.idle_word, round(0.03 * clock_hz))
            ticks = capture.focus_ticks.astype(int) + (np.array([-20, -10, 0, 10, 20]) * 1e-6 * clock_hz).astype(int)
            fields = list(trial._twin.fields(dataclasses.replace(capture, focus_ticks=ticks.astype(np.uint64)), clock_hz))
            rms = []
            for field in fields:
                at_x_m, at_y_m, moved = field.map()
                rms.append(np.sqrt((moved[np.hypot(at_x_m - x_m, (at_y_m - y_m)[:, None]) > field.scale.outside_m] ** 2).mean()))
            rows.append(fields[2].at([(x_m, y_m)])[0] / np.array(rms))
        medians[method] = np.median(rows, axis=0)
        print(method, medians[method].round(1))
    paper, contrast = medians["the paper's"], medians["--optimise contrast"]
    assert contrast[2] > 2 * paper[2]
    assert (contrast / paper > 1.25).all()


def test_a_focus_has_the_displacement_of_the_sign_of_its_response():
    board = small_board()
    trial = MethodTrial(board, 1, 1)
    twin = PlateTwin(board)
    response = twin.responses.drive_order_responses(trial.places_m, dtype=np.float64)
    assert np.array_equal(trial._words("the paper's")[0], focus(response, [1.0], board.idle_word))
    assert trial.figures(OWN)[0, 0] == pytest.approx(1e6 * twin.reference_amplitude(*trial.places_m[0]), rel=1e-6)
    assert len(METHODS) == len(set(METHODS))
