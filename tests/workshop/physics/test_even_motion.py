"""Motion at evenly spaced times is that of `motion`, whatever the steps; and kept modes give the same."""

import numpy as np
import pytest
from small_plate import small_board

from controller.workshop.physics import even_motion
from controller.workshop.physics.even_motion import EvenMotion
from controller.workshop.physics.modes.plate_modes import modes_of
from controller.workshop.physics.motion import PlateMotion


@pytest.mark.parametrize("quantity", ["m", "m/s", "m/s^2"])
def test_it_moves_as_the_exact_motion_does(quantity, monkeypatch):
    board = small_board()
    plate, random = PlateMotion(board, modes_of(board)), np.random.default_rng(1)
    step_s = np.sort(np.append(random.uniform(0, 1.5e-3, 39), 117 / 192e3))  # one at a time of a sample, by which it is heard
    steps_v = 60.0 * random.integers(-1, 2, (40, 32))
    places_m = np.array([[0.02, 0.01], [0.031, 0.027]])
    exact = plate.of_points(places_m, step_s, steps_v[:, :, None], np.arange(400) / 192e3, quantity)[:, 0]
    some = np.sort(random.choice(400, 200, replace=False))
    uneven = plate.of_points(places_m, step_s, steps_v[:, :, None], some / 192e3, quantity)[:, 0]
    assert np.abs(uneven - exact[:, some]).max() < 1e-5 * np.abs(exact).max()
    for kept_bytes in (1 << 30, 0):
        monkeypatch.setattr(even_motion, "KEPT_BYTES", kept_bytes)
        even = EvenMotion(plate, step_s, steps_v, 1 / 192e3, 400, quantity)
        for _ in range(2):
            found = np.stack([even.of_point(place_m) for place_m in places_m])
            assert np.abs(found - exact).max() < 1e-5 * np.abs(exact).max()
    late = EvenMotion(plate, step_s + 0.02e-6, steps_v, 1 / 192e3, 400, quantity).of_point(places_m[0])
    assert np.abs(late - exact[0]).max() > 1e-4 * np.abs(exact).max(), "a shift by a fiftieth of a microsecond shows"
