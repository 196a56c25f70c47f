"""Registry of touch panels: for the settings of each `[touch] kind`, its driver and where the driver runs.

A driver's module is imported when a panel is opened: a computer without such a panel may lack its libraries.
"""

from __future__ import annotations

from collections.abc import Mapping
from importlib import import_module
from typing import Final, NamedTuple, cast

from controller.board.touch_panels import Ft5x06Touch, Gt911Touch, LinuxInputTouch, SerialTouch, TouchPanel
from controller.errors import TouchError
from controller.touch.event_reader import EventReader


class PanelDriver(NamedTuple):
    """Driver of one kind of panel.

    Attributes
    ----------
    module : str
        Module of this package with `open_panel(settings) -> EventReader`, which raises TouchError if the panel is absent.
    own_process : bool
        Whether the driver runs in a process of its own: its bus may block for longer than a heartbeat.
    """

    module: str
    own_process: bool = False


PANELS: Final[Mapping[type[TouchPanel], PanelDriver]] = {
    LinuxInputTouch: PanelDriver("linux_input"),
    Ft5x06Touch: PanelDriver("ft5x06", own_process=True),
    Gt911Touch: PanelDriver("gt911", own_process=True),
    SerialTouch: PanelDriver("serial_panel"),
}


def driver_of(settings: TouchPanel) -> PanelDriver | None:
    """Driver for the settings of a panel; None for a recording, which has no device.

    Parameters
    ----------
    settings : TouchPanel
        The board's [touch].
    """
    return PANELS.get(type(settings))


def open_panel(settings: TouchPanel) -> EventReader:
    """Open the driver of a panel.

    Parameters
    ----------
    settings : TouchPanel
        The board's [touch].

    Raises
    ------
    TouchError
        If the panel is absent, or the settings are those of a recording.
    """
    driver = driver_of(settings)
    if driver is None:
        raise TouchError("the board has no touch panel: give its [touch] the kind of a panel, or replay a recording")
    return cast(EventReader, import_module(f"controller.touch.{driver.module}").open_panel(settings))
