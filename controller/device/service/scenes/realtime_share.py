"""Real time below the loop's, for a share of one core: who checks a page's regions does not wait behind the page's browser."""

from __future__ import annotations

import contextlib
import os
import signal
import time
from typing import Final, Self

PRIORITY: Final = 1  # the lowest
SHARE: Final = 0.25  # of one core, in the long run
MOST_S: Final = 0.05  # of processor time at once
LEAST_S: Final = 1e-3  # that a timer can measure


class RealtimeShare:
    """Each span entered is in real time, as far as the share goes; beyond it this process is an ordinary one.

    It is so only while the loop has a higher priority, and this process may be (`LimitRTPRIO=` of the unit). It stays so between
    two spans, since what has to be quick is waking up.
    """

    def __init__(self, loop: int) -> None:
        self._loop = loop
        self._left_s = MOST_S
        self._at_s = time.monotonic()  # when that was left
        self._used_s = 0.0  # processor time at the start of the span
        signal.signal(signal.SIGPROF, lambda *_: _schedule(os.SCHED_OTHER, 0))

    def __enter__(self) -> Self:
        now_s = time.monotonic()
        self._left_s, self._at_s = refilled(self._left_s, now_s - self._at_s), now_s
        self._used_s = time.process_time()
        if self._left_s >= LEAST_S and _above_us(self._loop):
            _schedule(os.SCHED_RR, PRIORITY)
            signal.setitimer(signal.ITIMER_PROF, self._left_s)
        else:
            _schedule(os.SCHED_OTHER, 0)
        return self

    def __exit__(self, *_: object) -> None:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        self._left_s -= time.process_time() - self._used_s


def refilled(left_s: float, passed_s: float) -> float:
    """Processor time that may be used in real time after a while."""
    return min(left_s + SHARE * passed_s, MOST_S)


def _above_us(loop: int) -> bool:
    """Whether the loop is in real time, and would be so before this process."""
    try:
        policy = os.sched_getscheduler(loop) & ~os.SCHED_RESET_ON_FORK
        return policy in (os.SCHED_FIFO, os.SCHED_RR) and os.sched_getparam(loop).sched_priority > PRIORITY
    except ProcessLookupError:
        return False


def _schedule(policy: int, priority: int) -> None:
    with contextlib.suppress(PermissionError):
        os.sched_setscheduler(0, policy, os.sched_param(priority))
