"""Touch controllers FocalTech FT5x06 and FT6x36, and EDT modules with them (M09 and later).

Register map: FT5x06 data sheet D-FT5x06-1212, FT6x36 application note; the kernel's edt-ft5x06.c has the same.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from typing import Final

from gpiod.line import Edge

from controller.device_settings import Ft5x06Touch
from controller.touch.contact_events import MAX_CONTACTS, Contact, describe
from controller.touch.event_reader import DeviceDescription
from controller.touch.i2c_bus import I2cBus, Transfer
from controller.touch.i2c_reader import I2cReader
from controller.touch.panel_lines import PanelLines

DEVICE_MODE: Final = b"\x00"  # 0: working; reports begin here
STATUS: Final = 2  # TD_STATUS: number of contacts in bits 3:0
FIRST_POINT: Final = 3
POINT_BYTES: Final = 6  # event flag and x, number and y (high byte first), weight, area
SHORT_POINTS: Final = 2  # most touches have no more: what follows is read only if there are more
INTERRUPT_MODE: Final = 0xA4  # G_MODE, 1: a pulse for each report
CHIP_ID: Final = b"\xa3"
FIRMWARE: Final = b"\xa6"

LIFTED, RESERVED = 1, 3  # event flag in bits 7:6 of a point; 0 put down, 2 contact

RESET_S: Final = 0.005
BOOT_S: Final = 0.3  # T_rsi, from the end of the reset to the first report


def contacts_of(report: Sequence[int], warnings: Counter[str]) -> list[Contact] | None:
    """Contacts of a report.

    Parameters
    ----------
    report : bytes
        Registers from 0 on, as many as were read.
    warnings : Counter of str
        Counts `ghost_points`.

    Returns
    -------
    list of Contact, or None
        None if the report lists more contacts than were read.

    Raises
    ------
    ValueError
        If it lists more contacts than there can be.
    """
    count = report[STATUS] & 0x0F
    if count > MAX_CONTACTS:
        raise ValueError(f"{count} contacts")
    if len(report) < FIRST_POINT + count * POINT_BYTES:
        return None
    contacts = []
    for start in range(FIRST_POINT, FIRST_POINT + count * POINT_BYTES, POINT_BYTES):
        flag = report[start] >> 6
        number = report[start + 2] >> 4
        if flag in (LIFTED, RESERVED) or number >= MAX_CONTACTS:
            continue
        x = (report[start] & 0x0F) << 8 | report[start + 1]
        y = (report[start + 2] & 0x0F) << 8 | report[start + 3]
        if x == 0 and y == 0:
            warnings["ghost_points"] += 1
            continue
        contacts.append(Contact(number, x, y))
    return contacts


class Ft5x06:
    """One such chip; a `Chip`.

    What it reports right after a start may be of before it: reports are skipped until they change or are empty.
    """

    def __init__(self, settings: Ft5x06Touch, warnings: Counter[str]) -> None:
        self.name = "FT5x06 touch panel"
        self.edge = Edge.FALLING
        self._settings = settings
        self._warnings = warnings
        address = settings.address
        self._short = Transfer(address, DEVICE_MODE, FIRST_POINT + SHORT_POINTS * POINT_BYTES)
        self._long = Transfer(address, DEVICE_MODE, FIRST_POINT + MAX_CONTACTS * POINT_BYTES)
        self._stale: bytes | None = None  # report found at the start

    @property
    def description(self) -> DeviceDescription:
        """Of the chip as it was started last; the extents are the board's, as the chip does not tell them."""
        return self._description

    def start(self, bus: I2cBus, lines: PanelLines) -> Iterator[float]:
        """Reset it if its line is there, set it to work; see `Chip.start`."""
        address = self._settings.address
        if lines.has_reset:
            lines.drive_reset(high=False)
            yield RESET_S
            lines.drive_reset(high=True)
            yield BOOT_S
        bus.write(address, DEVICE_MODE + b"\x00")
        bus.write(address, bytes((INTERRUPT_MODE, 1)))
        chip = bus.read(address, CHIP_ID, 1)[0]
        firmware = bus.read(address, FIRMWARE, 1)[0]
        self._description = describe(f"FT5x06 chip {chip:02x}", firmware, self._settings.width, self._settings.height, sized=False)
        bus.fetch(self._short)
        self._stale = bytes(self._short.data) if self._short.data[STATUS] & 0x0F else None

    def fetch(self, bus: I2cBus) -> Sequence[Contact] | None:
        """Contacts down now; see `Chip.fetch`."""
        bus.fetch(self._short)
        if self._stale is not None:
            if self._short.data == self._stale:
                self._warnings["stale_reports"] += 1
                return None
            self._stale = None
        contacts = contacts_of(self._short.data, self._warnings)
        if contacts is None:
            bus.fetch(self._long)
            contacts = contacts_of(self._long.data, self._warnings)
        return contacts


def open_ft5x06(settings: Ft5x06Touch) -> I2cReader:
    """Start the panel of a board.

    Raises
    ------
    TouchError
        If bus, lines or chip are not there.
    """
    warnings: Counter[str] = Counter()
    return I2cReader(settings, Ft5x06(settings, warnings), warnings)
