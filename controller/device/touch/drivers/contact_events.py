"""Kernel events (protocol B) for the contacts that a panel without kernel driver lists in each report."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final, NamedTuple

from controller.device.touch import event_codes as ev
from controller.device.touch.event_reader import AxisInfo, DeviceDescription, Event

MAX_CONTACTS: Final = 10
MAX_TRACKING_ID: Final = 65535
MAX_SIZE: Final = 65535
ORDER: Final = ((2, ev.ABS_MT_TOUCH_MAJOR), (0, ev.ABS_MT_POSITION_X), (1, ev.ABS_MT_POSITION_Y))  # in which values are sent


class ReportedContact(NamedTuple):
    """One contact of a report: the panel's number for it, raw position, raw size (0: not reported)."""

    number: int
    x: int
    y: int
    size: int = 0


def describe(name: str, version: int, width: int, height: int, *, sized: bool, remark: str = "") -> DeviceDescription:
    """Description of a panel on I2C with `MAX_CONTACTS` contacts, as a kernel driver would give it.

    `version` is that of the firmware; `width` and `height` are the largest raw x and y, the smallest are 0.
    """
    extents = (width, height)
    axes = {ev.ABS_MT_SLOT: AxisInfo(0, MAX_CONTACTS - 1), ev.ABS_MT_TRACKING_ID: AxisInfo(0, MAX_TRACKING_ID)}
    axes |= {code: AxisInfo(0, largest) for code, largest in zip(ev.POSITIONS, extents, strict=True)}
    if sized:
        axes[ev.ABS_MT_TOUCH_MAJOR] = AxisInfo(0, MAX_SIZE)
    codes = {
        ev.EV_SYN: (ev.EV_SYN, ev.EV_KEY, ev.EV_ABS),
        ev.EV_KEY: (ev.BTN_TOUCH,),
        ev.EV_ABS: tuple(sorted(axes)),
    }
    return DeviceDescription(name, ev.BUS_I2C, 0, 0, version, (ev.INPUT_PROP_DIRECT,), codes, dict(sorted(axes.items())), remark)


class ContactEvents:
    """Compares each report with the one before and gives the changes in protocol B.

    The slot of a contact is the panel's number for it; each new contact gets a new tracking id. As the kernel does, it sends
    only values that differ from the last ones of the slot; a new object starts without last values.
    """

    def __init__(self, *, sized: bool) -> None:
        self._tracking = [-1] * MAX_CONTACTS
        nothing = -1, -1, -1 if sized else 0
        self._values = [list(nothing) for _ in range(MAX_CONTACTS)]  # x, y and size that were sent last
        self._seen = [0] * MAX_CONTACTS  # number of the report that listed the contact last
        self._report = 0
        self._slot = -1
        self._next_id = 0
        self.down = 0  # contacts of the last report

    def report(self, contacts: Sequence[ReportedContact], time_s: float) -> list[Event]:
        """Events of a report of all contacts that are down, SYN_REPORT last; empty without a change.

        Their numbers are below `MAX_CONTACTS`; of two with one number the last counts.
        """
        events: list[Event] = []
        self._report += 1
        before = self.down
        for number, *values in contacts:
            self._seen[number] = self._report
            if self._tracking[number] < 0:
                self._select(number, time_s, events)
                self._tracking[number] = self._next_id
                events.append((ev.EV_ABS, ev.ABS_MT_TRACKING_ID, self._next_id, time_s))
                self._next_id = self._next_id + 1 if self._next_id < MAX_TRACKING_ID else 0
                self.down += 1
            sent = self._values[number]
            for which, code in ORDER:
                if values[which] != sent[which]:
                    self._select(number, time_s, events)
                    sent[which] = values[which]
                    events.append((ev.EV_ABS, code, values[which], time_s))
        for number in range(MAX_CONTACTS):
            if self._tracking[number] >= 0 and self._seen[number] != self._report:
                self._select(number, time_s, events)
                self._tracking[number] = -1
                events.append((ev.EV_ABS, ev.ABS_MT_TRACKING_ID, -1, time_s))
                self.down -= 1
        if bool(before) != bool(self.down):
            events.append((ev.EV_KEY, ev.BTN_TOUCH, int(self.down > 0), time_s))
        if events:
            events.append((ev.EV_SYN, ev.SYN_REPORT, 0, time_s))
        return events

    def _select(self, number: int, time_s: float, events: list[Event]) -> None:
        if number != self._slot:
            self._slot = number
            events.append((ev.EV_ABS, ev.ABS_MT_SLOT, number, time_s))
