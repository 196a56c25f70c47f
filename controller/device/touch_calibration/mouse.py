"""A mouse as reference for the lag of a touch panel: its steps and their times (python-evdev)."""

from __future__ import annotations

from controller.device.touch.drivers.evdev_library import evdev
from controller.device.touch.drivers.input_device import use_monotonic_clock
from controller.device.touch.event_reader import Event
from controller.device.touch_calibration.event_capture import EV_REL, REL_X, REL_Y
from controller.errors import TouchError


class Mouse:
    """A pointing device that reports relative steps.

    `device` is a path, best below /dev/input/by-id. Raises TouchError if it is absent, cannot be opened or is no mouse.
    """

    def __init__(self, device: str) -> None:
        self._device = device
        try:
            self._opened = evdev.InputDevice(device)
            steps = self._opened.capabilities().get(EV_REL, [])
            use_monotonic_clock(self._opened.fd)
        except (OSError, ValueError) as error:
            raise TouchError(f"{device}: the mouse cannot be opened ({getattr(error, 'strerror', None) or error})") from error
        if not {REL_X, REL_Y} <= set(steps):
            self._opened.close()
            raise TouchError(f"{device} is no mouse: it reports no steps along x and y")

    def fileno(self) -> int:
        """The event device."""
        return self._opened.fd

    def read(self) -> list[Event]:
        """Steps since the last call, as EV_REL events; raises TouchError if it was unplugged."""
        try:
            events = list(self._opened.read())
        except BlockingIOError:
            return []
        except OSError as error:
            raise TouchError(f"{self._device}: the mouse was disconnected ({error.strerror})") from error
        return [(e.type, e.code, e.value, e.timestamp()) for e in events if e.type == EV_REL and e.code in (REL_X, REL_Y)]

    def close(self) -> None:
        """Close the device."""
        self._opened.close()
