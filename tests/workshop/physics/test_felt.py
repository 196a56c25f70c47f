"""What a finger feels: against plates with the finger in their matrices, pads summed over a fine grid, the filter by its sum."""

import dataclasses

import numpy as np
import pytest
from small_plate import WHOLE, small_board
from tables import each_row
from workshop.physics.loaded_plate import stepped

from controller.workshop.physics.felt import (
    DETECTION_UM,
    LIGHT_TOUCH,
    ONE_NEWTON,
    FeltLoad,
    felt_amplitudes_um,
    felt_crosstalk,
    felt_in_words,
)
from controller.workshop.physics.focusing import focus
from controller.workshop.physics.modes.plate_modes import modes_of
from controller.workshop.physics.responses.impulse_response import ResponseModel

BOARD = small_board()
MODES = modes_of(BOARD, 60e3)
FOCUS_M, OTHER_M, RIM_M = (0.031, 0.022), (0.052, 0.037), (0.002, 0.02)


@pytest.fixture(scope="module")
def words():
    return focus(ResponseModel(BOARD).drive_order_responses([FOCUS_M], dtype=np.float64), [1.0], BOARD.idle_word)


def reference_um(words, fingers_m, load):
    """The definition, word by word: u by steps in time, pads as sums over a grid of 0.1 mm, the filter as a sum over the past."""
    radius_m, shapes = load.pad_mm / 2e3, []
    steps_m = (np.arange(-40, 41)) * radius_m / 40
    x, y = (grid.ravel() for grid in np.meshgrid(steps_m, steps_m))
    pressure = np.maximum(1 - (x**2 + y**2) / radius_m**2, 0)
    pressure /= pressure.sum()
    for x_m, y_m in fingers_m:
        on_plate = (x_m + x >= 0) & (x_m + x <= 0.07) & (y_m + y >= 0) & (y_m + y <= 0.05)
        places = np.column_stack([x_m + x, y_m + y])[on_plate]
        shapes.append(pressure[on_plate] @ MODES.shapes(places))
    moved = stepped(BOARD, MODES, words, shapes, dict.fromkeys(range(len(fingers_m)), load), 101)
    felt = []
    for now in range(300, 501):  # T is 400
        ago_s = (now - np.arange(now + 1)) * 2e-6
        felt.append(np.sqrt(2 * np.exp(-ago_s / 1e-4) @ moved[: now + 1] ** 2 * (1 - np.exp(-2e-6 / 1e-4))))
    return np.max(felt, axis=0) * 1e6


@each_row(
    ("fingers_m", "load"),
    [([FOCUS_M], LIGHT_TOUCH), ([FOCUS_M, OTHER_M], ONE_NEWTON), ([RIM_M, FOCUS_M], FeltLoad(4e-5, 3.0, 5e5, 6.0))],
    ids=["light", "two at 1 N", "pad over the edge"],
)
def test_felt_amplitude_is_its_definition(words, fingers_m, load):
    exact = reference_um(words, fingers_m, load)
    found = felt_amplitudes_um(BOARD, MODES, words, fingers_m, load)
    print(f"felt {found} um, largest difference {abs(found / exact - 1).max():.1e}")
    assert found == pytest.approx(exact, rel=2e-3)
    for wrong in (1.01 * load.mass_kg, 0.99 * load.mass_kg):
        other = felt_amplitudes_um(BOARD, MODES, words, fingers_m, dataclasses.replace(load, mass_kg=wrong))
        assert other[-1 if fingers_m[0] == RIM_M else 0] != pytest.approx(exact[-1 if fingers_m[0] == RIM_M else 0], rel=2e-3)


def test_crosstalk_is_what_others_feel_with_their_fingers_on_the_plate(words):
    meant, *others = reference_um(words, [FOCUS_M, OTHER_M, (0.015, 0.04)], LIGHT_TOUCH)
    assert felt_crosstalk(BOARD, MODES, words, FOCUS_M, [OTHER_M, (0.015, 0.04)]) == pytest.approx(others / meant, rel=5e-3)


def test_a_pad_without_extent_and_weight_is_a_point_of_the_bare_plate(words):
    point, small = (felt_amplitudes_um(BOARD, MODES, words, [FOCUS_M], FeltLoad(0.0, pad_mm=pad_mm)) for pad_mm in (0.0, 0.01))
    assert point == pytest.approx(small, rel=1e-4)
    assert felt_amplitudes_um(BOARD, MODES, words, [FOCUS_M], FeltLoad(0.0, pad_mm=8.0)) < 0.9 * point


@each_row(("felt_um", "said"), [(0.05, "not felt"), (DETECTION_UM[0], "may be felt"), (DETECTION_UM[1], "felt"), (9.0, "felt")])
def test_the_band_of_detection(felt_um, said):
    assert felt_in_words(felt_um) == said


@pytest.mark.slow
def test_the_upper_edge_of_the_band_is_the_papers_panel_at_1_n():
    places = np.random.default_rng(1).uniform((0.03, 0.03), (0.18, 0.118), (5, 2))
    model = ResponseModel(WHOLE)
    felt = []
    for place in places:
        emission = focus(model.drive_order_responses(place, dtype=np.float64), [1.0], WHOLE.idle_word)
        felt.extend(felt_amplitudes_um(WHOLE, model.plate_modes, emission, [place], ONE_NEWTON))
    print(f"the paper's panel at 1 N: felt amplitude {np.median(felt):.3f} um")
    assert np.median(felt) == pytest.approx(DETECTION_UM[1], rel=0.02)
