"""One decoder for the kernel's touch event streams: protocol A, protocol B and single-touch.

Kernel documentation: input/multi-touch-protocol.rst, input/event-codes.rst. Events change contacts;
each SYN_REPORT turns what changed into touch samples. What the three protocols share (hover, finger
numbers, the limit, counting, losses) is here once; `associate.py` gives protocol A its identities.

The kernel sends an axis of a slot only when it differs from the slot's last value, even if another
contact sent that: a slot keeps its position from one contact to the next.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from itertools import count

from controller.touch import event_codes as ev
from controller.touch.associate import FIRST_SERIAL, Contact, associate
from controller.touch.axes import Axes
from controller.touch.panel import Counts, PanelState, Protocol
from controller.touch.samples import TouchSample

MAX_PLAYED = 10
MAX_SLOTS = 256

# Values of Contact.identity besides the tracking ids of the device, which are not negative.
AWAY = -1  # no contact
UNKNOWN = -2  # nothing heard of this slot yet: a finger may have been down before the stream began
IMPLIED = -3  # a position came for an unknown slot, so a finger is there


class Decoder:
    """Events in, touch samples out at each SYN_REPORT.

    Hovering is no contact: BTN_TOUCH 0, ABS_MT_DISTANCE above 0 or, in protocol A, ABS_MT_TOUCH_MAJOR 0.
    A palm (ABS_MT_TOOL_TYPE) is counted but not played. When ten fingers are played, one that comes
    is not, as long as it stays: a finger that starts in the middle of its touch would feel like a press.

    Parameters
    ----------
    axes : Axes
        Maps raw positions to the plate.
    protocol : Protocol
        See `panel.protocol_of`.
    slot, last_slot : int
        Slot current at the start; highest slot the device declares, None if unknown.
    read_state : callable, optional
        Reads the panel's state after lost events. Without it (a recording) all fingers are released.
    """

    def __init__(
        self,
        axes: Axes,
        protocol: Protocol,
        *,
        slot: int = 0,
        last_slot: int | None = None,
        read_state: Callable[[], PanelState] | None = None,
    ) -> None:
        self.protocol = protocol
        self.counts = Counts()
        self.warnings: Counter[str] = Counter()
        self._axes = axes
        self._last_slot = MAX_SLOTS if last_slot is None else last_slot
        self._read_state = read_state
        self._x_code, self._y_code = ev.POSITIONS_SINGLE if protocol is Protocol.SINGLE else ev.POSITIONS
        self._slots: dict[int, Contact] = {}  # protocol A: by identity
        self._packets: list[Contact] = []  # protocol A: contacts of the report so far
        self._packet_seen = False
        self._gone: list[Contact] = []  # replaced within the report by another contact in the same slot
        self._touching: bool | None = None  # BTN_TOUCH, None until heard
        self._losing = False
        self._played = 0
        self._next_finger = 0
        self._serials = count(FIRST_SERIAL)
        self._select(slot)

    def feed(self, kind: int, code: int, value: int, time_s: float) -> tuple[TouchSample, ...] | None:
        """Take one event.

        Parameters
        ----------
        kind, code, value : int
            As in struct input_event.
        time_s : float
            Put into the samples as it is.

        Returns
        -------
        tuple of TouchSample or None
            At SYN_REPORT: fingers released, begun or moved, in this order of kind; else None.
        """
        if kind == ev.EV_SYN and code == ev.SYN_REPORT:
            return self._report(time_s)
        if self._losing:
            return None
        if kind == ev.EV_ABS:
            self._axis(code, value)
        elif kind == ev.EV_KEY and code == ev.BTN_TOUCH:
            self._button(value != 0)
        elif kind == ev.EV_SYN and code == ev.SYN_MT_REPORT and self.protocol is Protocol.A:
            self._end_packet()
        elif kind == ev.EV_SYN and code == ev.SYN_DROPPED:
            self._losing = True
            self.warnings["dropped"] += 1
        return None

    def release(self, time_s: float) -> tuple[TouchSample, ...]:
        """Release every finger and forget the panel's state (the stream ended, or events were lost)."""
        fingers = [c for c in (*self._gone, *self._slots.values()) if c.finger is not None]
        self._slots.clear()
        self._gone.clear()
        self._packets.clear()
        self._touching = None
        self._select(self._slot)
        return tuple([self._released(contact, time_s) for contact in fingers])

    def restore(self, state: PanelState, time_s: float) -> tuple[TouchSample, ...]:
        """Take over a state read from the panel; a tracking id that is still there is the same finger."""
        self._touching = state.touching
        for slot, tracking_id, x, y in state.slots:
            contact = self._enter(slot)
            self._identify(contact, max(tracking_id, AWAY))
            contact.moved |= (contact.x, contact.y) != (x, y)
            contact.x, contact.y = x, y
        self._select(state.slot)
        return self._samples(time_s)

    def fingers(self) -> list[tuple[int, float, float]]:
        """Fingers down now as (finger, x_m, y_m), moving or at rest."""
        return [(c.finger, c.x_m, c.y_m) for c in self._slots.values() if c.finger is not None]

    def _axis(self, code: int, value: int) -> None:
        here = self._here
        if code == self._x_code:
            here.moved |= value != here.x
            here.x = value
        elif code == self._y_code:
            here.moved |= value != here.y
            here.y = value
        elif self.protocol is Protocol.SINGLE:
            return
        elif code == ev.ABS_MT_SLOT:
            self._select(value)
        elif code == ev.ABS_MT_TRACKING_ID:
            if self.protocol is Protocol.B:
                self._identify(here, max(value, AWAY))
            else:
                here.identity = value
        elif code == ev.ABS_MT_DISTANCE or (code == ev.ABS_MT_TOUCH_MAJOR and self.protocol is Protocol.A):
            here.hovers = value > 0 if code == ev.ABS_MT_DISTANCE else value == 0
        elif code == ev.ABS_MT_TOOL_TYPE:
            here.palm = value == ev.MT_TOOL_PALM
        if here.identity == UNKNOWN and code in ev.POSITIONS:
            here.identity = IMPLIED

    def _button(self, touching: bool) -> None:
        if self.protocol is Protocol.SINGLE:
            self._identify(self._here, 0 if touching else AWAY)
        self._touching = touching

    def _select(self, slot: int) -> None:
        self._slot = slot
        self._here = self._enter(slot)

    def _enter(self, slot: int) -> Contact:
        """Contact of a slot; one that leads nowhere if no device has such a slot."""
        contact = self._slots.get(slot)
        if contact is not None:
            return contact
        if not 0 <= slot < MAX_SLOTS:
            self.warnings["slot_absurd"] += 1
            return Contact(AWAY)
        if slot > self._last_slot:
            self.warnings["slot_beyond_range"] += 1
        contact = Contact(UNKNOWN)
        if self.protocol is not Protocol.A:
            self._slots[slot] = contact
        return contact

    def _identify(self, contact: Contact, identity: int) -> None:
        """Give a contact its tracking id; another id than before is another finger."""
        if identity == contact.identity:
            return
        if contact.identity >= 0 and not contact.counted and self._down(contact):
            self.counts.contacts += 1  # came and went within one report
        if contact.finger is not None:
            self._gone.append(Contact(AWAY, finger=contact.finger, x_m=contact.x_m, y_m=contact.y_m))
            contact.finger = None
        contact.identity = identity
        contact.counted = contact.refused = False

    def _end_packet(self) -> None:
        """Protocol A: SYN_MT_REPORT closes one contact; an empty one says that there is none."""
        self._packet_seen = True
        if self._here.x is not None and self._here.y is not None and not self._here.hovers:
            if len(self._packets) < MAX_SLOTS:
                self._packets.append(self._here)
            else:
                self.warnings["contacts_absurd"] += 1
        self._here = Contact(AWAY)

    def _report(self, time_s: float) -> tuple[TouchSample, ...]:
        if self._losing:
            return self._after_loss(time_s)
        if self.protocol is Protocol.A:
            if self._here.x is not None:
                self._end_packet()
            if self._packet_seen or self._touching is False:
                now = associate(self._slots, self._packets, self._axes, self._serials)
                self._gone += [was for key, was in self._slots.items() if was.finger is not None and key not in now]
                self._slots = now
                self._packets.clear()
            self._packet_seen = False
            self._here = Contact(AWAY)
        samples = self._samples(time_s)
        down = 0
        for contact in self._slots.values():
            if self._down(contact):
                down += 1
                if not contact.counted and contact.identity >= 0:
                    contact.counted = True
                    self.counts.contacts += 1
        if down:
            self.counts.reports += 1
            self.counts.max_fingers = max(self.counts.max_fingers, down)
        return samples

    def _samples(self, time_s: float) -> tuple[TouchSample, ...]:
        samples = [self._released(contact, time_s) for contact in self._gone]
        self._gone.clear()
        for contact in self._slots.values():
            if not self._down(contact) or contact.palm:
                if contact.finger is not None:
                    samples.append(self._released(contact, time_s))
                contact.refused = False
        for contact in self._slots.values():
            if contact.palm or contact.refused or not self._down(contact):
                continue
            if contact.x is None or contact.y is None or not (contact.moved or contact.finger is None):
                continue
            if contact.finger is None:
                if self._played == MAX_PLAYED:
                    self.warnings["more_than_played"] += 1
                    contact.refused = True
                    continue
                contact.finger = self._next_finger
                self._next_finger += 1
                self._played += 1
            x, y = self._axes.clamp(contact.x, contact.y)
            if x != contact.x or y != contact.y:
                self.warnings["outside_axes"] += 1
            contact.x_m, contact.y_m = self._axes.place_m(x, y)
            contact.moved = False
            samples.append(TouchSample(contact.finger, contact.x_m, contact.y_m, time_s, True))
        return tuple(samples)

    def _down(self, contact: Contact) -> bool:
        return (contact.identity >= 0 or contact.identity == IMPLIED) and not contact.hovers and self._touching is not False

    def _released(self, contact: Contact, time_s: float) -> TouchSample:
        finger = contact.finger
        assert finger is not None
        contact.finger = None
        self._played -= 1
        return TouchSample(finger, contact.x_m, contact.y_m, time_s, False)

    def _after_loss(self, time_s: float) -> tuple[TouchSample, ...]:
        """First SYN_REPORT after SYN_DROPPED: all before it is void, the panel's state is read or given up."""
        self._losing = False
        if self._read_state is None or self.protocol is Protocol.A:  # the kernel keeps no state of protocol A
            return self.release(time_s)
        return self.restore(self._read_state(), time_s)
