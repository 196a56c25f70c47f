"""Why two foci are one place, apart, or take turns: what each of them gets of what it would get alone."""

import numpy as np
import pytest

from controller.loop.batching import MERGE_RADIUS_M, SEPARATION_M
from controller.physics.impulse_response import ResponseModel


@pytest.fixture(scope="module")
def shares(board):
    """Median over pairs of the worse focus's share, by distance in mm."""
    model, rng = ResponseModel(board), np.random.default_rng(1)
    margin_m = 0.03
    places = rng.uniform([margin_m] * 2, [board.plate.length_m - margin_m, board.plate.width_m - margin_m], (6, 2))
    angles = rng.uniform(0, 2 * np.pi, 6)

    def worse(apart_m):
        found = []
        for place, angle in zip(places, angles, strict=True):
            half = apart_m / 2 * np.array([np.cos(angle), np.sin(angle)])
            responses = model.drive_order_responses(np.array([place - half, place + half]), dtype=np.float64)
            alone = np.abs(responses).sum((1, 2))
            signs = np.sign((responses / alone[:, None, None]).sum(0))
            found.append(((signs * responses).sum((1, 2)) / alone).min())
        return float(np.median(found))

    return worse


def test_foci_within_the_merge_radius_and_beyond_the_separation_keep_their_amplitude(shares):
    far = shares(0.04)
    assert shares(MERGE_RADIUS_M) > 0.87
    assert shares(SEPARATION_M) > 0.85 * far


def test_foci_between_merge_radius_and_separation_weaken_each_other(shares):
    assert shares(0.9 * SEPARATION_M) < 0.85 * shares(0.04)
    assert shares(7e-3) < 0.6
    assert shares(1.6 * MERGE_RADIUS_M) < 0.8
