"""Where the pulses of a train that begins are put between those of others."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tables import each_row

from controller.device.loop.train_phases import moved_s

PERIOD_S = 20e-3


def distances_s(first_s, others_s, later_s):
    """To the nearest pulse of each other train, before or behind."""
    behind_s = [(first_s + later_s - other_s) % PERIOD_S for other_s in others_s]
    return [min(behind, PERIOD_S - behind) for behind in behind_s]


@each_row(
    ("others_ms", "expected_ms"),
    [
        ([], 0),
        ([4.0], 0),
        ([10.0, 25.0], 0),
        ([1.0], 5),  # behind the pulse that it would be too near to
        ([-1.0], 3),
        ([39.0], 3),
        ([1.0, 5.5], 9.5),  # not between them
        ([1.0, 6.0, 8.0], -8),  # the nearest of two ways there
        ([-3.0, 4.0, 11.0], 4),  # no room for 4 ms anywhere: with the next one
        ([-3.0, 2.0, 7.0, 12.0], 2),
    ],
)
def test_it_takes_the_next_room_or_the_next_train(others_ms, expected_ms):
    later_s = moved_s(1.0, PERIOD_S, [1.0 + other_ms * 1e-3 for other_ms in others_ms], 4e-3)
    assert later_s == pytest.approx(expected_ms * 1e-3, abs=1e-8)


def test_what_is_played_alone_takes_no_other_trains_pulse():
    others_s = [1.0 + other_ms * 1e-3 for other_ms in (-3.0, 4.0, 11.0)]
    assert moved_s(1.0, PERIOD_S, others_s, 4e-3, alone=True) == 0
    assert moved_s(1.0, PERIOD_S, others_s[:2], 4e-3, alone=True) == pytest.approx(8e-3)


@given(
    st.floats(0, 1e3),
    st.lists(st.floats(0, 1e3), max_size=9),
    st.floats(0.1e-3, 15e-3),
)
def test_it_has_time_for_itself_or_is_played_with_another(first_s, others_s, apart_s):
    later_s = moved_s(first_s, PERIOD_S, others_s, apart_s)
    assert abs(later_s) <= PERIOD_S / 2
    found_s, before_s = distances_s(first_s, others_s, later_s), distances_s(first_s, others_s, 0.0)
    if not others_s or all(distance_s >= apart_s for distance_s in before_s):
        assert later_s == 0
    assert all(distance_s >= apart_s - 1e-8 for distance_s in found_s) or min(found_s) < 1e-8
