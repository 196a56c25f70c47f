"""The table [touch] of board.toml: what all kinds of touch panels have, and those on a bus.

A kind of panel is one module of `touch/panels`, found by its name: its record, tagged with that name, and `open_panel`. A board
imports the module that its `kind` names and no other, so that nothing lists the kinds, and none needs another's packages.

Name devices by what does not change from one boot or kernel to the next: paths below /dev/input/by-path or /dev/serial/by-id,
GPIO chips by label, lines by name or, where they have none, by number.
"""

from __future__ import annotations

import pkgutil
from importlib import import_module
from typing import Annotated, ClassVar, Final

from msgspec import Meta

from controller.device.board.records import Positive, Record

Address = Annotated[int, Meta(ge=0x08, le=0x77)]
Extent = Annotated[int, Meta(ge=1, le=65535)]
AxisMm = Annotated[float, Meta(ge=-1e5, le=1e5)]  # a raw axis may be many times as long as the plate
Name = Annotated[str, Meta(min_length=1)]

PANELS: Final = "controller.device.touch.panels"


class TouchPanel(Record, frozen=True, kw_only=True):
    """A touch panel: how its axes map to the plate, and how its reports are to be understood.

    Attributes:
    x_mm_from_axes, y_mm_from_axes: Map from the panel's axes, each scaled to 0…1, to the plate: factor of the first axis, factor of
        the second, offset.
    lag_ms: Age of a position when it is reported; `calibrate-touch --lag` measures it.
    max_size_mm: A wider contact is a palm, and is ignored.
    confirm_reports: A contact counts as a finger from this report on.
    max_emissions_unconfirmed: Emissions that a contact may trigger before it is confirmed.
    ghost_ms: After an emission, until false contacts that it caused have gone; 0: it causes none. `calibrate-touch --ghosts`
        measures it.
    no_finger_mm: Rectangles on the plate where nothing is a finger, each as x and y of its corner, length along x, width along y:
        for a panel that reports contacts there that nobody makes, such as in its corners while it is idle.
    recording: Recording that `run` replays on a board without devices.
    """

    has_device: ClassVar[bool] = True  # else a recording is replayed
    own_process: ClassVar[bool] = False  # whether its bus may block for longer than a heartbeat

    x_mm_from_axes: tuple[AxisMm, AxisMm, AxisMm]
    y_mm_from_axes: tuple[AxisMm, AxisMm, AxisMm]
    lag_ms: Annotated[float, Meta(ge=0, le=200)] = 0.0
    max_size_mm: Positive = 30.0
    confirm_reports: Annotated[int, Meta(ge=1, le=10)] = 1
    max_emissions_unconfirmed: Annotated[int, Meta(ge=1, le=100)] = 1
    ghost_ms: Annotated[float, Meta(ge=0, le=500)] = 30.0
    no_finger_mm: tuple[tuple[AxisMm, AxisMm, AxisMm, AxisMm], ...] = ()
    recording: str = ""

    @property
    def runs_beside(self) -> bool:
        """Whether a process of its own reads it."""
        return self.own_process

    @property
    def lag_s(self) -> float:
        """Age of a position when it is reported, in s."""
        return self.lag_ms * 1e-3

    @property
    def max_size_m(self) -> float:
        """Largest size of a contact that counts as a finger, in m."""
        return self.max_size_mm * 1e-3

    @property
    def ghost_s(self) -> float:
        """Time after an emission until its ghosts have gone, in s."""
        return self.ghost_ms * 1e-3

    @property
    def no_finger_m(self) -> tuple[tuple[float, float, float, float], ...]:
        """Rectangles where nothing is a finger, each as smallest x and y, largest x and y, in m."""
        return tuple([(x * 1e-3, y * 1e-3, (x + length) * 1e-3, (y + width) * 1e-3) for x, y, length, width in self.no_finger_mm])


class DrivenPanel(TouchPanel, frozen=True, kw_only=True):
    """A touch panel that has no kernel driver here: other programs get its touches only if they are handed on.

    Attributes:
    share: Whether its contacts are handed on to other programs on this machine, such as a browser, as a touch screen of the kernel
        (/dev/uinput) whose axes are the plate's.
    """

    share: bool = False

    @property
    def runs_beside(self) -> bool:
        """Whether a process of its own reads it, as it does where contacts are shared: that costs the loop nothing."""
        return self.own_process or self.share


class I2cTouch(DrivenPanel, frozen=True, kw_only=True):
    """A touch panel on an I2C bus; its interrupt line announces each report.

    Attributes:
    bus: I2C bus, such as /dev/i2c-1.
    address: Address on the bus.
    interrupt_chip: Label of the GPIO chip with the following lines; where several chips have it, the path of a udev link to the
        chip.
    interrupt_line: Name of the interrupt line or, of a line without a name of its own, its number on the chip, such as "25"; left
        out: the panel is polled at the rate of its scans, 100 times a second.
    reset_line: Name or number of the reset line on the same chip; left out: the panel is not reset.
    width, height: Largest raw x and y; left out: the panel is asked, where it can answer.
    """

    own_process: ClassVar[bool] = True

    bus: Name
    address: Address
    interrupt_chip: str = ""
    interrupt_line: str = ""
    reset_line: str = ""
    width: Extent | None = None
    height: Extent | None = None

    def __post_init__(self) -> None:
        for key in ("interrupt_line", "reset_line"):
            if getattr(self, key) and not self.interrupt_chip:
                raise ValueError(f"interrupt_chip is missing: the label of the GPIO chip with {key} {getattr(self, key)!r}")
        if self.interrupt_chip and not (self.interrupt_line or self.reset_line):
            raise ValueError("interrupt_chip is given without interrupt_line or reset_line: name a line of it, or leave it out")
        if self.interrupt_line and self.interrupt_line == self.reset_line:
            raise ValueError(f"interrupt_line and reset_line are both {self.reset_line!r}: they are two lines")


class SerialTouch(DrivenPanel, frozen=True, kw_only=True):
    """A touch panel on a serial port.

    Attributes:
    device: Serial port, such as /dev/serial/by-id/...
    baud: Baud rate.
    """

    device: Name
    baud: Annotated[int, Meta(ge=1200, le=115200)] = 9600


def touch_record(kind: object) -> type[TouchPanel] | None:
    """The record of a kind of panel: of the module of that name, the record tagged with it; None if there is none."""
    if not isinstance(kind, str) or not kind.isidentifier():
        return None
    try:
        module = import_module(f"{PANELS}.{kind}")
    except ModuleNotFoundError as error:
        if error.name != f"{PANELS}.{kind}":
            raise
        return None
    records = (found for found in vars(module).values() if isinstance(found, type) and issubclass(found, TouchPanel))
    return next((record for record in records if record.__struct_config__.tag == kind), None)


def touch_records() -> tuple[type[TouchPanel], ...]:
    """The records of all kinds of panels, by their names."""
    names = sorted(module.name for module in pkgutil.iter_modules(import_module(PANELS).__path__))
    return tuple(record for record in map(touch_record, names) if record)
