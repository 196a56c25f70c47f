"""AHAP, Apple's haptic and audio pattern (JSON): developer.apple.com, "Representing haptic patterns in AHAP files".

Missing keys have defaults, values out of range are taken as the nearest, unknown keys are ignored. Controls act on all events at
once: that of intensity multiplies, that of sharpness is added. Of two controls the one that began last is in force, and the last
value of a curve stays.
"""

from bisect import bisect_right
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Final

import numpy as np
from msgspec import Struct, field

from controller.arrays import Floats
from controller.errors import ConfigError
from controller.workshop.clips.clip import NEUTRAL, Curve, DesignedClip, Number, Tap, Time, Vibration, bounded, decoded_json

LONGEST_S: Final = 30.0  # of an event: Core Haptics plays no longer one
INTENSITY_CONTROL, SHARPNESS_CONTROL = "HapticIntensityControl", "HapticSharpnessControl"
WITHOUT_EFFECT: Final = ("AttackTime", "DecayTime", "ReleaseTime")  # at their default, 0


class _Value(Struct, rename="pascal"):
    parameter_id: str = field(name="ParameterID")
    parameter_value: Number = 0.0


class _Event(Struct, rename="pascal"):
    event_type: str
    time: Time = 0.0
    event_duration: Time | None = None
    event_parameters: list[_Value] = []


class _Parameter(Struct, rename="pascal"):
    parameter_id: str = field(name="ParameterID")
    parameter_value: Number = 0.0
    time: Time = 0.0


class _Point(Struct, rename="pascal"):
    time: Time = 0.0
    parameter_value: Number = 0.0


class _ParameterCurve(Struct, rename="pascal"):
    parameter_id: str = field(name="ParameterID")
    time: Time = 0.0
    points: list[_Point] = field(name="ParameterCurveControlPoints", default_factory=list)


class _Item(Struct, rename="pascal"):
    event: _Event | None = None
    parameter: _Parameter | None = None
    parameter_curve: _ParameterCurve | None = None


class _File(Struct, rename="pascal"):
    pattern: list[_Item]


class _Control:
    """A dynamic parameter over time: steps and curves, each (start, points after the start)."""

    def __init__(self, neutral: float, pieces: Sequence[tuple[float, Curve]]) -> None:
        self._pieces = sorted(pieces, key=lambda piece: piece[0])
        self._starts_s = [start_s for start_s, _ in self._pieces]
        self._neutral = neutral

    def at(self, times_s: Floats) -> Floats:
        """Values at some times, which are in order."""
        values = np.full(len(times_s), self._neutral)
        for start_s, curve in self._within(float(times_s[0]), float(times_s[-1])):
            later = times_s >= start_s
            values[later] = curve.at(times_s[later] - start_s)
        return values

    def corners_s(self, start_s: float, end_s: float) -> list[float]:
        """Times within a span at which it bends, begins or jumps; of a jump also the time just before."""
        found = []
        for at_s, curve in self._within(start_s, end_s):
            found += [np.nextafter(at_s, -np.inf), at_s, *[at_s + time_s for time_s in curve.times_s]]
        return [float(time_s) for time_s in found if start_s < time_s < end_s]

    def _within(self, start_s: float, end_s: float) -> list[tuple[float, Curve]]:
        """Pieces that are in force at some time within a span."""
        return self._pieces[max(bisect_right(self._starts_s, start_s) - 1, 0) : bisect_right(self._starts_s, end_s)]


def read_ahap(file: Path) -> DesignedClip:
    """Read a clip; raises ConfigError if it is no AHAP."""
    items = decoded_json(file, _File).pattern
    ignored: Counter[str] = Counter()
    intensity, sharpness = _control(items, INTENSITY_CONTROL, 1.0), _control(items, SHARPNESS_CONTROL, 0.0)
    taps, vibrations = [], []
    for index, item in enumerate(items):
        for changed in (item.parameter, item.parameter_curve):
            if changed is not None and changed.parameter_id not in (INTENSITY_CONTROL, SHARPNESS_CONTROL):
                ignored[changed.parameter_id] += 1
        event = item.event
        if event is None:
            continue
        given = {value.parameter_id: value.parameter_value for value in event.event_parameters}
        strength, sharp = bounded(given.pop("HapticIntensity", 1.0)), bounded(given.pop("HapticSharpness", NEUTRAL))
        if event.event_type == "HapticTransient":
            at = np.array([event.time])
            taps.append(
                Tap(event.time, strength * bounded(float(intensity.at(at)[0])), bounded(sharp + float(sharpness.at(at)[0])))
            )
        elif event.event_type == "HapticContinuous":
            if event.event_duration is None:
                raise ConfigError(f"{file}: Pattern[{index}].Event.EventDuration is missing: a HapticContinuous has one")
            ignored.update(name for name in WITHOUT_EFFECT if given.get(name))
            ignored.update(["Sustained = 0"] if given.get("Sustained") == 0 else [])
            vibrations.append(
                _vibration(event.time, bounded(event.event_duration, 0.0, LONGEST_S), strength, sharp, intensity, sharpness)
            )
        else:
            ignored[event.event_type] += 1
    return DesignedClip(tuple(taps), tuple(vibrations), ignored)


def _control(items: Sequence[_Item], name: str, neutral: float) -> _Control:
    pieces = []
    for item in items:
        if item.parameter is not None and item.parameter.parameter_id == name:
            pieces.append((item.parameter.time, Curve((0.0,), (item.parameter.parameter_value,))))
        if item.parameter_curve is not None and item.parameter_curve.parameter_id == name and item.parameter_curve.points:
            points = sorted(item.parameter_curve.points, key=lambda point: point.time)
            curve = Curve(tuple(point.time for point in points), tuple(point.parameter_value for point in points))
            pieces.append((item.parameter_curve.time, curve))
    return _Control(neutral, pieces)


def _vibration(
    start_s: float, length_s: float, strength: float, sharp: float, intensity: _Control, sharpness: _Control
) -> Vibration:
    end_s = start_s + length_s
    corners = sorted({start_s, end_s, *intensity.corners_s(start_s, end_s), *sharpness.corners_s(start_s, end_s)})
    times_s = np.array(corners)
    amplitudes = strength * np.clip(intensity.at(times_s), 0, 1)
    sharps = np.clip(sharp + sharpness.at(times_s), 0, 1)
    return Vibration(
        start_s, end_s, Curve(tuple(corners), tuple(amplitudes.tolist())), Curve(tuple(corners), tuple(sharps.tolist()))
    )
