"""Which contacts may be ghosts: 60 V edges of an emission couple into a capacitive panel.

The rule, with G = `touch.ghost_ms` of board.toml, how long after the end of an emission its ghosts may still be reported:

- An emission casts a shadow from its start until G after its end. Shadows that touch are one.
- A contact first reported in a shadow is a suspect, and is held back.
- A suspect that is still down when its shadow ends is a finger: no ghost lives so long.
- Under emissions back to back the shadow does not end: then a suspect that has stayed for `PERSISTENCE` x G within
  `NEAR_M` from one report to the next is a finger; a ghost would have to be renewed at its own place twice in a row.

So a finger that lands in an emission is played at most max(T + G, 3 G) after its first report, and a ghost never is as
long as the emissions sprinkle them at random. G = 0: the panel makes no ghosts (resistive, acoustic, infrared).
"""

from __future__ import annotations

from math import inf

PERSISTENCE = 3
NEAR_M = 5e-3


class GhostGuard:
    """The shadows of the last emissions.

    Parameters
    ----------
    ghost_s : float
        G of the rule; 0: nobody is a suspect.
    """

    __slots__ = ("_before", "_end_s", "_ghost_s", "_period_s", "_shadow_s", "_start_s")

    def __init__(self, ghost_s: float) -> None:
        self._ghost_s = ghost_s
        self._before = (-inf, -inf)  # the shadow before the newest: reports are read later than they were made
        self._start_s = self._end_s = -inf  # of the newest emission's own shadow
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
        self._period_s = period_s if period_s > 0 else inf
        if self._period_s <= self._end_s - start_s:  # each repetition's shadow touches that of the next
            self._end_s = inf

    def suspects(self, first_s: float) -> bool:
        """Whether a contact first reported at a time may be a ghost."""
        if self._ghost_s == 0:
            return False
        begin_s, end_s = self._shadow(first_s)
        return begin_s <= first_s < end_s or self._before[0] <= first_s < self._before[1]

    def cleared_s(self, first_s: float, stayed_since_s: float) -> float:
        """When a suspect is a finger, if it is still down then.

        Parameters
        ----------
        first_s : float
            Its first report.
        stayed_since_s : float
            The first report since which it has not jumped.
        """
        shadow_end_s = self._before[1] if first_s < self._before[1] else self._shadow(first_s)[1]
        return min(shadow_end_s, stayed_since_s + PERSISTENCE * self._ghost_s)

    def _shadow(self, at_s: float) -> tuple[float, float]:
        """Begin and end of the newest shadow, or of that of its last repetition by a time."""
        if inf in (self._period_s, self._end_s) or at_s < self._start_s + self._period_s:
            return self._shadow_s, self._end_s
        since_s = (at_s - self._start_s) // self._period_s * self._period_s
        return self._start_s + since_s, self._end_s + since_s
