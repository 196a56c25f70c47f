"""Changes single lines of the [touch] table of a board.toml, and nothing else of the file."""

from __future__ import annotations

import os
import re
import shutil
import tempfile
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

from controller.device.board.board import load_board
from controller.device.board.lookup import SYSTEM_BOARDS, running_release
from controller.device.touch_calibration.calibration import Calibration, Row
from controller.errors import CalibrationError
from controller.text_file import decoded

AXIS_KEYS = ("x_mm_from_axes", "y_mm_from_axes")


def board_lines(calibration: Calibration) -> tuple[str, str]:
    """The two axis lines of a `calibration` for [touch]."""
    return _line(AXIS_KEYS[0], calibration.x_mm_from_axes), _line(AXIS_KEYS[1], calibration.y_mm_from_axes)


def with_calibration(text: str, calibration: Calibration) -> str:
    """Replace the two axis lines in the `text` of a board.toml by those of `calibration`; comments, order and line ends stay.

    Raises CalibrationError if each key does not stand exactly once, on one line, in [touch].
    """
    changed = text
    for key, line in zip(AXIS_KEYS, board_lines(calibration), strict=True):
        changed, count = re.subn(rf"^([ \t]*){key}[ \t]*=[ \t]*\[[^\]\r\n]*\]", rf"\g<1>{line}", changed, flags=re.M)
        if count != 1:
            raise CalibrationError(f"{key} stands on {count} lines instead of one: write the lines into [touch] by hand")
    if _without(tomllib.loads(text)) != _without(tomllib.loads(changed)):
        raise CalibrationError("the axis lines found are not those of [touch]: write them by hand")
    return changed


def check_writable(file: Path) -> None:
    """Refuse a board.toml (`file`) that cannot be changed, before a measurement is made for it.

    Raises CalibrationError if this user may not create files in its folder, or it is part of a release, which is signed and will be
    followed by others.
    """
    release = running_release()
    if release is not None and release.resolve() in file.resolve().parents:
        copy = f"cp -r {file.parent} {SYSTEM_BOARDS / file.parent.name}"
        raise CalibrationError(f"{file}: is part of a release; measure for a copy of the board, which is used in its place: {copy}")
    if not os.access(file.resolve().parent, os.W_OK | os.X_OK):
        raise CalibrationError(
            f"{file}: cannot be written (Permission denied): without --write, and as root with `| /usr/lib/haptic-panel/set-touch"
            f" {file.parent.name}` after it, the lines are put there"
        )


def write_calibration(file: Path, calibration: Calibration) -> None:
    """Change the two axis lines of a board.toml (`file`) to those of `calibration`.

    Raises CalibrationError or ConfigError: see `_rewrite`; the file is unchanged then.
    """
    _rewrite(file, lambda text: with_calibration(text, calibration))


def value_line(key: str, value: float) -> str:
    """Line for [touch] that sets `key` to `value`, to 0.1."""
    return f"{key} = {round(value, 3) + 0.0:.1f}"


def with_value(text: str, key: str, value: float) -> str:
    """Set `key` of [touch] to `value` in the `text` of a board.toml, inserted as first line if absent; all else stays.

    Raises CalibrationError if there is no table [touch], or it is not written as one line for each key.
    """
    line = value_line(key, value)
    table = re.search(r"^[ \t]*\[touch\][^\r\n]*(?P<end>\r?\n)(?P<lines>(?:(?![ \t]*\[)[^\n]*(?:\n|\Z))*)", text, flags=re.M)
    if table is None:
        raise CalibrationError(f"there is no table [touch]: write {line!r} by hand")
    lines = table["lines"]
    changed, count = re.subn(rf"^([ \t]*){key}[ \t]*=[ \t]*[-+\w.]+", rf"\g<1>{line}", lines, flags=re.M)
    if not count:
        changed = f"{line}{table['end']}{lines}"
    new = text[: table.start("lines")] + changed + text[table.end("lines") :]
    try:
        right = tomllib.loads(new).get("touch", {}).get(key) == float(line.partition("=")[2]) and _but(new, key) == _but(text, key)
    except tomllib.TOMLDecodeError:
        right = False
    if not right:
        raise CalibrationError(f"[touch] is not written as one line for each key: write {line!r} by hand")
    return new


def write_value(file: Path, key: str, value: float) -> None:
    """Set `key` of [touch] to `value` in a board.toml (`file`).

    Raises CalibrationError or ConfigError: see `_rewrite`; the file is unchanged then.
    """
    _rewrite(file, lambda text: with_value(text, key, value))


def _rewrite(file: Path, change: Callable[[str], str]) -> None:
    """Replace a board.toml atomically.

    Raises CalibrationError if the file cannot be written, or `change` does not find its lines; the file is unchanged then. Raises
    ConfigError if the board would not be valid with the new lines; the file is unchanged then.
    """
    file = file.resolve()  # a link stays a link
    temporary = None
    try:
        changed = change(decoded(file.read_bytes()))
        handle, name = tempfile.mkstemp(prefix=".board-", suffix=".toml", dir=file.parent)
        temporary = Path(name)
        with os.fdopen(handle, "w", encoding="utf-8", newline="") as new:
            new.write(changed)
            new.flush()
            os.fsync(new.fileno())
        shutil.copymode(file, temporary)
        load_board(temporary)
        temporary.replace(file)
        folder = os.open(file.parent, os.O_RDONLY)
        try:
            os.fsync(folder)
        finally:
            os.close(folder)
    except OSError as error:
        raise CalibrationError(f"{file}: cannot be written ({error.strerror}): write the lines by hand") from error
    finally:
        if temporary is not None:
            temporary.unlink(missing_ok=True)


def _line(key: str, row: Row) -> str:
    return f"{key} = [{', '.join(f'{round(value, 3) + 0.0:.3f}' for value in row)}]"


def _without(tables: dict[str, Any]) -> dict[str, Any]:
    touch = {key: value for key, value in tables.get("touch", {}).items() if key not in AXIS_KEYS}
    return tables | {"touch": touch}


def _but(text: str, key: str) -> dict[str, Any]:
    tables = tomllib.loads(text)
    return tables | {"touch": {name: value for name, value in tables.get("touch", {}).items() if name != key}}
