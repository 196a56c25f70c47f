"""What a touch panel is and says apart from its events: its protocol, its state, its counts."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from enum import Enum

from controller.touch import event_codes as ev


class Protocol(Enum):
    """How a device reports its contacts."""

    A = "A"
    B = "B"
    SINGLE = "single-touch"


def protocol_of(declared_axes: Iterable[int], seen: Iterable[tuple[int, int]]) -> Protocol:
    """Protocol of a device that declares these axes, or whose stream has shown these (type, code)."""
    axes, events = set(declared_axes), set(seen)
    if (ev.EV_ABS, ev.ABS_MT_SLOT) in events:
        return Protocol.B
    if (ev.EV_SYN, ev.SYN_MT_REPORT) in events:
        return Protocol.A
    axes |= {code for kind, code in events if kind == ev.EV_ABS}
    several = axes & {ev.ABS_MT_SLOT, ev.ABS_MT_TRACKING_ID, ev.ABS_MT_POSITION_X, ev.ABS_MT_POSITION_Y}
    return Protocol.B if several else Protocol.SINGLE


def protocol_of_device(declared_axes: Iterable[int]) -> Protocol:
    """Protocol of a live device, whose declared axes are known to be all it has: no slots, no protocol B."""
    axes = set(declared_axes)
    if ev.ABS_MT_SLOT in axes:
        return Protocol.B
    return Protocol.A if axes.issuperset(ev.POSITIONS) else Protocol.SINGLE


@dataclass(slots=True)
class Counts:
    """What was seen, counted before any limit of ours."""

    reports: int = 0  # SYN_REPORTs with a contact down
    contacts: int = 0  # contacts begun
    max_fingers: int = 0  # most contacts down at one SYN_REPORT
