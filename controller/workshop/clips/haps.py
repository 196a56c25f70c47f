""".haps, of Interhaptics and Razer (JSON), version 5: what vibrates.

It has no public description; names are as its writers use them. A track has melodies, a melody has notes. A note with keyframes
vibrates; one without is a tap. Gains of file, track, melody and note are multiplied.
"""

from collections import Counter
from pathlib import Path
from typing import Final

from msgspec import Struct, field

from controller.errors import ConfigError
from controller.workshop.clips.clip import NEUTRAL, Curve, DesignedClip, Number, Tap, Time, Vibration, bounded, decoded_json

VERSION: Final = "5"
RATE_HZ: Final = 100.0  # where a note has none


class _Point(Struct, rename=lambda name: f"m_{name}"):
    time: Time = 0.0
    value: Number = 0.0


class _Modulation(Struct, rename=lambda name: f"m_{name}"):
    keyframes: list[_Point] = []


class _Haptic(Struct, rename={"amplitude": "m_amplitudeModulation", "frequency": "m_frequencyModulation"}):
    amplitude: _Modulation = field(default_factory=_Modulation)
    frequency: _Modulation = field(default_factory=_Modulation)


class _Note(Struct, rename={"start": "m_startingPoint", "length": "m_length", "gain": "m_gain", "effect": "m_hapticEffect"}):
    start: Time
    length: Time = 0.0
    gain: Number = 1.0
    effect: _Haptic = field(default_factory=_Haptic)


class _Melody(Struct, rename=lambda name: f"m_{name}"):
    notes: list[_Note]
    mute: int | bool = 0
    gain: Number = 1.0


class _Track(Struct, rename=lambda name: f"m_{name}"):
    melodies: list[_Melody] = []
    gain: Number = 1.0
    loop: int | bool = 0


class _Other(Struct, rename=lambda name: f"m_{name}"):
    melodies: list[object] = []


class _File(Struct, rename=lambda name: f"m_{name}"):
    vibration: _Track
    gain: Number = 1.0
    stiffness: _Other = field(default_factory=_Other)
    texture: _Other = field(default_factory=_Other)


class _Version(Struct, rename={"version": "m_version", "later": "version"}):
    version: str | int | None = None
    later: str | int | None = None  # its name from version 6 on


def read_haps(file: Path) -> DesignedClip:
    """Read a clip; raises ConfigError if it is no .haps of this version."""
    found = decoded_json(file, _Version)
    version = found.later if found.version is None else found.version
    if str(version) != VERSION:
        raise ConfigError(f"{file}: its version is {str(version)[:20]!r}: only {VERSION} is known")
    read = decoded_json(file, _File)
    ignored = Counter({f"melodies of {name}": len(getattr(read, name).melodies) for name in ("stiffness", "texture")})
    ignored["m_loop"] = int(bool(read.vibration.loop))
    taps: list[Tap] = []
    vibrations: list[Vibration] = []
    for melody in read.vibration.melodies:
        ignored["muted melody"] += bool(melody.mute)
        gain = read.gain * read.vibration.gain * melody.gain
        for note in [] if melody.mute else melody.notes:
            if note.effect.amplitude.keyframes or note.effect.frequency.keyframes:
                vibrations.append(_vibration(note, gain * note.gain))
            else:
                taps.append(Tap(note.start, bounded(abs(gain * note.gain)), NEUTRAL))
    return DesignedClip(tuple(taps), tuple(vibrations), +ignored)


def _vibration(note: _Note, gain: float) -> Vibration:
    amplitude = [_Point(point.time, bounded(abs(gain * point.value))) for point in note.effect.amplitude.keyframes]
    return Vibration(
        note.start,
        note.start + note.length,
        _curve(note, amplitude, bounded(abs(gain))),
        Curve((note.start,), (NEUTRAL,)),
        rate_hz=_curve(note, note.effect.frequency.keyframes, RATE_HZ),
    )


def _curve(note: _Note, points: list[_Point], otherwise: float) -> Curve:
    """Values over time, of keyframes that count from the note's start."""
    found = sorted(points or [_Point(0.0, otherwise)], key=lambda point: point.time)
    return Curve(tuple(note.start + point.time for point in found), tuple(max(point.value, 0.0) for point in found))
