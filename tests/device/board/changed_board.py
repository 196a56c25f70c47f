"""Boards with other values of some keys, as records and as files."""

import re

import msgspec

from controller.device.board.board import Board


def changed(board, **keys):
    """The board with other values: a key `limits__ramp_ms` is that of a table, `actuators` a whole list."""
    tables = {}
    for key, value in keys.items():
        table, _, name = key.partition("__")
        tables[table] = {**tables.get(table, {}), name: value} if name else value
    for table, value in tables.items():
        new = msgspec.structs.replace(getattr(board, table), **value) if isinstance(value, dict) else value
        board = msgspec.structs.replace(board, **{table: new})
    assert isinstance(board, Board)
    return board


def rewritten(text, **keys):
    """The text of a board.toml with other lines: key = value, wherever the key stands at the start of a line."""
    for key, value in keys.items():
        text, count = re.subn(rf"^{key} = [^#\n]*", f"{key} = {value}", text, flags=re.MULTILINE)
        assert count == 1, key
    return text
