"""Touch panels with a kernel driver (evdev)."""

from __future__ import annotations

from controller.device.board.touch_panels import Name, TouchPanel
from controller.device.touch.event_reader import EventReader


class LinuxInputTouch(TouchPanel, frozen=True, kw_only=True, tag_field="kind", tag="linux_input"):
    """A touch panel with a kernel driver (evdev).

    Attributes:
    device: Path such as /dev/input/by-path/..., or the device's name.
    grab: Whether to keep other programs from reading it.
    """

    device: Name
    grab: bool = False


def open_panel(settings: LinuxInputTouch) -> EventReader:
    """Open the event device; TouchError if it is absent or no touch panel."""
    from controller.device.touch.drivers.event_device import LinuxInput

    return LinuxInput(settings.device, grab=settings.grab)
