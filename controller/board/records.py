"""Tables of a TOML file as frozen, checked records: an unknown key or an impossible value names file, key and value."""

from __future__ import annotations

import math
import re
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any, Final, TypeVar

import msgspec
from msgspec import Meta

from controller.board.table_keys import wrong_keys
from controller.board.validation import dotted, explain
from controller.errors import ConfigError
from controller.regular_file import read_regular
from controller.text_file import decoded

T = TypeVar("T")

BYTES_MAX: Final = 1 << 25  # of a board or a scene; the largest here has 20 kB

KEY = re.compile(r" is missing\b|: unknown key\b")  # what msgspec or a record says of one key, of which `wrong_keys` names all

Positive = Annotated[float, Meta(gt=0)]
NotNegative = Annotated[float, Meta(ge=0)]
PlaceMm = Annotated[float, Meta(ge=-1000, le=5000)]  # a plate has at most 4 m; what lies off it is refused with the plate's size
SizeMm = Annotated[float, Meta(gt=0, le=5000)]
Share = Annotated[float, Meta(gt=0, le=1)]


class Record(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """A table of a TOML file: frozen, typed, without unknown keys."""


def load_toml(file: Path, kind: type[T]) -> T:
    """Read a TOML file into a Record.

    Parameters
    ----------
    file : Path
    kind : type of Record
        The whole file.

    Raises
    ------
    ConfigError
        If the file is absent, unreadable, not TOML, or invalid; the message names file, key and value.
    """
    try:
        tables = tomllib.loads(decoded(read_regular(file, BYTES_MAX, links=True)))
    except OSError as error:
        raise ConfigError(f"{file}: cannot be read ({error.strerror})") from error
    except (ValueError, RecursionError) as error:
        raise ConfigError(f"{file}: not valid TOML: {error}") from error
    return as_record(f"{file}: ", tables, kind)


def as_record(before: str, tables: dict[str, Any], kind: type[T]) -> T:
    """Convert a table to a Record.

    Convert tables with names of the user's choice one by one: msgspec does not report which of them is invalid.

    Parameters
    ----------
    before : str
        Start of an error message: the file, and the place of the table in it.
    tables : dict
        The table as read from TOML.
    kind : type of Record

    Raises
    ------
    ConfigError
        Naming key and value; all keys that are missing or unknown, and of values the first that is wrong or not finite.
    """
    for path, value in _leaves(tables, ()):
        if isinstance(value, float) and not math.isfinite(value):
            raise ConfigError(f"{before}{dotted(path)} = {value}: must be a finite number")
    try:
        return msgspec.convert(tables, kind)
    except msgspec.ValidationError as error:
        keys, first = wrong_keys(tables, kind), explain(str(error), tables, kind)
        said = keys if keys and (first in keys or KEY.search(first)) else [first, *keys]
        raise ConfigError(f"{before}{'; '.join(said)}") from error


def _leaves(value: Any, path: tuple[str | int, ...]) -> Iterator[tuple[tuple[str | int, ...], Any]]:
    """Every value in a TOML table, with its path."""
    if isinstance(value, dict):
        for key, inner in value.items():
            yield from _leaves(inner, (*path, key))
    elif isinstance(value, list):
        for index, inner in enumerate(value):
            yield from _leaves(inner, (*path, index))
    else:
        yield path, value
