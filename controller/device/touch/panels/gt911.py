"""Touch controllers Goodix GT911 and compatible (data sheet and programming guide rev. 09).

The kernel's goodix.c drives the chips of `PRODUCTS` with the same register map; the GT1x series has another one.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Final, Literal

from controller.device.board.touch_panels import I2cTouch
from controller.device.touch.drivers.contact_events import MAX_CONTACTS, ReportedContact, describe
from controller.device.touch.drivers.counted_report import CountedReads, CountedReport, used_without
from controller.device.touch.drivers.i2c_bus import REFUSED_ERRNOS, I2cBus, write_message
from controller.device.touch.event_reader import DeviceDescription
from controller.errors import TouchError

if TYPE_CHECKING:
    from controller.device.touch.drivers.i2c_reader import I2cReader
    from controller.device.touch.drivers.panel_lines import PanelLines

# Registers have 16-bit addresses, high byte first; values low byte first.
CONFIG: Final = b"\x80\x47"  # version, largest x, largest y (2 bytes each), contacts, module switch 1; refresh rate last
CONFIG_BYTES: Final = 16
SHORTEST_SCAN_MS: Final = 5  # to which bits 3:0 of the refresh rate are added
PRODUCT_ID: Final = b"\x81\x40"  # 4 ASCII characters, zeros behind them; then the firmware's version, 2 bytes
PRODUCT_BYTES: Final = 6
PRODUCTS: Final = ("911", "9110", "9111", "912", "9147", "927", "9271", "928", "967")
STATUS: Final = b"\x81\x4e"  # bit 7: a report is ready, bits 3:0: its contacts, which follow
READY: Final = 0x80
POINT_BYTES: Final = 8  # number, x, y, size (2 bytes each), reserved
RISING_INTERRUPT: Final = (0, 3)  # of module switch 1, bits 1:0; 1 and 2: falling edge, low level

HIGH_ADDRESS, LOW_ADDRESS = 0x14, 0x5D  # selected by the level of the interrupt line at the end of the reset

RESET_S: Final = 0.011  # T2: more than 10 ms
ADDRESS_S: Final = 0.0005  # T3: more than 100 us
SELECTED_S: Final = 0.01  # T4: more than 5 ms
SYNC_S: Final = 0.05  # T5: the interrupt line held low
BOOT_S: Final = 0.05


class Gt911Touch(I2cTouch, frozen=True, kw_only=True, tag_field="kind", tag="gt911"):
    """Goodix GT911 and related chips (`gt911.PRODUCTS`).

    Attributes:
    address: Address on the bus; the interrupt line selects it at reset.
    """

    address: Literal[0x14, 0x5D] = 0x5D


def _point(report: Sequence[int], start: int) -> ReportedContact:
    number, x_low, x_high, y_low, y_high, size_low, size_high = report[start : start + 7]
    return ReportedContact(number & 0x0F, x_low | x_high << 8, y_low | y_high << 8, size_low | size_high << 8)


REPORT: Final = CountedReport(STATUS, 0, 1, POINT_BYTES, _point)


def product_of(identity: bytes, bus: str) -> str:
    """Product number of a chip, from its registers from `PRODUCT_ID` on; raises TouchError if it is not one of `PRODUCTS`."""
    name = identity[:4].rstrip(b"\0")
    if name.decode("ascii", "replace") in PRODUCTS:
        return name.decode("ascii")
    if not name.strip(b"\xff"):
        raise TouchError(
            f"the touch panel on {bus} answers with 0x{identity[0]:02X} only: is it powered and out of reset, and is the bus free?"
        )
    if not (name.isalnum() and name.isascii()):
        raise TouchError(
            f"the device that answers as touch panel on {bus} is no Goodix chip (product {name!r}): is the address another chip's?"
        )
    raise TouchError(
        f"the touch panel on {bus} is a Goodix {name.decode('ascii')!r}, which this driver does not support: "
        f'it supports {", ".join(PRODUCTS)}; with a kernel driver it can be used as kind = "linux_input"'
    )


class Gt911:
    """GT911 or compatible; a `Chip`.

    It has to answer the registers of its report; the others are used where it has them.

    The extents of `settings` overrule the chip's. Counts `ghost_points` and `points_refused`.
    """

    def __init__(self, settings: Gt911Touch, warnings: Counter[str]) -> None:
        self.name = "Goodix touch panel"
        self.rising = False
        self.scan_s = SHORTEST_SCAN_MS * 1e-3
        self.marks_reports = True
        self._settings = settings
        self._warnings = warnings
        self._use(settings.address)

    def start(self, bus: I2cBus, lines: PanelLines) -> Iterator[float]:
        """Reset the chip to its address if `lines` has a reset line, identify it on `bus`; see `Chip.start`."""
        if lines.has_reset:
            yield from self._reset(lines)
        product = self._find(bus, (self._address,) if lines.has_reset and lines.has_interrupt else (self._address, self._other))
        config = bus.ask(self._address, CONFIG, CONFIG_BYTES)
        refused = [register.hex().upper() for register, answer in ((PRODUCT_ID, product), (CONFIG, config)) if answer is None]
        name = f"GT{product_of(product, self._settings.bus)}" if product else "Goodix of unknown product"
        self.description = self._described(
            name, config, int.from_bytes(product[4:6], "little") if product else 0, used_without(refused, self._settings.bus)
        )
        if config:
            self.rising = config[6] & 0x03 in RISING_INTERRUPT
            self.scan_s = (SHORTEST_SCAN_MS + (config[15] & 0x0F)) * 1e-3
        bus.send(self._clear)

    def fetch(self, bus: I2cBus) -> Sequence[ReportedContact] | None:
        """Read the report that is ready from `bus` and clear it, which lets the chip make the next; see `Chip.fetch`."""
        bus.fetch(self._reads.short)
        if not self._reads.short.data[0] & READY:
            return None
        try:
            return self._reads.contacts(bus)
        finally:
            bus.send(self._clear)

    @property
    def _other(self) -> int:
        return LOW_ADDRESS if self._address == HIGH_ADDRESS else HIGH_ADDRESS

    def _reset(self, lines: PanelLines) -> Iterator[float]:
        """Reset the chip; the level of its interrupt line, if there is one, selects its address."""
        self._use(self._settings.address)
        lines.drive_reset(high=False)
        if lines.has_interrupt:
            lines.drive_interrupt(high=False)
        yield RESET_S
        if lines.has_interrupt:
            lines.drive_interrupt(high=self._address == HIGH_ADDRESS)
        yield ADDRESS_S
        lines.drive_reset(high=True)
        yield SELECTED_S
        if lines.has_interrupt:
            lines.drive_interrupt(high=False)
        yield SYNC_S
        lines.release_interrupt()
        yield BOOT_S

    def _use(self, address: int) -> None:
        self._address = address
        self._reads = CountedReads(REPORT, address, self._warnings)
        self._clear = write_message(address, STATUS + b"\x00")

    def _find(self, bus: I2cBus, addresses: Sequence[int]) -> bytes | None:
        """Product of the chip, at the first of `addresses` that has one; None if there is a chip that refuses to tell it.

        Without an interrupt line to select it, the address is the one of the level at power-up.

        Raises OSError if no chip answers; TouchError if what answers is no report.
        """
        for address in addresses:
            product = bus.ask(address, PRODUCT_ID, PRODUCT_BYTES)
            if product is not None:
                self._use(address)
                return product
        silent: OSError | None = None
        for address in addresses:
            try:
                contacts = bus.read(address, STATUS, 1)[0] & 0x0F
            except OSError as error:
                if error.errno not in REFUSED_ERRNOS:
                    raise
                silent = error
                continue
            if contacts > MAX_CONTACTS:
                raise TouchError(
                    f"the device that answers as touch panel on {self._settings.bus} is no Goodix chip: it reports "
                    f"{contacts} contacts; is the address another chip's?"
                )
            self._use(address)
            return None
        assert silent is not None
        raise silent

    def _described(self, name: str, config: bytes | None, firmware: int, remark: str) -> DeviceDescription:
        width = self._settings.width or (int.from_bytes(config[1:3], "little") if config else 0)
        height = self._settings.height or (int.from_bytes(config[3:5], "little") if config else 0)
        if not width or not height:
            lack = "has no configuration" if config else f"refuses the registers of its configuration, from 0x{CONFIG.hex()} on"
            raise TouchError(f"the {name} on {self._settings.bus} {lack}: give width and height in board.toml")
        return describe(name, firmware, width, height, sized=True, remark=remark)


def open_panel(settings: Gt911Touch) -> I2cReader:
    """Start the panel of a board with these `settings`; raises TouchError if bus, lines or chip are absent."""
    warnings: Counter[str] = Counter()
    from controller.device.touch.drivers.i2c_reader import I2cReader

    return I2cReader(settings, Gt911(settings, warnings), warnings)
