"""Why near foci are played together, and which are not: what each of them gets of what it would get alone."""

import numpy as np
import pytest

from controller.device.loop.playing.batching import MERGE_RADIUS_M, SEPARATION_M
from controller.workshop.physics.focusing import balanced_weights
from controller.workshop.physics.responses.impulse_response import ResponseModel

AWAY_M = 0.03  # from the sides


@pytest.fixture(scope="module")
def model(board):
    return ResponseModel(board)


@pytest.fixture(scope="module")
def centres(board):
    random = np.random.default_rng(1)
    return random.uniform([AWAY_M] * 2, [board.plate.length_m - AWAY_M, board.plate.width_m - AWAY_M], (6, 2)), random.uniform(
        0, 7, 6
    )


@pytest.fixture(scope="module")
def worst_share(model, centres):
    """Of foci around some places: the least that one of them gets when they are composed exactly."""

    def least(pattern_m):
        found = []
        for place, angle in zip(*centres, strict=True):
            turned = np.array(pattern_m) @ [[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]]
            responses = model.drive_order_responses(place + turned, dtype=np.float64)
            flat = responses.reshape(len(responses), -1)
            found.append(np.abs(flat @ np.sign(balanced_weights(responses) @ flat) / np.abs(flat).sum(1)).min())
        return min(found)

    return least


def pair(apart_m):
    return [(-apart_m / 2, 0), (apart_m / 2, 0)]


def lattice(columns, rows, apart_m):
    return [((x - (columns - 1) / 2) * apart_m, (y - (rows - 1) / 2) * apart_m) for x in range(columns) for y in range(rows)]


def test_two_foci_at_any_distance_get_nearly_what_two_far_ones_get(worst_share):
    far = worst_share(pair(0.04))
    assert far > 0.7
    for apart_m in (MERGE_RADIUS_M, SEPARATION_M, 5e-3, 7e-3, 9e-3):
        assert worst_share(pair(apart_m)) > 0.92 * far


def test_so_do_small_groups_but_not_crowds(worst_share):
    far = worst_share(lattice(2, 2, 0.03))
    assert worst_share(lattice(2, 2, 5e-3)) > 0.9 * far
    assert worst_share(lattice(3, 2, 3e-3)) < 0.5 * far


def test_foci_nearer_than_the_separation_cannot_have_unlike_amplitudes(model, centres):
    """One of them alone already moves the other by more than a quarter."""
    for apart_m, moves in ((0.86 * SEPARATION_M, True), (1.3 * SEPARATION_M, False)):
        responses = model.drive_order_responses(centres[0][0] + pair(apart_m), dtype=np.float64)
        alone = np.sum(np.sign(responses[0]) * responses[1]) / np.abs(responses[1]).sum()
        assert (alone > 0.25) == moves
