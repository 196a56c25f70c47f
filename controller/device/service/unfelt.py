"""Why a touch was not felt: what was left out on the way from the touch panel to the plate, a line a cause, with what to do."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

from controller.metrics import Skipped

NOT_PLAYED: Final = {  # of `Skipped`, what somebody misses: the other causes replace an emission by a newer one
    "outputs_off": "the outputs were off: see state and cause; closed interlock? disarmed by a client?",
    "refused": "the FPGA refused them, its queue full or its slots busy: haptic-panel doctor --link",
    "bad_entries": "their entry of the bank is damaged or absent: haptic-panel bank verify",
    "no_room": "too many commands waited: send fewer at once",
    "unconfirmed": "the touch panel had not confirmed the contact yet: [touch] max_emissions_unconfirmed",
}
REPORTED: Final = ("outside_region", *NOT_PLAYED)
MOSTLY: Final = 0.5


def left_out(skipped: Skipped) -> dict[str, int]:
    """What somebody may miss of it, by cause; causes that did not occur are left out."""
    counts = [(cause, getattr(skipped, cause)) for cause in REPORTED]
    return {cause: count for cause, count in counts if count}


def unfelt(points: int, refused: int, foci: int, left_out: Mapping[str, int]) -> list[str]:
    """Lines on what was not felt; none if all was.

    `points` were reported by the touch panel, `refused` of them taken for no finger's, `foci` played; `left_out` counts by cause.
    """
    lines = [f"{left_out[cause]:,} emissions not played: {why}" for cause, why in NOT_PLAYED.items() if left_out.get(cause)]
    fingers, outside = points - refused, left_out.get("outside_region", 0)
    if not points and not foci:
        lines.append("nothing was touched: the touch panel reported no position; haptic-panel record shows what it sends")
    if points and not fingers:
        lines.append(f"none of {points:,} positions was taken for a finger's: the touch panel's warnings say why")
    if outside > MOSTLY * max(fingers, 1):
        lines.append(
            f"{outside:,} of {fingers:,} positions lay outside all regions of the scene, where nothing is played: is that so?"
            " If not, [touch] x_mm_from_axes and y_mm_from_axes are another panel's (haptic-panel calibrate-touch)"
        )
    return lines
