"""Which of the emissions that wait are played together, and which wait for the plate's next turn. Pure.

The plate plays one waveform at a time. Foci far enough apart share one: their responses are summed. What
this costs in amplitude grows with their number (two get 0.74 of what one would get, four 0.54, ten 0.36); what
it saves is T for each.
"""

from __future__ import annotations

from collections.abc import Sequence

from controller.finger_state import Emission

MOST = 10  # foci of one waveform
SAME_M = 2.5e-3
APART_M = 8e-3


def together(due: Sequence[Emission], duration_s: float, most: int = MOST) -> tuple[tuple[Emission, ...], tuple[Emission, ...]]:
    """Choose what is played next.

    The one that waits longest is played, always. If it may be composed, so is what else may, becomes due within
    T of it, and is not in the way of one chosen before: nearer than APART_M to it, but not at the same place.

    Parameters
    ----------
    due : sequence of Emission
        At least one; in the order in which their owners began to wait. An emission that replaces an older one of its
        owner takes that one's place in the order: sorted by their own times, a fast train could push others back for ever.
    duration_s : float
        T.
    most : int
        Foci of one waveform.

    Returns
    -------
    chosen, rest : tuple of Emission
        Both in the order given.
    """
    first = due[0]
    if first.alternate or len(due) == 1:
        return (first,), tuple(due[1:])
    latest_s = first.time_s + duration_s
    chosen, rest = [first], []
    for emission in due[1:]:
        if emission.alternate or emission.time_s > latest_s or len(chosen) >= most or _in_the_way(emission, chosen):
            rest.append(emission)
        else:
            chosen.append(emission)
    return tuple(chosen), tuple(rest)


def _in_the_way(emission: Emission, chosen: Sequence[Emission]) -> bool:
    """Whether a focus lies where the skirt of another would spoil both: not apart, and not the same place either."""
    for other in chosen:
        squared_m2 = (emission.x_m - other.x_m) ** 2 + (emission.y_m - other.y_m) ** 2
        if SAME_M**2 < squared_m2 < APART_M**2:
            return True
    return False
