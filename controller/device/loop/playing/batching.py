"""Which of the emissions that are due are played as one waveform, and which wait for the next one. Pure.

The plate plays one waveform at a time. For several foci their responses are summed, and each focus gets a share of the
amplitude that it would get alone: about 0.74 of it for two foci, 0.54 for four, 0.36 for ten. For two it depends on their
distance, but little, since each is kicked to the side that serves both (exact composition, median; least of 10 random pairs):

    mm      2           3           4           5           6           7           8           9           10          far
    share   0.93; 0.93  0.86; 0.85  0.76; 0.76  0.73; 0.71  0.78; 0.76  0.82; 0.79  0.80; 0.79  0.79; 0.77  0.75; 0.70  0.74; 0.73

Triangles and squares of 2 to 12 mm get at least 0.8 of what far foci get. What cannot be composed takes turns: two foci nearer
than 3.5 mm that ask for unlike amplitudes, since they move together; and crowds: a lattice of six at 3 mm gets 0.16, of ten at
3 to 6 mm next to nothing at worst. So a focus has at most three others within 7 mm; those nearer than 2.5 mm are one place with
it, and are not counted. On a plate with longer or shorter waves these distances are as much of a wave.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from controller.device.scene.emission import Emission
from controller.device.waveforms.composition import MAX_FOCI

# On the paper's plate; on others they go with the length of its waves
MERGE_RADIUS_M: Final = 2.5e-3  # foci nearer than this are one place
SEPARATION_M: Final = 3.5e-3  # foci nearer than this and of unlike amplitudes take turns
CROWD_M: Final = 7e-3  # within which a focus has few others
MAX_NEIGHBOURS: Final = 3

Emissions = tuple[Emission, ...]


def select_batch(
    due: Sequence[Emission], duration_s: float, max_foci: int = MAX_FOCI, wave_scale: float = 1.0
) -> tuple[Emissions, Emissions]:
    """Choose what is played next as one waveform.

    The emission that has waited longest is always chosen. If it may be composed, so is every other one that may, that is due
    within `duration_s` of it, and whose focus is farther than `SEPARATION_M` from those chosen before that have another
    amplitude, and in no crowd: more than `MAX_NEIGHBOURS` within `CROWD_M` and not nearer than `MERGE_RADIUS_M`.

    `due`, at least one, are in the order in which their owners began to wait. An emission that replaces an older one of its owner
    takes its place in the order: if they were ordered by their own times, one train could delay another for ever. `duration_s` is
    the length of an emission, `wave_scale` that of the plate (`Bank.wave_scale`). Returns what is chosen and the rest, both in the
    order given; the rest is to be given again, before what begins to wait later.
    """
    first = due[0]
    if first.alternate or len(due) == 1:
        return (first,), tuple(due[1:])
    latest_s = first.time_s + duration_s
    chosen, rest = [first], []
    for emission in due[1:]:
        if emission.alternate or emission.time_s > latest_s or len(chosen) >= max_foci or _conflicts(emission, chosen, wave_scale):
            rest.append(emission)
        else:
            chosen.append(emission)
    return tuple(chosen), tuple(rest)


def _conflicts(emission: Emission, chosen: Sequence[Emission], wave_scale: float) -> bool:
    merge_m, separation_m, crowd_m = MERGE_RADIUS_M * wave_scale, SEPARATION_M * wave_scale, CROWD_M * wave_scale
    near = []
    for other in chosen:
        apart_m2 = _apart_m2(emission, other)
        if apart_m2 >= crowd_m * crowd_m:
            continue
        if apart_m2 < separation_m * separation_m and emission.amplitude != other.amplitude:
            return True
        if apart_m2 >= merge_m * merge_m:
            near.append(other)
    return len(near) > MAX_NEIGHBOURS or any(_neighbours(other, chosen, merge_m, crowd_m) >= MAX_NEIGHBOURS for other in near)


def _neighbours(emission: Emission, chosen: Sequence[Emission], merge_m: float, crowd_m: float) -> int:
    count = 0
    for other in chosen:
        count += merge_m * merge_m <= _apart_m2(emission, other) < crowd_m * crowd_m
    return count


def _apart_m2(one: Emission, other: Emission) -> float:
    x_m, y_m = one.x_m - other.x_m, one.y_m - other.y_m
    return x_m * x_m + y_m * y_m  # `**` would call a function, with objects in place of floats
