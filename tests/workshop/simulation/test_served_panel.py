"""The fingers of the served panel: as many as were asked for, on the plate, apart, each on a path of its own."""

import itertools
import math

import numpy as np
from tables import each_row

from controller.device.touch.recordings.replay import RecordingSource
from controller.workshop.simulation.served_panel import SWINGS_MM, moving


def samples(board, fingers, seconds=4.0):
    """Touch samples of each report."""
    recording = moving(seconds, fingers)
    source = RecordingSource(recording, recording.axes(board), 0.0)
    reports = []
    while (at_s := source.next_time_s()) is not None:
        reports.append(source.read(at_s))
    return reports


@each_row("fingers", range(1, len(SWINGS_MM) + 1))
def test_they_stay_on_the_plate_and_apart(board, fingers):
    down = {}
    for report in samples(board, fingers):
        down |= {sample.finger: (sample.x_m, sample.y_m) for sample in report if sample.contact}
        assert len(down) == fingers
        low_m, high_m = np.min([*down.values()], axis=0), np.max([*down.values()], axis=0)
        assert (low_m > 5e-3).all()
        assert (high_m < np.array([board.plate.length_m, board.plate.width_m]) - 5e-3).all()
        assert all(math.dist(one, other) > 20e-3 for one, other in itertools.combinations(down.values(), 2))


def test_each_moves(board):
    places = {}
    for report in samples(board, 4):
        for finger, x_m, y_m, _, contact, _ in report:
            if contact:
                places.setdefault(finger, []).append((x_m, y_m))
    assert len(places) == 4
    for path in places.values():
        assert max(math.dist(path[0], place) for place in path) > 15e-3
