"""A clip as pulses [ms, amplitude]: what a panel has in place of a vibration is single emissions, as often as its duty allows.

A tap is one pulse. A vibration is pulses at a rate that its sharpness gives; their phase is the rate's integral, so that a changing
rate neither stutters nor skips. Below 0.05 nothing is felt; from there to 0.1, the least that a panel plays, a pulse has 0.1.
Where pulses are nearer to each other than the duty allows a tap goes before a vibration, and the stronger tap before the weaker.
"""

import math
from bisect import bisect_left, insort
from typing import Final, NamedTuple

import numpy as np

from controller.arrays import Floats
from controller.device.board.devices import MIN_AMPLITUDE
from controller.device.scene.effects.effects import ROUNDING
from controller.device.scene.effects.rhythms import SILENCE
from controller.workshop.clips.clip import DesignedClip, Vibration

STEP_S: Final = 1e-4  # of the integral of a rate
DECIMALS: Final = 3  # of a time in ms: 1 us
ROUNDED_MS: Final = 10.0**-DECIMALS


class ImportReport(NamedTuple):
    """What became of a clip."""

    taps: int  # taps, taps_kept, wanted, kept: of its taps, and of the pulses of its vibrations
    taps_kept: int
    wanted: int
    kept: int
    # silent, lifted: pulses below half of the least amplitude, which are left out, and those between that and the least, which
    # have the least
    silent: int
    lifted: int
    too_close: int  # left out since another one is nearer than the duty allows
    slowed: int  # pulses where the file's frequency is higher than the duty allows: they follow each other as fast as it does
    ignored: dict[str, int]  # what has no counterpart, by its name in the file


def rhythm_of(clip: DesignedClip, least_ms: float, low_hz: float, high_hz: float) -> tuple[list[list[float]], ImportReport]:
    """Pulses [ms, amplitude] of a clip, in order of time.

    Pulses are at least `least_ms` apart; `low_hz` and `high_hz` are rates of a vibration of sharpness 0 and 1.
    """
    kept: dict[float, float] = {}  # amplitude by time in ms
    times: list[float] = []  # the same times in order
    silent = lifted = too_close = 0
    taps = sorted(((tap.at_s * 1e3, tap.amplitude) for tap in clip.taps), key=lambda tap: (-tap[1], tap[0]))
    vibrating = [_pulses(vibration, least_ms, low_hz, high_hz) for vibration in clip.vibrations]
    pulses = sorted(pulse for found, _ in vibrating for pulse in found)
    taps_kept = 0
    for group in (taps, pulses):
        for exact_ms, amplitude in group:
            at_ms = round(exact_ms, DECIMALS)
            if amplitude < SILENCE:
                silent += 1
            elif _is_free(times, at_ms, least_ms):
                insort(times, at_ms)
                kept[at_ms] = round(max(amplitude, MIN_AMPLITUDE), DECIMALS)
                lifted += amplitude < MIN_AMPLITUDE
            else:
                too_close += 1
        taps_kept = taps_kept if group is pulses else len(kept)
    found = [[at_ms, kept[at_ms]] for at_ms in times]
    ignored = dict(sorted(clip.ignored.items()))
    slowed = sum(count for _, count in vibrating)
    return found, ImportReport(len(taps), taps_kept, len(pulses), len(kept) - taps_kept, silent, lifted, too_close, slowed, ignored)


def _is_free(times: list[float], at_ms: float, least_ms: float) -> bool:
    place = bisect_left(times, at_ms)
    return all(abs(other - at_ms) >= least_ms * (1 - ROUNDING) for other in times[max(place - 1, 0) : place + 1])


def _pulses(vibration: Vibration, least_ms: float, low_hz: float, high_hz: float) -> tuple[list[tuple[float, float]], int]:
    """Time in ms and amplitude of each pulse of a vibration, the first at its start, none at its end; and how many are slowed."""
    length_s = vibration.end_s - vibration.start_s
    if length_s <= 0:
        return [], 0
    times_s: Floats = vibration.start_s + np.linspace(0, length_s, max(round(length_s / STEP_S), 1) + 1)
    if vibration.rate_hz is None:
        rates_hz = low_hz + (high_hz - low_hz) * vibration.sharpness.at(times_s)
    else:
        rates_hz = vibration.rate_hz.at(times_s)
    fastest_hz = 1e3 / (math.ceil(least_ms / ROUNDED_MS - ROUNDING) * ROUNDED_MS + ROUNDED_MS)  # as near once both are rounded
    allowed_hz = np.minimum(rates_hz, fastest_hz)
    phase = np.append(0.0, ((allowed_hz[1:] + allowed_hz[:-1]) / 2 * np.diff(times_s)).cumsum())
    turns = np.arange(math.ceil(vibration.phase), np.ceil(phase[-1] + vibration.phase - 1e-9)) - vibration.phase
    pulses_s = np.interp(turns, phase, times_s)
    slowed = np.interp(pulses_s, times_s, rates_hz) > 1e3 / least_ms * (1 + ROUNDING)
    amplitudes = vibration.amplitude.at(pulses_s)
    return list(zip((pulses_s * 1e3).tolist(), amplitudes.tolist(), strict=True)), int(slowed.sum())
