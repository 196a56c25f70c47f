"""Which cells of a bank a scene needs."""

import numpy as np
import pytest
from device.scene.scenes import ALWAYS, BOARD, CLICK, ENTER, LEAVE, SHAPES, TEXTURE, TRAIN, fractions, point_in, press_scene, square
from hypothesis import given, settings
from hypothesis import strategies as st
from tables import each_row

from controller.device.bank.grid import Grid
from controller.device.scene.coverage import cells_needed
from controller.device.scene.shapes import Rectangle
from controller.device.waveforms.selection import LATTICE_M


@each_row("shape", SHAPES)
@each_row("pitch_mm", [2.5, 5.0, 13.0])
@settings(max_examples=60)
@given(u=fractions, v=fractions)
def test_every_point_of_a_shape_has_its_four_cells_reached(shape, pitch_mm, u, v):
    grid = Grid.of(BOARD.plate, pitch_mm * 1e-3)
    reached = cells_needed(press_scene(shape), grid.points(), grid.pitch_m)
    point = point_in(shape, u, v)
    if point:
        cells, _ = grid.corners(*point)
        assert all(reached[cell] for cell in cells)


@each_row("shape", SHAPES)
def test_cells_that_no_point_of_a_shape_needs_are_not_reached(shape):
    grid = Grid.of(BOARD.plate, 5e-3)
    reached = cells_needed(press_scene(shape), grid.points(), grid.pitch_m)
    needed = np.zeros(len(reached), bool)
    for u in np.linspace(0, 1, 150):
        for v in np.linspace(0, 1, 150):
            point = point_in(shape, u, v)
            if point:
                needed[list(grid.corners(*point)[0])] = True
    assert not (needed & ~reached).any()
    # Cells that only the slack or the second row of the rim reaches are at most two pitches off.
    points = grid.points()
    for cell in np.flatnonzero(reached & ~needed):
        apart = np.abs(points[needed] - points[cell]).max(axis=1) if needed.any() else np.array([0.0])
        assert apart.min() < 2.1 * grid.pitch_m


@pytest.mark.parametrize("far", [False, True])
def test_a_region_in_a_corner_of_the_plate_reaches_the_four_outermost_cells_only(far):
    grid = Grid.of(BOARD.plate, 5e-3)
    x_m, y_m = (BOARD.plate.length_m - 1e-3, BOARD.plate.width_m - 1e-3) if far else (0.0, 0.0)
    reached = cells_needed(press_scene(Rectangle(x_m, y_m, x_m + 1e-3, y_m + 1e-3)), grid.points(), grid.pitch_m)
    assert set(np.flatnonzero(reached)) == set(grid.corners(x_m, y_m)[0])


@each_row("effect", [CLICK, TRAIN, TEXTURE])
def test_every_effect_of_a_finger_reaches_the_cells_of_its_region(scene_of, effect):
    grid = Grid.of(BOARD.plate, 5e-3)
    asked = np.array([grid.corners(x, y)[0] for x in (0.050, 0.090) for y in (0.050, 0.090)])
    assert cells_needed(scene_of(square(effect)), grid.points(), grid.pitch_m)[asked].all()


def test_a_region_within_one_grid_square_reaches_its_four_cells_only():
    grid = Grid.of(BOARD.plate, 5e-3)
    x_m, y_m = grid.x0_m + 10 * grid.pitch_m, grid.y0_m + 7 * grid.pitch_m
    within = Rectangle(x_m + 0.5e-3, y_m + 0.5e-3, x_m + 4.5e-3, y_m + 4.5e-3)
    reached = cells_needed(press_scene(within), grid.points(), grid.pitch_m)
    assert set(np.flatnonzero(reached)) == set(grid.corners(x_m + 1e-3, y_m + 1e-3)[0])


def test_a_region_that_nearly_touches_the_next_grid_square_reaches_it_because_points_are_rounded():
    grid = Grid.of(BOARD.plate, 5e-3)
    x_m, y_m = grid.x0_m + 10 * grid.pitch_m, grid.y0_m + 7 * grid.pitch_m
    near = Rectangle(x_m + 1e-3, y_m + 1e-3, x_m + grid.pitch_m - LATTICE_M / 3, y_m + grid.pitch_m - LATTICE_M / 3)
    over = grid.corners(near.x_high + LATTICE_M / 2, near.y_high + LATTICE_M / 2)[0]
    assert cells_needed(press_scene(near), grid.points(), grid.pitch_m)[list(over)].all()


@given(u=fractions, v=fractions, dx=st.floats(-1, 1), dy=st.floats(-1, 1), shape=st.sampled_from(SHAPES))
def test_points_rounded_to_the_bank_lattice_are_reached_too(u, v, dx, dy, shape):
    grid = Grid.of(BOARD.plate, 5e-3)
    point = point_in(shape, u, v)
    if point:
        rounded = point[0] + dx * LATTICE_M / 2, point[1] + dy * LATTICE_M / 2
        assert cells_needed(press_scene(shape), grid.points(), grid.pitch_m)[list(grid.corners(*rounded)[0])].all()


def test_what_begins_by_leaving_a_region_may_be_felt_anywhere(scene_of):
    points = Grid.of(BOARD.plate, 5e-3).points()
    assert cells_needed(scene_of(square(LEAVE)), points, 5e-3).all()
    assert not cells_needed(scene_of(square(ENTER)), points, 5e-3).all()


def test_a_margin_reaches_what_a_prediction_may_ask_for(scene_of):
    grid = Grid.of(BOARD.plate, 5e-3)
    scene = scene_of(square(CLICK), square(ALWAYS, "spot", 140))
    near, wide = (cells_needed(scene, grid.points(), grid.pitch_m, margin_m) for margin_m in (0.0, 12e-3))
    asked = list(grid.corners(0.050 - 11.9e-3, 0.090 + 11.9e-3)[0])
    assert wide[asked].all()
    assert not near[asked].all()
    away = np.abs(grid.points() - (0.16, 0.07)).max(axis=1) < 0.02
    assert np.array_equal(near[away], wide[away]), "a fixed emitter is where it is"


def test_fixed_emitters_reach_their_four_cells_and_their_region_none(scene_of):
    scene = scene_of(square(ALWAYS.replace("20", "20, x_mm = 101, y_mm = 71")))
    grid = Grid.of(BOARD.plate, 5e-3)
    reached = cells_needed(scene, grid.points(), grid.pitch_m)
    assert set(np.flatnonzero(reached)) == set(grid.corners(0.101, 0.071)[0])
