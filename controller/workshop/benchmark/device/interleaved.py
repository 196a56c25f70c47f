"""Processor time of several jobs that take turns, so that what disturbs the machine disturbs all alike."""

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

CLOCK_CALLS = 200
TURNS_AT_LEAST = 3


@dataclass(frozen=True)
class CallTiming:
    """Processor time of one call of a job in us."""

    median_us: float  # median_us, p99_us: over all calls that follow one of the same
    p99_us: float
    first_us: float  # median of those that follow other jobs, which have taken the caches
    calls: int


def interleaved(
    jobs: Sequence[Sequence[Callable[[], object]]], turns: int, most_s: float, each: Callable[[], None] = lambda: None
) -> list[CallTiming]:
    """Time jobs, by the processor time of this thread: other processes only disturb its caches.

    Each call of a job is made twice in every turn; what the clock itself takes is left out. A job that has taken longer than
    `most_s` makes three turns and no more. `each` is called after each turn.
    """
    clock = time.thread_time_ns
    empty = []
    for _ in range(CLOCK_CALLS):
        begin = clock()
        empty.append(clock() - begin)
    of_clock = float(np.median(empty))
    for calls in jobs:  # what is made once is not timed
        for call in calls:
            call()
    taken: list[list[tuple[int, int]]] = [[] for _ in jobs]
    for turn in range(turns):
        for calls, found in zip(jobs, taken, strict=True):
            if turn >= TURNS_AT_LEAST and sum(map(sum, found)) > 1e9 * most_s:
                continue
            for call in calls:
                begin = clock()
                call()
                middle = clock()
                call()
                found.append((middle - begin, clock() - middle))
        each()
    timings = []
    for found in taken:
        first_us, again_us = np.maximum(np.array(found) - of_clock, 0).T * 1e-3
        timings.append(
            CallTiming(float(np.median(again_us)), float(np.quantile(again_us, 0.99)), float(np.median(first_us)), len(found))
        )
    return timings
