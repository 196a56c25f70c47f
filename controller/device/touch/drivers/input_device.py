"""Opening the kernel's input devices (python-evdev), by path or name, with event times on CLOCK_MONOTONIC."""

from __future__ import annotations  # the event device of older versions of evdev has no kinds

import contextlib
import errno
import fcntl
import struct
from typing import Final, cast

from controller.device.touch import event_codes as ev
from controller.device.touch.drivers.evdev_library import evdev
from controller.device.touch.drivers.touch_nodes import what_is_lacking
from controller.device.touch.event_codes import Protocol, protocol_of_device
from controller.device.touch.event_reader import AxisInfo, DeviceDescription
from controller.errors import TouchError

CLOCK_MONOTONIC: Final = 1
EVIOCSCLOCKID: Final = 0x400445A0  # _IOW('E', 0xa0, int)


def open_touch_device(device: str, *, grab: bool) -> tuple[evdev.InputDevice[str], DeviceDescription]:
    """Open the event device of a touch panel.

    `device` is a path, best below /dev/input/by-path, or the name that the device reports; with `grab` other programs stop
    receiving its events. Raises TouchError if it is absent, cannot be opened or is no touch panel, or if several panels have this
    name.
    """
    path = device if device.startswith("/") else _path_of(device)
    try:
        opened = evdev.InputDevice(path)
    except (OSError, ValueError) as error:
        raise TouchError(_open_error(path, error)) from error
    try:
        description = _describe(opened)
        if grab:
            opened.grab()
        use_monotonic_clock(opened.fd)
    except ValueError as error:
        opened.close()
        raise TouchError(f"{path} ({opened.name}): {error}; choose another device") from error
    except OSError as error:
        opened.close()
        raise TouchError(_open_error(path, error)) from error
    return opened, description


def use_monotonic_clock(fd: int) -> None:
    """Have the kernel stamp the events of an open event device `fd` on CLOCK_MONOTONIC.

    Raises OSError if the file is no event device.
    """
    fcntl.ioctl(fd, EVIOCSCLOCKID, struct.pack("i", CLOCK_MONOTONIC))


def _path_of(name: str) -> str:
    """Event device of the panel with a name; other nodes of the panel (buttons, pen) may have the same name."""
    found = []
    refused = []
    present = []
    for path in evdev.list_devices():
        with contextlib.suppress(OSError):
            device = evdev.InputDevice(path)
            present.append(device.name)
            if device.name == name:
                lacking = what_is_lacking(_described(device))
                if lacking:
                    refused.append(f"{path}: {lacking}")
                else:
                    found.append(path)
            device.close()
    if refused and not found:
        raise TouchError(f"{name!r} is no touch panel: {'; '.join(sorted(refused))}; choose another device")
    if not found:
        listed = ", ".join(repr(other) for other in present) or "none that may be opened"
        raise TouchError(f"there is no touch panel named {name!r}: is it plugged in? Input devices: {listed}")
    if len(found) > 1:
        raise TouchError(
            f"several touch panels are named {name!r}: {', '.join(sorted(found))}; give a path below /dev/input/by-path"
        )
    return str(found[0])


def _axes(device: evdev.InputDevice[str]) -> dict[int, AxisInfo]:
    listed = cast("list[tuple[int, evdev.AbsInfo]]", device.capabilities(absinfo=True).get(ev.EV_ABS, []))
    return {code: AxisInfo(info.min, info.max, info.fuzz, info.flat, info.resolution) for code, info in listed}


def _describe(device: evdev.InputDevice[str]) -> DeviceDescription:
    """Description that the device of a touch panel reports.

    Raises ValueError if it is no touch panel, or has an axis without a range.
    """
    description = _described(device)
    if lacking := what_is_lacking(description):
        raise ValueError(f"it is no touch panel: {lacking}")
    axes = description.axes
    for code in ev.POSITIONS_SINGLE if protocol_of_device(axes) is Protocol.SINGLE else ev.POSITIONS:
        if axes[code].minimum >= axes[code].maximum:
            raise ValueError(f"its axis {code:#04x} reports a range from {axes[code].minimum} to {axes[code].maximum}")
    return description


def _described(device: evdev.InputDevice[str]) -> DeviceDescription:
    """Description that a device of any kind reports."""
    listed: dict[int, list[int]] = device.capabilities(absinfo=False)
    codes = {int(kind): tuple(map(int, found)) for kind, found in listed.items()}
    info = device.info
    properties = tuple(int(number) for number in device.input_props())
    return DeviceDescription(device.name, info.bustype, info.vendor, info.product, info.version, properties, codes, _axes(device))


def _open_error(path: str, error: Exception) -> str:
    number = getattr(error, "errno", None)
    if number in (errno.EACCES, errno.EPERM):
        return f"{path} may not be opened by this user: add it to the group that owns the device (on Debian: input)"
    if number == errno.EBUSY:
        return f"{path} is grabbed by another program: end it first, or leave out grab"
    if number in (errno.ENOENT, errno.ENODEV, errno.ENXIO):
        return f"there is no input device {path}: is the touch panel plugged in? Stable names are below /dev/input/by-path"
    if number in (errno.ENOTTY, errno.EINVAL) or isinstance(error, ValueError):
        return f"{path} is no input device: choose a device below /dev/input"
    return f"{path} cannot be opened ({getattr(error, 'strerror', error)})"
