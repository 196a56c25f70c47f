"""A table of cases as one test: every row is tried, and a failure names its row."""

import contextlib
import functools
import inspect

import pytest


@contextlib.contextmanager
def own(fixtures, afresh, number):
    """Fixtures of a row: a folder within that of the test, changes that end with the row, and those to be set up for each."""
    with contextlib.ExitStack() as stack:
        fixtures = dict(fixtures)
        if "monkeypatch" in fixtures:
            fixtures["monkeypatch"] = stack.enter_context(pytest.MonkeyPatch.context())
        if "tmp_path" in fixtures:
            fixtures["tmp_path"] /= str(number)
            fixtures["tmp_path"].mkdir()
        for make in afresh:
            made = make(**{name: fixtures[name] for name in inspect.signature(make).parameters})
            fixtures[make.__name__] = (
                stack.enter_context(contextlib.contextmanager(lambda made=made: made)()) if inspect.isgenerator(made) else made
            )
        yield fixtures


def each_row(names, table, ids=repr, afresh=()):
    """In place of `pytest.mark.parametrize`, where rows are many and need little set up for each of them.

    Each row has a `tmp_path`, a `monkeypatch` and the fixtures `afresh` of its own; others are set up once for all rows. Where
    several rows fail, all of them are shown.

    Parameters
    ----------
    names : str or tuple of str
        Of the arguments that a row gives.
    table : iterable
        Rows; with one name, its values.
    ids : callable or sequence
        What a failure calls a row: of its value, or of each of its values.
    afresh : sequence of fixtures
        Set up for each row, in this order.
    """
    names = tuple(name.strip() for name in names.split(",")) if isinstance(names, str) else tuple(names)
    table = [(row,) if len(names) == 1 else tuple(row) for row in table]
    assert table, "a test without any row"
    afresh = [inspect.unwrap(fixture) for fixture in afresh]

    def called(number, row):
        return "-".join(str(ids(value)) for value in row) if callable(ids) else ids[number]

    def decorate(test):
        @functools.wraps(test)
        def every_row(**fixtures):
            failed, skips = [], []
            for number, row in enumerate(table):
                try:
                    with own(fixtures, afresh, number) as ready:
                        arguments = dict(zip(names, row, strict=True)) | ready
                        test(**{name: arguments[name] for name in inspect.signature(test).parameters})
                except pytest.skip.Exception as skipped:
                    skips.append(skipped)
                except (Exception, BaseExceptionGroup, pytest.fail.Exception) as error:
                    error.add_note(f"row {number} of {test.__name__}: {called(number, row)}")
                    failed.append(error)
            if len(failed) > 1:
                raise BaseExceptionGroup(f"{len(failed)} of {len(table)} rows of {test.__name__}", failed)
            if failed:
                raise failed[0]
            if len(skips) == len(table):
                raise skips[0]

        asked = {
            name: argument for function in (test, *afresh) for name, argument in inspect.signature(function).parameters.items()
        }
        given = {*names, *(make.__name__ for make in afresh)}
        every_row.__signature__ = inspect.Signature([asked[name] for name in asked if name not in given])
        return every_row

    return decorate
