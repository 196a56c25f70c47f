"""Decoder of the kernel's touch event streams: protocol A, protocol B and single-touch.

Kernel documentation: input/multi-touch-protocol.rst, input/event-codes.rst. Events change contacts; at each SYN_REPORT
`plausibility.py` makes touch samples of those that are fingers. `associate.py` gives the contacts of protocol A their identities.

The kernel sends an axis of a slot only when it differs from the slot's last value, even if that value is from an earlier
contact: a slot keeps its position from one contact to the next.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from itertools import count
from math import inf
from typing import Final

from controller.device.touch.associate import ASK, FIRST_SERIAL, NO_CONTACT, UNKNOWN, Contact, associate
from controller.device.touch.axes import PanelAxes
from controller.device.touch.event_codes import (
    ABS_MT_DISTANCE,
    ABS_MT_POSITION_X,
    ABS_MT_POSITION_Y,
    ABS_MT_SLOT,
    ABS_MT_TOOL_TYPE,
    ABS_MT_TOUCH_MAJOR,
    ABS_MT_TRACKING_ID,
    ABS_X,
    ABS_Y,
    BTN_TOUCH,
    EV_ABS,
    EV_KEY,
    EV_SYN,
    MT_TOOL_PALM,
    SYN_DROPPED,
    SYN_MT_REPORT,
    SYN_REPORT,
    Protocol,
)
from controller.device.touch.event_reader import Event
from controller.device.touch.plausibility import Plausibility
from controller.device.touch.source import Counts, TouchSample

OTHER_AXES: Final = frozenset({ABS_MT_SLOT, ABS_MT_TOUCH_MAJOR, ABS_MT_TRACKING_ID, ABS_MT_DISTANCE, ABS_MT_TOOL_TYPE})
MAX_SLOTS: Final = 256
MAX_UNNAMED: Final = 32  # contacts of a report that have no tracking id


class Decoder:
    """Turns events into touch samples at each SYN_REPORT.

    A hovering finger is no contact: BTN_TOUCH 0, ABS_MT_DISTANCE above 0 or, in protocol A, ABS_MT_TOUCH_MAJOR 0.
    A palm is counted but not played. While ten fingers are played, a further finger is refused until it is lifted: a finger that
    began in the middle of its touch would feel like a press.

    `feed_report` is on the hot path from touch to emission: it allocates only the samples.

    `slot` is current at the start; `last_slot` is the highest that the device declares, None if unknown. After a reconnection of
    the device, counts, warnings and finger numbers of the decoder `after` are continued.
    """

    def __init__(
        self, axes: PanelAxes, protocol: Protocol, *, slot: int = 0, last_slot: int | None = None, after: Decoder | None = None
    ) -> None:
        self.counts: Counts = after.counts if after else Counts()  # reports, contacts and fingers so far
        self.counts.devices += 1
        self.warnings: Counter[str] = after.warnings if after else Counter()  # anomalies so far, by kind
        self._axes = axes
        self._last_slot = MAX_SLOTS if last_slot is None else last_slot
        self._is_a = protocol is Protocol.A
        self._is_b = protocol is Protocol.B
        self._is_single = protocol is Protocol.SINGLE
        self._x_code, self._y_code = (ABS_X, ABS_Y) if self._is_single else (ABS_MT_POSITION_X, ABS_MT_POSITION_Y)
        self._other_axes = frozenset() if self._is_single else OTHER_AXES
        self._slots: dict[int, Contact] = {}  # protocol A: by identity
        self._packets: list[Contact] = []  # protocol A: contacts of the report so far
        self._packets_s = 0.0  # time of the last report
        self._packet_seen = False
        self._replaced: list[Contact] = []  # contacts that another one has replaced within the report
        self._touching: bool | None = None  # BTN_TOUCH, None before its first event
        self._dropping = False
        # Whether the events fed last ended a report with at least one contact down, and without a position held back
        self.touched = False
        self.due_s = inf  # when to call `overdue` unless events are fed before; inf: never
        self._plausibility: Plausibility = Plausibility(
            axes, tells_all=self._is_a, counts=self.counts, warnings=self.warnings, after=after._plausibility if after else None
        )
        self._serials = count(FIRST_SERIAL)
        self._slot = slot
        self._current: Contact = self._contact_of(slot)

    def feed(self, kind: int, code: int, value: int, time_s: float) -> tuple[TouchSample, ...] | None:
        """Take one event; parameters and result as in `feed_report`."""
        return self.feed_report(((kind, code, value, time_s),), time_s)

    def feed_report(self, events: Iterable[Event], time_s: float) -> tuple[TouchSample, ...] | None:
        """Take events that all happened at one time; their own times are not looked at.

        Returns None unless the last event is SYN_REPORT; else samples of fingers released, then of fingers moved or begun.
        """
        samples = None
        self.touched = False
        current, x_code, y_code, axes = self._current, self._x_code, self._y_code, self._other_axes
        for kind, code, value, _ in events:
            samples = None
            if kind == EV_ABS:
                if self._dropping:
                    continue
                if code == x_code:
                    if value != current.x:
                        current.x = value
                        current.moved = True
                elif code == y_code:
                    if value != current.y:
                        current.y = value
                        current.moved = True
                elif code in axes:
                    self._axis(code, value)
                    current = self._current
                continue
            if kind == EV_SYN:
                if code == SYN_REPORT:
                    samples = self._report(time_s)
                elif code == SYN_MT_REPORT:
                    if self._is_a and not self._dropping:
                        self._end_packet()
                elif code == SYN_DROPPED and not self._dropping:
                    self._dropping = True
                    self.warnings["dropped"] += 1
            elif kind == EV_KEY and code == BTN_TOUCH and not self._dropping:
                if self._is_single:
                    self._identify(self._current, 0 if value else NO_CONTACT)
                self._touching = value != 0
            current = self._current
        return samples

    def release(self, time_s: float) -> tuple[TouchSample, ...]:
        """Release every finger and forget the panel's state, at the end of the stream or after a loss of events."""
        fingers = [c for c in (*self._replaced, *self._slots.values()) if c.finger is not None]
        self._slots.clear()
        self._replaced.clear()
        self._packets.clear()
        self._touching = None
        self._current = self._contact_of(self._slot)
        released = tuple([self._plausibility.released(contact, time_s) for contact in fingers])
        self._plausibility.forget()
        self.due_s = inf
        return released

    def overdue(self, time_s: float) -> tuple[TouchSample, ...]:
        """Samples of fingers because there was no report by `due_s`; see `Plausibility.overdue`."""
        samples = self._plausibility.overdue(self._slots.values(), time_s)
        if samples and self._is_a and self._plausibility.due_s == inf:  # what is reported next starts again
            self._slots = {key: contact for key, contact in self._slots.items() if contact.finger is not None}
        self.due_s = self._plausibility.due_s
        return samples

    def fingers(self) -> list[tuple[int, float, float]]:
        """Fingers that are down, as (finger, x_m, y_m)."""
        return [(c.finger, c.x_m, c.y_m) for c in self._slots.values() if c.finger is not None]

    def _axis(self, code: int, value: int) -> None:
        """One of `OTHER_AXES`."""
        if code == ABS_MT_SLOT:
            self._slot = value
            contact = self._slots.get(value)
            self._current = self._contact_of(value) if contact is None else contact
            return
        current = self._current
        if code == ABS_MT_TOUCH_MAJOR:
            current.width_m = value * self._axes.size_m_per_unit if value > 0 else 0.0
            if current.width_m > self._axes.settings.max_size_m:
                current.settled = ASK
            if self._is_a:
                current.hovers = value == 0
        elif code == ABS_MT_TRACKING_ID:
            if self._is_b:
                self._identify(current, max(value, NO_CONTACT))
            else:
                current.identity = value
        elif code == ABS_MT_DISTANCE:
            current.hovers, current.settled = value > 0, ASK
        elif code == ABS_MT_TOOL_TYPE:
            current.tool_palm, current.settled = value == MT_TOOL_PALM, ASK

    def _contact_of(self, slot: int) -> Contact:
        """Contact of a slot; a detached one if no device has such a slot."""
        contact = self._slots.get(slot)
        if contact is not None:
            return contact
        if not 0 <= slot < MAX_SLOTS:
            self.warnings["slot_absurd"] += 1
            return Contact(NO_CONTACT)
        if slot > self._last_slot:
            self.warnings["slot_beyond_range"] += 1
        contact = Contact(NO_CONTACT if self._is_single else UNKNOWN)
        if not self._is_a:
            self._slots[slot] = contact
        return contact

    def _identify(self, contact: Contact, identity: int) -> None:
        """Give a contact its tracking id; another id than before is another finger."""
        if identity == contact.identity:
            return
        if contact.identity >= 0 and not (contact.counted or contact.hovers or self._touching is False):
            self.counts.contacts += 1  # began and ended within one report
        if contact.finger is not None:
            gone = Contact(NO_CONTACT, finger=contact.finger, x_m=contact.x_m, y_m=contact.y_m, size_m=contact.size_m)
            gone.held, gone.held_x_m = contact.held, contact.held_x_m
            self._replaced.append(gone)
            contact.finger = None
            contact.held = 0
        contact.identity = identity
        contact.settled = ASK
        contact.counted = contact.refused = contact.palm = contact.silent = False

    def _end_packet(self) -> None:
        """Protocol A: SYN_MT_REPORT ends one contact; an empty packet means that there is no contact."""
        self._packet_seen = True
        if self._current.x is not None and self._current.y is not None and not self._current.hovers:
            if len(self._packets) < (MAX_UNNAMED if self._current.identity < 0 else MAX_SLOTS):
                self._packets.append(self._current)
            else:
                self.warnings["contacts_absurd"] += 1
        self._current = Contact(NO_CONTACT)

    def _report(self, time_s: float) -> tuple[TouchSample, ...]:
        if self._dropping:  # all before is void; a live panel's driver gives its state as the next report
            self._dropping = False
            return self.release(time_s)
        before: tuple[TouchSample, ...] = ()
        if time_s > self.due_s:
            before = self.overdue(time_s)
        if self._is_a:
            if self._current.x is not None:
                self._end_packet()
            if self._packet_seen or self._touching is False:
                now = associate(self._slots, self._packets, self._axes, self._serials, time_s - self._packets_s)
                self._packets_s = time_s
                self._replaced += [was for key, was in self._slots.items() if was.finger is not None and key not in now]
                self._slots = now
                self._packets.clear()
            self._packet_seen = False
            self._current = Contact(NO_CONTACT)
        samples = self._plausibility.report(self._slots.values(), self._replaced, time_s, hovering=self._touching is False)
        self.touched = self._plausibility.touched
        self.due_s = self._plausibility.due_s
        return before + samples if before else samples
