"""A plate that two FPGAs drive is measured as one: what is recorded, learned and built is as of the same patches on one FPGA."""

import msgspec
import numpy as np
import pytest
from small_plate import small_board
from workshop.calibration.true_plate import TruePlate

from controller.clocks import VirtualClock
from controller.device.bank import packing
from controller.device.bank.grid import Grid
from controller.device.bank.reader import Bank
from controller.device.board.devices import LinkedFpga
from controller.device.service.drivers import open_session
from controller.errors import CalibrationError
from controller.workshop.bank_builder.own_bank import Order
from controller.workshop.calibration.interpolation.interpolate import interpolate
from controller.workshop.calibration.learning.learning import learn
from controller.workshop.calibration.point_plan import scattered_points
from controller.workshop.calibration.recording.excitation import drive_words
from controller.workshop.calibration.recording.in_place import Excitation, InPlace
from controller.workshop.calibration.recording.simulated_measurement import Flaws, RecordingSettings, simulate_measurement
from controller.workshop.calibration.recording.simulated_recorder import SimulatedRecorder
from controller.workshop.calibration.records.measurement_file import NAME
from controller.workshop.calibration.records.measurements import read_measurement
from controller.workshop.gateware.wired_fpgas import open_simulated_panel

HALF = 4  # channels of each disc


def panel(fpgas):
    """Two discs, the second of which two FPGAs leave to the second."""
    board = small_board()
    board = msgspec.structs.replace(board, plate=msgspec.structs.replace(board.plate, decay_time_ms=0.3))
    patches = tuple(
        msgspec.structs.replace(patch, channel=n + (32 - HALF) * (fpgas > 1 and n >= HALF))
        for n, patch in enumerate(board.actuators)
    )
    link = msgspec.structs.replace(board.link, fpga=(LinkedFpga(),) * fpgas if fpgas > 1 else ())
    return msgspec.structs.replace(board, actuators=patches, link=link)


ONE, TWO = panel(1), panel(2)
CHANNELS = [*range(HALF), *range(32, 32 + HALF)]


def measured_in_place(board):
    """Records of a point by a patch of each disc: (emission, repetition, sample)."""
    board = msgspec.structs.replace(board, actuators=(board.actuators[0], board.actuators[-1]))
    clock = VirtualClock()
    link = open_simulated_panel(board, clock.now_s)
    sync = board.actuators[-1].channel  # of the second FPGA
    recorder = SimulatedRecorder(board, link, clock.now_s, 250e3, "m/s", sync)
    recorder.place_m = np.array([0.03, 0.02])
    session = open_session(link, board, clock.now_s)
    return InPlace(session, board, clock, recorder, Excitation(drive_words(board), 1, 4e-3, 2.2e-3), sync).measure()


def test_a_point_is_recorded_as_with_one():
    one, two = measured_in_place(ONE), measured_in_place(TWO)
    assert two.shape == one.shape == (2, 1, 600)
    assert np.sqrt(np.mean((two - one) ** 2) / np.mean(one**2)) < 0.01, "a hundredth of a sample of misalignment"


@pytest.fixture(scope="module")
def folders(tmp_path_factory):
    points_m = scattered_points(ONE, 40, 2e-3)
    names = tuple(str(n) for n in range(len(points_m)))
    made = [tmp_path_factory.mktemp("measured") / str(fpgas) for fpgas in (1, 2)]
    for folder, board in zip(made, (ONE, TWO), strict=True):
        simulate_measurement(folder, board, board, names, points_m, RecordingSettings(record_s=3e-3), Flaws(snr_db=60.0))
    return made


def test_the_responses_of_each_channel_are_those_of_the_same_patch(folders):
    one, two = (learn(folder, board).responses for folder, board in zip(folders, (ONE, TWO), strict=True))
    assert not two.responses[:, :, HALF:32].any()
    assert not two.known[:, HALF:32].any()
    error = two.responses[:, :, CHANNELS] - one.responses[:, :, : 2 * HALF]
    assert np.sqrt(np.mean(error**2) / np.mean(one.responses[:, :, : 2 * HALF] ** 2)) < 0.02, "noise of 60 dB"


def test_a_bank_of_measurements_has_a_file_of_the_channels_of_each(tmp_path):
    true = TruePlate(TWO, 1.0)
    source, _ = interpolate(TWO, true.learned(scattered_points(TWO, 60, 2e-3)))
    cells = np.zeros(Grid.of(TWO.plate, 4e-3).cells, bool)
    cells[[70, 71, 90]] = True
    Order(TWO, 4e-3).build(tmp_path / "b.bank", cells, source=source, progress=False)
    with Bank.open(tmp_path / "b.bank", TWO) as bank:
        for number, (one, board) in enumerate(zip((bank, *bank.others), TWO.fpga_boards, strict=True)):
            assert one.header.provenance.kind == "measured"
            place = np.array(bank.grid.place(71))
            own = source.drive_order_responses([place])[0, :, 32 * number : 32 * number + 32]
            words = np.frombuffer(one.drive.words(71), "<u4")
            assert words.tolist() == packing.drive_words(np.ascontiguousarray(own), board.idle_word).tolist()


def test_an_idle_word_of_one_fpga_is_refused_in_a_line(folders):
    file = folders[1] / NAME
    text = file.read_text()
    assert text.count("idle_word = [") == 1
    file.write_text(text.replace("idle_word = [", "idle_word = 5 # ["))
    try:
        with pytest.raises(CalibrationError, match="are not of the 2 FPGAs of board 'simulated'") as caught:
            read_measurement(folders[1], TWO)
        assert "\n" not in str(caught.value)
    finally:
        file.write_text(text)


def test_words_of_one_fpga_are_not_those_of_two(folders):
    for folder, board in zip(folders, (TWO, ONE), strict=True):
        with pytest.raises(CalibrationError, match="drive words"):
            read_measurement(folder, board)
