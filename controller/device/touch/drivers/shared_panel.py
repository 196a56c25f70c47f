"""Contacts of a panel without kernel driver, handed on to other programs of the machine as a touch screen of the kernel.

The panel's own process does it, after it has sent a report to the loop. What is handed on are the fingers that the plausibility
stage believes, on the plate: palms, rectangles without fingers and outliers are not; ghosts of emissions, which only the loop
can know, are, as they are by a kernel driver.
"""

from __future__ import annotations

import dataclasses
from collections import Counter
from collections.abc import Callable, Sequence
from typing import Final

from controller.device.board.touch_panels import TouchPanel
from controller.device.touch.drivers.awaited_reader import NO_DEVICE
from controller.device.touch.drivers.contact_events import MAX_CONTACTS, ContactEvents, ReportedContact
from controller.device.touch.drivers.screen import UNITS_PER_MM, KernelScreen
from controller.device.touch.event_reader import DeviceDescription, Event
from controller.device.touch.live_source import LiveSource
from controller.device.touch.source import Sides, TouchedPlate, TouchSample
from controller.errors import TouchError

UNITS_PER_M: Final = UNITS_PER_MM * 1e3


class _Fed:
    """An `EventReader` that gives what was read already."""

    def __init__(self) -> None:
        self.warnings: Counter[str] = Counter()
        self.description = NO_DEVICE
        self.present = True
        self.events: Sequence[Event] = ()

    def fileno(self) -> None:
        """None."""

    def next_time_s(self) -> None:
        """None."""

    def read(self, _now_s: float) -> Sequence[Event]:
        """The events that were put in, once."""
        events, self.events = self.events, ()
        return events

    def close(self) -> None:
        """Nothing."""


class SharedPanel:
    """Hands the contacts of one panel on. `open_screen` makes the touch screen, by name and sides in mm, or raises TouchError."""

    def __init__(
        self,
        touch: TouchPanel,
        length_m: float,
        width_m: float,
        open_screen: Callable[[str, float, float], KernelScreen] = KernelScreen,
    ) -> None:
        self.warnings: Counter[str] = Counter()  # counts `share_lost`
        self._sides_mm = (length_m * 1e3, width_m * 1e3)
        self._open_screen = open_screen
        self._screen: KernelScreen | None = None
        self._fed = _Fed()
        self._source = LiveSource(self._fed, TouchedPlate(touch, Sides(length_m, width_m)))
        self._contacts = ContactEvents(sized=False)
        self._down: dict[int, ReportedContact] = {}  # by finger; its number is the slot

    def follow(self, description: DeviceDescription) -> DeviceDescription:
        """Take the device as it was opened last; its description, with a remark if its contacts cannot be handed on."""
        self._fed.description = description
        if self._screen is None:
            try:
                self._screen = self._open_screen(f"{description.name} (haptic-panel)", *self._sides_mm)
            except TouchError as error:
                remark = f"touch.share: its contacts are not handed on to other programs: {error}"
                return dataclasses.replace(description, remark="; ".join(filter(None, (description.remark, remark))))
        return description

    def next_time_s(self) -> float | None:
        """When a decision on a contact is due without a report; None: never."""
        return self._source.next_time_s() if self._screen is not None else None

    def hand_on(self, events: Sequence[Event], now_s: float) -> None:
        """Hand on what changes by the events of at most one report, or without any by `now_s`."""
        if self._screen is None:
            return
        self._fed.events = events
        samples = self._source.read(now_s)
        if not samples:
            return
        try:
            self._show(self._screen, samples, now_s)
        except OSError:
            self.warnings["share_lost"] += 1
            self.close()

    def close(self) -> None:
        """Take the screen away; it is made again when the panel is opened again."""
        if self._screen is not None:
            self._screen.close()
            self._screen = None
        self._contacts = ContactEvents(sized=False)
        self._down.clear()

    def _show(self, screen: KernelScreen, samples: Sequence[TouchSample], now_s: float) -> None:
        """Report the released first, so that a slot is empty before another finger has it."""
        for released in (True, False):
            for sample in samples:
                if sample.contact is released:
                    continue
                before = self._down.pop(sample.finger, None)
                if sample.contact:
                    slot = (
                        before.number if before else min(set(range(MAX_CONTACTS)) - {other.number for other in self._down.values()})
                    )
                    x, y = (round(place_m * UNITS_PER_M) for place_m in (sample.x_m, sample.y_m))
                    self._down[sample.finger] = ReportedContact(slot, x, y)
            if events := self._contacts.report(list(self._down.values()), now_s):
                screen.report(events)
