import numpy as np
import pytest

from controller.device.bank.grid import Grid
from controller.device.bank.reader import Bank
from controller.device.kernel.null_twin import RING
from controller.device.waveforms.composition import Composer
from controller.workshop.bank_builder.build import build_bank
from controller.workshop.bank_builder.methods.design import DesignMethod
from controller.workshop.bank_builder.methods.device_composition import DeviceComposition
from controller.workshop.bank_builder.methods.prediction import Prediction
from controller.workshop.bank_builder.request import BankRequest
from controller.workshop.physics.responses.impulse_response import ResponseModel

POINTS = [(0.06, 0.05, 1.0), (0.0612, 0.0713, 0.5), (0.14, 0.09, 0.7)]
NULL = [(0.1, 0.06)]


@pytest.fixture(scope="module")
def bank(board, tmp_path_factory):
    grid = Grid.of(board.plate, 2.5e-3)
    cells = np.zeros(grid.cells, bool)
    pad = [(x_m + along_x, y_m + along_y) for x_m, y_m in NULL for along_x, along_y in RING]
    for x_m, y_m, *_ in (*POINTS, *NULL, *pad):
        cells[list(grid.corners(x_m, y_m)[0])] = True
    path = tmp_path_factory.mktemp("bank") / "bank"
    build_bank(BankRequest(board, path, 2.5e-3, cells))
    with Bank.open(path, board) as opened:
        yield opened


def test_the_words_are_the_composers_and_the_expected_displacements_the_plates(board, bank):
    method: DesignMethod = DeviceComposition(board, bank)
    designed = method.design(POINTS)
    assert designed.words.tobytes() == Composer(bank, board.idle_word).compose(POINTS).tobytes()
    predicted = Prediction(board, ResponseModel(board)).at_focus(designed.words, [point[:2] for point in POINTS])
    assert designed.displacement_m == pytest.approx(predicted, rel=0.04)
    assert designed.displacement_m != pytest.approx(1.06 * predicted, rel=0.04)
    assert designed.nulls_m.shape == (0,)


def test_a_null_is_predicted_where_it_is_kept_still(board, bank):
    method = DeviceComposition(board, bank)
    designed, loud = method.design(POINTS, NULL), method.design(POINTS)
    prediction = Prediction(board, ResponseModel(board))
    nulls_m, loud_m = (np.abs(prediction.near_focus(some.words, NULL)).max() for some in (designed, loud))
    assert designed.nulls_m[0] < 0.4 * loud_m
    assert nulls_m < 0.5 * loud_m
