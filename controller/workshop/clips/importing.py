"""Files of designers as a TOML text of effects, and a report of what became of each."""

import re
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, Final

from controller.device.board.board import Board
from controller.device.scene.effects.effects import MOST_PULSES
from controller.device.scene.effects.library import highest_rate_hz, library
from controller.errors import ConfigError
from controller.workshop.clips.ahap import read_ahap
from controller.workshop.clips.android import read_android
from controller.workshop.clips.clip import DesignedClip
from controller.workshop.clips.haps import read_haps
from controller.workshop.clips.hjif import read_hjif
from controller.workshop.clips.lofelt import read_haptic
from controller.workshop.clips.rhythm import rhythm_of

READERS: Final[dict[str, Callable[[Path], DesignedClip]]] = {  # by the file's suffix
    ".ahap": read_ahap,
    ".haptic": read_haptic,
    ".hjif": read_hjif,
    ".haps": read_haps,
    ".xml": read_android,
}
INSTEAD: Final = {".hmpg": "the binary form of HJIF: save it as .hjif"}
NAME_CHARACTERS: Final = 64
LONGEST_S: Final = 600.0  # of all vibrations of a clip


def imported(files: Sequence[Path], board: Board, when: str, low_hz: float, high_hz: float) -> tuple[str, list[dict[str, Any]]]:
    """Effects of files, as TOML, and the figures of each.

    The board's duty limit says how near two pulses may be, and limits the rates of a vibration of sharpness 0 (`low_hz`) and 1
    (`high_hz`); `when` is the occasion of the effects. Raises ConfigError if a file cannot be read, is silent, or has more pulses
    than an effect can.
    """
    highest_hz = highest_rate_hz(board)
    if not 0 < low_hz <= high_hz:
        raise ConfigError(f"rates from {low_hz:g} to {high_hz:g} Hz: the first has to be above 0 and not above the second")
    tables, figures, names = [], [], set(library())
    for file in files:
        clip = _reader(file)(file)
        length_s = sum(vibration.end_s - vibration.start_s for vibration in clip.vibrations)
        if length_s > LONGEST_S:
            raise ConfigError(f"{file}: vibrates for {length_s:g} s in all, a clip for {LONGEST_S:g} s at most")
        pulses, report = rhythm_of(clip, 1e3 / highest_hz, min(low_hz, highest_hz), min(high_hz, highest_hz))
        if not pulses:
            raise ConfigError(f"{file}: nothing of it is felt: {report.silent} pulses are weaker than half of the least amplitude")
        if len(pulses) > MOST_PULSES:
            raise ConfigError(
                f"{file}: {len(pulses):,} pulses, an effect has at most {MOST_PULSES:,}: cut the clip, or lower the rates"
            )
        name = _name(file, names)
        names.add(name)
        points = ", ".join(f"[{at_ms:.10g}, {amplitude:g}]" for at_ms, amplitude in pulses)
        tables.append(f'[effects.{name}] # {_comment(file)}\nwhen = "{when}"\npulses = [{points}]\n')
        figures.append({"file": str(file), "effect": name, "length_ms": pulses[-1][0], "pulses": len(pulses)} | report._asdict())
    return "\n".join(tables), figures


def _reader(file: Path) -> Callable[[Path], DesignedClip]:
    reader = READERS.get(file.suffix.lower())
    if instead := INSTEAD.get(file.suffix.lower()):
        raise ConfigError(f"{file}: is {instead}")
    if reader is None:
        raise ConfigError(f"{file}: {file.suffix or 'a file without a suffix'} is no known format; there are: {', '.join(READERS)}")
    return reader


def _name(file: Path, taken: set[str]) -> str:
    """A name for a TOML key that is not taken, from the name of a file."""
    plain = re.sub(r"[^A-Za-z0-9_-]+", "_", file.stem)[: NAME_CHARACTERS - 4].strip("_") or "clip"
    numbers = (f"{plain}_{number}" for number in range(2, len(taken) + 3))
    return plain if plain not in taken else next(name for name in numbers if name not in taken)


def _comment(file: Path) -> str:
    """A file's name without what a comment cannot have."""
    return "".join(character for character in file.name if character.isprintable())
