"""What fingers between cells lose, by pitch, on the simulated board and on a plate of another size and thickness."""

import msgspec
import numpy as np
import pytest
from tables import each_row

from controller.device.bank.grid import Grid
from controller.device.bank.inspection import bank_info
from controller.device.bank.reader import Bank
from controller.device.waveforms.composition import Composer
from controller.errors import ConfigError
from controller.workshop.bank_builder.build import build_bank
from controller.workshop.bank_builder.interpolation_error import interpolation_error, interpolation_warning, refuse_coarse
from controller.workshop.bank_builder.methods.plain import SignOfSum
from controller.workshop.bank_builder.methods.prediction import Prediction
from controller.workshop.bank_builder.request import BankRequest
from controller.workshop.physics.responses.impulse_response import ResponseModel
from tests.small_plate import small_board


@pytest.fixture(scope="module")
def board():
    return small_board()


@pytest.fixture(scope="module")
def thick(board):
    """Four times as thick, so that waves are twice as long, on four times the area: as many modes."""
    replace = msgspec.structs.replace
    patches = [replace(patch, x_mm=2 * patch.x_mm, y_mm=2 * patch.y_mm, size_mm=2 * patch.size_mm) for patch in board.actuators]
    plate = replace(board.plate, thickness_mm=2.0, length_mm=140.0, width_mm=100.0)
    return replace(board, name="thick", plate=plate, actuators=patches)


@pytest.fixture(scope="module")
def model(board):
    return ResponseModel(board)


def error(board, model, pitch_m):
    grid = Grid.of(board.plate, pitch_m)
    return interpolation_error(board, model, grid, np.ones(grid.cells, bool))


def test_the_error_grows_from_nothing_to_everything_with_the_pitch(board, model):
    fine, middle, coarse = (error(board, model, pitch_m) for pitch_m in (2.5e-3, 5e-3, 10e-3))
    assert abs(np.median(fine.interpolated)) < 0.005
    assert fine.interpolated.max() < 0.02
    assert 0.05 < np.median(middle.interpolated) < 0.15
    assert np.median(coarse.interpolated) > 0.8, "a fifth at most is left at 10 mm"
    assert fine.nearest.max() > 5 * fine.interpolated.max()
    assert fine.distance_m.max() <= 2.5e-3 * 0.5**0.5
    assert np.array_equal(fine.within(10.0), fine.nearest)
    assert np.array_equal(fine.within(0.0), fine.interpolated)
    assert interpolation_warning(fine.summary()) == ""
    said = interpolation_warning(middle.summary())
    assert "a finger between cells loses" in said
    assert "of 48 places" in said


def test_a_plate_with_waves_of_twice_the_length_may_have_twice_the_pitch(board, model, thick):
    here, there = error(board, model, 2.5e-3), error(thick, ResponseModel(thick), 5e-3)
    assert np.median(there.interpolated) == pytest.approx(np.median(here.interpolated), abs=0.005)
    assert np.median(there.nearest) == pytest.approx(np.median(here.nearest), rel=0.5)


@each_row(("pitch_mm", "refused"), [(2.5, False), (4.2, False), (4.3, True), (5.0, True), (10.0, True)])
def test_a_pitch_above_half_a_wavelength_is_refused_unless_the_board_accepts_it(board, thick, pitch_mm, refused):
    refuse_coarse(thick, 2 * pitch_mm * 1e-3 if not refused else 5e-3)
    accepting = msgspec.structs.replace(board, bank=msgspec.structs.replace(board.bank, coarse=True))
    refuse_coarse(accepting, pitch_mm * 1e-3)
    if not refused:
        refuse_coarse(board, pitch_mm * 1e-3)
        return
    with pytest.raises(ConfigError, match=rf"pitch_mm = {pitch_mm:g} is above 4\.22 mm, half a wavelength") as raised:
        refuse_coarse(board, pitch_mm * 1e-3)
    assert "\n" not in str(raised.value)


def test_the_bank_tells_its_error_and_composing_from_it_loses_as_much(board, model, tmp_path):
    """The error is that of the device's own arithmetic: 8 bits of response and weights in 256ths change it by less than 1 %."""
    grid = Grid.of(board.plate, 5e-3)
    cells = np.zeros((grid.ny, grid.nx), bool)
    cells[3:5, 5:7] = True
    report = build_bank(BankRequest(board, tmp_path / "bank", 5e-3, cells.ravel()))
    reported = bank_info(tmp_path / "bank")["parameters"]["interpolation_error"]
    assert reported == report.interpolation_error
    assert reported["places"] == 48
    evaluated = interpolation_error(board, model, grid, cells.ravel())
    assert evaluated.summary() == reported
    x_m, y_m = grid.place(3 * grid.nx + 5)
    place = (x_m + 2.5e-3, y_m + 2.5e-3)
    prediction = Prediction(board, model)
    exact_m = SignOfSum(board, model).design([(*place, 1.0)]).displacement_m[0]
    with Bank.open(tmp_path / "bank", board) as bank:
        words = np.frombuffer(Composer(bank, board.idle_word).compose([(*place, 1.0)]), np.uint32)
    lost = 1 - prediction.at_focus(words, [place])[0] / exact_m
    assert lost == pytest.approx(evaluated.interpolated.max(), abs=0.05)


def test_cells_with_nothing_between_them_have_no_error(board, model):
    grid = Grid.of(board.plate, 10e-3)
    lone = np.zeros(grid.cells, bool)
    lone[[2, 20]] = True
    summary = interpolation_error(board, model, grid, lone).summary()
    assert summary == {}
    assert interpolation_warning(summary) == ""
