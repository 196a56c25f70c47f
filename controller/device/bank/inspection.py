"""Inspects whole banks: what a bank holds, whether every bit is as written, whether it suits a board."""

from __future__ import annotations

import os
import zlib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from controller.device.bank.file_format import Header, Section
from controller.device.bank.grid import Grid
from controller.device.bank.header_reading import header_length, parse
from controller.device.bank.memory import memory_fit
from controller.device.bank.reader import Bank
from controller.device.board.board import Board
from controller.device.kernel import unpack_loads
from controller.errors import BankError
from controller.regular_file import open_regular


def bank_info(path: Path) -> dict[str, Any]:
    """Header and section table of the bank at `path`, as a dict for JSON.

    Raises BankError if it is no bank, or its header or a table is damaged.
    """
    with Bank.open(path) as bank:
        header, grid = bank.header, bank.grid
        return {
            "path": str(path),
            "bytes": bank.file.size,
            "format": header.version,
            "creator": header.creator,
            "board": header.parameters.get("board"),
            "board_digest": header.board_digest.hex(),
            "grid": {
                "pitch_mm": grid.pitch_m * 1e3,
                "nx": grid.nx,
                "ny": grid.ny,
                "x0_mm": grid.x0_m * 1e3,
                "y0_mm": grid.y0_m * 1e3,
            },
            "cells": header.entries,
            "cells_of_grid": grid.cells,
            "compositions": header.compositions,
            "samples": header.samples,
            "bit_clock_hz": header.bit_clock_hz,
            "responses": "not reported" if header.provenance is None else header.provenance.in_words(),
            "parameters": header.parameters,
            "sections": {s.name: {"offset": s.offset, "bytes": s.size} for s in bank.sections.values()},
        }


def verify_bank(path: Path, progress: Callable[[int, int], None] | None = None) -> dict[str, Any]:
    """Read every byte of a bank and check it; a flip of any bit is found.

    `progress` is called with bytes read and bytes in all. The BankError that is raised names the place of the first damage. Raises
    BankError: naming the place of the first damage.
    """
    with Bank.open(path) as bank:  # checks the header, its padding and the tables
        end = bank.sections["index"].offset
        for section in bank.sections.values():
            _check_padding(bank, end, section.offset)
            end = section.offset + section.size
            if section.name in {"drive", "response", "composed"}:
                _check_rows(bank, section, progress or (lambda _done, _all: None))
        _ = bank.responses.common  # the tables of a compact bank
        _check_padding(bank, end, bank.file.size)
        if progress:
            progress(bank.file.size, bank.file.size)
        return {"path": str(path), "bytes": bank.file.size, "cells": bank.header.entries, "good": True}


def _check_rows(bank: Bank, section: Section, progress: Callable[[int, int], None]) -> None:
    """Check every row of a section against its CRC-32, and that the padding between rows is zero."""
    if not section.rows:
        return
    if section.name == "composed":
        names, crcs = [f"composition {row}" for row in range(section.rows)], [crc for _, crc in bank.drive.compositions.values()]
    else:
        names = [f"{section.name} of entry {entry} (cell {cell})" for entry, cell in enumerate(np.flatnonzero(bank.cells))]
        crcs = [crc_of[section.name == "response"] for crc_of in bank.file.tables.crcs]
    crc_of_row = zlib.crc32 if section.name == "response" else _crc_of_words(bank.samples)
    for number, (name, crc) in enumerate(zip(names, crcs, strict=True)):
        start = section.offset + number * section.stride
        row = bank.file.read(start, section.row_bytes)
        try:
            wrong = "" if crc_of_row(row) == crc else "wrong CRC-32"
        except ValueError as error:
            wrong = str(error)
        if wrong:
            raise _damage(bank, start, len(row), f"{name}: {wrong}")
        _check_padding(bank, start + section.row_bytes, start + section.stride)
        progress(start + section.stride, bank.file.size)


def _crc_of_words(samples: int) -> Callable[[bytes], int]:
    """CRC-32 of the words that a drive row carries; raises ValueError if its frames are not whole."""
    words = bytearray(4 * samples)
    return lambda row: unpack_loads(words, row)


def _check_padding(bank: Bank, start: int, end: int) -> None:
    if bank.file.read(start, end - start).strip(b"\0"):
        raise _damage(bank, start, end - start, "padding that is not zero")


def _damage(bank: Bank, start: int, size: int, what: str) -> BankError:
    return BankError(f"{bank.path}: damaged in bytes {start} to {start + size - 1}: {what}; rebuild it: {bank.rebuild}")


def measured_at(path: Path) -> bool:
    """Whether the bank at `path` has responses that were measured, at least in part, even if it is damaged behind its header."""
    try:
        provenance = header_of(path).provenance
    except (OSError, BankError):
        return False
    return provenance is not None and provenance.from_measurements


def header_of(path: Path) -> Header:
    """Header of the bank at `path`, whatever is behind it; raises OSError or BankError if it cannot be read, or is damaged."""
    with os.fdopen(open_regular(path, links=True), "rb") as file:
        size = os.fstat(file.fileno()).st_size
        length = header_length(file.read(16), size)
        file.seek(0)
        return parse(file.read(length), size)[0]


def bounds_of(board: Board) -> dict[str, Any]:
    """The bounds of a board whose bank is chosen."""
    bounds: dict[str, Any] = {"max_error": board.compose.max_error, "max_time_us": board.compose.max_time_us}
    if board.compose.max_bank_mb is not None:
        bounds["max_bank_mb"] = board.compose.max_bank_mb
    return bounds | ({"method": "compact"} if board.compose.method == "compact" else {})


def wrong_pitch(bank: Bank, board: Board) -> str:
    """How the grid of a bank differs from that of a board, or the bounds it was chosen for from the board's; empty: they do not."""
    if board.compose.method != "bank":
        choice = bank.header.choice
        if choice and bounds_of(board).items() <= choice["asked"].items():
            return ""
        return f"it was not chosen for {', '.join(f'compose.{name} = {value}' for name, value in bounds_of(board).items())}"
    if bank.header.compact:
        return "" if memory_fit(board).compact else "it is compact, as compose.method chose"
    if not bank.composes:
        return "it holds no responses, as compose.method = auto chose"
    if bank.grid == Grid.of(board.plate, board.bank.pitch_mm * 1e-3):
        return ""
    return f"its cells are {bank.grid.pitch_m * 1e3:g} mm apart, bank.pitch_mm of the board is {board.bank.pitch_mm:g}"
