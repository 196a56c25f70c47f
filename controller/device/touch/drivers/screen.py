"""A touch screen of the kernel that this program makes (uinput, python-evdev): contacts of protocol B, axes in units of the plate.

It is gone when its file is closed, also by the end of the process, whatever ends it; the kernel then lifts what was down.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any, Final

from controller.device.touch import event_codes as ev
from controller.device.touch.drivers.contact_events import MAX_CONTACTS, MAX_TRACKING_ID
from controller.device.touch.drivers.evdev_library import evdev
from controller.device.touch.drivers.event_device import INPUT_EVENT
from controller.device.touch.event_reader import Event
from controller.errors import TouchError

NODE: Final = Path("/dev/uinput")
UNITS_PER_MM: Final = 100
LONGEST_NAME: Final = 79  # UINPUT_MAX_NAME_SIZE less its end


def why_not() -> str:
    """Why this user can make no touch screen; empty: it can."""
    if not NODE.exists():
        return f"there is no {NODE}: load the kernel module uinput (modprobe uinput)"
    if not os.access(NODE, os.R_OK | os.W_OK, effective_ids=True):
        return f"{NODE} may not be opened by this user: systemd/udev/60-haptic-panel.rules gives it to the group haptic-panel"
    return ""


class KernelScreen(evdev.UInput):
    """A touch screen.

    `name` is what other programs see; the axes are as long as the sides of the plate, in units of 0.01 mm. Raises TouchError if the
    kernel refuses it.
    """

    def __init__(self, name: str, length_mm: float, width_mm: float) -> None:
        if lacking := why_not():
            raise TouchError(lacking)
        sides = (round(length_mm * UNITS_PER_MM), round(width_mm * UNITS_PER_MM))
        positions = [(code, evdev.AbsInfo(0, 0, side, 0, 0, UNITS_PER_MM)) for code, side in zip(ev.POSITIONS, sides, strict=True)]
        numbers = ((ev.ABS_MT_SLOT, MAX_CONTACTS - 1), (ev.ABS_MT_TRACKING_ID, MAX_TRACKING_ID))
        axes = [*((code, evdev.AbsInfo(0, 0, last, 0, 0, 0)) for code, last in numbers), *positions]
        codes: dict[int, Any] = {ev.EV_KEY: [ev.BTN_TOUCH], ev.EV_ABS: axes}
        try:
            super().__init__(
                codes,
                name=name.encode("ascii", "replace").decode()[:LONGEST_NAME],
                phys="haptic-panel/input0",
                input_props=[ev.INPUT_PROP_DIRECT],
            )
        except (OSError, evdev.UInputError) as error:
            raise TouchError(f"{NODE} makes no touch screen ({getattr(error, 'strerror', None) or error})") from error

    def report(self, events: Sequence[Event]) -> None:
        """Send the events of a report, SYN_REPORT last, by one system call; the kernel gives them their time.

        Raises OSError if the kernel does not take them.
        """
        os.write(self.fd, b"".join([INPUT_EVENT.pack(0, 0, kind, code, value) for kind, code, value, _ in events]))

    def _find_device(self, fd: int) -> None:  # type: ignore[override]
        """None: nobody here reads it, and nobody waits for its node."""
