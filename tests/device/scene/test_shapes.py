"""Shapes: which points they contain, which boxes they meet, which polygons are none."""

import math

import numpy as np
import pytest
from device.scene.scenes import SHAPES, fractions
from hypothesis import given
from hypothesis import strategies as st
from tables import each_row

from controller.device.scene import shapes
from controller.device.scene.shapes import Boxes, Circle, Polygon, Rectangle


@given(st.floats(0, 0.2), st.floats(0, 0.14), st.floats(1e-4, 0.05), fractions, fractions, st.sampled_from(SHAPES))
def test_a_box_that_holds_a_point_of_a_shape_meets_it(x, y, size, u, v, shape):
    box = Boxes(*(np.array([value]) for value in (x, x + size, y, y + size)))
    inside = shape.contains(x + u * size, y + v * size)
    assert shape.meets(box)[0] or not inside


def test_the_rim_belongs_to_rectangles_and_circles():
    corners, poles = [(1, 2), (3, 2), (1, 5), (3, 5)], [(0, 2), (4, 2), (2, 0), (2, 4)]
    assert all(Rectangle(1, 2, 3, 5).contains(*corner) for corner in corners)
    assert all(Circle(2, 2, 2).contains(*pole) for pole in poles)


def test_a_polygon_contains_what_its_picture_shows():
    corner = Polygon(((0, 0), (4, 0), (4, 1), (1, 1), (1, 4), (0, 4)))
    assert [corner.contains(*p) for p in [(0.5, 3), (3, 0.5), (2, 2), (-1, 0.5), (5, 0.5), (0.5, 0.5)]] == [1, 1, 0, 0, 0, 1]
    assert corner.centre == pytest.approx((9.5 / 7, 9.5 / 7))
    assert Polygon(corner.corners[::-1]).centre == pytest.approx(corner.centre)


@each_row(
    "corners",
    [
        [(0, 0), (2, 2), (2, 0), (0, 2)],  # a bow
        [(0, 0), (2, 0), (1, 0), (1, 1)],  # folded back
        [(0, 0), (2, 0), (2, 0), (1, 1)],  # a corner twice
        [(0, 0), (1, 0), (2, 0)],  # no area
        [(0, 0), (4, 0), (4, 4), (2, 0), (0, 4)],  # a corner on an edge
        [(0, 0), (3 * 0.1, 3 * 0.7), (-1.8, 2.4), (0.1, 0.7), (-2.1, 0.3)],  # a corner on an edge but for rounding
        [(1, 1), (1, 1), (1, 1)],  # one point
        [(0, 0), (2, 0), (1, 1), (2, 2), (0, 2), (1, 1)],  # two parts that meet in a point
    ],
)
def test_crossing_outlines_are_found(corners):
    for turn in range(len(corners)):
        assert Polygon((*corners[turn:], *corners[:turn])).crossing()


@given(st.integers(3, 12), st.floats(0.2, 1), st.floats(0, 6.28))
def test_stars_do_not_cross(count, depth, angle):
    corners = [
        (math.cos(angle + math.pi * k / count) * r, math.sin(angle + math.pi * k / count) * r)
        for k in range(2 * count)
        for r in [1 if k % 2 else depth]
    ]
    star = Polygon(tuple(corners))
    assert star.crossing() is None
    assert star.contains(0, 0)
    assert star.centre == pytest.approx((0, 0), abs=1e-9)


def test_edges_of_a_polygon_that_are_far_apart_are_not_compared(monkeypatch):
    compared = []
    real = shapes._touch
    monkeypatch.setattr(shapes, "_touch", lambda *ends: compared.append(ends) or real(*ends))
    corners = [(math.cos(2 * math.pi * turn / 1000), math.sin(2 * math.pi * turn / 1000)) for turn in range(1000)]
    assert Polygon(tuple(corners)).crossing() is None
    assert len(compared) < 4000, "of half a million pairs"


CORNERS = st.lists(st.tuples(st.integers(0, 6), st.integers(0, 6)), min_size=3, max_size=7)


@given(CORNERS, st.sampled_from([1.0, 0.1, 1 / 3]))
def test_a_crossing_is_found_as_by_comparing_each_edge_with_each(corners, scale):
    polygon = Polygon(tuple((x * scale, y * scale) for x, y in corners))
    edges, last = polygon.edges(), len(corners) - 1
    pairs = [(i, j) for i in range(len(edges)) for j in range(i + 1, len(edges))]
    touching = (
        (i, j)
        for i, j in pairs
        if (shapes._folded_back if j == i + 1 or (i, j) == (0, last) else shapes._touch)(*edges[i], *edges[j])
    )
    assert polygon.crossing() == next(touching, None)


@given(CORNERS, st.lists(st.tuples(st.integers(-1, 14), st.integers(-1, 14)), min_size=1))
def test_many_points_are_found_in_a_polygon_as_one_by_one(corners, points):
    polygon = Polygon(tuple((x / 3, y / 3) for x, y in corners))
    x, y = np.array(points, float).T / 6
    assert polygon._contain(x, y).tolist() == [polygon.contains(*point) for point in zip(x.tolist(), y.tolist(), strict=True)]
