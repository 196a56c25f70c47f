"""An effect as a designer's file: each pulse is a transient of AHAP, or an emphasis of .haptic on a silent vibration."""

import json
from collections.abc import Callable, Sequence
from typing import Any, Final

from controller.device.scene.effects.effects import MOST_PULSES
from controller.device.scene.effects.trains import Train
from controller.errors import ConfigError
from controller.workshop.clips.clip import NEUTRAL

DECIMALS: Final = 6  # of a time in s: 1 us
LEVEL_DECIMALS: Final = 6  # of an amplitude
Pulses = Sequence[tuple[float, float]]


def pulses_of(name: str, train: Train) -> list[tuple[float, float]]:
    """Time in s and amplitude of each pulse of an effect that is not silent.

    Raises ConfigError if they are more than a file that can be imported again has.
    """
    if train.pulses > MOST_PULSES:
        raise ConfigError(f"effect {name!r} has {train.pulses:,} pulses, a file {MOST_PULSES:,} at most: shorten it")
    pulses = ((train.first_s + train.after_s(pulse), train.amplitude_of(pulse, 1.0)) for pulse in range(train.pulses))
    return [(round(at_s, DECIMALS), amplitude) for at_s, amplitude in pulses if amplitude]


def as_ahap(name: str, pulses: Pulses) -> dict[str, Any]:
    """AHAP of pulses."""
    events = [
        {
            "Event": {
                "Time": at_s,
                "EventType": "HapticTransient",
                "EventParameters": [
                    {"ParameterID": "HapticIntensity", "ParameterValue": round(amplitude, LEVEL_DECIMALS)},
                    {"ParameterID": "HapticSharpness", "ParameterValue": NEUTRAL},
                ],
            }
        }
        for at_s, amplitude in pulses
    ]
    return {"Version": 1.0, "Metadata": {"Project": "haptic-panel", "Description": name}, "Pattern": events}


def as_haptic(name: str, pulses: Pulses) -> dict[str, Any]:
    """.haptic of pulses; its amplitudes are of power."""
    start = [{"time": 0.0, "amplitude": 0.0}] if pulses[0][0] > 0 else []
    points = [
        {"time": at_s, "amplitude": 0.0, "emphasis": {"amplitude": round(amplitude**2, LEVEL_DECIMALS), "frequency": NEUTRAL}}
        for at_s, amplitude in pulses
    ]
    return {
        "version": {"major": 1, "minor": 0, "patch": 0},
        "metadata": {"editor": "haptic-panel", "author": "", "source": "", "project": "", "tags": [], "description": name},
        "signals": {"continuous": {"envelopes": {"amplitude": [*start, *points], "frequency": []}}},
    }


WRITERS: Final[dict[str, Callable[[str, Pulses], dict[str, Any]]]] = {
    ".ahap": as_ahap,
    ".haptic": as_haptic,
}  # by the file's suffix


def exported(name: str, train: Train, suffix: str) -> tuple[str, dict[str, Any]]:
    """The effect `name` as the text of a file of a kind, and its figures; `suffix` is a key of `WRITERS`.

    Raises ConfigError if it is silent, or has too many pulses.
    """
    pulses = pulses_of(name, train)
    if not pulses:
        raise ConfigError(f"effect {name!r} is silent: there is nothing to export")
    figures = {"effect": name, "pulses": len(pulses), "silent": train.pulses - len(pulses), "length_ms": pulses[-1][0] * 1e3}
    return json.dumps(WRITERS[suffix](name, pulses), indent=1) + "\n", figures
