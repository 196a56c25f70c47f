"""Names of haptics elsewhere, and haptic.js as a file."""

import gzip
import re
import tomllib
from pathlib import Path

import pytest
from tables import each_row

from controller.device.board.devices import MIN_AMPLITUDE
from controller.device.page import names
from controller.device.page.files import OWN
from controller.device.scene.effects import library
from controller.errors import ConfigError


def test_every_name_is_an_effect_that_can_be_played():
    effects = tomllib.loads((Path(library.__file__).parent / "effects.toml").read_text())["effects"]
    for name, (effect, share) in names.load_names().items():
        assert effect in effects, name
        assert MIN_AMPLITUDE <= share <= 1, f"{name}: below the least amplitude"


def test_the_standards_words_are_there():
    assert {"hint", "edge", "tick", "align"} <= names.load_names().keys()


@each_row(
    ("text", "error"),
    [
        ("[a]\nx = ['click', 2.0]", ConfigError),
        ("[a]\nx = 'click'", ConfigError),
        ("[a]\nx = ['c', 1.0]\n[b]\nx = ['c', 1.0]", ValueError),
    ],
)
def test_a_table_that_cannot_be_is_refused(tmp_path, text, error):
    (tmp_path / "names.toml").write_text(text)
    with pytest.raises(error):
        names.load_names(tmp_path / "names.toml")


def test_the_pages_need_nothing_that_a_strict_policy_forbids():
    for file in OWN.rglob("*.html"):
        text = file.read_text()
        assert not re.search(r"<style|\sstyle=|\son\w+=|<script(?![^>]*src=)|https?://", text), file
    for file in OWN.rglob("*.js"):
        assert not re.search(r"\beval\(|new Function|innerHTML|https?://(?!www\.w3\.org/2000/svg)", file.read_text()), file


def test_the_script_is_small():
    assert len(gzip.compress((OWN / "haptic.js").read_bytes())) <= 5120
