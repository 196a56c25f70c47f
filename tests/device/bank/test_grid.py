import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tables import each_row

from controller.device.bank.grid import Grid
from controller.device.board.plate.plate import Plate
from controller.errors import ConfigError


def plate(length_mm: float, width_mm: float) -> Plate:
    return Plate(
        length_mm=length_mm,
        width_mm=width_mm,
        thickness_mm=0.5,
        young_modulus_pa=70e9,
        poisson_ratio=0.2,
        density_kg_m3=2500.0,
        edges="simply_supported",
        decay_time_ms=1.0,
    )


PLATES = st.builds(plate, st.floats(20, 500), st.floats(20, 500))
PITCHES_M = st.floats(1e-3, 10e-3)
PLACES_M = st.floats(-0.1, 0.6)


def test_the_paper_s_plate_at_5_mm_has_41_by_28_cells():
    grid = Grid.of(plate(210, 148), 5e-3)
    assert (grid.nx, grid.ny, grid.cells) == (41, 28, 1148)
    assert (grid.x0_m, grid.y0_m) == pytest.approx((5e-3, 6.5e-3))


def test_a_pitch_that_divides_the_plate_loses_no_cell_to_rounding():
    for parts in range(3, 200):
        assert Grid.of(plate(210, 210), 0.21 / parts).cells == (parts - 1) ** 2


@given(PLATES, PITCHES_M)
def test_cells_keep_one_pitch_from_every_side_and_no_row_more_would_fit(glass, pitch_m):
    grid = Grid.of(glass, pitch_m)
    low, high = grid.points().min(axis=0), grid.points().max(axis=0)
    extent = np.array([glass.length_m, glass.width_m])
    assert (low >= pitch_m * (1 - 1e-8)).all()
    assert low == pytest.approx(extent - high)  # centred
    assert (low < 1.5 * pitch_m).all()


@given(PLATES, PITCHES_M, PLACES_M, PLACES_M)
def test_the_nearest_cell_is_the_nearest_of_all(glass, pitch_m, x_m, y_m):
    grid = Grid.of(glass, pitch_m)
    cell, distance_m = grid.nearest(x_m, y_m)
    every = np.hypot(*(grid.points() - (x_m, y_m)).T)
    assert distance_m == pytest.approx(every[cell])
    assert distance_m <= every.min() + 1e-12
    assert grid.within(x_m, y_m, distance_m + 1e-9) == cell
    assert grid.within(x_m, y_m, distance_m - 1e-9) == -1


@given(PLATES, PITCHES_M, PLACES_M, PLACES_M)
def test_bilinear_weights_rebuild_the_point_or_its_place_on_the_rim(glass, pitch_m, x_m, y_m):
    grid = Grid.of(glass, pitch_m)
    cells, weights = grid.corners(x_m, y_m)
    points = grid.points()
    assert min(weights) >= 0
    assert math.fsum(weights) == pytest.approx(1)
    rebuilt = np.array(weights) @ points[list(cells)]
    assert rebuilt == pytest.approx(np.clip((x_m, y_m), points[0], points[-1]), abs=1e-8)  # a millionth of a pitch
    heaviest = cells[int(np.argmax(weights))]
    assert grid.nearest(*rebuilt)[1] == pytest.approx(np.hypot(*(points[heaviest] - rebuilt)), abs=1e-9)


@given(PLATES, PITCHES_M, st.data())
def test_on_a_cell_no_other_cell_counts(glass, pitch_m, data):
    grid = Grid.of(glass, pitch_m)
    cell = data.draw(st.integers(0, grid.cells - 1))
    cells, weights = grid.corners(*grid.points()[cell])
    assert {c: w for c, w in zip(cells, weights, strict=True) if w} == {cell: 1}


def test_a_single_row_of_cells_has_corners_too():
    grid = Grid.of(plate(210, 20), 10e-3)
    assert grid.ny == 1
    cells, weights = grid.corners(25e-3, 3e-3)
    assert sum(w for c, w in zip(cells, weights, strict=True) if c == 1) == pytest.approx(0.5)
    assert max(cells) < grid.cells


@each_row("pitch_m", [0.0, -1e-3, math.nan, math.inf, 75e-3])
def test_refuses_a_pitch_that_leaves_no_cell(pitch_m):
    with pytest.raises(ConfigError, match="pitch_mm"):
        Grid.of(plate(210, 148), pitch_m)
