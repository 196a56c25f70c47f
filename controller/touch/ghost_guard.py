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

    __slots__ = ("_before", "_end_s", "_ghost_s", "_start_s")

    def __init__(self, ghost_s: float) -> None:
        self._ghost_s = ghost_s
        self._start_s = self._end_s = -inf  # of the newest shadow
        self._before = (-inf, -inf)  # the one before: reports are read later than they were made

    def emitted(self, start_s: float, end_s: float) -> None:
        """An emission sounds, and what sounded before ends; `end_s` may be inf, until the next one is told."""
        if start_s > self._end_s:
            self._before = (self._start_s, self._end_s)
            self._start_s = start_s
        self._end_s = end_s + self._ghost_s

    def suspects(self, first_s: float) -> bool:
        """Whether a contact first reported at a time may be a ghost."""
        if self._ghost_s == 0:
            return False
        return self._start_s <= first_s < self._end_s or self._before[0] <= first_s < self._before[1]

    def cleared_s(self, first_s: float, stayed_since_s: float) -> float:
        """When a suspect is a finger, if it is still down then.

        Parameters
        ----------
        first_s : float
            Its first report.
        stayed_since_s : float
            The first report since which it has not jumped.
        """
        shadow_end_s = self._before[1] if first_s < self._before[1] else self._end_s
        return min(shadow_end_s, stayed_since_s + PERSISTENCE * self._ghost_s)
