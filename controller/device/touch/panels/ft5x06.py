"""Touch controllers FocalTech FT5x06 and FT6x36, and EDT modules with them.

Register map: FT5x06 data sheet D-FT5x06-1212, FT6x36 application note; the kernel's edt-ft5x06.c has the same. The firmware of
EDT's M06 has no register map; it answers the commands 0xBB with its name and 0xF9 with a report and its checksum.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Container, Iterator, Sequence
from functools import partial, reduce
from operator import xor
from typing import TYPE_CHECKING, Final

from controller.device.board.touch_panels import Address, Extent, I2cTouch
from controller.device.touch.drivers.contact_events import MAX_CONTACTS, ReportedContact, describe
from controller.device.touch.drivers.counted_report import CountedReads, CountedReport, contacts_at, used_without
from controller.device.touch.drivers.i2c_bus import I2cBus, Transfer
from controller.errors import TouchError

if TYPE_CHECKING:
    from controller.device.touch.drivers.i2c_reader import I2cReader
    from controller.device.touch.drivers.panel_lines import PanelLines

DEVICE_MODE: Final = b"\x00"  # 0: working; reports begin here
STATUS: Final = 2  # TD_STATUS: number of contacts in bits 3:0
FIRST_POINT: Final = 3
POINT_BYTES: Final = 6  # event flag and x, number and y (high byte first), weight, area
INTERRUPT_MODE: Final = 0xA4  # G_MODE, 1: a pulse for each report
CHIP_ID: Final = b"\xa3"
FIRMWARE: Final = b"\xa6"
VENDOR: Final = b"\xa8"

EDT_NAME: Final = b"\xbb"  # model, "*", version, "$" of M06 and M12; an M06 sends a byte before it; undefined in other chips
EDT_NAME_BYTES: Final = 22
EDT_MODEL: Final = b"EP0"  # prefix of the models
M06_REPORT: Final = b"\xf9"
M06_HEADER: Final = b"\xaa\xaa\x1a"  # the last byte is the length of the report
M06_FIRST_POINT: Final = 5
M06_POINT_BYTES: Final = 4  # event flag and x, number and y (high byte first)
M06_POINTS: Final = 5
M06_BYTES: Final = M06_FIRST_POINT + M06_POINTS * M06_POINT_BYTES + 1  # the last byte: exclusive or of all others

PUT_DOWN, LIFTED, RESERVED = 0, 1, 3  # event flag in bits 7:6 of a point; 2 contact

RESET_S: Final = 0.005
BOOT_S: Final = 0.3  # T_rsi, from the end of the reset to the first report
SCAN_S: Final = 0.01


class Ft5x06Touch(I2cTouch, frozen=True, kw_only=True, tag_field="kind", tag="ft5x06"):
    """FocalTech FT5x06 or FT6x36, and EDT modules with them, M06 included.

    Attributes:
    width, height: Largest raw x and y: these panels cannot be asked.
    """

    address: Address = 0x38
    width: Extent
    height: Extent


def contacts_of_m06(report: Sequence[int], warnings: Counter[str]) -> list[ReportedContact]:
    """Decode the answer of an EDT M06 to `M06_REPORT`; counts `ghost_points`.

    Raises ValueError if its header or its checksum is wrong.
    """
    if bytes(report[: len(M06_HEADER)]) != M06_HEADER:
        raise ValueError("no header of a report")
    if reduce(xor, report):
        raise ValueError("wrong checksum")
    starts = range(M06_FIRST_POINT, M06_BYTES - 1, M06_POINT_BYTES)
    skipped = PUT_DOWN, LIFTED, RESERVED  # positions of contacts just put down are wrong
    return contacts_at(report, starts, partial(_point, skipped=skipped), warnings)


def _point(report: Sequence[int], start: int, skipped: Container[int] = (LIFTED, RESERVED)) -> ReportedContact | None:
    """Contact of the point that begins there, unless its event flag is `skipped`."""
    if report[start] >> 6 in skipped:
        return None
    x = (report[start] & 0x0F) << 8 | report[start + 1]
    y = (report[start + 2] & 0x0F) << 8 | report[start + 3]
    return ReportedContact(report[start + 2] >> 4, x, y)


REPORT: Final = CountedReport(DEVICE_MODE, STATUS, FIRST_POINT, POINT_BYTES, _point)


def edt_model(answer: bytes) -> tuple[str, bool]:
    """Identify an EDT module by its answer to `EDT_NAME`.

    Returns the model, empty if it is no EDT module, and whether it has the firmware of an M06.
    """
    for start, m06 in ((0, False), (1, True)):
        if answer[start : start + len(EDT_MODEL)].upper() == EDT_MODEL:
            return answer[start:].partition(b"*")[0].rstrip(b"$\0").decode("ascii", "replace"), m06
    return "", False


class Ft5x06:
    """FT5x06 or FT6x36, or an EDT module; a `Chip`. Its firmware is identified at each start.

    The first reports after a start may be from before it: reports are skipped until they change or are empty. A chip has to answer
    the registers of its report; there are boards that imitate one and refuse all others.

    Counts `ghost_points`, `stale_reports` and `points_refused`.
    """

    def __init__(self, settings: Ft5x06Touch, warnings: Counter[str]) -> None:
        self.name = "FT5x06 touch panel"
        self.rising = False
        self.scan_s = SCAN_S
        self.marks_reports = False
        self._settings = settings
        self._warnings = warnings
        self._use(m06=False)
        self._stale: bytes | None = None  # report found at the start

    def start(self, bus: I2cBus, lines: PanelLines) -> Iterator[float]:
        """Reset the chip if `lines` has a reset line, identify it on `bus`, set it to working mode; see `Chip.start`."""
        address = self._settings.address
        if lines.has_reset:
            lines.drive_reset(high=False)
            yield RESET_S
            lines.drive_reset(high=True)
            yield BOOT_S
        model, m06 = edt_model(bus.ask(address, EDT_NAME, EDT_NAME_BYTES) or b"")
        self._use(m06=m06)
        bus.fetch(self._short)  # refused by no chip that works
        name, firmware, remark = f"EDT {model}", 0, ""
        if not m06:
            identity, firmware, refused = self._identity(bus)
            name = name if model else f"FT5x06 chip {identity}"
            if not bus.offer(address, DEVICE_MODE + b"\x00"):
                refused.append(DEVICE_MODE[0])
            if not bus.offer(address, bytes((INTERRUPT_MODE, 1))):
                refused.append(INTERRUPT_MODE)
            remark = used_without([f"{register:02X}" for register in refused], self._settings.bus)
        self.description = describe(name, firmware, self._settings.width, self._settings.height, sized=False, remark=remark)
        bus.fetch(self._short)
        self._stale = bytes(self._short.data) if self._holds_contacts() else None

    def fetch(self, bus: I2cBus) -> Sequence[ReportedContact] | None:
        """Read the contacts that are down from `bus`; see `Chip.fetch`."""
        bus.fetch(self._short)
        if self._stale is not None:
            if self._short.data == self._stale:
                self._warnings["stale_reports"] += 1
                return None
            self._stale = None
        return self._reads.contacts(bus) if self._reads else contacts_of_m06(self._short.data, self._warnings)

    def _use(self, *, m06: bool) -> None:
        """Choose the transfers and the report format of the firmware."""
        address = self._settings.address
        self._reads = None if m06 else CountedReads(REPORT, address, self._warnings)
        self._short = self._reads.short if self._reads else Transfer(address, M06_REPORT, M06_BYTES)

    def _identity(self, bus: I2cBus) -> tuple[str, int, list[int]]:
        """Number of the chip and of its firmware, and the registers of both that it refuses.

        Refuses a stuck bus, a chip without firmware and a device without registers; each of them answers any register.
        """
        asked = {register[0]: bus.ask(self._settings.address, register, 1) for register in (CHIP_ID, FIRMWARE, VENDOR)}
        refused = [register for register, answer in asked.items() if answer is None]
        answers = [answer[0] for answer in asked.values() if answer is not None]
        device = f"the device at 0x{self._settings.address:02X} on {self._settings.bus} is no FocalTech chip with firmware"
        if not refused and len(set(answers)) == 1:
            raise TouchError(
                f"{device}: chip, firmware and vendor are all 0x{answers[0]:02X}; "
                "is it powered, is the bus free, is the address right?"
            )
        if refused and self._short.data[STATUS] & 0x0F > MAX_CONTACTS:
            raise TouchError(f"{device}: it reports {self._short.data[STATUS] & 0x0F} contacts; is the address another chip's?")
        chip, firmware = asked[CHIP_ID[0]], asked[FIRMWARE[0]]
        return f"{chip[0]:02x}" if chip else "unknown", firmware[0] if firmware else 0, refused

    def _holds_contacts(self) -> bool:
        try:
            return (REPORT.contacts if self._reads else contacts_of_m06)(self._short.data, Counter()) != []
        except ValueError:
            return False


def open_panel(settings: Ft5x06Touch) -> I2cReader:
    """Start the panel of a board with these `settings`; raises TouchError if bus, lines or chip are absent."""
    warnings: Counter[str] = Counter()
    from controller.device.touch.drivers.i2c_reader import I2cReader

    return I2cReader(settings, Ft5x06(settings, warnings), warnings)
