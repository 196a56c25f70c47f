"""A table of cases as one test: every row is tried, and a failure names its row."""

import functools
import inspect

import pytest


def each_row(names, table, ids=repr):
    """In place of `pytest.mark.parametrize`, where rows are many and need nothing set up for each of them.

    Fixtures are set up once for all rows. Where several rows fail, all of them are shown.

    Parameters
    ----------
    names : str or tuple of str
        Of the arguments that a row gives.
    table : iterable
        Rows; with one name, its values.
    ids : callable or sequence
        What a failure calls a row: of its value, or of each of its values.
    """
    names = tuple(name.strip() for name in names.split(",")) if isinstance(names, str) else tuple(names)
    table = [(row,) if len(names) == 1 else tuple(row) for row in table]
    assert table, "a test without any row"

    def called(number, row):
        return "-".join(str(ids(value)) for value in row) if callable(ids) else ids[number]

    def decorate(test):
        @functools.wraps(test)
        def every_row(**fixtures):
            failed = []
            for number, row in enumerate(table):
                try:
                    test(**dict(zip(names, row, strict=True)), **fixtures)
                except (Exception, BaseExceptionGroup, pytest.fail.Exception) as error:
                    error.add_note(f"row {number} of {test.__name__}: {called(number, row)}")
                    failed.append(error)
            if len(failed) > 1:
                raise BaseExceptionGroup(f"{len(failed)} of {len(table)} rows of {test.__name__}", failed)
            if failed:
                raise failed[0]

        signature = inspect.signature(test)
        rest = [argument for name, argument in signature.parameters.items() if name not in names]
        every_row.__signature__ = signature.replace(parameters=rest)
        return every_row

    return decorate
