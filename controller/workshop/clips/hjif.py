"""HJIF, the interchange form (JSON) of MPEG haptics, ISO/IEC 23090-31: github.com/MPEGGroup/HapticReferenceSoftware, IOJson.cpp.

Perceptions have channels, channels have bands of frequencies, bands have effects, and effects have keyframes. All bands of what
vibrates are felt at one place. Profile Simple Parametric is read whole, of Main all but wavelets and composite effects.
"""

import math
import re
from collections import Counter
from collections.abc import Iterator, Sequence
from itertools import groupby
from pathlib import Path
from typing import Annotated, Final, Literal, NamedTuple

from msgspec import Meta, Struct

from controller.errors import ConfigError
from controller.workshop.clips.clip import NEUTRAL, Curve, DesignedClip, Number, Tap, Vibration, bounded, decoded_json

FELT: Final = ("Vibrotactile", "Vibration")  # modalities; the second is an older name of the first
FIRST_YEAR: Final = 2023
MOST_KEYFRAMES: Final = 1_000_000  # of all effects, each as often as it is referred to

Ticks = Annotated[int, Meta(ge=0, le=86_400 * 48_000)]
Hz = Annotated[float, Meta(ge=0, le=1e6)]


class _Keyframe(Struct):
    relative_position: Ticks = 0
    amplitude_modulation: Number | None = None
    frequency_modulation: Hz | None = None


class _Effect(Struct):
    effect_type: Literal["Basis", "Reference", "Composite"]
    position: Ticks = 0
    id: int | None = None
    phase: Number = 0.0
    base_signal: str = "Sine"
    keyframes: list[_Keyframe] = []


class _Band(Struct):
    band_type: Literal["Transient", "Curve", "VectorialWave", "WaveletWave"]
    lower_frequency_limit: Hz
    upper_frequency_limit: Hz
    effects: list[_Effect]


class _Channel(Struct):
    bands: list[_Band]
    gain: Number = 1.0
    actuator_target: list[object] = []


class _Perception(Struct):
    perception_modality: str
    channels: list[_Channel]
    effect_library: list[_Effect] = []


class _File(Struct):
    version: str
    profile: Literal["Main", "Simple Parametric"]
    perceptions: list[_Perception]
    timescale: Annotated[int, Meta(ge=1, le=48_000)] = 1000


class _Placed(NamedTuple):
    """A basis effect in its band, where and as strong as its channel plays it; times in s."""

    start_s: float
    tick_s: float
    gain: float
    band: _Band
    effect: _Effect


def read_hjif(file: Path) -> DesignedClip:
    """Read a clip; raises ConfigError if it is no HJIF, or refers to an effect that it does not have."""
    read = decoded_json(file, _File)
    year = re.match(r"(\d{4})(-\d+)?$", read.version)
    if year is None or int(year[1]) < FIRST_YEAR:
        raise ConfigError(f"{file}: version = {read.version[:20]!r}: a year from {FIRST_YEAR} on is expected")
    ignored: Counter[str] = Counter()
    taps: list[Tap] = []
    vibrations: list[Vibration] = []
    keyframes = 0
    for placed in _placed(file, read, ignored):
        keyframes += len(placed.effect.keyframes)
        if keyframes > MOST_KEYFRAMES:
            raise ConfigError(f"{file}: its effects have more than {MOST_KEYFRAMES:,} keyframes, references included")
        match placed.band.band_type:
            case "VectorialWave":
                vibrations += _vibration(placed)
                ignored.update([f"base_signal = {placed.effect.base_signal}"] if placed.effect.base_signal != "Sine" else [])
            case "Transient":
                taps += [_tap(placed, keyframe) for keyframe in placed.effect.keyframes]
            case _:
                taps += _swings(placed)
    return DesignedClip(tuple(taps), tuple(vibrations), ignored)


def _placed(file: Path, read: _File, ignored: Counter[str]) -> Iterator[_Placed]:
    """Every basis effect of what vibrates, references resolved; what is left out is counted."""
    for number, perception in enumerate(read.perceptions):
        if perception.perception_modality not in FELT:
            ignored[f"perception_modality = {perception.perception_modality}"] += 1
            continue
        library = {effect.id: effect for effect in perception.effect_library}
        for channel in perception.channels:
            ignored.update(["actuator_target"] if channel.actuator_target else [])
            for band in channel.bands:
                if band.band_type == "WaveletWave":
                    ignored["WaveletWave"] += 1
                    continue
                for effect in band.effects:
                    played = library.get(effect.id) if effect.effect_type == "Reference" else effect
                    if played is None:
                        raise ConfigError(
                            f"{file}: perceptions[{number}].effect_library has no effect {effect.id}, to which one refers"
                        )
                    if played.effect_type != "Basis":
                        ignored[f"{played.effect_type} effect"] += 1
                        continue
                    yield _Placed(effect.position / read.timescale, 1 / read.timescale, channel.gain, band, played)


def _strength(placed: _Placed, keyframe: _Keyframe) -> float:
    return bounded(abs(placed.gain * _level(keyframe)))


def _at_s(placed: _Placed, keyframe: _Keyframe) -> float:
    return placed.start_s + keyframe.relative_position * placed.tick_s


def _tap(placed: _Placed, keyframe: _Keyframe) -> Tap:
    return Tap(_at_s(placed, keyframe), _strength(placed, keyframe), NEUTRAL)


def _swings(placed: _Placed) -> list[Tap]:
    """Taps of a curve: the curve is the movement itself, and a panel pushes once where it is farthest to one side."""
    ordered = sorted(placed.effect.keyframes, key=lambda keyframe: keyframe.relative_position)
    points = [next(same) for _, same in groupby(ordered, key=_level)]
    levels = [-math.inf, *(_level(point) for point in points), -math.inf]
    highest = [level > max(before, after, 0) for before, level, after in zip(levels, levels[1:-1], levels[2:], strict=False)]
    return [_tap(placed, point) for point, is_highest in zip(points, highest, strict=True) if is_highest]


def _level(keyframe: _Keyframe) -> float:
    return 1.0 if keyframe.amplitude_modulation is None else keyframe.amplitude_modulation


def _vibration(placed: _Placed) -> list[Vibration]:
    """The vibration of an effect, from its position to its last keyframe; none if it has no length."""
    keyframes = sorted(placed.effect.keyframes, key=lambda keyframe: keyframe.relative_position)
    if not keyframes or not keyframes[-1].relative_position:
        return []
    band = placed.band
    levels = [(_at_s(placed, point), _strength(placed, point)) for point in keyframes if point.amplitude_modulation is not None]
    rates = [
        (_at_s(placed, point), max(min(point.frequency_modulation, band.upper_frequency_limit), band.lower_frequency_limit))
        for point in keyframes
        if point.frequency_modulation is not None
    ]
    return [
        Vibration(
            placed.start_s,
            _at_s(placed, keyframes[-1]),
            _curve(levels or [(placed.start_s, bounded(abs(placed.gain)))]),
            Curve((placed.start_s,), (NEUTRAL,)),
            rate_hz=_curve(rates or [(placed.start_s, band.lower_frequency_limit)]),
            phase=placed.effect.phase / math.tau % 1,
        )
    ]


def _curve(points: Sequence[tuple[float, float]]) -> Curve:
    times_s, values = zip(*points, strict=True)
    return Curve(times_s, values)
