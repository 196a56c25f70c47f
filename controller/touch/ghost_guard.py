"""Which contacts may be ghosts: 60 V edges of an emission couple into a capacitive panel.

The rule, with G = `touch.ghost_ms` of board.toml, how long after the end of an emission its ghosts may still be reported:

- An emission casts a shadow from its start until G after its end. Shadows that touch are one.
- A contact first reported in a shadow is a suspect, and is held back.
- A suspect that is still down when its shadow ends is a finger: no ghost lives so long.

Under emissions close to each other a shadow would have no end. So the panel listens: while there is a suspect, the loop begins
no emission (`Tracker.quiet_until_s`), and the shadow ends at most T + G after the suspect's first report. A finger that
lands in an emission waits for so long at most, and a ghost is never played. What listening may cost is bounded (`Listening`).

G = 0: the panel makes no ghosts (resistive, acoustic, infrared).
"""

from __future__ import annotations

from math import inf

SHARE = 2 / 3  # of the time may be spent listening: a storm of ghosts leaves every emission a third of it
BURST_S = 0.1  # of listening beyond that share, when there was little of it before
BURST_GHOSTS = 4  # the same in ghosts' lives, where they live long


class GhostGuard:
    """The shadows of the last emissions.

    Parameters
    ----------
    ghost_s : float
        G of the rule; 0: nobody is a suspect.
    """

    __slots__ = ("_before", "_end_s", "_ghost_s", "_length_s", "_period_s", "_shadow_s", "_start_s")

    def __init__(self, ghost_s: float) -> None:
        self._ghost_s = ghost_s
        self._before = (-inf, -inf)  # the shadow before the newest: reports are read later than they were made
        self._start_s = self._end_s = -inf  # of the newest emission's own shadow
        self._length_s = ghost_s  # of one emission's shadow
        self._shadow_s = -inf  # when the shadow began that it is part of
        self._period_s = inf

    def emitted(self, start_s: float, end_s: float, period_s: float = 0.0) -> None:
        """An emission sounds, and what sounded before ends; see `TrackedTouch.emitted`."""
        last = self._shadow(start_s)
        if start_s > last[1]:
            self._before = last
            self._shadow_s = start_s
        else:
            self._shadow_s = last[0]
        self._start_s, self._end_s = start_s, end_s + self._ghost_s
        self._length_s = self._end_s - start_s
        self._period_s = period_s if period_s > 0 else inf
        if self._period_s <= self._length_s:  # each repetition's shadow touches that of the next
            self._end_s = inf

    def suspects(self, first_s: float) -> bool:
        """Whether a contact first reported at a time may be a ghost."""
        if self._ghost_s == 0:
            return False
        begin_s, end_s = self._shadow(first_s)
        return begin_s <= first_s < end_s or self._before[0] <= first_s < self._before[1]

    def cleared_s(self, first_s: float) -> float:
        """When a suspect is a finger, if it is still down then: the end of its shadow; inf while repetitions prolong it.

        Parameters
        ----------
        first_s : float
            Its first report.
        """
        return self._before[1] if first_s < self._before[1] else self._shadow(first_s)[1]

    def silent_s(self, first_s: float, now_s: float) -> float:
        """As `cleared_s`, if no emission and no repetition begins from `now_s` on."""
        cleared_s = self.cleared_s(first_s)
        if cleared_s != inf:
            return cleared_s
        return self._start_s + max((now_s - self._start_s) // self._period_s, 0.0) * self._period_s + self._length_s

    def _shadow(self, at_s: float) -> tuple[float, float]:
        """Begin and end of the newest shadow, or of that of its last repetition by a time."""
        if inf in (self._period_s, self._end_s) or at_s < self._start_s + self._period_s:
            return self._shadow_s, self._end_s
        since_s = (at_s - self._start_s) // self._period_s * self._period_s
        return self._start_s + since_s, self._end_s + since_s


class Listening:
    """How much silence may be asked for: `SHARE` of the time, and a little at once.

    Parameters
    ----------
    ghost_s : float
        G.

    Attributes
    ----------
    total_s : float
        Silence that was asked for and kept.
    again_s : float
        When to ask again after a refusal; inf: nothing was refused.
    """

    __slots__ = ("_at_s", "_credit_s", "_most_s", "_on", "again_s", "total_s")

    def __init__(self, ghost_s: float) -> None:
        self._most_s = self._credit_s = max(BURST_S, BURST_GHOSTS * ghost_s) * (1 - SHARE)
        self._at_s = -inf
        self._on = False
        self.again_s = inf
        self.total_s = 0.0

    def begin(self, now_s: float, until_s: float) -> bool:
        """Listen from now until a time, or go on doing so; False if that is too much."""
        self.end(now_s, going_on=self._on)
        cost_s = (until_s - now_s) * (1 - SHARE)
        if not self._on and self._credit_s < min(cost_s, self._most_s):
            self.again_s = now_s + (min(cost_s, self._most_s) - self._credit_s) / SHARE
            return False
        self._on = True
        return True

    def end(self, now_s: float, *, going_on: bool = False) -> None:
        """Count the time that went by since the last call, and listen no longer."""
        since_s, self._at_s = max(now_s - self._at_s, 0.0), now_s
        if self._on:
            self.total_s += since_s
        self._credit_s = min(self._credit_s + (SHARE - self._on) * since_s, self._most_s)
        self._on = going_on
        self.again_s = inf
