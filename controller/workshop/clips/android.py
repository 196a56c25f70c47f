"""Vibration effects of Android as XML (`VibrationXmlParser`, platform_frameworks_base): waveforms and basic envelopes.

Names of effects (`predefined-effect`, `primitive-effect`) say nothing about their form, which each phone has of its own.
"""

import math
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Final
from xml.etree import ElementTree

from controller.errors import ConfigError
from controller.text_file import read_text
from controller.workshop.clips.clip import BYTES_MAX, Curve, DesignedClip, Vibration

FULL: Final = 255
LONGEST_MS: Final = 86_400_000.0
ROOTS: Final = ("vibration-effect", "vibration")  # the second is an older name of the first


def read_android(file: Path) -> DesignedClip:
    """Read a clip; what repeats is played once.

    Raises ConfigError if it is no effect of Android, or has a value that such an effect cannot have.
    """
    ignored: Counter[str] = Counter()
    vibrations: list[Vibration] = []
    at_s = 0.0
    for element in _root(file):
        if element.tag == "waveform-effect":
            ignored["repeating"] += element.find("repeating") is not None
            found = list(_waveform(file, element, at_s))
        elif element.tag == "basic-envelope-effect":
            found = list(_envelope(file, element, at_s))
        else:
            ignored[_shown(f"{element.tag} {element.get('name', '')}".strip())] += 1
            continue
        vibrations += found
        at_s = found[-1].end_s if found else at_s
    return DesignedClip((), tuple(vibration for vibration in vibrations if any(vibration.amplitude.values)), +ignored)


def _root(file: Path) -> ElementTree.Element:
    try:
        text = read_text(file, BYTES_MAX)
        if "<!DOCTYPE" in text:
            raise ConfigError(f"{file}: has a DOCTYPE, which no effect of Android has")
        root = ElementTree.fromstring(text)
    except OSError as error:
        raise ConfigError(f"{file}: cannot be read ({error.strerror})") from error
    except (ElementTree.ParseError, ValueError) as error:
        raise ConfigError(f"{file}: {error}") from error
    if root.tag not in ROOTS:
        raise ConfigError(f"{file}: is <{_shown(root.tag)}>: only <{ROOTS[0]}> is known")
    return root


def _waveform(file: Path, element: ElementTree.Element, at_s: float) -> Iterator[Vibration]:
    """Steps of a waveform, one after the other; a phone vibrates at the resonance of its motor, the high end of any range."""
    for entry in element.iter("waveform-entry"):
        length_s = _number(file, entry, "durationMs", LONGEST_MS) * 1e-3
        level = 1.0 if entry.get("amplitude") == "default" else _number(file, entry, "amplitude", FULL) / FULL
        yield Vibration(at_s, at_s + length_s, Curve((at_s,), (level,)), Curve((at_s,), (1.0,)))
        at_s += length_s


def _envelope(file: Path, element: ElementTree.Element, at_s: float) -> Iterator[Vibration]:
    """An envelope: from nothing along its control points, each `durationMs` after the one before."""
    points = list(element.iter("control-point"))
    if not points:
        return
    times_s, levels, sharps = [at_s], [0.0], []
    for point in points:
        times_s.append(times_s[-1] + _number(file, point, "durationMs", LONGEST_MS) * 1e-3)
        levels.append(_number(file, point, "intensity", 1.0))
        sharps.append(_number(file, point, "sharpness", 1.0))
    first = _number(file, element, "initialSharpness", 1.0) if element.get("initialSharpness") else sharps[0]
    yield Vibration(at_s, times_s[-1], Curve(tuple(times_s), tuple(levels)), Curve(tuple(times_s), (first, *sharps)))


def _number(file: Path, element: ElementTree.Element, name: str, most: float) -> float:
    text = element.get(name)
    if text is None:
        raise ConfigError(f"{file}: a {element.tag} has no {name}")
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not 0 <= value <= most:
        raise ConfigError(f"{file}: {name} = {_shown(text)!r} of a {element.tag}: a number from 0 to {most:,.10g} is expected")
    return value


def _shown(text: str) -> str:
    """What a message may repeat of a file."""
    return "".join(character if character.isprintable() else "?" for character in text[:40])
