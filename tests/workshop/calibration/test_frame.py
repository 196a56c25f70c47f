"""The measuring frame, found from records of a plate with other edges than the direct waves know of: none."""

import msgspec
import numpy as np
import pytest
from small_plate import WHOLE, small_board
from workshop.calibration.true_plate import TruePlate

from controller.workshop.calibration.frame import MIRRORS, MeasuringFrame, middle_m
from controller.workshop.calibration.learning.locating import locate
from controller.workshop.calibration.point_plan import grid_points, scattered_points
from controller.workshop.calibration.transfer_functions.direct_wave import direct_transfer
from controller.workshop.calibration.transfer_functions.transfers import RawBins

SMALL = small_board()
BOARD = msgspec.structs.replace(  # two discs at opposite corners: at one edge they leave scale and wavelength open
    SMALL, actuators=tuple(msgspec.structs.replace(a, y_mm=a.y_mm if a.x_mm < 35 else 50 - a.y_mm) for a in SMALL.actuators)
)
STATED_M = scattered_points(BOARD, 120, 5e-3)
FRAMES = (
    MeasuringFrame(offset_m=(2e-3, -1e-3)),
    MeasuringFrame(rotation=0.03),
    MeasuringFrame("x runs the other way", offset_m=(0.0, 1e-3)),
)


@pytest.fixture(scope="module")
def plate():
    return TruePlate(BOARD, 1.6, edges="free", theory="mindlin")


def located(plate, actual_m, common=1.0, stated_m=STATED_M):
    """From records of 30 dB, all with a factor in common at each frequency."""
    records = plate.learned(actual_m, noise=10**-1.5).responses
    board, bit_clock_hz = plate.board, plate.board.waveform.bit_clock_hz
    bins = RawBins.of(board, plate.samples / bit_clock_hz)
    some = slice(bins.first, bins.first + len(bins.gain))
    turn = np.exp(-2j * np.pi * bins.frequency_hz / bit_clock_hz) / bit_clock_hz
    transfers = np.fft.rfft(records, bins.length, axis=1)[:, some].swapaxes(1, 2) * turn * common
    return locate(board, bins, stated_m, transfers, np.ones((len(stated_m), 32), bool))


@pytest.mark.parametrize("true", FRAMES)
def test_a_frame_is_found_whatever_unit_and_delay_the_records_have(plate, true):
    actual_m = true.places(STATED_M, middle_m(BOARD))
    found = located(plate, actual_m)
    off_mm = 1e3 * np.hypot(*(found.places(STATED_M, middle_m(BOARD)) - actual_m).T)
    print(f"{found.in_words()}: points off by {off_mm.mean():.2f} mm, {off_mm.max():.2f} at most")
    assert found.mirror == true.mirror
    assert found.differs(BOARD, STATED_M)
    assert off_mm.max() < 0.15
    changed = (*found.offset_m, found.rotation, found.scale - 1)
    assert tuple(value != 0 for value in changed) == found.sure, "what the waves leave open is as stated"


@pytest.mark.parametrize(
    ("board", "edges", "stated_m"),
    [
        (SMALL, "free", grid_points(SMALL)),
        (SMALL, "free", scattered_points(SMALL, 110, 3e-3)),
        (SMALL, "simply_supported", grid_points(SMALL)[::4]),
        pytest.param(SMALL, "simply_supported", grid_points(SMALL), marks=pytest.mark.slow),
        pytest.param(BOARD, "simply_supported", grid_points(SMALL), marks=pytest.mark.slow),
    ],
)
def test_echoes_feign_no_frame(board, edges, stated_m):
    """They made -5 % of scale at 16 standard deviations, 1.3 degrees, and half a millimetre, on regular points or with all discs
    at one edge."""
    theory = "kirchhoff" if edges == "simply_supported" else "mindlin"
    found = located(TruePlate(board, 4.0, edges=edges, theory=theory), stated_m, stated_m=stated_m)
    print(found.in_words())
    assert found.places(stated_m, middle_m(board)) == pytest.approx(stated_m)
    if edges == "simply_supported" and board is SMALL:
        assert found.scale_error > 0.03
        assert "scale as stated: the waves do not tell it" in found.in_words()


def test_direct_waves_alone_give_the_frame_to_a_tenth_of_a_millimetre():
    """On the paper's plate, under four times as much of something else; 1 % of scale would be a millimetre."""
    random, bins = np.random.default_rng(3), RawBins.of(WHOLE, 2e-3)
    stated_m = random.uniform(0.02, 0.98, (100, 2)) * 2 * middle_m(WHOLE)
    true = MeasuringFrame("y runs the other way", (-1.5e-3, 3e-3), rotation=-0.02, scale=1.015)
    actual_m = true.places(stated_m, middle_m(WHOLE))
    waves = direct_transfer(WHOLE, bins, actual_m, 1.01)
    other = random.standard_normal((2, *waves.shape)) * np.abs(waves).std(axis=2, keepdims=True) * 4
    transfers = np.zeros((100, 32, len(bins.gain)), np.complex64)
    transfers[:, [a.channel for a in WHOLE.actuators]] = waves + other[0] + 1j * other[1]
    found = locate(WHOLE, bins, stated_m, transfers, np.ones((100, 32), bool))
    print(found.in_words())
    assert found.mirror == true.mirror
    assert np.hypot(*(found.places(stated_m, middle_m(WHOLE)) - actual_m).T).max() < 0.15e-3
    assert abs(found.scale - true.scale) < 4 * found.scale_error < 0.01


def test_points_that_lie_where_they_are_stated_stay_there(plate):
    found = located(plate, STATED_M)
    print(found.in_words())
    assert not found.differs(BOARD, STATED_M)
    assert found.places(STATED_M, middle_m(BOARD)) == pytest.approx(STATED_M, abs=1e-12)


def test_records_without_direct_waves_have_no_frame(plate):
    shuffled = np.random.default_rng(2).permutation(STATED_M)
    assert located(plate, shuffled) is None
    assert located(plate, STATED_M[:15], stated_m=STATED_M[:15]) is None


def test_mirrors_are_all_turns_of_a_rectangle():
    assert len({tuple(np.ravel(matrix)) for matrix in MIRRORS.values()}) == 8
    assert all(abs(np.linalg.det(matrix)) == 1 for matrix in MIRRORS.values())
