"""names.toml: names of haptics elsewhere; each page is greeted with them."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Final

from msgspec import Meta

from controller.device.board.records import as_record, read_tables

TABLE: Final = Path(__file__).with_name("names.toml")
Share = Annotated[float, Meta(gt=0, le=1)]


def load_names(file: Path = TABLE) -> dict[str, tuple[str, float]]:
    """Effect and share of the amplitude of each name, of all tables together.

    Raises ConfigError if the file is invalid; ValueError if a name stands there twice.
    """
    names: dict[str, tuple[str, float]] = {}
    for table, rows in read_tables(file).items():
        known = as_record(f"{file}: {table}: ", rows, dict[str, tuple[str, Share]])
        if both := names.keys() & known.keys():
            raise ValueError(f"{file}: {min(both)} stands there twice")
        names |= known
    return names
