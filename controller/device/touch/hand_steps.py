"""How far a hand moves a finger from one report of its panel to the next."""

from __future__ import annotations

from math import hypot
from typing import Final

from controller.device.touch.associate import Contact

SPEED_CHANGE: Final = 0.6  # m/s between two steps; libinput takes 7 mm more in 12 ms than in the 12 ms before for a jump
HAND_SPEED: Final = 2.0  # m/s of a first step; very fast strokes, 20 cm in 0.2 s, reach 1.9 (minimum jerk: Flash, Hogan 1985)
NOISE_M: Final = 2e-3  # of a position; the coarsest panel recorded has steps of 1.8 mm


def reaches(contact: Contact, off_x_m: float, off_y_m: float, step_s: float, *, rested: bool) -> bool:
    """Whether a hand may have moved the finger of a contact by so much from its last place in `step_s` (`moving_s`).

    `rested`: it was not believed in the report before the step.
    """
    speed = SPEED_CHANGE
    if not rested:
        if contact.step_vx == contact.step_vx:
            off_x_m -= contact.step_vx * step_s
            off_y_m -= contact.step_vy * step_s
        else:  # it has begun: NaN
            speed = HAND_SPEED
    return hypot(off_x_m, off_y_m) <= NOISE_M + speed * step_s  # as `within`, without its call for each report


def goes_on(contact: Contact, x_m: float, y_m: float, time_s: float, before_s: float, period_s: float) -> bool:
    """Whether a place confirms the one that was held back: near it, or as far beyond it as that was from the last one."""
    step_s = moving_s(time_s - before_s, period_s)
    off_x_m, off_y_m = x_m - contact.held_x_m, y_m - contact.held_y_m
    if within(off_x_m, off_y_m, HAND_SPEED, step_s):
        return True
    share = step_s / moving_s(before_s - contact.held_s, period_s, lost=2)
    off_x_m -= (contact.held_x_m - contact.x_m) * share
    off_y_m -= (contact.held_y_m - contact.y_m) * share
    return within(off_x_m, off_y_m, SPEED_CHANGE, step_s)


def moving_s(since_s: float, period_s: float, *, lost: int = 1) -> float:
    """Time in which a finger may have moved.

    `since_s` has passed since the report in which it was last found; reports may be read late: it has had one period at least. Up
    to `lost` reports may be missing in between; before that it rested.
    """
    if since_s <= period_s:
        return period_s
    most_s = (1 + lost) * period_s
    return since_s if since_s < most_s else most_s


def within(off_x_m: float, off_y_m: float, speed: float, time_s: float) -> bool:
    """Whether an offset is one of the panel's noise, or of a `speed` in m/s for so long. False for NaN."""
    return hypot(off_x_m, off_y_m) <= NOISE_M + speed * time_s
