"""Where the next emission of a moving finger will be, before it is due: its waveform can be sent ahead."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Final

from controller.device.loop.playing.due_emissions import Owner
from controller.device.scene.fingers import ActiveEffects
from controller.device.scene.region_lookup import OUTSIDE
from controller.device.scene.scene import Scene

PREFETCH_DISTANCE_M: Final = 0.75e-3  # an emission this near is predicted, even if it takes more than one report to get there
MIN_STEP_M: Final = 0.1e-3  # from report to report; a finger that moves less is at rest
# What is completed later in the time between two reports may be found complete one report later: of a lone finger, and of several,
# of which one may have what was sent for it composed with another's
LATEST_IN_REPORT: Final = (0.95, 0.9)

Locate = Callable[[int, float], tuple[float, float] | None]
"""The place (x_m, y_m) of a finger at a host time; None if it is not down."""


def next_focus(
    effects: dict[Owner, ActiveEffects], scene: Scene, finger: int, locate: Locate, now_s: float, report_s: float, after_s: float
) -> tuple[float, float, float] | None:
    """Predict the focus of a finger's next emission, if one of its next reports will complete a spacing, and no other finger's.

    An emission follows the first report after a spacing is completed. Where that is follows from the finger's motion, where the
    focus is from when the panel reports.

    `effects` are those of all fingers. The finger's last report was at the host time `now_s`; from report to report it takes
    `report_s`, from a report to the focus `after_s`. Returns x_m, y_m and amplitude.
    """
    crossing = _next_crossing(effects, scene, finger, locate, now_s, report_s)
    if crossing is None or crossing[0] % 1 > LATEST_IN_REPORT[len(effects) > 1]:
        return None
    reports, amplitude = math.ceil(crossing[0]), crossing[1]
    for other in effects.values():
        if other.finger is not None and other.finger != finger:
            near = _next_crossing(effects, scene, other.finger, locate, now_s, report_s)
            if near is not None and math.ceil(near[0]) == reports:
                return None
    focus = locate(finger, now_s + reports * report_s + after_s)
    return None if focus is None else (*focus, amplitude)


def _next_crossing(
    effects: dict[Owner, ActiveEffects], scene: Scene, finger: int, locate: Locate, now_s: float, report_s: float
) -> tuple[float, float] | None:
    """Reports until a finger completes a spacing, and its amplitude; None if that is too far away to be known."""
    active = effects.get(finger)
    here, then = locate(finger, now_s), locate(finger, now_s + report_s)
    if active is None or here is None or then is None:
        return None
    if len(effects) > 1 and active.region != OUTSIDE and scene.regions[active.region].nulled:
        return None  # where the others will be kept still is not known
    step_m = math.dist(here, then)
    if step_m < MIN_STEP_M:
        return None
    distance_m, amplitude = active.next_crossing((then[0] - here[0]) / step_m, (then[1] - here[1]) / step_m)
    return None if distance_m > max(step_m, PREFETCH_DISTANCE_M) else (distance_m / step_m, amplitude)
