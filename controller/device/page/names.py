"""names.toml, names of haptics elsewhere, as a table of haptic.js."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated, Final

from msgspec import Meta

from controller.device.board.records import as_record, read_tables

BEGIN: Final = "// names: begin"
END: Final = "  // names: end"
Share = Annotated[float, Meta(gt=0, le=1)]


def load_names(file: Path) -> dict[str, tuple[str, float]]:
    """Effect and share of the amplitude of each name, of all tables together.

    Raises
    ------
    ConfigError
        If the file is invalid.
    ValueError
        If a name stands there twice.
    """
    names: dict[str, tuple[str, float]] = {}
    for table, rows in read_tables(file).items():
        known = as_record(f"{file}: {table}: ", rows, dict[str, tuple[str, Share]])
        if both := names.keys() & known.keys():
            raise ValueError(f"{file}: {min(both)} stands there twice")
        names |= known
    return names


def with_names(script: str, file: Path) -> str:
    """The text of haptic.js with the names of a file.

    Raises
    ------
    ValueError
        If the text has no place for them.
    """
    head, begin, rest = script.partition(BEGIN)
    line, _, rest = rest.partition("\n")
    _, end, tail = rest.partition(END)
    if not begin or not end:
        raise ValueError(f"haptic.js has no lines {BEGIN!r} and {END.strip()!r}")
    rows = [f"{name}: {json.dumps(list(effect))}" for name, effect in load_names(file).items()]
    table = "".join(f"    {', '.join(rows[at : at + 4])},\n" for at in range(0, len(rows), 4))
    return f"{head}{begin}{line}\n  const NAMES = {{\n{table}  }};\n{end}{tail}"
