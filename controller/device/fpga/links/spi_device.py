"""A device of spidev: opened by one program alone, set to what the FPGA needs, and its settings read back from the kernel."""

from __future__ import annotations

import errno
import fcntl
import os
import re
import struct
from pathlib import Path
from typing import Final

import spidev

from controller.errors import LinkError

BUFSIZ: Final = Path("/sys/module/spidev/parameters/bufsiz")
BUFSIZ_DEFAULT: Final = 4096
RD_BITS_PER_WORD: Final = 0x80016B03
RD_MAX_SPEED_HZ: Final = 0x80046B04
RD_MODE32: Final = 0x80046B05
MODE: Final = 0  # SCK idle low, sampled on its rising edge; most significant bit first, chip select active low
BITS_PER_WORD: Final = 8


def read_bufsiz() -> int:
    """Largest message that spidev accepts, in bytes."""
    try:
        return int(BUFSIZ.read_text())
    except (OSError, ValueError):
        return BUFSIZ_DEFAULT


def open_device(device: str, sck_hz: int) -> tuple[spidev.SpiDev, int]:
    """Open a device exclusively; returns it with the SCK in Hz that it is set to.

    Raises LinkError if it is absent, in use, or does not take the settings.
    """
    spi = spidev.SpiDev()
    try:
        spi.open(*_bus_and_select(device))
    except OSError as error:
        raise LinkError(_why_not_open(device, error)) from error
    try:
        fcntl.flock(spi.fileno(), fcntl.LOCK_EX | fcntl.LOCK_NB)  # spidev itself does not refuse a second program
        spi.lsbfirst = spi.cshigh = spi.threewire = spi.loop = spi.no_cs = False
        spi.mode = MODE
        spi.bits_per_word = BITS_PER_WORD
        mode, bits = _read(spi, RD_MODE32, "=I"), _read(spi, RD_BITS_PER_WORD, "=B")
        if mode != MODE or bits != BITS_PER_WORD:
            raise LinkError(
                f"{device} stays in mode 0x{mode:X} with {bits} bits a word; the FPGA needs mode {MODE} with {BITS_PER_WORD}:"
                " look at the device tree's entry for it"
            )
        return spi, set_speed(spi, sck_hz)
    except BlockingIOError as error:
        spi.close()
        raise LinkError(f"{device} is in use by another haptic-panel: end it first") from error
    except OSError as error:
        spi.close()
        raise LinkError(f"{device} cannot be set to mode {MODE}, {BITS_PER_WORD} bits: {error.strerror}") from error
    except LinkError:
        spi.close()
        raise


def set_speed(spi: spidev.SpiDev, sck_hz: int) -> int:
    """Set SCK; returns what the kernel says that it is, in Hz. Raises OSError if the controller refuses it."""
    spi.max_speed_hz = sck_hz
    return _read(spi, RD_MAX_SPEED_HZ, "=I")


def _bus_and_select(device: str) -> tuple[int, int]:
    """Bus and chip select of a device, of which links may be given: python3-spidev 3.6, which is Debian's, opens no path."""
    path = os.path.realpath(device)
    if numbers := re.fullmatch(r"/dev/spidev(\d+)\.(\d+)", path):
        return int(numbers[1]), int(numbers[2])
    os.stat(path)  # noqa: PTH116 - not there: the same error as of an open
    raise LinkError(f"{device} is {path}, which is no device of spidev: give /dev/spidevB.C, or a link to it")


def _read(spi: spidev.SpiDev, request: int, layout: str) -> int:
    """Read one of spidev's settings from the kernel."""
    value: int = struct.unpack(layout, fcntl.ioctl(spi.fileno(), request, bytes(struct.calcsize(layout))))[0]
    return value


def _why_not_open(device: str, error: OSError) -> str:
    if error.errno in (errno.ENOENT, errno.ENXIO, errno.ENODEV):
        there = ", ".join(sorted(str(path) for path in Path("/dev").glob("spidev*"))) or "none"
        return f"there is no {device} (there are: {there}): switch SPI on, on a Raspberry Pi by dtparam=spi=on in config.txt"
    if error.errno in (errno.EACCES, errno.EPERM):
        return f"{device} may not be opened by this user: add it to the group that owns the device (on Debian: spi)"
    return f"{device} could not be opened: {error.strerror or error}"
