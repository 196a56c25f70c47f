""".haptic, of Meta Haptics Studio and Lofelt (JSON, data model 1): github.com/Lofelt/NiceVibrations, core/datamodel/README.md.

One vibration with breakpoints, some with an emphasis: a tap. Amplitudes are of power, and players take their square root, which is
what makes quiet clips felt; a frequency is 0 to 1 of the range that a player has.
"""

import math
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

from msgspec import Meta, Struct

from controller.errors import ConfigError
from controller.workshop.clips.clip import NEUTRAL, Curve, DesignedClip, Tap, Time, Vibration, decoded_json

MAJOR = 1
Share = Annotated[float, Meta(ge=0, le=1)]


class _Emphasis(Struct):
    amplitude: Share
    frequency: Share


class _Amplitude(Struct):
    time: Time
    amplitude: Share
    emphasis: _Emphasis | None = None


class _Frequency(Struct):
    time: Time
    frequency: Share


class _Envelopes(Struct):
    amplitude: Annotated[list[_Amplitude], Meta(min_length=1)]
    frequency: list[_Frequency] = []


class _Continuous(Struct):
    envelopes: _Envelopes


class _Signals(Struct):
    continuous: _Continuous


class _Version(Struct):
    major: int


class _File(Struct):
    version: _Version
    signals: _Signals


def read_haptic(file: Path) -> DesignedClip:
    """Read a clip; raises ConfigError if it is no .haptic of this major version."""
    read = decoded_json(file, _File)
    if read.version.major != MAJOR:
        raise ConfigError(f"{file}: version.major = {read.version.major}: only {MAJOR} is known")
    envelopes = read.signals.continuous.envelopes
    _check_order(file, "amplitude", [point.time for point in envelopes.amplitude])
    _check_order(file, "frequency", [point.time for point in envelopes.frequency])
    points = envelopes.amplitude
    amplitude = Curve(tuple(point.time for point in points), tuple(math.sqrt(point.amplitude) for point in points))
    frequency = Curve((0.0,), (NEUTRAL,))
    if envelopes.frequency:
        frequency = Curve(
            tuple(point.time for point in envelopes.frequency), tuple(point.frequency for point in envelopes.frequency)
        )
    taps = [
        Tap(point.time, math.sqrt(point.emphasis.amplitude), point.emphasis.frequency)
        for point in points
        if point.emphasis is not None
    ]
    vibration = Vibration(points[0].time, points[-1].time, amplitude, frequency)
    return DesignedClip(tuple(taps), (vibration,) if any(amplitude.values) else (), Counter())


def _check_order(file: Path, name: str, times_s: Sequence[float]) -> None:
    for index in range(1, len(times_s)):
        if times_s[index] < times_s[index - 1]:
            raise ConfigError(
                f"{file}: signals.continuous.envelopes.{name}[{index}].time = {times_s[index]:g} is earlier than the one before"
            )
