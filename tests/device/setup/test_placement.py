"""Discs along the edge: on the glass, clear of each other, unlike their mirror images; or one line."""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tables import each_row

from controller.device.board.plate.parts import Parts
from controller.device.setup.placement import APART_MM, actuators_around, centres_around
from controller.errors import ConfigError


def centres_or_line(*arguments):
    try:
        return centres_around(*arguments)
    except ConfigError as error:
        return str(error)


@settings(deadline=None, max_examples=60)
@given(st.floats(20, 4000), st.floats(20, 4000), st.floats(5, 60), st.integers(1, 8), st.floats(0, 40))
def test_discs_lie_on_the_glass_and_not_on_each_other(length_mm, width_mm, disc_mm, discs, rim_mm):
    centres = centres_or_line(length_mm, width_mm, disc_mm, discs, rim_mm)
    if isinstance(centres, str):
        assert "do not fit along the edge" in centres
        return
    assert len(centres) == discs
    for index, (x_mm, y_mm) in enumerate(centres):
        edge_mm = min(x_mm, length_mm - x_mm, y_mm, width_mm - y_mm)
        assert edge_mm == pytest.approx(rim_mm + disc_mm / 2, abs=0.011)
        assert all(math.dist((x_mm, y_mm), other) >= disc_mm + APART_MM - 0.03 for other in centres[:index])


@each_row(("length_mm", "width_mm", "discs"), [(217, 136, 7), (217, 136, 8), (210, 148, 8), (150, 70, 6), (150, 150, 4)])
def test_no_disc_is_the_mirror_image_of_another(length_mm, width_mm, discs):
    centres = centres_around(length_mm, width_mm, 12.0, discs, 3.0)
    mirrored = [image for x, y in centres for image in ((length_mm - x, y), (x, width_mm - y))]
    assert min(math.dist(a, b) for a in centres for b in mirrored) > 3


def test_a_glass_as_small_as_a_stamp_is_refused():
    with pytest.raises(ConfigError, match="8 discs of 27 mm do not fit along the edge of 60 × 50 mm of glass, 3 mm from it"):
        centres_around(60, 50, 27, 8, 3)


def test_quadrants_are_a_checkerboard_and_clear_of_each_other():
    parts = Parts(disc="7BB-20-6")
    actuators = actuators_around(217, 136, parts, 7, 3)
    assert [one["channel"] for one in actuators] == list(range(28))
    for disc in range(7):
        quadrants = actuators[4 * disc : 4 * disc + 4]
        assert [one["idle"] for one in quadrants] == [1, 0, 0, 1]
        across = max(one["x_mm"] for one in quadrants) - min(one["x_mm"] for one in quadrants)
        assert quadrants[0]["size_mm"] < across
        assert across + quadrants[0]["size_mm"] <= parts.data.brass_mm
