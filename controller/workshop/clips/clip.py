"""What a clip of any format says: taps, and vibrations whose strength and sharpness change over time."""

import re
from collections import Counter
from pathlib import Path
from typing import Annotated, NamedTuple, TypeVar

import msgspec
import numpy as np
from msgspec import Meta

from controller.arrays import Floats
from controller.device.board.validation import NO_JSON
from controller.errors import ConfigError
from controller.text_file import read_text

T = TypeVar("T")

BYTES_MAX = 1 << 24
SPARE_COMMA = re.compile(
    r'("(?:\\.|[^"\\])*")|,(?=\s*[}\]])'
)  # behind the last of a list: some tools write it, and Apple's reads it
NEUTRAL = 0.5  # sharpness, where a file has none

Time = Annotated[float, Meta(ge=0, le=86400)]  # in s
Number = Annotated[float, Meta(ge=-1e9, le=1e9)]


class Curve(NamedTuple):
    """Points (s, value) in order of time, linear between them and constant beyond; of two at one time the later one follows."""

    times_s: tuple[float, ...]
    values: tuple[float, ...]

    def at(self, times_s: Floats) -> Floats:
        """Values at some times."""
        return np.interp(times_s, self.times_s, self.values)


class Tap(NamedTuple):
    """A short event, such as a transient of AHAP or an emphasis of .haptic; amplitude and sharpness 0 to 1."""

    at_s: float
    amplitude: float
    sharpness: float


class Vibration(NamedTuple):
    """A continuous event; amplitude and sharpness 0 to 1."""

    start_s: float
    end_s: float
    amplitude: Curve
    sharpness: Curve
    rate_hz: Curve | None = None  # where the file has frequencies; they take the place of the sharpness
    phase: float = 0.0  # of its start, in turns


class DesignedClip(NamedTuple):
    """A clip."""

    taps: tuple[Tap, ...]
    vibrations: tuple[Vibration, ...]
    ignored: Counter[str]  # what a panel has no counterpart for, by its name in the file


def decoded_json(file: Path, kind: type[T]) -> T:
    """Read a JSON file of a known kind.

    Raises ConfigError if it cannot be read, is not JSON, or has a value that this kind cannot have; the message names file and
    place.
    """
    try:
        text = SPARE_COMMA.sub(lambda found: found[1] or "", read_text(file, BYTES_MAX))
        return msgspec.json.decode(text, type=kind)
    except OSError as error:
        raise ConfigError(f"{file}: cannot be read ({error.strerror})") from error
    except (*NO_JSON, ValueError) as error:
        raise ConfigError(f"{file}: {error}") from error


def bounded(value: float, least: float = 0.0, most: float = 1.0) -> float:
    """The nearest value within bounds, as players take values beyond them."""
    return min(max(value, least), most)
