"""Which of the emissions that are due are played as one waveform, and which wait for the next one. Pure.

The plate plays one waveform at a time. For several foci their responses are summed, and each focus gets a share of the
amplitude that it would get alone: about 0.72 of it for two foci, 0.5 for four, 0.35 for ten. For two it depends on their
distance; this is the smaller share of both (simulated panel, median of 16 random pairs; tests/loop/test_focus_distances.py):

    mm      0.5   1.5   2.5   4     5     6     7     8     9     10    12    20
    share   0.99  0.96  0.90  0.76  0.66  0.60  0.57  0.58  0.62  0.67  0.74  0.70

Two foci nearer than half a focal spot are one place. Farther away each lies on the flank of the other, then in the trough
around it (-0.3 at 7 mm), which weakens both: two such foci are played in turn.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from controller.scene.emission import Emission
from controller.waveforms.composition import MAX_FOCI

MERGE_RADIUS_M: Final = 2.5e-3  # foci nearer than this are one place
SEPARATION_M: Final = 9e-3  # foci nearer than this, and not one place, take turns

Emissions = tuple[Emission, ...]


def select_batch(due: Sequence[Emission], duration_s: float, max_foci: int = MAX_FOCI) -> tuple[Emissions, Emissions]:
    """Choose what is played next as one waveform.

    The emission that has waited longest is always chosen. If it may be composed, so is every other one that may, that is due
    within `duration_s` of it, and whose focus is farther than `SEPARATION_M` from those chosen before; or nearer than
    `MERGE_RADIUS_M` and of the same amplitude.

    Parameters
    ----------
    due : sequence of Emission
        At least one, in the order in which their owners began to wait. An emission that replaces an older one of its owner
        takes its place in the order: if they were ordered by their own times, one train could delay another for ever.
    duration_s : float
        Length of an emission.
    max_foci : int
        Foci of one waveform.

    Returns
    -------
    chosen, rest : tuple of Emission
        Both in the order given. The rest is to be given again, before what begins to wait later.
    """
    first = due[0]
    if first.alternate or len(due) == 1:
        return (first,), tuple(due[1:])
    latest_s = first.time_s + duration_s
    chosen, rest = [first], []
    for emission in due[1:]:
        if emission.alternate or emission.time_s > latest_s or len(chosen) >= max_foci or _conflicts(emission, chosen):
            rest.append(emission)
        else:
            chosen.append(emission)
    return tuple(chosen), tuple(rest)


def _conflicts(emission: Emission, chosen: Sequence[Emission]) -> bool:
    for other in chosen:
        apart_m2 = (emission.x_m - other.x_m) ** 2 + (emission.y_m - other.y_m) ** 2
        if apart_m2 < SEPARATION_M**2 and (apart_m2 > MERGE_RADIUS_M**2 or emission.amplitude != other.amplitude):
            return True
    return False
