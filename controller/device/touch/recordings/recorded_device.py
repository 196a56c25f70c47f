"""One device of a recording, whichever program has made it: what the head says, and its events."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from typing import Final

from controller.device.touch import event_codes as ev
from controller.device.touch.axes import AxisRange
from controller.device.touch.event_reader import AxisInfo, DeviceDescription

Event = tuple[int, int, int, float]  # type, code, value, time in s as recorded

INT32_MIN, INT32_MAX = -(1 << 31), (1 << 31) - 1
MAX_DIGITS: Final = 20  # Python refuses to parse numbers of thousands of digits


@dataclass(slots=True, eq=False)
class RecordedDevice:
    """A device and its events."""

    name: str = ""  # as the device reports it, or its path; empty: unknown
    axes: dict[int, AxisRange] = field(default_factory=dict)  # declared ranges by code of EV_ABS
    keys: set[int] = field(default_factory=set)  # keys, properties: codes of EV_KEY and of INPUT_PROP that it declares
    properties: set[int] = field(default_factory=set)
    slot: int = 0  # current slot at the start
    events: list[Event] = field(default_factory=list)  # each (type, code, value, time_s): as recorded; times of any origin

    def declare(self, code: int, minimum: int, maximum: int) -> None:
        """Take in the range of an axis; one that no position can have is left out."""
        if minimum < maximum:
            self.axes[code] = AxisRange(minimum, maximum)

    @property
    def description(self) -> DeviceDescription:
        """What the head says of the device."""
        axes = {code: AxisInfo(its.minimum, its.maximum) for code, its in self.axes.items()}
        codes = {ev.EV_KEY: tuple(sorted(self.keys)), ev.EV_ABS: tuple(sorted(axes))}
        return DeviceDescription(self.name, properties=tuple(sorted(self.properties)), codes=codes, axes=axes)


def int32(digits: str, warnings: Counter[str]) -> int:
    """A decimal number as a value of struct input_event; beyond 32 bits it is clamped and counted as `value_absurd`."""
    value = int(digits[:MAX_DIGITS])
    if INT32_MIN <= value <= INT32_MAX:
        return value
    warnings["value_absurd"] += 1
    return INT32_MIN if value < 0 else INT32_MAX


def seconds(whole: str, microseconds: str) -> float:
    """Time of two decimal numbers; of absurdly many digits an absurd time, which the recording counts and corrects."""
    return int(whole[:MAX_DIGITS]) + int(microseconds[:MAX_DIGITS]) * 1e-6
