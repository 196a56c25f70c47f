"""A table of cases fails with the names of its rows, and runs all of them."""

import inspect
import os

import pytest
from tables import each_row


def test_every_row_runs_with_what_fixtures_gave_and_a_failure_names_its_row():
    ran = []

    @each_row(("one", "other"), [(1, 1), (2, 3), (4, 4)])
    def equal(fixture, one, other):
        ran.append((fixture, one, other))
        assert one == other

    assert list(inspect.signature(equal).parameters) == ["fixture"]
    with pytest.raises(AssertionError) as failed:
        equal(fixture="made once")
    assert failed.value.__notes__ == ["row 1 of equal: 2-3"]
    assert ran == [("made once", 1, 1), ("made once", 2, 3), ("made once", 4, 4)]


def test_of_several_rows_that_fail_each_is_named_one_table_within_the_other():
    @each_row("letter", "ab", ids=str.upper)
    @each_row("number", (1, 2), ids=["first", "second"])
    def never(letter, number):
        with pytest.raises(ValueError, match="never"):
            int(number)

    with pytest.raises(BaseExceptionGroup) as failed:
        never()
    assert [group.__notes__ for group in failed.value.exceptions] == [["row 0 of never: A"], ["row 1 of never: B"]]
    first, _ = failed.value.exceptions
    assert [row.__notes__ for row in first.exceptions] == [["row 0 of never: first"], ["row 1 of never: second"]]


def test_a_row_that_is_skipped_keeps_no_other_from_running():
    ran = []

    @each_row("number", (1, 2))
    def some(number, least):
        if number < least:
            pytest.skip("too few")
        ran.append(number)

    some(least=2)
    assert ran == [2]
    with pytest.raises(pytest.skip.Exception, match="too few"):
        some(least=3)


def test_a_table_without_rows_is_no_test():
    with pytest.raises(AssertionError, match="without any row"):
        each_row("value", [])


@pytest.fixture
def counted(tmp_path):
    yield [tmp_path.name]
    (tmp_path / "ended").touch()


@each_row("value", "abc", afresh=[counted])
def test_each_row_has_fixtures_and_a_folder_of_its_own(counted, tmp_path, monkeypatch, value):
    assert counted == [{"a": "0", "b": "1", "c": "2"}[value]]
    assert value == "a" or (tmp_path.parent / str(int(tmp_path.name) - 1) / "ended").exists()
    assert "HAPTIC_PANEL_ROW" not in os.environ
    monkeypatch.setenv("HAPTIC_PANEL_ROW", value)
    counted.append(value)
