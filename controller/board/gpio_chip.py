"""GPIO lines by the chip's label and the line's name, which do not change between kernels and boots as numbers do."""

from __future__ import annotations

import difflib
import errno
from collections.abc import Iterable
from pathlib import Path

import gpiod

from controller.errors import ControllerError

DEVICES = Path("/dev")
NEAR_NAMES = 4  # similar names listed in an error message


def find_chip(label: str, failure: type[ControllerError]) -> Path:
    """Path of the GPIO chip with this label.

    Parameters
    ----------
    label : str
        As `gpiodetect` lists it.
    failure : type of ControllerError
        What to raise: LinkError, TouchError.

    Raises
    ------
    ControllerError
        If there is none, or this user may not open it; the message lists the chips that exist.
    """
    labels = []
    refused = []
    for path in sorted(DEVICES.glob("gpiochip*")):
        try:
            with gpiod.Chip(str(path)) as chip:
                found = chip.get_info().label
        except OSError as error:
            refused.append(f"{path} ({error.strerror})")
            continue
        if found == label:
            return path
        labels.append(found)
    there = f"there are: {', '.join(sorted(set(labels))) or 'none'}"
    if refused:
        there += f"; not permitted: {', '.join(refused)}: add this user to the group that owns them (on Debian: gpio)"
    raise failure(f"no GPIO chip has the label {label!r}; {there}")


def request_lines(
    label: str, lines: dict[str, gpiod.LineSettings], consumer: str, failure: type[ControllerError]
) -> gpiod.LineRequest:
    """Request lines of one chip for exclusive use.

    Parameters
    ----------
    label : str
        Label of the chip.
    lines : dict
        Settings by line name.
    consumer : str
        Name of the user of the lines, as gpioinfo shows it.
    failure : type of ControllerError
        What to raise.

    Raises
    ------
    ControllerError
        If the chip or a line does not exist, or a line is in use.
    """
    path = find_chip(label, failure)
    try:
        with gpiod.Chip(str(path)) as chip:
            for name in lines:
                _require_free(chip, label, name, failure)
            config: dict[Iterable[int | str] | int | str, gpiod.LineSettings | None] = dict(lines.items())
            return chip.request_lines(config, consumer=consumer)
    except OSError as error:
        if error.errno == errno.EBUSY:  # taken since it was checked
            raise failure(f"a line of GPIO chip {label!r} is in use by another program: end it first") from error
        raise failure(f"GPIO chip {label!r} ({path}) failed: {error.strerror}") from error


def _require_free(chip: gpiod.Chip, label: str, name: str, failure: type[ControllerError]) -> None:
    """Raise unless a line exists and is not in use."""
    try:
        info = chip.get_line_info(name)
    except OSError as error:
        if error.errno != errno.ENOENT:
            raise
        names = [chip.get_line_info(offset).name for offset in range(chip.get_info().num_lines)]
        known = sorted({line for line in names if line})
        near = difflib.get_close_matches(name, known, NEAR_NAMES, cutoff=0.4) or known[:NEAR_NAMES]
        raise failure(
            f"GPIO chip {label!r} has no line named {name!r}; names like it: {', '.join(near) or 'none, its lines have no names'}"
        ) from None
    if info.used:
        holder = info.consumer or "the kernel"
        raise failure(f"line {name!r} of GPIO chip {label!r} is in use by {holder}: end it, or choose another line")
