from pathlib import Path

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from controller.device.board.board import load_board
from controller.device.board.lookup import data_folder
from controller.device.touch.axes import AxisRange, PanelAxes

BOARD = load_board(data_folder("boards") / "simulated")


def board(x_mm, y_mm):
    touch = msgspec.structs.replace(BOARD.touch, x_mm_from_axes=x_mm, y_mm_from_axes=y_mm)
    return msgspec.structs.replace(BOARD, touch=touch, folder=Path())


def test_the_ends_of_the_axes_are_the_corners_of_the_plate():
    axes = PanelAxes(BOARD, AxisRange(100, 1100), AxisRange(-50, 50))
    assert axes.position_m(100, -50) == (0, 0)
    assert axes.position_m(1100, 50) == pytest.approx((0.210, 0.148), abs=1e-12)
    assert axes.position_m(350, 0) == pytest.approx((0.0525, 0.074), abs=1e-12)


def test_one_percent_more_in_any_coefficient_is_seen():
    x_mm, y_mm = (150.0, 20.0, 10.0), (-5.0, 110.0, 12.0)
    right = PanelAxes(board(x_mm, y_mm), AxisRange(0, 1000), AxisRange(0, 1000)).position_m(800, 600)
    assert right == pytest.approx((0.150 * 0.8 + 0.020 * 0.6 + 0.010, -0.005 * 0.8 + 0.110 * 0.6 + 0.012), rel=1e-12)
    for k in range(3):
        off_x, off_y = list(x_mm), list(y_mm)
        off_x[k] *= 1.01
        off_y[k] *= 1.01
        place = PanelAxes(board(tuple(off_x), tuple(off_y)), AxisRange(0, 1000), AxisRange(0, 1000)).position_m(800, 600)
        assert place[0] != pytest.approx(right[0], rel=1e-4)
        assert place[1] != pytest.approx(right[1], rel=1e-4)


def test_swapped_and_mirrored_panels():
    axes = PanelAxes(board((0.0, -210.0, 210.0), (148.0, 0.0, 0.0)), AxisRange(0, 10), AxisRange(0, 10))
    assert axes.position_m(0, 0) == pytest.approx((0.210, 0))
    assert axes.position_m(10, 5) == pytest.approx((0.105, 0.148))


def test_a_panel_larger_than_the_glass_is_held_to_the_plate():
    axes = PanelAxes(board((230.0, 0.0, -10.0), (0.0, 160.0, -6.0)), AxisRange(0, 100), AxisRange(0, 100))
    assert axes.position_m(0, 0) == (0, 0)
    assert axes.position_m(100, 100) == (BOARD.plate.length_m, BOARD.plate.width_m)


def test_an_axis_without_extent_reads_as_its_middle():
    axes = PanelAxes(BOARD, AxisRange(500, 500), AxisRange(0, 100))
    assert axes.position_m(500, 25) == pytest.approx((0.105, 0.037))


@given(st.integers(-(1 << 31), 1 << 31), st.integers(-(1 << 31), 1 << 31))
def test_clamped_values_lie_in_the_ranges_and_those_inside_stay(x, y):
    axes = PanelAxes(BOARD, AxisRange(-100, 1000), AxisRange(7, 9))
    near_x, near_y = axes.clamp(x, y)
    assert -100 <= near_x <= 1000
    assert 7 <= near_y <= 9
    assert near_x == x or not -100 <= x <= 1000
    assert near_y == y or not 7 <= y <= 9


@given(
    st.tuples(*[st.floats(-300, 300)] * 3),
    st.tuples(*[st.floats(-300, 300)] * 3),
    st.integers(2, 9999),
    st.integers(2, 9999),
    st.data(),
)
def test_what_is_plain_maps_to_the_plate_without_being_clamped(x_mm, y_mm, width, height, data):
    axes = PanelAxes(board(x_mm, y_mm), AxisRange(-5, width), AxisRange(7, 7 + height))
    low_x, high_x, low_y, high_y = axes.plain()
    if low_x <= high_x < float("inf"):
        x, y = data.draw(st.integers(low_x, high_x)), data.draw(st.integers(low_y, high_y))
        assert axes.mapped_m(x, y) == axes.position_m(x, y)


def test_on_a_panel_of_the_size_of_the_plate_all_but_the_rim_is_plain():
    assert PanelAxes(BOARD, AxisRange(0, 2100), AxisRange(0, 1480)).plain() == (1, 2099, 1, 1479)
    beyond = PanelAxes(board((230.0, 0.0, -10.0), (0.0, 160.0, -6.0)), AxisRange(0, 2100), AxisRange(0, 1480))
    assert beyond.plain() == (float("inf"),) * 4
