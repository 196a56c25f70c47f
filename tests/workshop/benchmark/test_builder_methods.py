"""What each method buys: on a small board, relative to the board's own words."""

import msgspec
import numpy as np
import pytest
from small_plate import small_board

from controller.commands.bank import _methods_table
from controller.workshop.benchmark.builder_methods import COLUMNS, METHODS, OWN, MethodTrial, method_figures
from controller.workshop.physics.focusing import focus
from controller.workshop.physics.plate_twin import PlateTwin


@pytest.mark.slow
def test_methods_are_judged_beside_the_boards_own_words():
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


def test_a_focus_has_the_displacement_of_the_sign_of_its_response():
    board = small_board()
    trial = MethodTrial(board, 1, 1)
    twin = PlateTwin(board)
    response = twin.responses.drive_order_responses(trial.places_m, dtype=np.float64)
    assert np.array_equal(trial._words("the paper's")[0], focus(response, [1.0], board.idle_word))
    assert trial.figures(OWN)[0, 0] == pytest.approx(1e6 * twin.reference_amplitude(*trial.places_m[0]), rel=1e-6)
    assert len(METHODS) == len(set(METHODS))
