"""Patterns of texts end where the text does: `$` would take a line break after it, and into a file's name."""

import re
from pathlib import Path

import pytest

from controller.device.board.records import as_record
from controller.device.update.settings import UpdateSettings
from controller.errors import ConfigError

CONTROLLER = Path(__file__).parents[3] / "controller"


def test_no_pattern_ends_with_a_dollar_sign():
    for path in CONTROLLER.rglob("*.py"):
        for line in path.read_text(encoding="utf-8").splitlines():
            assert not re.search(r"pattern=\w*\"[^\"]*\$\"", line), f"{path}: {line}"


def test_a_line_break_is_refused_and_the_message_says_what_other_languages_say():
    with pytest.raises(ConfigError, match=re.escape("must be a text that matches ^[0-9a-z-]{1,32}$")):
        as_record("", {"channel": "stable\n"}, UpdateSettings)
    assert as_record("", {"channel": "stable"}, UpdateSettings).channel == "stable"
