"""R C of the stages, from responses of a plate whose stages are not as board.toml says."""

import msgspec
import pytest
from small_plate import small_board
from tables import each_row
from workshop.calibration.true_plate import TruePlate

from controller.workshop.calibration.fits.stage_fit import fit_stages, stage_notes
from controller.workshop.calibration.point_plan import scattered_points

BOARD = small_board()


def learned(resistance=1.0, capacitance=1.0, points=40, **plate):
    driver = BOARD.driver
    driver = msgspec.structs.replace(
        driver, resistance_ohm=driver.resistance_ohm * resistance, capacitance_f=driver.capacitance_f * capacitance
    )
    there = msgspec.structs.replace(BOARD, driver=driver)
    return TruePlate(there, 4.0, **plate).learned(scattered_points(BOARD, points, 0.0, seed=2))


@each_row(("resistance", "capacitance"), [(1.0, 1.0), (1.12, 1.12), (0.9, 1.0), (1.0, 1.2)])
def test_it_is_found_on_the_boards_own_plate(resistance, capacitance):
    fit = fit_stages(BOARD, learned(resistance, capacitance))
    assert fit.time_constant == pytest.approx(resistance * capacitance, abs=0.02)
    assert fit.error >= 0.08


def test_it_is_said_where_it_surely_differs_and_not_otherwise():
    assert not stage_notes(BOARD, learned())
    (note,) = stage_notes(BOARD, learned(1.12, 1.12))
    assert "R C is +24 ± 8 % off board.toml's" in note


@each_row("plate", [{"length_mm": 73.0}, {"young_modulus_pa": 72e9}, {"length_mm": 73.0, "young_modulus_pa": 72e9}])
def test_a_plate_that_is_not_quite_the_boards_is_not_taken_for_other_stages(plate):
    assert not stage_notes(BOARD, learned(**plate))


def test_nothing_is_said_of_too_few_points_or_where_the_edges_are_others():
    assert fit_stages(BOARD, learned(1.12, 1.12, points=20)) is None
    assert fit_stages(BOARD, learned(1.12, 1.12, edges="free", theory="mindlin")) is None
