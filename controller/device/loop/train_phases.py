"""When the pulses of a train that begins come, beside those of trains of the same period that go on. Pure.

Trains keep their distance from pulse to pulse. One that begins so that its pulses come just behind another finger's would have
each of them wait for plate and wire, as long as both go on. So they are moved, once, after the first pulse: to where there is room
for an upload of their own or, where this host has no such room left, to another train's pulses, with which they are played as one
waveform.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from controller.clocks import FpgaTime

ROUNDING_S: Final = 1e-9


def moved_s(first_s: FpgaTime, period_s: float, others_s: Sequence[FpgaTime], apart_s: float, *, alone: bool = False) -> float:
    """How much later the pulses after the first one of a train come; below 0: earlier.

    `period_s` is that of all these trains, of which `others_s` have some pulse each; a pulse needs `apart_s` for itself before it.
    `alone`: it may not be played with another train's. At most half a period; 0 if nothing is in the way, or if nothing helps.
    """
    behind_s = [(first_s - other_s) % period_s for other_s in others_s]  # of each other train's last pulse
    least_s, most_s = apart_s - ROUNDING_S, period_s - apart_s + ROUNDING_S
    for later_s in sorted([0.0, *[(apart_s - behind) % period_s for behind in behind_s]]):
        if all(least_s <= (behind + later_s) % period_s <= most_s for behind in behind_s):
            break
    else:
        later_s = 0.0 if alone else min([-behind % period_s for behind in behind_s])
    return later_s if later_s <= period_s / 2 else later_s - period_s
