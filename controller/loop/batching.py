"""Which of the emissions that wait are played together, and which wait for the plate's next turn. Pure.

The plate plays one waveform at a time. Foci that are apart share one: their responses are summed, and each gets
less than it would get alone (of two about 0.72, of four 0.5, of ten 0.35). It depends on how far apart two are, here the
worse of both (simulated panel, median of 16 random pairs; tests/loop/test_focus_distances.py):

    mm      0.5   1.5   2.5   4     5     6     7     8     9     10    12    20
    share   0.99  0.96  0.90  0.76  0.66  0.60  0.57  0.58  0.62  0.67  0.74  0.70

Within half a spot two foci are one. Beyond it each lies on the other's slope, then in the trough around it (-0.3
at 7 mm), and both lose by it: such two take turns.
"""

from __future__ import annotations

from collections.abc import Sequence

from controller.scene.emission import Emission
from controller.waveforms.composition import MAX_FOCI

MERGE_RADIUS_M = 2.5e-3  # foci nearer than this are one place
SEPARATION_M = 9e-3  # foci nearer than this, and not one place, take turns

Emissions = tuple[Emission, ...]


def select_batch(due: Sequence[Emission], duration_s: float, most: int = MAX_FOCI) -> tuple[Emissions, Emissions]:
    """Choose what is played next.

    The one that waits longest is played, always. If it may be composed, so is what else may, is due within T of it,
    and is not in the way of one chosen before it: nearer than SEPARATION_M, unless within MERGE_RADIUS_M and of its amplitude.

    Parameters
    ----------
    due : sequence of Emission
        At least one; in the order in which their owners began to wait. An emission that replaces an older one of its
        owner takes that one's place in the order: by their own times, one train could push another back for ever.
    duration_s : float
        T.
    most : int
        Foci of one waveform.

    Returns
    -------
    chosen, rest : tuple of Emission
        Both in the order given; the rest is to be given again, before what begins to wait later.
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
    for other in chosen:
        apart_m2 = (emission.x_m - other.x_m) ** 2 + (emission.y_m - other.y_m) ** 2
        if apart_m2 < SEPARATION_M**2 and (apart_m2 > MERGE_RADIUS_M**2 or emission.amplitude != other.amplitude):
            return True
    return False
