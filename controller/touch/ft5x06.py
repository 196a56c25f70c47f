"""Touch controllers FocalTech FT5x06 and FT6x36, and EDT modules with them.

Register map: FT5x06 data sheet D-FT5x06-1212, FT6x36 application note; the kernel's edt-ft5x06.c has the same. The firmware of
EDT's M06 has no such map: it answers commands, 0xBB with its name and 0xF9 with a report that carries a checksum.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from functools import reduce
from operator import xor
from typing import Final

from gpiod.line import Edge

from controller.board.devices import Ft5x06Touch
from controller.errors import TouchError
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
VENDOR: Final = b"\xa8"

EDT_NAME: Final = b"\xbb"  # model, "*", version, "$" of M06 and M12; an M06 puts a byte before it; others have anything there
EDT_NAME_BYTES: Final = 22
EDT_MODEL: Final = b"EP0"  # what models begin with
M06_REPORT: Final = b"\xf9"
M06_HEADER: Final = b"\xaa\xaa\x1a"  # and the length of the report
M06_FIRST_POINT: Final = 5
M06_POINT_BYTES: Final = 4  # event flag and x, number and y (high byte first)
M06_POINTS: Final = 5
M06_BYTES: Final = M06_FIRST_POINT + M06_POINTS * M06_POINT_BYTES + 1  # the last: all others, exclusive or

PUT_DOWN, LIFTED, RESERVED = 0, 1, 3  # event flag in bits 7:6 of a point; 2 contact

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
    starts = range(FIRST_POINT, FIRST_POINT + count * POINT_BYTES, POINT_BYTES)
    return _contacts(report, starts, (LIFTED, RESERVED), warnings)


def contacts_of_m06(report: Sequence[int], warnings: Counter[str]) -> list[Contact]:
    """Contacts of a report of an EDT M06.

    Parameters
    ----------
    report : bytes
        Answer to `M06_REPORT`, `M06_BYTES` long.
    warnings : Counter of str
        Counts `ghost_points`.

    Raises
    ------
    ValueError
        If its header or its checksum is wrong.
    """
    if bytes(report[: len(M06_HEADER)]) != M06_HEADER:
        raise ValueError("no header of a report")
    if reduce(xor, report):
        raise ValueError("wrong checksum")
    starts = range(M06_FIRST_POINT, M06_BYTES - 1, M06_POINT_BYTES)
    return _contacts(report, starts, (PUT_DOWN, LIFTED, RESERVED), warnings)  # places of contacts just put down are not true


def _contacts(report: Sequence[int], starts: range, skipped: tuple[int, ...], warnings: Counter[str]) -> list[Contact]:
    """Contacts of the points that begin at these bytes, but for those with these event flags."""
    contacts = []
    for start in starts:
        number = report[start + 2] >> 4
        if report[start] >> 6 in skipped or number >= MAX_CONTACTS:
            continue
        x = (report[start] & 0x0F) << 8 | report[start + 1]
        y = (report[start + 2] & 0x0F) << 8 | report[start + 3]
        if x == 0 and y == 0:
            warnings["ghost_points"] += 1
            continue
        contacts.append(Contact(number, x, y))
    return contacts


def edt_model(answer: bytes) -> tuple[str, bool]:
    """Model of an EDT module by its answer to `EDT_NAME`, empty if it is none, and whether its firmware is an M06's."""
    for start, m06 in ((0, False), (1, True)):
        if answer[start : start + len(EDT_MODEL)].upper() == EDT_MODEL:
            return answer[start:].partition(b"*")[0].rstrip(b"$\0").decode("ascii", "replace"), m06
    return "", False


class Ft5x06:
    """One such chip; a `Chip`. Which firmware it has is found out at each start.

    What it reports right after a start may be of before it: reports are skipped until they change or are empty.
    """

    def __init__(self, settings: Ft5x06Touch, warnings: Counter[str]) -> None:
        self.name = "FT5x06 touch panel"
        self.edge = Edge.FALLING
        self._settings = settings
        self._warnings = warnings
        self._use(m06=False)
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
        model, m06 = edt_model(bus.read(address, EDT_NAME, EDT_NAME_BYTES))
        self._use(m06=m06)
        chip = firmware = 0
        if not m06:
            chip, firmware = self._identity(bus)
            bus.write(address, DEVICE_MODE + b"\x00")
            bus.write(address, bytes((INTERRUPT_MODE, 1)))
        name = f"EDT {model}" if model else f"FT5x06 chip {chip:02x}"
        self._description = describe(name, firmware, self._settings.width, self._settings.height, sized=False)
        bus.fetch(self._short)
        self._stale = bytes(self._short.data) if self._holds_contacts() else None

    def fetch(self, bus: I2cBus) -> Sequence[Contact] | None:
        """Contacts down now; see `Chip.fetch`."""
        bus.fetch(self._short)
        if self._stale is not None:
            if self._short.data == self._stale:
                self._warnings["stale_reports"] += 1
                return None
            self._stale = None
        contacts = self._contacts_of(self._short.data, self._warnings)
        if contacts is None:
            bus.fetch(self._long)
            contacts = self._contacts_of(self._long.data, self._warnings)
        return contacts

    def _use(self, *, m06: bool) -> None:
        """Ask for reports as this firmware wants it."""
        address = self._settings.address
        self._contacts_of: Callable[[Sequence[int], Counter[str]], list[Contact] | None]
        if m06:
            self._short = self._long = Transfer(address, M06_REPORT, M06_BYTES)
            self._contacts_of = contacts_of_m06
        else:
            self._short = Transfer(address, DEVICE_MODE, FIRST_POINT + SHORT_POINTS * POINT_BYTES)
            self._long = Transfer(address, DEVICE_MODE, FIRST_POINT + MAX_CONTACTS * POINT_BYTES)
            self._contacts_of = contacts_of

    def _identity(self, bus: I2cBus) -> tuple[int, int]:
        """Number of the chip and of its firmware; a bus that is stuck, an empty chip and one without registers are refused."""
        chip, firmware, vendor = (bus.read(self._settings.address, register, 1)[0] for register in (CHIP_ID, FIRMWARE, VENDOR))
        if chip == firmware == vendor:
            raise TouchError(
                f"what answers as touch panel at 0x{self._settings.address:02X} on {self._settings.bus} is no FocalTech chip with "
                f"firmware: chip, firmware and vendor are all 0x{chip:02X}; is it powered, is the bus free, is the address right?"
            )
        return chip, firmware

    def _holds_contacts(self) -> bool:
        try:
            return self._contacts_of(self._short.data, Counter()) != []
        except ValueError:
            return False


def open_ft5x06(settings: Ft5x06Touch) -> I2cReader:
    """Start the panel of a board.

    Raises
    ------
    TouchError
        If bus, lines or chip are not there.
    """
    warnings: Counter[str] = Counter()
    return I2cReader(settings, Ft5x06(settings, warnings), warnings)
