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

from controller.console import tell
from controller.device.board.table_keys import wrong_keys
from controller.device.board.validation import dotted, explain
from controller.errors import ConfigError
from controller.log import Priority
from controller.regular_file import read_regular
from controller.text_file import decoded

T = TypeVar("T")

BYTES_MAX: Final = 1 << 25  # of a board or a scene; the largest here has 20 kB
DEPTH_MAX: Final = 32  # of tables and lists in one another; what is known nests six deep

# Keys that are still read in this version, with a warning, by their path without numbers.
OLD_NAMES: Final[dict[tuple[str, ...], str]] = {("regions", "quiet_for"): "nulled"}

KEY = re.compile(r" is missing\b|: unknown key\b")  # what msgspec or a record says of one key, of which `wrong_keys` names all

Positive = Annotated[float, Meta(gt=0)]
NotNegative = Annotated[float, Meta(ge=0)]
LONGEST_PLATE_MM: Final = 4000
LEAST_MM, MOST_MM = -1000, LONGEST_PLATE_MM + 1000  # of a place: what lies off the plate is refused with the plate's size
PlaceMm = Annotated[float, Meta(ge=LEAST_MM, le=MOST_MM)]
SizeMm = Annotated[float, Meta(gt=0, le=MOST_MM)]
SizeM = Annotated[float, Meta(ge=0, le=MOST_MM * 1e-3)]  # 0: the least size in mm, rounded
PlaceM = Annotated[float, Meta(ge=(LEAST_MM - MOST_MM) * 1e-3, le=(MOST_MM + MOST_MM) * 1e-3)]  # of a side
Share = Annotated[float, Meta(gt=0, le=1)]


def left_out() -> float:
    """Value, NaN, of a key that was left out and follows from others; no file may give it."""
    return math.nan


class Record(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """A table of a TOML file: frozen, typed, without unknown keys."""


def load_toml(file: Path, kind: type[T]) -> T:
    """Read a TOML file into a Record.

    Raises ConfigError if the file is absent, unreadable, not TOML, or invalid; the message names file, key and value.
    """
    return as_record(f"{file}: ", read_tables(file), kind)


def read_tables(file: Path) -> dict[str, Any]:
    """Read a TOML file; raises ConfigError if it is absent, unreadable, or not TOML."""
    try:
        return tomllib.loads(decoded(read_regular(file, BYTES_MAX, links=True)))
    except OSError as error:
        raise ConfigError(f"{file}: cannot be read ({error.strerror})") from error
    except (ValueError, RecursionError) as error:
        raise ConfigError(f"{file}: not valid TOML: {error}") from error


def as_record(before: str, tables: dict[str, Any], kind: type[T]) -> T:
    """Convert a table to a Record.

    Convert tables with names of the user's choice one by one: msgspec does not report which of them is invalid.

    `before` is the start of an error message: the file, and the place of the table in it. Raises ConfigError, naming key and value;
    what is nested too deep; all keys that are missing or unknown, and of values the first that is wrong or not finite.
    """
    renamed = False
    for path, value in _leaves(tables, ()):
        if len(path) > DEPTH_MAX:
            raise ConfigError(f"{before}{dotted(path[:1])}: tables and lists are nested more than {DEPTH_MAX} deep")
        if isinstance(value, float) and not math.isfinite(value):
            raise ConfigError(f"{before}{dotted(path)} = {value}: must be a finite number")
        if name := OLD_NAMES.get(tuple(key for key in path if isinstance(key, str))):
            renamed = True
            advice = f"is called {name} now; the next version does not know the old name"
            tell(f"{before}{dotted(path)} {advice}", Priority.WARNING)
    if renamed:
        tables = _renamed(before, tables, ())
    try:
        return msgspec.convert(tables, kind)
    except msgspec.ValidationError as error:
        keys, first = wrong_keys(tables, kind), explain(str(error), tables, kind)
        said = keys if keys and (first in keys or KEY.search(first)) else [first, *keys]
        raise ConfigError(f"{before}{'; '.join(said)}") from error


def _renamed(before: str, value: Any, path: tuple[str, ...]) -> Any:
    """What was read from TOML, with today's names of keys."""
    if isinstance(value, list):
        return [_renamed(before, inner, path) for inner in value]
    if not isinstance(value, dict):
        return value
    names = {key: OLD_NAMES.get((*path, key), key) for key in value}
    for old, name in names.items():
        if old != name and name in value:
            raise ConfigError(f"{before}{'.'.join(path)}: {old} and {name} are the same key: leave out {old}")
    return {names[key]: _renamed(before, inner, (*path, key)) for key, inner in value.items()}


def _leaves(value: Any, path: tuple[str | int, ...]) -> Iterator[tuple[tuple[str | int, ...], Any]]:
    """Every value in a TOML table, with its path; of what is nested too deep the table or list itself."""
    if len(path) > DEPTH_MAX:
        yield path, value
    elif isinstance(value, dict):
        for key, inner in value.items():
            yield from _leaves(inner, (*path, key))
    elif isinstance(value, list):
        for index, inner in enumerate(value):
            yield from _leaves(inner, (*path, index))
    else:
        yield path, value
