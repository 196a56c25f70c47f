"""Touch panels with a kernel driver, read from their event device (kernel documentation: input/event-codes.rst).

python-evdev opens the device but does not read it: it would create an object for every waiting event. Events are read into
one buffer that is reused, one report at a time.
"""

from __future__ import annotations  # the event device of older versions of evdev has no kinds

import contextlib
import fcntl
import os
import struct
from collections import Counter
from collections.abc import Sequence
from typing import Final

from controller.device.touch import event_codes as ev
from controller.device.touch.drivers.evdev_library import evdev
from controller.device.touch.drivers.input_device import open_touch_device
from controller.device.touch.event_codes import EV_SYN, SYN_DROPPED, SYN_REPORT, Protocol, protocol_of_device
from controller.device.touch.event_reader import Event
from controller.errors import TouchError

RETRY_S: Final = 0.5  # between attempts to open a lost panel
INPUT_EVENT: Final = struct.Struct("@llHHi")  # struct input_event
EVENT_BYTES: Final = INPUT_EVENT.size
BUFFERED_EVENTS: Final = 64
MAX_READ_BYTES: Final = 40 * EVENT_BYTES  # a longer report comes in parts: no list is larger than 512 bytes
MAX_PARTS: Final = 40  # of a report that is left out, in one read: a flood without an end leaves the loop its turn
MAX_SLOTS: Final = 256
NOTHING: Final = memoryview(b"")


def _eviocgmtslots(size_bytes: int) -> int:
    return 0x80000000 | size_bytes << 16 | 0x450A  # _IOC(_IOC_READ, 'E', 0x0a, size)


class LinuxInput:
    """An `EventReader` of one event device.

    After a loss of events in the kernel's buffer (SYN_DROPPED) the device's state is read and given as a report. Events
    still in the buffer are older than that state and are discarded first, as libevdev does.

    `device` is a path, best below /dev/input/by-path, or the name that the device reports; with `grab` other programs stop
    receiving its events. Raises TouchError if it is absent, cannot be opened or is no touch panel, or if several panels have this
    name.
    """

    def __init__(self, device: str, *, grab: bool = False) -> None:
        self.warnings: Counter[str] = Counter()
        self._device = device
        self._grab = grab
        self._into = [memoryview(bytearray(BUFFERED_EVENTS * EVENT_BYTES))]
        self._left = NOTHING  # of what was read last, in there: not yet returned
        self._dropping = False
        self._state_due = False  # the next read gives the panel's state
        self._retry_s = 0.0
        self._opened: evdev.InputDevice[str] | None = None
        self._open()

    @property
    def present(self) -> bool:
        """Whether the device is open."""
        return self._opened is not None

    def fileno(self) -> int | None:
        """The event device."""
        return self._opened.fd if self._opened is not None else None

    def next_time_s(self) -> float | None:
        """At once while events are buffered; while the panel is lost, when to open it again."""
        if self._opened is None:
            return self._retry_s
        return 0.0 if self._left or self._state_due else None

    def read(self, now_s: float) -> Sequence[Event]:
        """Events of at most one report by `now_s`; see `EventReader.read`."""
        if self._opened is None:
            if now_s >= self._retry_s:
                self._reopen(now_s)
            return ()
        if self._state_due:
            self._state_due = False
            return self._resynchronise(now_s)
        event: tuple[int, int, int, int, int]
        for _ in range(MAX_PARTS):
            if not (self._left or self._fill()):
                break
            events: list[Event] = []
            for event in INPUT_EVENT.iter_unpack(self._left[:MAX_READ_BYTES]):
                second, microsecond, kind, code, value = event
                events.append((kind, code, value, second + microsecond * 1e-6))
                if not kind:  # EV_SYN
                    if code == SYN_REPORT:
                        break
                    if code == SYN_DROPPED:
                        self.warnings["dropped"] += 1
                        self._dropping = True
                        break
            self._left = self._left[EVENT_BYTES * len(events) :]
            if not self._dropping:
                return events
            if events[-1][:2] == (EV_SYN, SYN_REPORT):
                self._dropping = False
                return self._resynchronise(now_s)
        if self._opened is None:
            return self._lost(now_s)
        return ()

    def close(self) -> None:
        """Close the device, which ends a grab."""
        if self._opened is not None:
            with contextlib.suppress(OSError):
                self._opened.close()
            self._opened = None

    def _fill(self) -> bool:
        """Fill the buffer; False if no event waits or the device is lost."""
        assert self._opened is not None
        try:
            size = os.readv(self._opened.fd, self._into)
        except BlockingIOError:
            return False
        except OSError:  # ENODEV when unplugged
            size = 0
        self._left = self._into[0][: size - size % EVENT_BYTES]
        if not self._left:
            self.close()
            return False
        return True

    def _lost(self, now_s: float) -> Sequence[Event]:
        """Lift every contact of a lost device; it is opened again later."""
        self.warnings["panel_lost"] += 1
        self._left = NOTHING
        self._dropping = False
        self._retry_s = now_s + RETRY_S
        return release_report(self._protocol, self._slots, now_s)

    def _reopen(self, now_s: float) -> None:
        self._retry_s = now_s + RETRY_S
        try:
            self._open()
        except TouchError:
            return  # still absent, or another device has its name

    def _open(self) -> None:
        # As it was opened last
        self._opened, self.description = open_touch_device(self._device, grab=self._grab)
        self._protocol = protocol_of_device(self.description.axes)
        slot_axis = self.description.axes.get(ev.ABS_MT_SLOT)
        self._slots = min(max(slot_axis.maximum, 0), MAX_SLOTS - 1) + 1 if slot_axis else 0
        self._state_due = True

    def _resynchronise(self, now_s: float) -> Sequence[Event]:
        """The device's state as a report; older events in the kernel's buffer are discarded."""
        assert self._opened is not None
        while self._opened is not None and self._fill():
            pass
        if self._opened is None:
            return self._lost(now_s)
        self._left = NOTHING
        try:
            return self._state(self._opened, now_s)
        except OSError:
            self.close()
            return self._lost(now_s)

    def _state(self, device: evdev.InputDevice[str], now_s: float) -> list[Event]:
        events: list[Event] = []
        axes = self.description.axes
        if self._protocol is Protocol.A:  # the kernel keeps no state of protocol A
            return release_report(self._protocol, 0, now_s)
        if self._protocol is Protocol.B:
            columns = [(code, self._slot_values(device.fd, code)) for code in ev.SLOT_STATE if code in axes]
            for slot in range(self._slots):
                events.append((ev.EV_ABS, ev.ABS_MT_SLOT, slot, now_s))
                events += [(ev.EV_ABS, code, values[slot], now_s) for code, values in columns]
            events.append((ev.EV_ABS, ev.ABS_MT_SLOT, device.absinfo(ev.ABS_MT_SLOT).value, now_s))
        else:
            events += [(ev.EV_ABS, code, device.absinfo(code).value, now_s) for code in ev.POSITIONS_SINGLE]
        if ev.BTN_TOUCH in self.description.codes.get(ev.EV_KEY, ()):
            events.append((ev.EV_KEY, ev.BTN_TOUCH, int(ev.BTN_TOUCH in device.active_keys()), now_s))
        events.append((ev.EV_SYN, ev.SYN_REPORT, 0, now_s))
        return events

    def _slot_values(self, fd: int, code: int) -> tuple[int, ...]:
        """Last value of one axis in every slot (EVIOCGMTSLOTS)."""
        layout = struct.Struct(f"=I{self._slots}i")
        request = bytearray(layout.pack(code, *[0] * self._slots))
        fcntl.ioctl(fd, _eviocgmtslots(layout.size), request)
        return tuple(layout.unpack(request)[1:])


def release_report(protocol: Protocol, slots: int, time_s: float) -> list[Event]:
    """Report that lifts every contact; `slots` is the number of slots, for protocol B."""
    events: list[Event] = []
    if protocol is Protocol.B:
        for slot in range(slots):
            events += [(ev.EV_ABS, ev.ABS_MT_SLOT, slot, time_s), (ev.EV_ABS, ev.ABS_MT_TRACKING_ID, -1, time_s)]
    elif protocol is Protocol.A:
        events.append((ev.EV_SYN, ev.SYN_MT_REPORT, 0, time_s))
    else:
        events.append((ev.EV_KEY, ev.BTN_TOUCH, 0, time_s))
    events.append((ev.EV_SYN, ev.SYN_REPORT, 0, time_s))
    return events
