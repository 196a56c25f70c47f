"""Scenes as files: found, read, accepted up to the limits, refused beyond them."""

import msgspec
import pytest
from device.scene.scenes import BOARD, square
from tables import each_row

from controller.device.scene import scene_file
from controller.device.scene.effects.trains import Train
from controller.device.scene.scene import load_scene
from controller.device.scene.scene_file import find_scene
from controller.errors import ConfigError


@each_row(("rate_hz", "good"), [(500, True), (499.9, False), (499.51, False), (499.5, True), (25, True)])
def test_a_spot_whose_pause_is_shorter_than_a_drive_word_is_refused_before_the_fpga_does(scene_of, rate_hz, good):
    """The FPGA takes T = 160,000 ticks or T + 160 and more, and calls what lies between BAD_PERIOD: above 499.5005 Hz."""
    effect = f'{{ effect = "always", rate_hz = {rate_hz} }}'
    if good:
        scene_of(square(effect))
        return
    said = r"effects\[0\]\.rate_hz = 499\.\d+ leaves [\d.]+ us between emissions, .*: give 500 \(no pause\) or at most 499\.5$"
    with pytest.raises(ConfigError, match=said):
        scene_of(square(effect))


def test_a_period_that_rounding_puts_a_tick_off_the_emission_is_the_emissions():
    waveform = msgspec.structs.replace(BOARD.waveform, bit_clock_hz=333_333.0, duration_ms=3.0)
    board = msgspec.structs.replace(BOARD, waveform=waveform)
    assert board.emission_ticks == 1000 * board.bit_period >> 16 == 240_000
    assert board.period_ticks(1 / 333.333) == 240_000
    assert board.period_ticks(1 / 333.33) == 240_002
    assert BOARD.period_ticks(1 / 500) == BOARD.emission_ticks == 160_000
    assert BOARD.period_ticks(1 / 25) == 3_200_000


@each_row("text", ["", "regions = []", "regions = 3", "not toml", "speed = 3"])
def test_a_file_without_regions_is_refused(tmp_path, text):
    file = tmp_path / "scene.toml"
    file.write_text(text)
    with pytest.raises(ConfigError, match=r"scene\.toml"):
        load_scene(file, BOARD)


def test_the_highest_rate_that_emissions_fit_into_is_accepted(scene_of):
    assert scene_of(square('{ effect = "train", rate_hz = 500, duration_ms = 4 }')).regions[0].press == (Train(1.0, 2, 1 / 500),)


def test_what_reaches_just_to_the_limits_is_accepted_rounding_included(scene_of, tmp_path):
    corner = '{ effect = "always", rate_hz = 5, x_mm = 210, y_mm = 148 }'
    fine = '{ effect = "texture", spacing_mm = 0.1 }'
    assert scene_of(square(corner + "," + fine, "wide", 100.1).replace("width_mm = 40", "width_mm = 109.9")).emitters
    board = msgspec.structs.replace(BOARD, limits=msgspec.structs.replace(BOARD.limits, max_duty=0.7))
    scene_of(square('{ effect = "train", rate_hz = 350, duration_ms = 4 }'))
    assert load_scene(tmp_path / "scene.toml", board).regions[0].press  # 350 Hz × 2 ms is above 0.7 in binary


def test_a_scene_is_found_by_path_or_name_and_an_unknown_one_lists_those_that_exist(tmp_path):
    board = msgspec.structs.replace(BOARD, folder=tmp_path)
    for name in ("board", "scene", "piano"):
        (tmp_path / f"{name}.toml").write_text("")
    assert find_scene(board, "piano") == find_scene(board, "piano.toml") == tmp_path / "piano.toml"
    assert find_scene(BOARD, str(tmp_path / "piano.toml")) == tmp_path / "piano.toml"
    for unknown in ("organ", "board", str(tmp_path)):
        with pytest.raises(ConfigError, match=r"'simulated' has: piano, scene \(or a path\)"):
            find_scene(board, unknown)


def test_thousands_of_regions_are_not_compared_each_with_each(tmp_path, monkeypatch):
    compared = []
    real = scene_file._covers
    monkeypatch.setattr(scene_file, "_covers", lambda *shapes: compared.append(shapes) or real(*shapes))
    file = tmp_path / "many.toml"
    keys = [
        f'[[regions]]\nname = "{x} {y}"\nshape = "rectangle"\nx_mm = {4 * x}\ny_mm = {4 * y}\nwidth_mm = 3\nheight_mm = 3\n'
        'effects = ["click"]\n'
        for x in range(50)
        for y in range(36)
    ]
    file.write_text("".join(keys))
    assert len(load_scene(file, BOARD).regions) == 1800
    assert not compared
    file.write_text("".join(keys) + keys[7].replace("0 7", "again"))
    with pytest.raises(ConfigError, match=r"regions\[1800\] \('again'\) is never felt: regions\[7\] \('0 7'\) covers it"):
        load_scene(file, BOARD)
    assert len(compared) == 1
