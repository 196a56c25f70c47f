"""Ghost rejection: which contacts may be caused by the 60 V edges of an emission, which couple into a capacitive panel.

The rule, with G = `touch.ghost_ms` of board.toml, the longest time from the end of an emission to the last report of a ghost:

- The ghost window of an emission lasts from its start until G after its end. Windows that touch are merged.
- A contact first reported in a ghost window is a suspect and is held back.
- A suspect that is still down when its window ends is a finger: no ghost lives so long.

With emissions in quick succession a window would never end. Therefore, while there is a suspect, the loop begins no emission
(`Tracker.quiet_until_s`), and the window ends at most T + G after the suspect's first report (T: length of an emission). A
finger put down during an emission waits at most that long, and a ghost is never played. `QuietBudget` limits the quiet time.

G = 0: the panel makes no ghosts (resistive, acoustic, infrared).
"""

from __future__ import annotations

from math import inf

MAX_QUIET_SHARE = 2 / 3  # of all time: even a storm of ghosts leaves emissions a third of it
ROUNDING_S = 1e-9  # of times: a time that lacks no more is had at once
BURST_S = 0.1  # quiet time allowed at once beyond that share
BURST_LIVES = 4  # the same in multiples of G, if that is longer


class GhostGuard:
    """Ghost windows of the last emissions. `ghost_s` is G of the rule; with 0 nothing need be announced or asked."""

    def __init__(self, ghost_s: float) -> None:
        self.expects_ghosts = ghost_s > 0
        self._ghost_s = ghost_s
        self._previous = (-inf, -inf)  # begin and end of the last but one window: reports are read later than they were made
        self._start_s = self._end_s = -inf  # of the newest emission's own window
        self._length_s = ghost_s  # of the window of one emission
        self._window_begin_s = -inf  # of the merged window
        self._period_s = inf

    def emitted(self, start_s: float, end_s: float, period_s: float = 0.0) -> None:
        """Announce an emission from `start_s` to `end_s`, repeated every `period_s` if above 0; see `TrackedTouch.emitted`."""
        last = self._window(start_s)
        if start_s > last[1]:
            self._previous = last
            self._window_begin_s = start_s
        else:
            self._window_begin_s = last[0]
        self._start_s, self._end_s = start_s, end_s + self._ghost_s
        self._length_s = self._end_s - start_s
        self._period_s = period_s if period_s > 0 else inf
        if self._period_s <= self._length_s:  # the windows of all repetitions merge
            self._end_s = inf

    def suspects(self, first_s: float) -> bool:
        """Whether a contact first reported at `first_s` may be a ghost."""
        begin_s, end_s = self._window(first_s)
        return begin_s <= first_s < end_s or self._previous[0] <= first_s < self._previous[1]

    def cleared_s(self, first_s: float) -> float:
        """End of a suspect's ghost window: if it is still down then, it is a finger.

        It was first reported at `first_s`; inf while an emission repeats.
        """
        return self._previous[1] if first_s < self._previous[1] else self._window(first_s)[1]

    def cleared_if_quiet_s(self, first_s: float, now_s: float) -> float:
        """As `cleared_s` of `first_s`, provided that no emission and no repetition begins from `now_s` on."""
        cleared_s = self.cleared_s(first_s)
        if cleared_s != inf:
            return cleared_s
        return self._start_s + max((now_s - self._start_s) // self._period_s, 0.0) * self._period_s + self._length_s

    def _window(self, at_s: float) -> tuple[float, float]:
        """Begin and end of the newest window at `at_s`; while an emission repeats, of that of its last repetition."""
        if inf in (self._period_s, self._end_s) or at_s < self._start_s + self._period_s:
            return self._window_begin_s, self._end_s
        since_s = (at_s - self._start_s) // self._period_s * self._period_s
        return self._start_s + since_s, self._end_s + since_s


class QuietBudget:
    """Limits the quiet time to `MAX_QUIET_SHARE` of all time, with a reserve for a burst (a leaky bucket).

    `ghost_s` is G of the rule.
    """

    def __init__(self, ghost_s: float) -> None:
        self._max_credit_s = self._credit_s = max(BURST_S, BURST_LIVES * ghost_s) * (1 - MAX_QUIET_SHARE)
        self._last_s = -inf
        self._quiet = False
        self.asked = False  # whether `begin` was called since the last `end`, which is needed then
        self.retry_s = inf  # when to ask again after a refusal, on the loop's clock; inf: nothing was refused
        self.total_s = 0.0  # quiet time so far

    def begin(self, now_s: float, until_s: float) -> bool:
        """Begin or continue a quiet time that is expected to end at `until_s`; False: refused, it would exceed the budget."""
        self.end(now_s, going_on=self._quiet)
        self.asked = True
        cost_s = (until_s - now_s) * (1 - MAX_QUIET_SHARE)
        missing_s = min(cost_s, self._max_credit_s) - self._credit_s
        if not self._quiet and missing_s > ROUNDING_S:
            self.retry_s = now_s + missing_s / MAX_QUIET_SHARE
            return False
        self._quiet = True
        return True

    def end(self, now_s: float, *, going_on: bool = False) -> None:
        """Account for the time since the last call and end the quiet time, unless it is `going_on`."""
        since_s, self._last_s = max(now_s - self._last_s, 0.0), now_s
        if self._quiet:
            self.total_s += since_s
        self._credit_s = min(self._credit_s + (MAX_QUIET_SHARE - self._quiet) * since_s, self._max_credit_s)
        self._quiet = self.asked = going_on
        self.retry_s = inf
