"""Decoder of the kernel's touch event streams: protocol A, protocol B and single-touch.

Kernel documentation: input/multi-touch-protocol.rst, input/event-codes.rst. Events change contacts; each SYN_REPORT gives
touch samples of the changes. The three protocols share hover, finger numbers, the limit of ten, counts and losses;
`associate.py` gives the contacts of protocol A their identities.

The kernel sends an axis of a slot only when it differs from the slot's last value, even if that value is from an earlier
contact: a slot keeps its position from one contact to the next.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from itertools import count
from typing import Final

from controller.touch.associate import FIRST_SERIAL, Contact, associate
from controller.touch.axes import Axes
from controller.touch.event_codes import (
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
from controller.touch.event_reader import Event
from controller.touch.source import Counts, TouchSample, touch_sample

MAX_PLAYED: Final = 10
MAX_SLOTS: Final = 256
MAX_UNNAMED: Final = 32  # contacts of a report that have no tracking id

# Values of Contact.identity besides the tracking ids of the device, which are never negative
NO_CONTACT: Final = -1
UNKNOWN: Final = -2  # no event of this slot yet: a finger may have been down before the stream began
IMPLIED: Final = -3  # a position of an unknown slot: a finger is down


class Decoder:
    """Turns events into touch samples at each SYN_REPORT.

    A hovering finger is no contact: BTN_TOUCH 0, ABS_MT_DISTANCE above 0 or, in protocol A, ABS_MT_TOUCH_MAJOR 0.
    A palm (ABS_MT_TOOL_TYPE) is counted but not played. While ten fingers are played, a further finger is refused until it is
    lifted: a finger that began in the middle of its touch would feel like a press.

    `feed_report` is on the hot path from touch to emission: it allocates only the samples.

    Parameters
    ----------
    axes : Axes
        Maps raw positions to the plate.
    protocol : Protocol
        See `event_codes.protocol_of`.
    slot, last_slot : int
        Current slot at the start; highest slot that the device declares, None if unknown.
    after : Decoder, optional
        Decoder before a reconnection of the device, whose counts, warnings and finger numbers are continued.

    Attributes
    ----------
    counts : Counts
        Reports, contacts and fingers so far.
    warnings : Counter of str
        Anomalies so far, by kind.
    touched : bool
        Whether the events fed last ended a report with at least one contact down.
    """

    def __init__(
        self, axes: Axes, protocol: Protocol, *, slot: int = 0, last_slot: int | None = None, after: Decoder | None = None
    ) -> None:
        self.counts: Counts = after.counts if after else Counts()
        self.warnings: Counter[str] = after.warnings if after else Counter()
        self._axes = axes
        self._limits = (axes.x.minimum, axes.x.maximum, axes.y.minimum, axes.y.maximum)
        self._size_m = axes.size_m_per_unit
        self._last_slot = MAX_SLOTS if last_slot is None else last_slot
        self._is_a = protocol is Protocol.A
        self._is_b = protocol is Protocol.B
        self._is_single = protocol is Protocol.SINGLE
        self._x_code, self._y_code = (ABS_X, ABS_Y) if self._is_single else (ABS_MT_POSITION_X, ABS_MT_POSITION_Y)
        self._slots: dict[int, Contact] = {}  # protocol A: by identity
        self._packets: list[Contact] = []  # protocol A: contacts of the report so far
        self._packets_s = 0.0  # time of the last report
        self._packet_seen = False
        self._replaced: list[Contact] = []  # contacts that another one has replaced within the report
        self._touching: bool | None = None  # BTN_TOUCH, None before its first event
        self._dropping = False
        self.touched = False
        self._played = 0
        self._next_finger: int = after._next_finger if after else 0
        self._serials = count(FIRST_SERIAL)
        self._slot = slot
        self._current: Contact = self._contact_of(slot)

    def feed(self, kind: int, code: int, value: int, time_s: float) -> tuple[TouchSample, ...] | None:
        """Take one event; parameters and result as in `feed_report`."""
        return self.feed_report(((kind, code, value, time_s),), time_s)

    def feed_report(self, events: Iterable[Event], time_s: float) -> tuple[TouchSample, ...] | None:
        """Take events that all happened at one time; their own times are not looked at.

        Parameters
        ----------
        events : iterable of Event
            Type, code and value as in struct input_event.
        time_s : float
            Time of the samples.

        Returns
        -------
        tuple of TouchSample or None
            If the last event is SYN_REPORT: fingers released, then fingers moved or begun; else None.
        """
        samples = None
        self.touched = False
        x_code, y_code = self._x_code, self._y_code
        for kind, code, value, _ in events:
            samples = None
            if kind == EV_ABS:
                if self._dropping:
                    continue
                current = self._current
                if code == x_code:
                    if value != current.x:
                        current.x = value
                        current.moved = True
                elif code == y_code:
                    if value != current.y:
                        current.y = value
                        current.moved = True
                else:
                    self._axis(code, value)
                    continue
                if current.identity == UNKNOWN and not self._is_single:
                    current.identity = IMPLIED
            elif kind == EV_SYN:
                if code == SYN_REPORT:
                    samples = self._report(time_s)
                elif code == SYN_MT_REPORT:
                    if self._is_a and not self._dropping:
                        self._end_packet()
                elif code == SYN_DROPPED and not self._dropping:
                    self._dropping = True
                    self.warnings["dropped"] += 1
            elif kind == EV_KEY and code == BTN_TOUCH and not self._dropping:
                self._button(value != 0)
        return samples

    def release(self, time_s: float) -> tuple[TouchSample, ...]:
        """Release every finger and forget the panel's state, at the end of the stream or after a loss of events.

        Parameters
        ----------
        time_s : float
            Time of the samples.
        """
        fingers = [c for c in (*self._replaced, *self._slots.values()) if c.finger is not None]
        self._slots.clear()
        self._replaced.clear()
        self._packets.clear()
        self._touching = None
        self._select(self._slot)
        return tuple([self._released(contact, time_s) for contact in fingers])

    def fingers(self) -> list[tuple[int, float, float]]:
        """Fingers that are down, as (finger, x_m, y_m)."""
        return [(c.finger, c.x_m, c.y_m) for c in self._slots.values() if c.finger is not None]

    def _axis(self, code: int, value: int) -> None:
        """Any axis but the positions."""
        if self._is_single:
            return
        current = self._current
        if code == ABS_MT_SLOT:
            contact = self._slots.get(value)
            if contact is None:
                self._select(value)
            else:
                self._slot = value
                self._current = contact
        elif code == ABS_MT_TOUCH_MAJOR:
            current.size = value
            if self._is_a:
                current.hovers = value == 0
        elif code == ABS_MT_TRACKING_ID:
            if self._is_b:
                self._identify(current, max(value, NO_CONTACT))
            else:
                current.identity = value
        elif code == ABS_MT_DISTANCE:
            current.hovers = value > 0
        elif code == ABS_MT_TOOL_TYPE:
            current.palm = value == MT_TOOL_PALM

    def _button(self, touching: bool) -> None:
        if self._is_single:
            self._identify(self._current, 0 if touching else NO_CONTACT)
        self._touching = touching

    def _select(self, slot: int) -> None:
        self._slot = slot
        self._current = self._contact_of(slot)

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
        contact = Contact(UNKNOWN)
        if not self._is_a:
            self._slots[slot] = contact
        return contact

    def _identify(self, contact: Contact, identity: int) -> None:
        """Give a contact its tracking id; another id than before is another finger."""
        if identity == contact.identity:
            return
        if contact.identity >= 0 and not contact.counted and self._down(contact):
            self.counts.contacts += 1  # began and ended within one report
        if contact.finger is not None:
            self._replaced.append(
                Contact(NO_CONTACT, finger=contact.finger, x_m=contact.x_m, y_m=contact.y_m, size_m=contact.size_m)
            )
            contact.finger = None
        contact.identity = identity
        contact.counted = contact.refused = False

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
        return self._samples(time_s)

    def _samples(self, time_s: float) -> tuple[TouchSample, ...]:
        """Samples of a report: fingers released, moved and begun."""
        samples = []
        changed = []
        if self._replaced:
            for contact in self._replaced:
                samples.append(self._released(contact, time_s))
            self._replaced.clear()
        hovering = self._touching is False
        down = 0
        for contact in self._slots.values():
            identity = contact.identity
            if (identity < 0 and identity != IMPLIED) or hovering or contact.hovers:
                if contact.finger is not None:
                    samples.append(self._released(contact, time_s))
                contact.refused = False
                continue
            down += 1
            if not contact.counted and identity >= 0:
                contact.counted = True
                self.counts.contacts += 1
            if contact.palm:
                if contact.finger is not None:
                    samples.append(self._released(contact, time_s))
                contact.refused = False
            elif contact.moved or contact.finger is None:
                changed.append(contact)
        if down:
            self.touched = True
            counts = self.counts
            counts.reports += 1
            counts.max_fingers = max(counts.max_fingers, down)
        for contact in changed:  # after all releases, which make room for new fingers
            self._place(contact, time_s, samples)
        return tuple(samples)

    def _place(self, contact: Contact, time_s: float, samples: list[TouchSample]) -> None:
        """Append the sample of a contact that has moved or begun, if it is played."""
        x, y = contact.x, contact.y
        if x is None or y is None or contact.refused:
            return
        finger = contact.finger
        if finger is None:
            if self._played == MAX_PLAYED:
                self.warnings["more_than_played"] += 1
                contact.refused = True
                return
            finger = contact.finger = self._next_finger
            self._next_finger += 1
            self._played += 1
        x_low, x_high, y_low, y_high = self._limits
        if not (x_low <= x <= x_high and y_low <= y <= y_high):
            self.warnings["outside_axes"] += 1
            x, y = self._axes.clamp(x, y)
        x_m, y_m = self._axes.position_m(x, y)
        self.counts.positions += 1
        if self._axes.off_plate:
            self.counts.off_plate += 1
        contact.x_m = x_m
        contact.y_m = y_m
        contact.size_m = size_m = contact.size * self._size_m if contact.size > 0 else 0.0
        contact.moved = False
        samples.append(touch_sample((finger, x_m, y_m, time_s, True, size_m)))

    def _down(self, contact: Contact) -> bool:
        return (contact.identity >= 0 or contact.identity == IMPLIED) and not contact.hovers and self._touching is not False

    def _released(self, contact: Contact, time_s: float) -> TouchSample:
        finger = contact.finger
        assert finger is not None
        contact.finger = None
        self._played -= 1
        return TouchSample(finger, contact.x_m, contact.y_m, time_s, False, contact.size_m)
