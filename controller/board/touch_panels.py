"""The table [touch] of board.toml: one record for each kind of touch panel.

Name devices by what does not change from one boot or kernel to the next: paths below /dev/input/by-path or /dev/serial/by-id,
GPIO chips by label, lines by name or, where they have none, by number.
"""

from __future__ import annotations

from typing import Annotated, Literal

from msgspec import Meta

from controller.board.records import Positive, Record

Address = Annotated[int, Meta(ge=0x08, le=0x77)]
Extent = Annotated[int, Meta(ge=1, le=65535)]
AxisMm = Annotated[float, Meta(ge=-1e5, le=1e5)]  # a raw axis may be many times as long as the plate
Name = Annotated[str, Meta(min_length=1)]


class TouchPanel(Record, frozen=True, kw_only=True):
    """A touch panel: how its axes map to the plate, and how its reports are to be understood.

    Attributes
    ----------
    x_mm_from_axes, y_mm_from_axes
        Map from the panel's axes, each scaled to 0…1, to the plate: factor of the first axis, factor of the second, offset.
    lag_ms
        Age of a position when it is reported; `calibrate-touch --lag` measures it.
    max_size_mm
        A wider contact is a palm, and is ignored.
    confirm_reports
        A contact counts as a finger from this report on.
    max_emissions_unconfirmed
        Emissions that a contact may trigger before it is confirmed.
    ghost_ms
        After an emission, until false contacts that it caused have gone; 0: it causes none. `calibrate-touch --ghosts`
        measures it.
    no_finger_mm
        Rectangles on the plate where nothing is a finger, each as x and y of its corner, length along x, width along y: for a
        panel that reports contacts there that nobody makes, such as in its corners while it is idle.
    recording
        Recording that `run` replays on a board without devices.
    """

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

    def check_no_finger(self, length_mm: float, width_mm: float) -> None:
        """Check that each rectangle without fingers lies on a plate of these sides, and leaves some of it.

        Raises
        ------
        ValueError
            Naming the rectangle.
        """
        for index, (x_mm, y_mm, along_mm, across_mm) in enumerate(self.no_finger_mm):
            where = f"touch.no_finger_mm[{index}] = {[x_mm, y_mm, along_mm, across_mm]}"
            if along_mm <= 0 or across_mm <= 0:
                raise ValueError(f"{where}: its length and width, the last two, must be above 0 mm")
            if x_mm > length_mm or y_mm > width_mm or x_mm + along_mm < 0 or y_mm + across_mm < 0:
                raise ValueError(f"{where} lies beside the plate (0 to {length_mm:g}, 0 to {width_mm:g} mm): nothing is left out")
            if x_mm <= 0 and y_mm <= 0 and x_mm + along_mm >= length_mm and y_mm + across_mm >= width_mm:
                raise ValueError(f"{where} covers the plate: no finger would be left")


class RecordingTouch(TouchPanel, frozen=True, kw_only=True, tag_field="kind", tag="recording"):
    """No touch panel: a recording is replayed."""

    ghost_ms: Annotated[float, Meta(ge=0, le=500)] = 0.0  # emissions cannot cause contacts in a recording


class LinuxInputTouch(TouchPanel, frozen=True, kw_only=True, tag_field="kind", tag="linux_input"):
    """A touch panel with a kernel driver (evdev).

    Attributes
    ----------
    device
        Path such as /dev/input/by-path/..., or the device's name.
    grab
        Whether to keep other programs from reading it.
    """

    device: Name
    grab: bool = False


class I2cTouch(TouchPanel, frozen=True, kw_only=True):
    """A touch panel on an I2C bus; its interrupt line announces each report.

    Attributes
    ----------
    bus
        I2C bus, such as /dev/i2c-1.
    address
        Address on the bus.
    interrupt_chip
        Label of the GPIO chip with the following lines; where several chips have it, the path of a udev link to the chip.
    interrupt_line
        Name of the interrupt line or, of a line without a name of its own, its number on the chip, such as "25"; left out: the
        panel is polled at the rate of its scans, 100 times a second.
    reset_line
        Name or number of the reset line on the same chip; left out: the panel is not reset.
    width, height
        Largest raw x and y; left out: the panel is asked, where it can answer.
    """

    bus: Name
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


class Ft5x06Touch(I2cTouch, frozen=True, kw_only=True, tag_field="kind", tag="ft5x06"):
    """FocalTech FT5x06 or FT6x36, and EDT modules with them, M06 included.

    Attributes
    ----------
    width, height
        Largest raw x and y: these panels cannot be asked.
    """

    address: Address = 0x38
    width: Extent
    height: Extent


class Gt911Touch(I2cTouch, frozen=True, kw_only=True, tag_field="kind", tag="gt911"):
    """Goodix GT911 and related chips (`gt911.PRODUCTS`).

    Attributes
    ----------
    address
        Address on the bus; the interrupt line selects it at reset.
    """

    address: Literal[0x14, 0x5D] = 0x5D


class SerialTouch(TouchPanel, frozen=True, kw_only=True, tag_field="kind", tag="serial_panel"):
    """A touch panel with the Elo SmartSet protocol on a serial port.

    Attributes
    ----------
    device
        Serial port, such as /dev/serial/by-id/...
    baud
        Baud rate.
    """

    device: Name
    baud: Annotated[int, Meta(ge=1200, le=115200)] = 9600


Touch = RecordingTouch | LinuxInputTouch | Ft5x06Touch | Gt911Touch | SerialTouch
