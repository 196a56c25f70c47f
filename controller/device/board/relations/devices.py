"""Relations of the devices: lines and buses that several tables name, the wire to the FPGA."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import TYPE_CHECKING

from controller.device.board.devices import divided_hz
from controller.device.board.relations.relation import refuses, warns
from controller.device.board.touch_panels import I2cTouch, SerialTouch

if TYPE_CHECKING:
    from controller.device.board.board import Board

LEAST_SCK = 0.8  # of what was asked for
PI_CHIP = re.compile(r"pinctrl-(bcm2711|bcm2835|rp1)")
PI_BUSES = {  # pins of a Raspberry Pi's header that the kernel takes for a device
    r"/dev/spidev0\.0": (8, 9, 10, 11),
    r"/dev/spidev0\.1": (7, 9, 10, 11),
    r"/dev/spidev1\.0": (18, 19, 20, 21),
    r"/dev/spidev1\.1": (17, 19, 20, 21),
    r"/dev/spidev1\.2": (16, 19, 20, 21),
    r"/dev/i2c-0": (0, 1),
    r"/dev/i2c-1": (2, 3),
    r"/dev/(serial0|ttyAMA0|ttyS0)": (14, 15),
}
PERMIT_DANGER = "the run permit would follow what else the line does"


@refuses("`link` and `touch`: `*_line`, `gpio_chip`, `interrupt_chip`")
def _lines(board: Board) -> Iterator[str]:
    """No two lines are the same."""
    taken: dict[tuple[str, str], str] = {}
    for key, chip, line in _named_lines(board):
        first = taken.setdefault((chip, _number(chip, line)), key)
        if first != key:
            danger = f": {PERMIT_DANGER}" if "link.permit_line" in (first, key) else ""
            yield f"{key} = {line!r} is {first} already, on {chip}{danger}; each needs a line of its own"


@refuses("`link` and `touch`: `*_line`; `link.device`, `touch.bus`, `temperature.device`")
def _bus_lines(board: Board) -> Iterator[str]:
    """On a Raspberry Pi, no line is a pin of a bus that is used."""
    touch, link, temperature = board.touch, board.link, board.temperature
    devices = _devices(board) if link.kind != "simulated" else []
    if isinstance(touch, I2cTouch):
        devices.append(("touch.bus", touch.bus))
    elif isinstance(touch, SerialTouch):
        devices.append(("touch.device", touch.device))
    if temperature is not None and temperature.kind == "lm75":
        devices.append(("temperature.device", temperature.device))
    for key, chip, line in _named_lines(board):
        for of, device in devices:
            pins = next((pins for pattern, pins in PI_BUSES.items() if re.fullmatch(pattern, device)), ())
            if PI_CHIP.fullmatch(chip) and _number(chip, line) in {str(pin) for pin in pins}:
                yield f"{key} = {line!r} is a pin of {of} = {device!r}, which the kernel drives: take another line"


def _named_lines(board: Board) -> list[tuple[str, str, str]]:
    """Every GPIO line that is used: key, chip and line."""
    link, touch = board.link, board.touch
    found = []
    if link.kind == "spi":
        found += [(f"link.{key}", link.gpio_chip, getattr(link, key)) for key in ("trigger_line", "configured_line", "permit_line")]
        found += [(f"link.fpga[{n}].configured_line", link.gpio_chip, one.configured_line) for n, one in enumerate(link.fpga)]
    if isinstance(touch, I2cTouch):
        found += [(f"touch.{key}", touch.interrupt_chip, getattr(touch, key)) for key in ("interrupt_line", "reset_line")]
    return [(key, chip, line) for key, chip, line in found if line]


def _devices(board: Board) -> list[tuple[str, str]]:
    """The device of each FPGA, with its key."""
    each = [(f"link.fpga[{number}].device", one.device) for number, one in enumerate(board.link.fpga)]
    return each or [("link.device", board.link.device)]


@refuses("`link.fpga`: `device`, `configured_line`; `link.device`, `configured_line`")
def _of_each(board: Board) -> Iterator[str]:
    """Each of several FPGAs on SPI has a chip select of its own; they share a `configured_line`, or each has one."""
    link = board.link
    if link.kind != "spi" or not link.fpga:
        return
    first: dict[str, str] = {}
    for key, device in _devices(board):
        if first.setdefault(device, key) != key:
            yield f"{key} = {device!r} is {first[device]} already: each FPGA needs a chip select of its own"
    if link.device:
        yield f"link.device = {link.device!r} is not used, as each link.fpga has its own: take it out"
    without = [number for number, one in enumerate(link.fpga) if not one.configured_line]
    if len(without) < len(link.fpga):
        if without:
            yield f"link.fpga[{without[0]}].configured_line is missing: give one to each FPGA, or to none"
        elif link.configured_line:
            yield (
                f"link.configured_line = {link.configured_line!r} is of all FPGAs, and link.fpga gives one to each: take the one"
                " or the others out"
            )


def _number(chip: str, line: str) -> str:
    """A line's name; on a Raspberry Pi the number in it, as GPIO25 and 25 are the same."""
    found = re.fullmatch(r"(?:GPIO)?(\d+)", line) if PI_CHIP.fullmatch(chip) else None
    return found[1] if found else line


@refuses("`link.device`, `touch.device`")
def _ports(board: Board) -> Iterator[str]:
    """FPGA and touch panel are on different serial ports."""
    link, touch = board.link, board.touch
    if link.kind == "serial" and isinstance(touch, SerialTouch) and touch.device == link.device:
        yield f"touch.device = {touch.device!r} is link.device already: the FPGA and the touch panel need a port each"


@refuses("`touch.bus`, `address`, `temperature.device`, `address`")
def _addresses(board: Board) -> Iterator[str]:
    """Two chips of one I2C bus have different addresses."""
    touch, temperature = board.touch, board.temperature
    if temperature is None or temperature.kind != "lm75" or not isinstance(touch, I2cTouch):
        return
    if (touch.bus, touch.address) == (temperature.device, temperature.address):
        yield (
            f"temperature.address = {temperature.address} is touch.address already, on touch.bus = {touch.bus!r}: two chips"
            " cannot answer at one address"
        )


@warns("`link.sck_hz`, `spi_source_hz`")
def _sck(board: Board) -> Iterator[str]:
    """The controller makes 0.8 of SCK or more by an even divider."""
    link = board.link
    if link.kind != "spi" or link.spi_source_hz is None:
        return
    sck_hz = divided_hz(link.spi_source_hz, link.sck_hz)
    if sck_hz < LEAST_SCK * link.sck_hz:
        yield (
            f"link.sck_hz = {link.sck_hz} becomes {sck_hz:g}: link.spi_source_hz = {link.spi_source_hz} is divided by an even"
            " number; ask for what there is"
        )


@warns("`link.kind`, `*_line`")
def _serial_lines(board: Board) -> Iterator[str]:
    """A serial link has no lines."""
    link = board.link
    given = [key for key in ("trigger_line", "configured_line", "permit_line") if getattr(link, key)]
    if link.kind == "serial" and given:
        yield (
            f'link.{given[0]} = {getattr(link, given[0])!r} is not used: a link of kind = "serial" drives no lines; leave it out'
        )


@warns("`touch.kind`, `recording`")
def _recording(board: Board) -> Iterator[str]:
    """A board without a panel has a recording."""
    if not board.touch.has_device and not board.touch.recording:
        yield 'touch.recording is missing with touch.kind = "recording": nothing is touched unless run is given --replay'


@warns("`touch.max_size_mm`, `plate.length_mm`, `width_mm`")
def _palms(board: Board) -> Iterator[str]:
    """A palm is smaller than the plate."""
    short_mm = min(board.plate.length_mm, board.plate.width_mm)
    if board.touch.max_size_mm > short_mm:
        yield (
            f"touch.max_size_mm = {board.touch.max_size_mm:g} is more than the plate is wide, {short_mm:g} mm: no palm is ever"
            " ignored"
        )


@warns("`application_socket.clients_per_user`, `max_clients`")
def _clients(board: Board) -> Iterator[str]:
    """One user cannot take every place."""
    socket = board.application_socket
    if socket is not None and socket.clients_per_user > socket.max_clients:
        yield (
            f"application_socket.clients_per_user = {socket.clients_per_user} is above max_clients = {socket.max_clients}: one"
            " user can take every place"
        )
