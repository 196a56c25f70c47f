"""What is said of the time of `calibrate bank`, and that the number of cores changes nothing but it."""

from itertools import count

import numpy as np
import pytest
from small_plate import small_board
from threadpoolctl import threadpool_limits
from workshop.calibration.true_plate import TruePlate

from controller.device.bank.grid import Grid
from controller.workshop.calibration import cores, duration
from controller.workshop.calibration.interpolation import kriging, point_fit, spectra, wave_fit
from controller.workshop.calibration.interpolation.interpolate import interpolate
from controller.workshop.calibration.point_plan import grid_points, scattered_points
from controller.workshop.calibration.recording.simulated_measurement import Flaws, RecordingSettings, simulate_measurement

BOARD = small_board()
PITCH_M = 5e-3
INVERSE = kriging.inverse


def measured(folder, points_m):
    names = tuple(map(str, range(len(points_m))))
    simulate_measurement(folder, BOARD, BOARD, names, points_m, RecordingSettings(record_s=4e-3), Flaws())
    return folder


@pytest.fixture(autouse=True)
def small_matrices():
    with threadpool_limits(1, "blas"):
        yield


def banked(points_m, monkeypatch, number):
    """Responses of two cells by some number of cores, and how often all points were solved for."""
    solved, inverse = [], INVERSE
    for module in (cores, kriging, spectra):
        monkeypatch.setattr(module, "cores", lambda: number)
    for module in (kriging, point_fit):
        monkeypatch.setattr(module, "inverse", lambda matrix: solved.append(len(matrix)) or inverse(matrix))
    plate = TruePlate(BOARD, 2 * BOARD.waveform.duration_ms, edges="free", theory="mindlin")
    source, _ = interpolate(BOARD, plate.learned(points_m))
    return source.entry_responses(np.array([[0.02, 0.02], [0.04, 0.03]])).tobytes(), len(solved)


@pytest.mark.slow
def test_it_counts_the_work_that_is_done_and_any_number_of_cores_does_the_same(tmp_path, monkeypatch):
    """By a clock that shows 1 s more at each look all takes a second. Wavelengths are fitted again if places were."""
    points_m = scattered_points(BOARD, 90, 2e-3)
    folder = measured(tmp_path, points_m)
    found = duration.foreseen(BOARD, folder, PITCH_M, count().__next__)
    one, solves = banked(points_m, monkeypatch, 1)
    assert banked(points_m, monkeypatch, 3) == (one, solves)
    assert found[:3] == (90, solves + wave_fit.SOLVES, len(Grid.of(BOARD.plate, PITCH_M).points()))
    slower = duration.foreseen(BOARD, folder, PITCH_M, count(step=3).__next__)
    assert slower.seconds == pytest.approx(3 * found.seconds)
    assert "90 points" in found.in_words()


@pytest.mark.slow
def test_of_a_whole_grid_wavelengths_alone_are_solved_for(tmp_path, monkeypatch):
    points_m = grid_points(BOARD)
    found = duration.foreseen(BOARD, measured(tmp_path, points_m), PITCH_M, count().__next__)
    assert found.solves == banked(points_m, monkeypatch, 1)[1]


def test_without_a_record_nothing_is_said(tmp_path):
    folder = measured(tmp_path, scattered_points(BOARD, 2, 2e-3))
    for file in (folder / "records").iterdir():
        file.unlink()
    assert duration.foreseen(BOARD, folder, PITCH_M) is None
