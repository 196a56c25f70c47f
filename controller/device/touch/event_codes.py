"""Event codes of touch panels (linux/input-event-codes.h), and which multi-touch protocol a device speaks."""

from __future__ import annotations

from collections.abc import Iterable
from enum import Enum
from typing import Final

EV_SYN: Final = 0x00
EV_KEY: Final = 0x01
EV_REL: Final = 0x02
EV_ABS: Final = 0x03
EV_MSC: Final = 0x04

BUS_RS232, BUS_I2C = 0x13, 0x18

INPUT_PROP_POINTER, INPUT_PROP_DIRECT = 0x00, 0x01

SYN_REPORT: Final = 0
SYN_CONFIG: Final = 1
SYN_MT_REPORT: Final = 2
SYN_DROPPED: Final = 3

BUTTONS_OF_MICE: Final = range(0x110, 0x118)
BUTTONS_OF_JOYSTICKS: Final = (
    *range(0x120, 0x13F),
    *range(0x220, 0x224),
    *range(0x2C0, 0x2E8),
)  # joysticks, gamepads, more of both
BTN_TOOL_PEN: Final = 0x140
BTN_TOOL_FINGER: Final = 0x145
BTN_TOUCH: Final = 0x14A
BTN_STYLUS: Final = 0x14B

ABS_X: Final = 0x00
ABS_Y: Final = 0x01
ABS_MT_SLOT: Final = 0x2F
ABS_MT_TOUCH_MAJOR: Final = 0x30
ABS_MT_POSITION_X: Final = 0x35
ABS_MT_POSITION_Y: Final = 0x36
ABS_MT_TOOL_TYPE: Final = 0x37
ABS_MT_TRACKING_ID: Final = 0x39
ABS_MT_DISTANCE: Final = 0x3B

MT_TOOL_PALM: Final = 2

SLOT_STATE = (  # what the kernel keeps of each slot and the decoder uses, position last
    ABS_MT_TRACKING_ID,
    ABS_MT_TOUCH_MAJOR,
    ABS_MT_TOOL_TYPE,
    ABS_MT_DISTANCE,
    ABS_MT_POSITION_X,
    ABS_MT_POSITION_Y,
)

POSITIONS = (ABS_MT_POSITION_X, ABS_MT_POSITION_Y)
POSITIONS_SINGLE = (ABS_X, ABS_Y)


class Protocol(Enum):
    """How a device reports its contacts (kernel documentation: input/multi-touch-protocol.rst)."""

    A = "A"
    B = "B"
    SINGLE = "single-touch"


def protocol_of(declared_axes: Iterable[int], seen: Iterable[tuple[int, int]]) -> Protocol:
    """Protocol of a recording.

    `declared_axes` are codes of EV_ABS, which a recording may lack; `seen` are (type, code) of the stream's events.
    """
    axes, events = set(declared_axes), set(seen)
    if (EV_ABS, ABS_MT_SLOT) in events:
        return Protocol.B
    if (EV_SYN, SYN_MT_REPORT) in events:
        return Protocol.A
    axes |= {code for kind, code in events if kind == EV_ABS}
    multi_touch = axes & {ABS_MT_SLOT, ABS_MT_TRACKING_ID, ABS_MT_POSITION_X, ABS_MT_POSITION_Y}
    return Protocol.B if multi_touch else Protocol.SINGLE


def protocol_of_device(declared_axes: Iterable[int]) -> Protocol:
    """Protocol of a live device, which declares all its axes (codes of EV_ABS): without slots it is not protocol B."""
    axes = set(declared_axes)
    if ABS_MT_SLOT in axes:
        return Protocol.B
    return Protocol.A if axes.issuperset(POSITIONS) else Protocol.SINGLE
