"""Touch panels with a kernel driver, by their event device (python-evdev; kernel documentation: input/event-codes.rst).

Opening goes through evdev; reading does not: it would make an object for each of all events that wait. Events are read
into one buffer that is kept, a report at a time.
"""

from __future__ import annotations

import contextlib
import errno
import fcntl
import os
import struct
from collections import Counter
from collections.abc import Sequence
from typing import Final

import evdev

from controller.errors import TouchError
from controller.touch import event_codes as ev
from controller.touch.event_codes import EV_SYN, SYN_DROPPED, SYN_REPORT
from controller.touch.event_reader import AxisInfo, DeviceDescription, Event
from controller.touch.panel import Protocol, protocol_of_device

RETRY_S: Final = 0.5  # between attempts to open a panel that is gone
INPUT_EVENT: Final = struct.Struct("@llHHi")  # struct input_event
EVENT_BYTES: Final = INPUT_EVENT.size
BUFFERED_EVENTS: Final = 64
PART_EVENTS: Final = 40  # a longer report comes in parts: no list is over 512 bytes
MAX_SLOTS: Final = 256

CLOCK_MONOTONIC: Final = 1
EVIOCSCLOCKID: Final = 0x400445A0  # _IOW('E', 0xa0, int)


def _eviocgmtslots(size_bytes: int) -> int:
    return 0x80000000 | size_bytes << 16 | 0x450A  # _IOC(_IOC_READ, 'E', 0x0a, size)


class LinuxInput:
    """An `EventReader` of one event device.

    Events lost in the kernel's buffer (SYN_DROPPED) are made up for here: what is left in the buffer is older than
    the state read then, so it is thrown away first (as libevdev does).

    Parameters
    ----------
    device : str
        Path, best below /dev/input/by-path; or name as the device gives it.
    grab : bool
        Nobody else gets the panel's events.

    Raises
    ------
    TouchError
        If it is not there, cannot be opened, or is no touch panel; if several have that name.
    """

    def __init__(self, device: str, *, grab: bool = False) -> None:
        self.warnings: Counter[str] = Counter()
        self._wanted = device
        self._grab = grab
        self._buffer = bytearray(BUFFERED_EVENTS * INPUT_EVENT.size)
        self._into = [memoryview(self._buffer)]
        self._begin = self._end = 0  # bytes of the buffer not yet given
        self._dropping = False
        self._state_due = False  # the next read gives the panel's state
        self._retry_s = 0.0
        self._opened: evdev.InputDevice[str] | None = None
        self._open()

    @property
    def description(self) -> DeviceDescription:
        """Of the device as it was opened last."""
        return self._description

    @property
    def present(self) -> bool:
        """Whether the device is open."""
        return self._opened is not None

    def fileno(self) -> int | None:
        """The event device."""
        return self._opened.fd if self._opened is not None else None

    def next_time_s(self) -> float | None:
        """At once while events are held here; when to look for a lost panel."""
        if self._opened is None:
            return self._retry_s
        return 0.0 if self._begin < self._end or self._state_due else None

    def read(self, now_s: float) -> Sequence[Event]:
        """Events of at most one report; see `EventReader.read`."""
        if self._opened is None:
            if now_s >= self._retry_s:
                self._reopen(now_s)
            return ()
        if self._state_due:
            self._state_due = False
            return self._guarded_state(now_s)
        events: list[Event] = []
        append = events.append
        unpack = INPUT_EVENT.unpack_from
        buffer = self._buffer
        begin = self._begin
        for _ in range(PART_EVENTS):
            if begin == self._end:
                if not self._fill():
                    self._begin = self._end = 0
                    return self._lost(now_s) if self._opened is None else events
                begin = 0
            second, microsecond, kind, code, value = unpack(buffer, begin)
            begin += EVENT_BYTES
            if kind == EV_SYN and code == SYN_DROPPED:
                self.warnings["dropped"] += 1
                self._dropping = True
            elif self._dropping:
                if kind == EV_SYN and code == SYN_REPORT:
                    self._dropping = False
                    return self._guarded_state(now_s)
            else:
                append((kind, code, value, second + microsecond * 1e-6))
                if kind == EV_SYN and code == SYN_REPORT:
                    break
        self._begin = begin
        return events

    def close(self) -> None:
        """Close the device; the kernel ends a grab with it."""
        if self._opened is not None:
            with contextlib.suppress(OSError):
                self._opened.close()
            self._opened = None

    def _fill(self) -> bool:
        """Read what waits, as much as the buffer holds; False if nothing does, or the device is gone."""
        assert self._opened is not None
        try:
            size = os.readv(self._opened.fd, self._into)
        except BlockingIOError:
            return False
        except OSError:  # ENODEV when unplugged
            size = 0
        self._begin, self._end = 0, size - size % INPUT_EVENT.size
        if not self._end:
            self.close()
        return self._end > 0

    def _lost(self, now_s: float) -> Sequence[Event]:
        """The device has gone: lift what may be down, look for it again later."""
        self.warnings["panel_lost"] += 1
        self._begin = self._end = 0
        self._dropping = False
        self._retry_s = now_s + RETRY_S
        return lifted(self._protocol, self._slots, now_s)

    def _reopen(self, now_s: float) -> None:
        self._retry_s = now_s + RETRY_S
        try:
            self._open()
        except TouchError:
            return  # still away, or something else answers to its name: told when it was lost

    def _open(self) -> None:
        path = self._wanted if self._wanted.startswith("/") else _path_of(self._wanted)
        try:
            device = evdev.InputDevice(path)
        except (OSError, ValueError) as error:
            raise TouchError(_why_not_open(path, error)) from error
        try:
            description = _describe(device)
            if self._grab:
                device.grab()
            fcntl.ioctl(device.fd, EVIOCSCLOCKID, struct.pack("i", CLOCK_MONOTONIC))
        except ValueError as error:
            device.close()
            raise TouchError(f"{path} ({device.name}): {error}; choose a touch panel") from error
        except OSError as error:
            device.close()
            raise TouchError(_why_not_open(path, error)) from error
        self._description = description
        self._protocol = protocol_of_device(description.axes)
        slot_axis = description.axes.get(ev.ABS_MT_SLOT)
        self._slots = min(max(slot_axis.maximum, 0), MAX_SLOTS - 1) + 1 if slot_axis else 0
        self._opened = device
        self._state_due = True

    def _guarded_state(self, now_s: float) -> Sequence[Event]:
        """The state as a report; what waits in the kernel's buffer is older and goes."""
        assert self._opened is not None
        while self._opened is not None and self._fill():
            pass
        if self._opened is None:
            return self._lost(now_s)
        self._begin = self._end = 0
        try:
            return self._state(self._opened, now_s)
        except OSError:
            self.close()
            return self._lost(now_s)

    def _state(self, device: evdev.InputDevice[str], now_s: float) -> list[Event]:
        events: list[Event] = []
        axes = self._description.axes
        if self._protocol is Protocol.A:  # the kernel keeps no state of protocol A
            return lifted(self._protocol, 0, now_s)
        if self._protocol is Protocol.B:
            columns = [(code, self._slot_values(device.fd, code)) for code in ev.SLOT_STATE if code in axes]
            for slot in range(self._slots):
                events.append((ev.EV_ABS, ev.ABS_MT_SLOT, slot, now_s))
                events += [(ev.EV_ABS, code, values[slot], now_s) for code, values in columns]
            events.append((ev.EV_ABS, ev.ABS_MT_SLOT, device.absinfo(ev.ABS_MT_SLOT).value, now_s))
        else:
            events += [(ev.EV_ABS, code, device.absinfo(code).value, now_s) for code in ev.POSITIONS_SINGLE]
        if ev.BTN_TOUCH in self._description.codes.get(ev.EV_KEY, ()):
            events.append((ev.EV_KEY, ev.BTN_TOUCH, int(ev.BTN_TOUCH in device.active_keys()), now_s))
        events.append((ev.EV_SYN, ev.SYN_REPORT, 0, now_s))
        return events

    def _slot_values(self, fd: int, code: int) -> tuple[int, ...]:
        """What the kernel keeps of one axis in every slot (EVIOCGMTSLOTS)."""
        layout = struct.Struct(f"=I{self._slots}i")
        request = bytearray(layout.pack(code, *[0] * self._slots))
        fcntl.ioctl(fd, _eviocgmtslots(layout.size), request)
        return tuple(layout.unpack(request)[1:])


def lifted(protocol: Protocol, slots: int, time_s: float) -> list[Event]:
    """A report that says of every contact that it is gone."""
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


def _path_of(name: str) -> str:
    """Event device of the panel with this name; a panel's other nodes (its buttons, its pen) may share it."""
    found = []
    others = []
    for path in evdev.list_devices():
        with contextlib.suppress(OSError):
            device = evdev.InputDevice(path)
            others.append(device.name)
            if device.name == name:
                axes = _axes(device)
                if axes.keys() >= set(ev.POSITIONS) or axes.keys() >= set(ev.POSITIONS_SINGLE):
                    found.append(path)
            device.close()
    if not found:
        there = ", ".join(repr(other) for other in others) or "none that may be opened"
        raise TouchError(f"there is no touch panel named {name!r}: is it plugged in? Input devices: {there}")
    if len(found) > 1:
        raise TouchError(
            f"several touch panels are named {name!r}: {', '.join(sorted(found))}; give a path below /dev/input/by-path"
        )
    return str(found[0])


def _axes(device: evdev.InputDevice[str]) -> dict[int, AxisInfo]:
    listed: list[tuple[int, evdev.AbsInfo]] = device.capabilities(absinfo=True).get(ev.EV_ABS, [])  # type: ignore[assignment]
    return {code: AxisInfo(info.min, info.max, info.fuzz, info.flat, info.resolution) for code, info in listed}


def _describe(device: evdev.InputDevice[str]) -> DeviceDescription:
    """What the device says of itself.

    Raises
    ------
    ValueError
        If it has no axes on which a place could be told.
    """
    axes = _axes(device)
    places = ev.POSITIONS_SINGLE if protocol_of_device(axes) is Protocol.SINGLE else ev.POSITIONS
    for code in places:
        if code not in axes:
            raise ValueError("it has no axes for a place")
        if axes[code].minimum >= axes[code].maximum:
            raise ValueError(f"its axis {code:#04x} says to range from {axes[code].minimum} to {axes[code].maximum}")
    listed: dict[int, list[int]] = device.capabilities(absinfo=False)
    codes = {int(kind): tuple(map(int, found)) for kind, found in listed.items()}
    info = device.info
    properties = tuple(int(number) for number in device.input_props())
    return DeviceDescription(device.name, info.bustype, info.vendor, info.product, info.version, properties, codes, axes)


def _why_not_open(path: str, error: Exception) -> str:
    number = getattr(error, "errno", None)
    if number in (errno.EACCES, errno.EPERM):
        return f"{path} may not be opened by this user: add it to the group that owns the device (on Debian: input)"
    if number == errno.EBUSY:
        return f"{path} is grabbed by another program: end it first, or leave out grab"
    if number in (errno.ENOENT, errno.ENODEV, errno.ENXIO):
        return f"there is no input device {path}: is the touch panel plugged in? Stable names are below /dev/input/by-path"
    if number in (errno.ENOTTY, errno.EINVAL) or isinstance(error, ValueError):
        return f"{path} is no input device: choose one below /dev/input"
    return f"{path} cannot be opened ({getattr(error, 'strerror', error)})"
