"""Where discs stand: what it changes of foci on the paper's plate, and what it does not.

`pytest -m slow -rP tests/workshop/physics/test_placement.py` prints the table of the README.
"""

import msgspec
import numpy as np
import pytest

from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.workshop.benchmark.focus.focus_figures import random_points, single_foci
from controller.workshop.physics.responses.impulse_response import ResponseModel

pytestmark = pytest.mark.slow
BOARD = load_board(find_board("simulated"))
POINTS = 10
CLEAR_M = 15e-3  # of a point from every disc

PLACES_MM = {
    "as the paper's": [(29, 15), (93, 15), (157, 15), (195, 64), (171, 133), (109, 133), (47, 133), (15, 79)],
    "mirrored pairs": [(40, 15), (170, 15), (40, 133), (170, 133), (15, 50), (195, 50), (15, 98), (195, 98)],
    "along one side": [(15 + 25.7 * n, 15) for n in range(8)],
    "in one corner": [(15 + 14 * (n % 4), 15 + 14 * (n // 4)) for n in range(8)],
    "2 mm from the edges": [(29, 7), (93, 7), (157, 7), (203, 64), (171, 141), (109, 141), (47, 141), (7, 79)],
    "five of them": [(29, 15), (157, 15), (195, 64), (109, 133), (15, 79)],
}


def with_discs(centres_mm):
    """The board with discs of four quadrants, idling as a checkerboard."""
    patches = [
        msgspec.structs.replace(
            BOARD.actuators[0], channel=4 * disc + index, x_mm=x + 2.5 * right, y_mm=y + 2.5 * up, idle=right == up
        )
        for disc, (x, y) in enumerate(centres_mm)
        for index, (right, up) in enumerate([(-1, -1), (1, -1), (-1, 1), (1, 1)])
    ]
    return msgspec.structs.replace(BOARD, actuators=tuple(msgspec.structs.replace(one, idle=int(one.idle)) for one in patches))


def test_corners_and_symmetry_cost_little_and_channels_count():
    points = random_points(BOARD, 3, 400)
    discs = np.array([place for places in PLACES_MM.values() for place in places]) * 1e-3
    points = points[np.linalg.norm(points[:, None] - discs, axis=2).min(axis=1) > CLEAR_M][:POINTS]
    assert len(points) == POINTS
    found = {}
    for name, places in PLACES_MM.items():
        board = with_discs(places)
        figures = single_foci(board, ResponseModel(board), points)
        found[name] = {key: figures[key]["median"] for key in ("amplitude_um", "contrast_all", "contrast", "spot_mm")}
        print(f"{name:>20}: " + ", ".join(f"{key} {value:.3g}" for key, value in found[name].items()))
    papers = found["as the paper's"]
    for name in ("mirrored pairs", "along one side", "in one corner"):
        assert found[name]["contrast_all"] == pytest.approx(papers["contrast_all"], rel=0.25)
    assert found["five of them"]["amplitude_um"] == pytest.approx(5 / 8 * papers["amplitude_um"], rel=0.1)
