import numpy as np
import pytest

from controller.bank.grid import Grid
from controller.bank.reader import Bank
from controller.bank_builder.build import build_bank
from controller.physics.impulse_response import ResponseModel
from controller.waveform_design.prediction import Prediction
from controller.waveforms.composition import Composer
from controller.waveforms.design import DesignMethod
from controller.waveforms.device_composition import DeviceComposition

POINTS = [(0.06, 0.05, 1.0), (0.0612, 0.0713, 0.5), (0.14, 0.09, 0.7)]
QUIET = [(0.1, 0.06)]


@pytest.fixture(scope="module")
def bank(board, tmp_path_factory):
    grid = Grid.of(board.plate, 2.5e-3)
    cells = np.zeros(grid.cells, bool)
    for x_m, y_m, *_ in (*POINTS, *QUIET):
        cells[list(grid.corners(x_m, y_m)[0])] = True
    path = tmp_path_factory.mktemp("bank") / "bank"
    build_bank(board, path, 2.5e-3, cells, measure_sgemm=False)
    with Bank.open(path, board) as opened:
        yield opened


def test_the_words_are_the_composers_and_the_expected_displacements_the_plates(board, bank):
    method: DesignMethod = DeviceComposition(board, bank)
    designed = method.design(POINTS)
    assert designed.words.tobytes() == Composer(bank, board.idle_word).compose(POINTS).tobytes()
    predicted = Prediction(board, ResponseModel(board)).at_focus(designed.words, [point[:2] for point in POINTS])
    assert designed.displacement_m == pytest.approx(predicted, rel=0.04)
    assert designed.displacement_m != pytest.approx(1.06 * predicted, rel=0.04)
    assert designed.quiet_m.shape == (0,)


def test_a_quiet_place_is_predicted_where_it_is_kept_still(board, bank):
    method = DeviceComposition(board, bank)
    designed, loud = method.design(POINTS, QUIET), method.design(POINTS)
    prediction = Prediction(board, ResponseModel(board))
    quiet_m, loud_m = (np.abs(prediction.near_focus(some.words, QUIET)).max() for some in (designed, loud))
    assert designed.quiet_m[0] < 0.4 * loud_m
    assert quiet_m < 0.5 * loud_m
