"""Touch panels: each module is a kind, with its record and `open_panel`; a driver gives the events of Linux's input devices.

They import what needs a panel's packages when the panel is opened, since a board of that kind is read on computers without them.
"""

from importlib import import_module
from typing import cast

from controller.device.board.touch_panels import TouchPanel
from controller.device.touch.event_reader import EventReader


def open_panel(settings: TouchPanel) -> EventReader:
    """Open the driver of a panel, which is in the module of its record.

    Raises TouchError if the panel is absent, or the settings are those of a recording.
    """
    return cast(EventReader, import_module(type(settings).__module__).open_panel(settings))
