"""Pulses of any rhythm: those that an effect lists, and those of a train whose rate changes (`rate_envelope`)."""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Iterator, Sequence
from functools import lru_cache
from itertools import pairwise
from typing import Final

from controller.device.board.devices import MIN_AMPLITUDE
from controller.device.scene.effects.effects import ROUNDING, EffectTable

Point = tuple[float, float]
SILENCE: Final = MIN_AMPLITUDE / 2  # an envelope below it is nearer to silence than to the weakest emission
FOREVER_MS: Final = 1e12  # an envelope is constant beyond its last point


def between(points: Sequence[Point], at: float) -> float:
    """Value at a place of points (place, value): linear between them, constant before the first and after the last."""
    after = bisect_right(points, (at, math.inf))
    if not after or after == len(points):
        return points[after and -1][1]
    (before_at, before), (after_at, value) = points[after - 1], points[after]
    return before + (value - before) * (at - before_at) / (after_at - before_at)


@lru_cache(maxsize=2)  # an effect is asked for it once for each check
def rhythm_of(effect: EffectTable) -> tuple[Point, ...]:
    """Each pulse (ms, amplitude) of an effect of a rhythm, in order of time, silent ones included; empty: it has none."""
    if effect.pulses is not None:
        return effect.pulses
    if effect.rate_envelope is None or effect.duration_ms is None:
        return ()
    times_ms = pulse_times_ms(effect.rate_envelope, effect.duration_ms, effect.phase or 0.0)
    envelope = effect.envelope or ((0.0, 1.0),)
    return tuple((at_ms, between(envelope, at_ms)) for at_ms in times_ms)


def pulse_times_ms(rates: Sequence[Point], duration_ms: float, phase: float) -> list[float]:
    """Times at which the integral of a rate has come to `phase`, `phase` + 1, …, before the end.

    `rates` are points (ms, Hz) in order of time, all above 0 Hz; `phase` is 0 to 1 periods.
    """
    times_ms: list[float] = []
    passed, wanted = 0.0, phase  # periods
    for begin_ms, end_ms, first_hz, last_hz in _pieces(rates, duration_ms):
        length_s = (end_ms - begin_ms) * 1e-3
        slope = (last_hz - first_hz) / length_s
        whole = passed + (first_hz + last_hz) / 2 * length_s
        while wanted < whole - ROUNDING:
            missing = wanted - passed  # = first t + slope t² / 2, solved without cancellation
            root = math.sqrt(max(first_hz * first_hz + 2 * slope * missing, 0.0))
            times_ms.append(begin_ms + 2e3 * missing / (first_hz + root))
            wanted += 1
        passed = whole
    return times_ms


def _pieces(rates: Sequence[Point], duration_ms: float) -> Iterator[tuple[float, float, float, float]]:
    """(begin in ms, end in ms, rate at its begin, rate at its end) of each linear piece up to the end."""
    points = [(0.0, between(rates, 0.0)), *[point for point in rates if point[0] > 0], (FOREVER_MS, rates[-1][1])]
    for (begin_ms, first_hz), (after_ms, _) in pairwise(points):
        if begin_ms < duration_ms:
            end_ms = min(after_ms, duration_ms)
            yield begin_ms, end_ms, first_hz, between(points, end_ms)
