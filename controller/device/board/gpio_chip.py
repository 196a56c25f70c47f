"""GPIO lines by the chip's label and the line's name, which do not change between kernels and boots as chip numbers do.

Lines of some chips have no names, or one name for several ("NC", "-"): a line is then given by its number on the chip, written as
text ("25"), which the wiring of the chip fixes. A name goes before a number, as in the tools of libgpiod.
"""

from __future__ import annotations

import difflib
import errno
from collections.abc import Iterable, Sequence
from pathlib import Path

import gpiod

from controller.errors import ControllerError

DEVICES = Path("/dev")
NEAR_NAMES = 4  # similar names listed in an error message


def find_chip(label: str, failure: type[ControllerError]) -> Path:
    """Path of the GPIO chip with this label.

    `label` is as `gpiodetect` lists it; a path is taken as it is: a link of udev tells apart several chips with one label.
    `failure` is what to raise: LinkError, TouchError. Raises ControllerError if there is none, or several, or this user may not
    open it; the message lists the chips that exist.
    """
    if label.startswith("/"):
        return Path(label)
    labels = []
    refused = []
    found: list[Path] = []
    for path in sorted(DEVICES.glob("gpiochip*")):
        try:
            with gpiod.Chip(str(path)) as chip:
                its = chip.get_info().label
        except OSError as error:
            refused.append(f"{path} ({error.strerror})")
            continue
        labels.append(its)
        if its == label and path.resolve() not in [other.resolve() for other in found]:  # a Pi 5 has two names for one chip
            found.append(path)
    if len(found) > 1:
        paths = ", ".join(map(str, found))
        raise failure(f"{len(found)} GPIO chips have the label {label!r}: {paths}; give the path of a udev link to one of them")
    if found:
        return found[0]
    there = f"there are: {', '.join(sorted(set(labels))) or 'none'}"
    if refused:
        there += f"; not permitted: {', '.join(refused)}: add this user to the group that owns them (on Debian: gpio)"
    raise failure(f"no GPIO chip has the label {label!r}; {there}")


def find_lines(chip: gpiod.Chip, label: str, lines: Iterable[str], failure: type[ControllerError]) -> dict[str, int]:
    """Number on its chip of each line, by what was given: a name, or a number in decimal digits where no line has this name.

    Raises ControllerError if there is no such line, if several have the name, or if two of `lines` are the same line; OSError if
    the chip fails.
    """
    names = [chip.get_line_info(number).name or "" for number in range(chip.get_info().num_lines)]
    found: dict[str, int] = {}
    for line in lines:
        number = _number_of(line, names, label, failure)
        for other, its in found.items():
            if its == number and other != line:
                raise failure(f"lines {other!r} and {line!r} of GPIO chip {label!r} are one line: its number {number}")
        found[line] = number
    return found


def request_lines(
    label: str, lines: dict[str, gpiod.LineSettings], consumer: str, failure: type[ControllerError]
) -> tuple[gpiod.LineRequest, dict[str, int]]:
    """Request lines of one chip for exclusive use.

    `lines` are settings by name or number, see `find_lines`; `consumer` is what gpioinfo shows as the user of the lines. Returns
    the request, and the number of each line, by which the request knows it. Raises ControllerError if the chip or a line does not
    exist, or a line is in use.
    """
    path = find_chip(label, failure)
    try:
        with gpiod.Chip(str(path)) as chip:
            numbers = find_lines(chip, label, lines, failure)
            for line, number in numbers.items():
                info = chip.get_line_info(number)
                if info.used:
                    holder = info.consumer or "the kernel"
                    raise failure(f"line {line!r} of GPIO chip {label!r} is in use by {holder}: end it, or choose another line")
            config: dict[Iterable[int | str] | int | str, gpiod.LineSettings | None] = {
                numbers[line]: settings for line, settings in lines.items()
            }
            return chip.request_lines(config, consumer=consumer), numbers
    except OSError as error:
        if error.errno == errno.EBUSY:  # taken since it was checked
            raise failure(f"a line of GPIO chip {label!r} is in use by another program: end it first") from error
        raise failure(f"GPIO chip {label!r} ({path}) failed: {error.strerror}") from error


def _number_of(line: str, names: Sequence[str], label: str, failure: type[ControllerError]) -> int:
    """Number of a line by its name, or as it is given."""
    numbers = [number for number, name in enumerate(names) if name == line]
    if len(numbers) == 1:
        return numbers[0]
    if numbers:
        listed = ", ".join(f'"{number}"' for number in numbers)
        raise failure(f"{len(numbers)} lines of GPIO chip {label!r} are named {line!r}: give the number of one: {listed}")
    if line.isascii() and line.isdecimal() and len(line) <= len(str(len(names))) and int(line) < len(names):
        return int(line)
    known = sorted({name for name in names if name})
    listed = ", ".join(difflib.get_close_matches(line, known, NEAR_NAMES, cutoff=0.4) or known[:NEAR_NAMES])
    said = f"names like it: {listed}; " if listed else "its lines have no names; "
    raise failure(
        f"GPIO chip {label!r} has no line named {line!r}; {said}"
        f'a line without a name is given by its number, "0" to "{len(names) - 1}"'
    )
