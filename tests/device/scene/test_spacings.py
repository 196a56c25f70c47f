"""What a finger feels as it moves: every spacing of its way, every line it crosses, and nothing while it lies still."""

import math

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from tables import each_row

from controller.device.scene.effects.effects import EffectTable
from controller.device.scene.progress import MAX_REARM_M, REARM_SHARE, REST_M
from controller.device.scene.shapes import Circle, Polygon, Rectangle
from controller.device.scene.spacings import Spacing, spacing_of

places = st.lists(st.tuples(st.integers(-4, 4), st.floats(REARM_SHARE + 0.001, 1 - REARM_SHARE - 0.001)), min_size=2, max_size=60)


def hits(spacing, points):
    """Numbers of the points at which something is felt; the first is where the finger comes in."""
    progress = spacing.begin(*points[0])
    return [number for number, point in enumerate(points[1:], 1) if progress.crossed(*point)]


def along(axis, places_m):
    return [(0.05, at_m) if axis else (at_m, 0.05) for at_m in places_m]


@given(st.sampled_from([0, 1]), st.floats(1e-4, 0.03), st.floats(0, 0.05), places)
def test_every_report_that_crosses_lines_is_felt_once_however_many_it_crosses(axis, spacing_m, origin_m, places):
    """For a finger that is seen a quarter of a spacing away from any line, back and forth."""
    way = [origin_m + (cell + part) * spacing_m for cell, part in places]
    expected = [k for k in range(1, len(places)) if places[k][0] != places[k - 1][0]]
    assert hits(Spacing(spacing_m, axis, origin_m, 1.0), along(axis, way)) == expected


@given(st.floats(1e-3, 0.03), st.integers(-5, 5), st.lists(st.floats(-1, 1), max_size=50))
def test_a_finger_that_trembles_on_a_line_feels_it_once(spacing_m, line, noise):
    rest_m = 0.99 * min(REARM_SHARE * spacing_m, MAX_REARM_M)
    way = [(line - 0.5) * spacing_m, *(line * spacing_m + part * rest_m for part in noise)]
    assert len(hits(Spacing(spacing_m, 0, 0.0, 1.0), along(0, way))) <= 1


def test_a_line_is_felt_again_on_the_way_back():
    grating = Spacing(10e-3, 0, 0.0, 1.0)
    way = [0.003, 0.0101, 0.0107, 0.0099, 0.0094, 0.0102]
    assert hits(grating, along(0, way)) == [1, 3, 5]


def test_a_jump_back_over_the_line_just_felt_and_others_is_felt():
    assert hits(Spacing(10e-3, 0, 0.0, 1.0), along(0, [0.015, 0.0201, -0.005, 0.0001])) == [1, 2, 3]
    assert hits(Spacing(10e-3, 0, 0.0, 1.0), along(0, [0.025, 0.0199, 0.045])) == [1, 2]


def test_lines_belong_to_their_axis_only():
    points = [(0.001, 0.001 + k * 1e-3) for k in range(50)]
    assert hits(Spacing(3e-3, 0, 0.0, 1.0), points) == []
    assert len(hits(Spacing(3e-3, 1, 0.0, 1.0), points)) == 16


@each_row("axis", [0, 1, None])
def test_a_spacing_one_percent_off_is_felt_elsewhere(axis):
    points = along(axis, [k * 1e-4 for k in range(2000)])
    right, wrong = (hits(Spacing(spacing_m, axis, 0.0, 1.0), points) for spacing_m in (5e-3, 5.05e-3))
    assert right == [50 * k for k in range(1, 40)]
    assert wrong != right
    assert len(wrong) == 39


@given(st.floats(2e-3, 0.03), st.floats(0.01, 0.5), st.floats(0, 2 * math.pi), st.integers(20, 300))
def test_a_straight_way_is_felt_every_spacing_in_any_direction(spacing_m, length_m, angle, reports):
    step_m = length_m / reports
    assume(step_m < spacing_m)
    points = [(step_m * k * math.cos(angle), step_m * k * math.sin(angle)) for k in range(reports + 1)]
    count = length_m / spacing_m
    assume(abs(count - round(count)) > 1e-3)
    felt = hits(Spacing(spacing_m, None, 0.0, 1.0), points)
    assert len(felt) == math.floor(count)
    for number, report in enumerate(felt, 1):
        assert 0 <= report * step_m - number * spacing_m + 1e-6 <= step_m + 2e-6


@given(st.floats(1e-3, 0.03), st.lists(st.tuples(st.floats(0, 1), st.floats(0, 6.3)), min_size=2, max_size=200))
def test_a_finger_that_trembles_at_rest_goes_no_way(spacing_m, noise):
    rest_m = 0.49 * min(REST_M, spacing_m / 4)
    points = [(0.05 + r * rest_m * math.cos(angle), 0.05 + r * rest_m * math.sin(angle)) for r, angle in noise]
    assert hits(Spacing(spacing_m, None, 0.0, 1.0), points) == []


def test_not_even_a_long_tremble_adds_up_to_a_way():
    for radius_m in (0.12e-3, 0.07e-3):
        points = [(0.05 + radius_m * math.cos(2.4 * k), 0.05 + radius_m * math.sin(2.4 * k)) for k in range(5000)]
        assert hits(Spacing(1e-3, None, 0.0, 1.0), points) == []


@given(
    st.sampled_from([0, 1, None]),
    st.floats(1e-3, 0.03),
    st.floats(0, 0.2),
    st.floats(0, 0.14),
    st.floats(0, 2 * math.pi),
    st.floats(0, 0.9),
)
def test_the_way_to_go_is_the_way_after_which_something_is_felt(axis, spacing_m, x_m, y_m, angle, gone):
    """For a finger that has gone a part of a spacing in one direction and goes on in it."""
    x, y = math.cos(angle), math.sin(angle)
    assume(axis is None or abs((x, y)[axis]) > 1e-3)
    here = x_m + gone * spacing_m * x, y_m + gone * spacing_m * y
    for part, felt in ((0.999, False), (1.001, True)):
        progress = Spacing(spacing_m, axis, 0.01, 1.0).begin(x_m, y_m)
        assume(not progress.crossed(*here))
        to_go_m = progress.remaining_m(*here, x, y)
        across_m = to_go_m * abs((x, y)[axis]) if axis is not None else to_go_m
        assume(across_m > 1e-5)  # a thousandth of it is more than rounding
        assert progress.crossed(here[0] + part * to_go_m * x, here[1] + part * to_go_m * y) == felt


@each_row(("way", "x", "to_go_m"), [([15, 20.1], 1, 9.9), ([15, 20.1], -1, 10.1), ([15, 20.1, 22], -1, 2), ([25, 19.9], 1, 10.1)])
def test_the_line_just_felt_is_not_the_next_one_on_the_way_back(way, x, to_go_m):
    progress = Spacing(10e-3, 0, 0.0, 1.0).begin(way[0] * 1e-3, 0.0)
    for at_mm in way[1:]:
        progress.crossed(at_mm * 1e-3, 0.0)
    assert progress.remaining_m(way[-1] * 1e-3, 0.0, x, 0.0) * 1e3 == pytest.approx(to_go_m, abs=1e-5)


def test_a_finger_that_goes_along_the_lines_never_comes_to_one():
    assert Spacing(0.01, 0, 0.0, 1.0).begin(0.005, 0.005).remaining_m(0.005, 0.005, 0.0, 1.0) == math.inf


def test_the_way_round_a_small_circle_is_its_circumference_within_a_percent():
    radius_m = 4e-3
    points = [(radius_m * math.cos(k / 200), radius_m * math.sin(k / 200)) for k in range(20_000)]
    assert len(hits(Spacing(1e-3, None, 0.0, 1.0), points)) == pytest.approx(0.4 * 1000, rel=0.01)


@each_row(
    ("shape", "lows"),
    [
        (Rectangle(0.02, 0.03, 0.09, 0.1), (0.02, 0.03)),
        (Circle(0.05, 0.06, 0.01), (0.04, 0.05)),
        (Polygon(((0.01, 0.02), (0.2, 0.03), (0.1, 0.14))), (0.01, 0.02)),
    ],
)
def test_lines_begin_at_the_regions_lower_end_moved_by_the_phase(shape, lows):
    for axis, name in enumerate("xy"):
        effect = EffectTable(when="move", spacing_mm=4.0, along=name, phase=0.25, amplitude=0.5)
        assert spacing_of(effect, shape, 0.8) == pytest.approx(Spacing(4e-3, axis, lows[axis] + 1e-3, 0.4))
    assert spacing_of(EffectTable(when="move", spacing_mm=4.0), shape, 1.0).axis is None
