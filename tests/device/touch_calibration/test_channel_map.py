"""Where channels were felt: swapped, wandered and dead ones are named, others are not."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tables import each_row

from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.device.touch_calibration.channel_map import channel_map
from controller.workshop.physics.responses.impulse_response import ResponseModel

BOARD = load_board(find_board("simulated"))
PLACES = {actuator.channel: (actuator.x_mm * 1e-3, actuator.y_mm * 1e-3) for actuator in BOARD.actuators}


def felt(moved=None, off_m=0.0):
    """Where a finger is on each channel, some of which move the patch of another."""
    moved = moved or {}
    places = {channel: PLACES[moved.get(channel, channel)] for channel in PLACES}
    return {channel: (x_m + off_m, y_m - off_m) for channel, (x_m, y_m) in places.items()}


def test_right_wires_are_right_wherever_on_its_disc_a_finger_was():
    for off_m in (0.0, 6e-3, -6e-3):
        found = channel_map(BOARD, felt(off_m=off_m))
        assert found.wrong == []
        assert [found.felt_at[4 * disc] for disc in range(8)] == list(range(8))
    assert found.discs[1] == [4, 5, 6, 7]


@each_row(
    ("moved", "said"),
    [
        ({7: 8, 8: 7}, ["channels 7 and 8 are swapped"]),
        ({0: 31, 31: 0, 5: 20, 20: 5}, ["channels 0 and 31 are swapped", "channels 5 and 20 are swapped"]),
        ({3: 12}, ["channel 3 moves the disc of channels 12, 13, 14, 15"]),
        ({3: 12, 12: 20, 20: 3}, [f"channel {q} moves the disc of channels" for q in (3, 12, 20)]),
        ({1: 2, 2: 1}, []),
    ],
)
def test_wires_that_are_not_are_named(moved, said):
    wrong = channel_map(BOARD, felt(moved)).wrong
    assert len(wrong) == len(said)
    assert all(line.startswith(start) for line, start in zip(wrong, said, strict=True))


def test_a_channel_that_nobody_felt_is_named():
    found = channel_map(BOARD, felt() | {12: None})
    assert found.wrong == ["channel 12: nothing was felt: a dead stage, wire or patch"]
    assert found.felt_at[12] is None


@settings(deadline=None, max_examples=50)
@given(st.permutations(list(PLACES)))
def test_every_channel_of_any_wiring_is_named_exactly_if_its_disc_is_another(wiring):
    moved = dict(zip(PLACES, wiring, strict=True))
    wrong = channel_map(BOARD, felt(moved)).wrong
    astray = {channel for channel, patch in moved.items() if channel // 4 != patch // 4}
    named = [
        int(word) for line in wrong for word in line.partition(" moves")[0].partition(" are ")[0].replace("and", "").split()[1:]
    ]
    assert sorted(named) == sorted(astray)


def test_a_channel_bulges_its_own_disc_and_hardly_another():
    """What a finger can tell, by the plate's model: any quadrant of its own disc at least five times as much as another disc."""
    model = ResponseModel(BOARD)
    shapes = np.asarray(model.plate_modes.shapes(np.array(list(PLACES.values()))))
    bulge_um = abs(shapes @ (model.step.static[:, None] * model.forces)) * BOARD.driver.supply_v * 1e6
    for channel in PLACES:
        own = bulge_um[4 * (channel // 4) : 4 * (channel // 4) + 4, channel]
        others = np.delete(bulge_um[:, channel], slice(4 * (channel // 4), 4 * (channel // 4) + 4))
        assert bulge_um[channel, channel] == pytest.approx(own.max())
        assert own.min() > 5 * others.max()
