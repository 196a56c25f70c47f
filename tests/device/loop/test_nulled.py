"""Fingers that shall feel nothing while another one's effect plays (`nulled`)."""

import numpy as np
import pytest

from controller.device.bank.grid import Grid
from controller.device.bank.reader import Bank
from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.device.kernel.null_twin import RING, SUMS
from controller.device.scene.coverage import cells_needed
from controller.device.scene.scene import load_scene
from controller.device.waveforms.composition import Composer
from controller.device.waveforms.pad import pad_places
from controller.device.waveforms.selection import LATTICE_M, NULL, Selection
from controller.errors import ConfigError
from controller.workshop.bank_builder.build import build_bank
from controller.workshop.bank_builder.methods.prediction import Prediction
from controller.workshop.bank_builder.request import BankRequest
from controller.workshop.physics.responses.impulse_response import ResponseModel

BOARD = load_board(find_board("simulated"))
SCENE = """
[[regions]]
name = "left"
shape = "rectangle"
x_mm = 0.0
y_mm = 0.0
width_mm = 100.0
height_mm = 148.0
{left}
effects = ["click"]

[[regions]]
name = "right"
shape = "plate"
effects = []
"""
PLAYED, RESTING = (90.0, 70.0), (110.0, 78.0)
FINGERS = [(0.0, {0: RESTING}), (0.1, {0: RESTING, 1: PLAYED}), (0.15, {0: RESTING}), (0.2, {0: None})]
PLACES_M = [(0.09, 0.07), (0.11, 0.078)]


@pytest.fixture(scope="module")
def bank_file(tmp_path_factory):
    """Cells of 2.5 mm around both fingers."""
    path = tmp_path_factory.mktemp("bank") / "bank"
    points_m = Grid.of(BOARD.plate, 2.5e-3).points()
    near = np.min([np.hypot(*(points_m - place).T) for place in PLACES_M], axis=0) < 8e-3
    build_bank(BankRequest(BOARD, path, 2.5e-3, near))
    return path


@pytest.fixture(scope="module")
def prediction():
    return Prediction(BOARD, ResponseModel(BOARD))


def words_of(run):
    capture, bit_ticks = run.capture, run.board.bit_ticks
    sampled = int(capture.focus_ticks[0]) - bit_ticks * np.arange(1000, 0, -1)
    return capture.words[np.searchsorted(capture.ticks.astype(np.int64), sampled, side="right") - 1]


def pad_rms_m(prediction, words):
    """What words do to the resting finger's pad of 8 mm within 25 us of T, every 2 mm."""
    across = np.arange(-4e-3, 5e-3, 2e-3)
    pad = [(PLACES_M[1][0] + x_m, PLACES_M[1][1] + y_m) for x_m in across for y_m in across if np.hypot(x_m, y_m) < 4.1e-3]
    return np.sqrt(np.mean(prediction.near_focus(words, pad) ** 2))


def test_what_is_kept_still_is_the_ring_of_a_pad():
    assert np.array(RING) == pytest.approx(np.array(pad_places(0.0, 0.0)[1:]), abs=1e-9)
    assert not np.triu(np.array(SUMS) @ np.array(SUMS).T, 1).any()


def test_a_finger_that_rests_beside_a_click_is_kept_still(perform, bank_file, prediction):
    runs = {key: perform(FINGERS, SCENE.format(left=key), bank=bank_file) for key in ("", 'nulled = "others"')}
    plain, quiet = (words_of(run) for run in runs.values())
    assert [run.counters.kept_still for run in runs.values()] == [0, 1]
    assert [run.counters.foci for run in runs.values()] == [1, 1]

    assert pad_rms_m(prediction, quiet) < pad_rms_m(prediction, plain) / 3
    played = prediction.at_focus(quiet, PLACES_M[:1]) / prediction.at_focus(plain, PLACES_M[:1])
    assert played[0] > 0.96


def test_a_lone_finger_costs_nothing(perform, bank_file):
    alone = [(0.0, {0: PLAYED}), (0.05, {0: None})]
    quiet = perform(alone, SCENE.format(left='nulled = "others"'), bank=bank_file)
    assert quiet.counters.kept_still == 0
    assert np.array_equal(words_of(quiet), words_of(perform(alone, SCENE.format(left=""), bank=bank_file)))


def test_quiet_places_that_the_bank_does_not_know_are_left_out(bank_file):
    with Bank.open(bank_file, BOARD) as bank:
        selection = Selection(bank, 1e-3, BOARD.idle_word)
        point = (*PLACES_M[0], 0.7)
        words = bytes(selection.waveform(selection.null_key([point], [PLACES_M[1]])))
        assert words != bytes(selection.waveform(selection.key([point])))
        assert words == bytes(selection.waveform(selection.null_key([point], [PLACES_M[1], (0.03, 0.03)])))
        nowhere = selection.null_key([point], [(0.03, 0.03)])
        assert bytes(selection.waveform(nowhere)) == bytes(selection.waveform(selection.key([point])))


def test_the_nearest_four_places_are_kept_still_but_none_at_a_focus(bank_file):
    with Bank.open(bank_file, BOARD) as bank:
        selection = Selection(bank, 1e-3, BOARD.idle_word)
        point = (0.1, 0.07, 1.0)
        far = [(0.1 + 0.01 * n, 0.07) for n in (5, 3, 1, 2, 4)]
        key = selection.null_key([point], [*far, (0.104, 0.07)])
        assert key == ((3200, 2240, 0), *[(3200 + 320 * n, 2240, NULL) for n in (1, 2, 3, 4)])
        assert selection.null_key([point], [(0.104, 0.07)]) == selection.key([point])
        assert selection.null_key([point], []) == selection.key([point])


def test_it_is_as_deep_at_half_the_amplitude_and_the_kernel_s_words_are_whole(bank_file, prediction):
    with Bank.open(bank_file, BOARD) as bank:
        composer = Composer(bank, BOARD.idle_word)
        for amplitude in (1.0, 0.5):
            point = (*(round(place / LATTICE_M) * LATTICE_M for place in PLACES_M[0]), amplitude)
            before = np.frombuffer(bytes(composer.compose([point])), "<u4")
            view = composer.compose([point])
            composer.keep_still([point], [(*PLACES_M[1], 1.0)])
            after = np.frombuffer(bytes(view), "<u4")
            moved = [pad_rms_m(prediction, words) for words in (before, after)]
            assert moved[1] < moved[0] / 2.5
            focus = [prediction.at_focus(words, [point[:2]])[0] for words in (before, after)]
            assert focus[1] == pytest.approx(focus[0], rel=0.05), "a whole pad costs 3.5 % at the median"


def test_a_spot_cannot_keep_fingers_still(tmp_path):
    file = tmp_path / "scene.toml"
    file.write_text(SCENE.format(left='nulled = "others"').replace('["click"]', '["always"]'))
    with pytest.raises(ConfigError, match=r"regions\[0\]\.effects\[0\] has when = \"always\" in a region with nulled"):
        load_scene(file, BOARD)


def test_a_scene_with_it_needs_the_cells_of_the_whole_plate(tmp_path):
    file = tmp_path / "scene.toml"
    points_m = np.array([(0.01 * i, 0.01 * j) for j in range(15) for i in range(21)])
    needed = []
    for key in ("", 'nulled = "others"'):
        file.write_text(SCENE.format(left=key))
        needed.append(cells_needed(load_scene(file, BOARD), points_m, 0.01).mean())
    assert needed[0] < needed[1] == 1


def test_its_old_name_is_read_with_a_warning_and_both_are_refused(tmp_path, capsys):
    file = tmp_path / "scene.toml"
    file.write_text(SCENE.format(left='quiet_for = "others"'))
    assert load_scene(file, BOARD).regions[0].nulled
    warning = f"{file}: regions[0].quiet_for is called nulled now; the next version does not know the old name"
    assert capsys.readouterr().err.endswith(f"{warning}\n")
    file.write_text('effects.quiet_for = { when = "press" }\n' + SCENE.format(left="").replace('"click"', '"quiet_for"'))
    load_scene(file, BOARD)
    assert capsys.readouterr().err == "", "a name of the user's choice"
    file.write_text(SCENE.format(left='quiet_for = "others"\nnulled = "others"'))
    with pytest.raises(ConfigError, match="quiet_for and nulled are the same key: leave out quiet_for"):
        load_scene(file, BOARD)
