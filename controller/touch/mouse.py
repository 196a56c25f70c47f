"""A mouse by its event device (python-evdev): how far it went, and when, on the loop's clock."""

from __future__ import annotations

import fcntl
import struct

import evdev

from controller.errors import TouchError
from controller.touch.event_reader import Event
from controller.touch.kept_events import EV_REL, REL_X, REL_Y
from controller.touch.linux_input import CLOCK_MONOTONIC, EVIOCSCLOCKID


class Mouse:
    """A pointing device that tells steps.

    Parameters
    ----------
    device : str
        Path, best below /dev/input/by-id.

    Raises
    ------
    TouchError
        If it is not there, cannot be opened, or is no mouse.
    """

    def __init__(self, device: str) -> None:
        self._device = device
        try:
            self._opened = evdev.InputDevice(device)
            steps = self._opened.capabilities().get(EV_REL, [])
            fcntl.ioctl(self._opened.fd, EVIOCSCLOCKID, struct.pack("i", CLOCK_MONOTONIC))
        except (OSError, ValueError) as error:
            raise TouchError(f"{device}: the mouse cannot be opened ({getattr(error, 'strerror', None) or error})") from error
        if not {REL_X, REL_Y} <= set(steps):
            self._opened.close()
            raise TouchError(f"{device} is no mouse: it tells no steps along x and y")

    def fileno(self) -> int:
        """The event device."""
        return self._opened.fd

    def read(self) -> list[Event]:
        """The steps that have come.

        Raises
        ------
        TouchError
            If it was unplugged.
        """
        try:
            events = list(self._opened.read())
        except BlockingIOError:
            return []
        except OSError as error:
            raise TouchError(f"{self._device}: the mouse has gone ({error.strerror})") from error
        return [(e.type, e.code, e.value, e.timestamp()) for e in events if e.type == EV_REL and e.code in (REL_X, REL_Y)]

    def close(self) -> None:
        """Give the device back."""
        self._opened.close()
