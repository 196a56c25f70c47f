"""Times of a recording put in order: from 0, never decreasing, without impossible gaps."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence

LONGEST_GAP_S = 60.0
SETTLED_EVENTS = 50  # a clock that has not come back after so many events was set


def rebased(raw_s: Sequence[float], warnings: Counter[str]) -> list[float]:
    """Times from the first event.

    An event earlier than the one before, or more than a minute later, or without a time that is a
    number, takes the time of the one before. If those after it stay off, the clock was set while
    recording: they keep their distances to each other.

    Parameters
    ----------
    raw_s : sequence of float
        As recorded, in s; anything.
    warnings : Counter
        Counts `time_backwards` and `time_absurd`.
    """
    times: list[float] = []
    offset_s = 0.0
    now_s = -math.inf  # before the first event with a time
    for index, raw in enumerate(raw_s):
        time_s = raw - offset_s
        if not abs(time_s) < 1e15:
            warnings["time_absurd"] += 1
        elif now_s == -math.inf:
            offset_s, now_s = raw, 0.0
        elif now_s <= time_s <= now_s + LONGEST_GAP_S:
            now_s = time_s
        else:
            warnings["time_backwards" if time_s < now_s else "time_absurd"] += 1
            if not any(_fits(later - offset_s, now_s) for later in raw_s[index + 1 : index + 1 + SETTLED_EVENTS]):
                offset_s = raw - now_s
        times.append(max(now_s, 0.0))
    return times


def _fits(time_s: float, now_s: float) -> bool:
    return now_s <= time_s <= now_s + LONGEST_GAP_S
