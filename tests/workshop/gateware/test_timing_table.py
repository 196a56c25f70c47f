"""Timing tables and their pictures: what is read, what is refused, and what a picture says of itself."""

import dataclasses

import pytest
from tables import each_row

from controller.workshop.gateware.timing_diagram import LONGEST_TICKS, TimeAxis, diagrams, draw, picture_digest
from controller.workshop.gateware.timing_table import Change, load_cases, read_case, read_table, read_tick

TICKS = {"first": 6, "shut": 3}
ENTRIES = {
    "title": "A trigger plays a word",
    "why": "for the test",
    "setup": "armed",
    "bit_ticks": 4,
    "slots": {"0": "0x11 34*2"},
    "plays": ["slot=0 emissions=1"],
    "settings": {"RAMP_SAMPLES": 4},
    "table": """
    0:          trigger          # a comment
    first:      -> channel=0x11
    first + bit : permit=0 -> channel=idle focus
    2000:       frame="PLAY slot=0"
    """,
}


def test_a_case_is_what_its_table_says():
    case = read_case("one", ENTRIES, TICKS)
    assert case.inputs == (Change(0, "trigger", ""), Change(10, "permit", "0"), Change(2000, "frame", "PLAY slot=0"))
    assert case.outputs == (Change(6, "channel", "0x11"), Change(10, "channel", "idle"), Change(10, "focus", ""))
    assert (case.slots, case.plays, case.settings) == ({0: (17, 34, 34)}, ("slot=0 emissions=1",), {"RAMP_SAMPLES": 4})
    assert case.last_tick == 2000


def test_the_hash_is_of_everything_a_table_says():
    case = read_case("one", ENTRIES, TICKS)
    assert read_case("one", ENTRIES, TICKS).digest == case.digest
    changes = [{"title": "x"}, {"bit_ticks": 5}, {"slots": {}}, {"table": ENTRIES["table"].replace("2000", "2001")}]
    digests = {read_case("one", ENTRIES | change, TICKS).digest for change in changes}
    assert len(digests | {case.digest, read_case("one", ENTRIES, TICKS | {"first": 7}).digest}) == len(changes) + 2


@each_row(
    ("text", "tick"),
    [
        ("0", 0),
        ("first", 6),
        ("first+4", 10),
        ("first+2*shut", 12),
        ("2*", None),
        (" first + shut - 1 ", 8),
        ("-0+2", None),
        ("a", None),
    ],
)
def test_a_tick_is_a_sum(text, tick):
    if tick is None:
        with pytest.raises(ValueError, match="tick"):
            read_tick(text, TICKS)
    else:
        assert read_tick(text, TICKS) == tick


@each_row(
    ("table", "what"),
    [
        ("0 trigger", "is not `tick"),
        ("0:", "is not `tick"),
        ("4: trigger\n4: permit=0", "later"),
        ("0: -> focus", "nothing is done"),
        ("0: channel=1", "none of trigger"),
        ("0: trigger -> permit=1", "none of channel"),
        ("0: trigger -> focus=1", "pulse"),
        ("0: trigger=short", "invalid literal"),
        ("0: permit", "needs a value"),
        ("0: permit=2", "0 or 1"),
        ("0: trigger -> channel=up", "invalid literal"),
    ],
)
def test_a_row_that_cannot_be_read_is_refused(table, what):
    with pytest.raises(ValueError, match=what):
        read_table(table, TICKS)


@each_row(
    ("change", "what"),
    [({"why": None}, "'why'"), ({"setup": "on"}, "setup"), ({"slot": 1}, "unknown: slot"), ({"bit_ticks": "4"}, "type number")],
)
def test_an_entry_that_cannot_be_read_is_refused(change, what):
    with pytest.raises(ValueError, match=what):
        read_case("one", ENTRIES | change, TICKS)


FILE = """[ticks]
first = 6
[case.one]
title = "t"
why = "w"
setup = "armed"
bit_ticks = 4
table = '''
0: trigger
first: -> channel=1
'''
"""


def test_a_folder_of_tables(tmp_path):
    (tmp_path / "a.timing.toml").write_text(FILE)
    assert [case.name for case in load_cases(tmp_path)] == ["one"]
    (tmp_path / "b.timing.toml").write_text(FILE)
    with pytest.raises(ValueError, match="same name"):
        load_cases(tmp_path)
    (tmp_path / "b.timing.toml").write_text(FILE.replace("setup", "set_up"))
    with pytest.raises(ValueError, match=r"b\.timing\.toml, one: 'setup'"):
        load_cases(tmp_path)


def test_a_picture_says_of_which_table_it_is(tmp_path):
    (tmp_path / "a.timing.toml").write_text(FILE)
    ((path, text),) = diagrams(tmp_path).items()
    path.write_text(text)
    (case,) = load_cases(tmp_path)
    assert picture_digest(tmp_path / "one.svg") == case.digest
    before = (tmp_path / "one.svg").read_bytes()
    path.write_text(before.decode() + " ")
    assert diagrams(tmp_path) == {path: before.decode() + " "}, "of this table: it is not drawn again"
    draw(dataclasses.replace(case, title="u"), tmp_path / "one.svg")
    assert picture_digest(tmp_path / "one.svg") != case.digest
    assert picture_digest(tmp_path / "none.svg") is None
    (tmp_path / "drawn.svg").write_text("<svg/>")
    assert picture_digest(tmp_path / "drawn.svg") is None


def test_time_in_which_nothing_happens_is_cut_out():
    axis = TimeAxis(read_case("one", ENTRIES, TICKS))
    assert axis.at(6) - axis.at(0) == 6
    assert axis.at(8) - axis.at(6) == 2
    assert axis.at(2000) - axis.at(10) < 3 * LONGEST_TICKS
    assert axis.cuts == sorted(axis.cuts)
    assert axis.labels == [0, 6, 10, 2000]
