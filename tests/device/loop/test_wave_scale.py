"""Distances on the device go with the length of the plate's waves; on the shipped boards they are what they were."""

import msgspec
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from small_plate import small_board
from tables import each_row

from controller.device.bank.file_format import Header, creator
from controller.device.bank.grid import Grid
from controller.device.bank.reader import Bank
from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.device.loop.fixed_emitters import common_period_s
from controller.device.loop.playing.batching import SEPARATION_M, select_batch
from controller.device.scene.emission import Emission
from controller.device.scene.scene import FixedEmitter, load_scene
from controller.device.scene.scene_file import find_scene
from controller.device.waveforms.selection import LATTICE_M, REUSE_RADIUS_M, Selection, lattice_key
from controller.workshop.bank_builder.build import build_bank
from controller.workshop.bank_builder.choice import PITCHES_MM, SNAPS_MM, settings
from controller.workshop.bank_builder.request import BankRequest
from controller.workshop.physics.field import CREST_M, FocusScale
from controller.workshop.physics.plate import wave_scale
from controller.workshop.physics.responses.impulse_response import ResponseModel

BOARD = small_board()


def thicker(times, board=BOARD):
    """Waves are longer by the root of it."""
    return msgspec.structs.replace(board, plate=msgspec.structs.replace(board.plate, thickness_mm=board.plate.thickness_mm * times))


@pytest.fixture(scope="module")
def banks(tmp_path_factory):
    """Of the small board and of one with waves twice as long, with the same fixed emitters."""
    folder = tmp_path_factory.mktemp("banks")
    emitters = [FixedEmitter(0.02, 0.02, 10.0, "a"), FixedEmitter(0.027, 0.02, 10.0, "b")]
    opened = []
    for name, board in (("one", BOARD), ("two", thicker(4))):
        build_bank(BankRequest(board, folder / name, 10e-3, emitters=emitters))
        opened.append(Bank.open(folder / name, board))
    yield opened
    for bank in opened:
        bank.close()


@each_row("name", ["simulated", "ulx3s", "ulx3s_pi5"])
def test_on_the_shipped_boards_nothing_changes(name):
    board = load_board(find_board(name))
    assert wave_scale(board) == 1.0
    assert np.array_equal(FocusScale.of(board).crest_m, CREST_M)


def test_scales_from_a_phone_to_a_floor_are_those_of_the_waves():
    whole = load_board(find_board("simulated"))
    assert wave_scale(thicker(4)) == 2.0
    for band_hz, times in (((40e3, 140e3), 0.5**0.5), ((10e3, 35e3), 2**0.5)):
        waveform = msgspec.structs.replace(whole.waveform, band_low_hz=band_hz[0], band_high_hz=band_hz[1])
        assert wave_scale(msgspec.structs.replace(whole, waveform=waveform)) == pytest.approx(times, rel=4e-3)


def emission(owner, x_m, y_m, amplitude):
    return Emission(0.0, x_m, y_m, None, "r", amplitude, owner)


points = st.tuples(*[st.floats(0, 30e-3)] * 2, st.sampled_from([0.5, 1.0]))


@given(st.lists(points, min_size=2, max_size=8), st.sampled_from([0.25, 0.5, 4.0]))
def test_what_plays_together_is_decided_in_wavelengths(places, scale):
    """Powers of two, by which nothing is rounded."""
    whole = [emission(str(index), *place) for index, place in enumerate(places)]
    scaled = [one._replace(x_m=scale * one.x_m, y_m=scale * one.y_m) for one in whole]
    assert [[one.owner for one in part] for part in select_batch(scaled, 2e-3, wave_scale=scale)] == [
        [one.owner for one in part] for part in select_batch(whole, 2e-3)
    ]


def test_fixed_emitters_that_need_turns_on_a_thick_plate_have_no_common_period():
    emitters = [FixedEmitter(0.06, 0.07, 20.0, "a"), FixedEmitter(0.06 + 1.5 * SEPARATION_M, 0.07, 20.0, "b", 0.5)]
    assert common_period_s(emitters) == 0.05
    assert common_period_s(emitters, 2.0) is None


def test_places_are_rounded_by_the_same_share_of_a_wave(banks):
    one, two = (Selection(bank, -1.0, BOARD.idle_word) for bank in banks)
    assert (one.lattice_m, one.reuse_m) == (LATTICE_M, REUSE_RADIUS_M)
    assert (two.lattice_m, two.reuse_m) == (2 * LATTICE_M, 2 * REUSE_RADIUS_M)
    x_m, y_m = 0.0303, 0.0217
    assert one.key([(x_m / 2, y_m / 2, 1.0)]) == two.key([(x_m, y_m, 1.0)])
    assert one.key([(x_m, y_m, 1.0)]) != two.key([(x_m, y_m, 1.0)])
    near = one.null_key([(0.02, 0.02, 1.0)], [(0.031, 0.02)]), two.null_key([(0.02, 0.02, 1.0)], [(0.031, 0.02)])
    assert [len(key) for key in near] == [2, 1]  # 11 mm are 1.04 wavelengths, and 0.52
    assert two.single_focus(((10, 20, 3),)) == (5e-3, 10e-3, 3)


def test_what_was_composed_beforehand_is_found_by_a_lattice_of_other_waves(banks):
    for bank, scale in zip(banks, (1.0, 2.0), strict=True):
        assert bank.wave_scale == bank.header.parameters["wave_scale"] == scale
        key = Selection(bank, 1e-3, BOARD.idle_word).key([(0.02, 0.02, 1.0), (0.027, 0.02, 1.0)])
        assert key == lattice_key([(0.02, 0.02, 1.0), (0.027, 0.02, 1.0)], scale * LATTICE_M)
        assert list(bank.drive.compositions) == [key]


def test_a_waveform_reused_beside_its_place_loses_as_much_on_a_phone_as_on_the_papers_plate():
    """In the band, with waves of 5.3 mm. By the paper's radius it is four times that: it goes with the square of the distance."""

    def lost(board, beside_m):
        model = ResponseModel(board)
        places = np.random.default_rng(2).uniform([0.015, 0.015], [0.055, 0.035], (16, 2))
        here, beside = (model.drive_order_responses(some, dtype=np.float64) for some in (places, places + np.array([beside_m, 0])))
        reached = (here * np.sign(beside)).sum(axis=(1, 2)) / np.abs(here).sum(axis=(1, 2))
        return float(1 - reached.mean())

    phone = thicker(0.25)
    assert wave_scale(phone) == 0.5
    paper, scaled, unscaled = lost(BOARD, REUSE_RADIUS_M), lost(phone, 0.5 * REUSE_RADIUS_M), lost(phone, REUSE_RADIUS_M)
    print(f"lost beside a place, mean of 16: paper {paper:.4f}, phone {scaled:.4f}, phone with the paper's radius {unscaled:.4f}")
    assert scaled == pytest.approx(paper, rel=0.25)
    assert unscaled > 3 * scaled


def test_a_choice_has_pitches_for_longer_waves():
    whole = load_board(find_board("simulated"))
    board = thicker(16, msgspec.structs.replace(whole, waveform=msgspec.structs.replace(whole.waveform, duration_ms=0.2)))
    found = settings(board, load_scene(find_scene(whole, "keyboard"), board), 5e-3)
    assert {one.pitch_mm for one in found} <= {4 * pitch_mm for pitch_mm in PITCHES_MM}
    assert {one.snap_mm for one in found if one.composes} <= {4 * snap_mm for snap_mm in SNAPS_MM}
    assert max(one.pitch_mm for one in found) > 10


@each_row(("reported", "scale"), [({}, 1.0), ({"wave_scale": 2}, 2.0), ({"wave_scale": 0.5}, 0.5)])
def test_banks_from_before_have_the_lattice_that_they_were_built_with(reported, scale):
    assert header(reported).wave_scale == scale


@each_row("reported", [0, -1.0, 1e9, "2", None, [2]])
def test_a_scale_that_cannot_be_is_not_used(reported):
    assert header({"wave_scale": reported}).wave_scale == 1.0


def header(parameters):
    return Header(creator(), bytes(32), Grid(5e-3, 3, 2, 5e-3, 6e-3), 500e3, 9, 1, parameters)
