"""Where the screen lies on the plate: what is taken, kept over restarts, greeted with, and what is refused."""

import json
import math
import os

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tables import each_row

from controller.device.page.screen import Screen, ScreenPlace
from controller.device.page.settings import PageSettings

PLACE = {"x_mm_from_pixels": [0.11, 0.001, 3.0], "y_mm_from_pixels": [0.001, -0.12, 140.0]}
SCREEN = {"kind": "screen", "id": 1, **PLACE}


def turned(degrees, pixel_mm=0.1):
    cosine, sine = (pixel_mm * f(math.radians(degrees)) for f in (math.cos, math.sin))
    return {"x_mm_from_pixels": [cosine, sine, 0.0], "y_mm_from_pixels": [sine, -cosine, 0.0]}


def test_what_is_kept_is_in_force_at_once_and_after_a_restart(tmp_path):
    file, called = tmp_path / "made" / "screen.json", []
    screen = Screen(PageSettings(), file)
    assert screen.place is None
    forget = screen.watch(lambda: called.append(1))
    assert screen.keep(SCREEN) == ""
    forget()
    assert screen.keep(SCREEN | turned(90)) == ""
    assert called == [1]
    assert Screen(PageSettings(), file).place == screen.place == msgspec.convert(turned(90), ScreenPlace)


def test_what_the_settings_say_wins(tmp_path):
    given_there = PageSettings(x_mm_from_pixels=(0.1, 0.0, 0.0), y_mm_from_pixels=(0.0, -0.1, 148.0))
    Screen(PageSettings(), tmp_path / "screen.json").keep(SCREEN)
    screen = Screen(given_there, tmp_path / "screen.json")
    assert screen.place.x_mm_from_pixels == (0.1, 0.0, 0.0)
    assert "settings say where the screen lies" in screen.keep(SCREEN)


@each_row(
    ("changed", "reason"),
    [
        ({"x_mm_from_pixels": [0.1, 0.0]}, "Expected `array` of length 3"),
        ({"x_mm_from_pixels": None}, "Expected `array`, got `null`"),
        ({"x_mm_from_pixels": [0.1, "0", 0.0]}, "Expected `float`, got `str`"),
        ({"more": 1}, "unknown field `more`"),
        ({"x_mm_from_pixels": [math.nan, 0.0, 0.0]}, "must be finite numbers"),
        ({"x_mm_from_pixels": [0.1, 0.0, math.inf]}, "must be finite numbers"),
        ({"x_mm_from_pixels": [0.1, 0.0, 20_000.0]}, "more than 10000 mm off"),
        (turned(0, 0.001), "0.001 mm apart along the screen's x: must be 0.01 to 5"),
        (turned(0, 6.0), "6 mm apart along the screen's x"),
        ({"x_mm_from_pixels": [0.1, 0.1, 0.0], "y_mm_from_pixels": [0.1, 0.1, 0.0]}, "less than 30 degrees apart"),
        ({"x_mm_from_pixels": [1e200, 0.0, 0.0], "y_mm_from_pixels": [1e200, 0.1, 0.0]}, "mm apart along the screen's x"),
    ],
)
def test_what_cannot_be_is_refused_and_the_place_before_stays(tmp_path, changed, reason):
    screen = Screen(PageSettings(), tmp_path / "screen.json")
    screen.keep(SCREEN)
    assert reason in screen.keep(SCREEN | changed)
    assert screen.place == Screen(PageSettings(), tmp_path / "screen.json").place == msgspec.convert(PLACE, ScreenPlace)


@given(st.floats(-180, 180), st.floats(0.011, 4.9), st.booleans())
def test_every_turn_and_mirror_of_a_screen_is_taken(degrees, pixel_mm, mirrored):
    place = turned(degrees, pixel_mm)
    if mirrored:
        place["x_mm_from_pixels"] = [-one for one in place["x_mm_from_pixels"]]
    assert msgspec.convert(place, ScreenPlace).wrong() == ""


@each_row("text", ["", "{", "[]", json.dumps(turned(0, 9.0)), '{"x_mm_from_pixels": [1, 2, 3]}', "x" * 5000])
def test_a_damaged_file_counts_as_none_and_is_reported(tmp_path, text, capsys):
    (tmp_path / "screen.json").write_text(text)
    assert Screen(PageSettings(), tmp_path / "screen.json").place is None
    assert f"{tmp_path / 'screen.json'}: left out" in capsys.readouterr().err


@pytest.mark.skipif(os.geteuid() == 0, reason="root may write everywhere")
def test_what_cannot_be_written_is_refused(tmp_path):
    tmp_path.chmod(0o500)
    assert "cannot be written" in Screen(PageSettings(), tmp_path / "screen.json").keep(SCREEN)
