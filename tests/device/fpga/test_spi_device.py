"""Which device spidev is commanded to open: its versions from 3.6 on know only bus and chip select, no path."""

import errno
import time

import msgspec
import pytest
from tables import each_row

from controller.device.board.devices import LinkSettings
from controller.device.fpga.links import spi_device, spi_link
from controller.errors import LinkError

SETTINGS = LinkSettings(
    kind="spi", clock_hz=62_500_000, sck_hz=25_000_000, slots=4, device="/dev/null", gpio_chip="none", trigger_line="GPIO25"
)


class Opened(Exception):
    """What was opened."""


class SpiDev36:
    """What python3-spidev 3.6 opens devices by."""

    def open(self, bus, device):
        if (bus, device) == (7, 1):
            raise FileNotFoundError(errno.ENOENT, "No such file or directory")
        raise Opened(bus, device)


def opened(monkeypatch, device):
    """Bus and chip select for a device of board.toml."""
    monkeypatch.setattr(spi_device.spidev, "SpiDev", SpiDev36)
    with pytest.raises((Opened, LinkError)) as raised:
        spi_link.SpiLink(msgspec.structs.replace(SETTINGS, device=device), time.monotonic)
    return raised.value


def test_bus_and_chip_select_are_those_of_the_path(monkeypatch):
    assert opened(monkeypatch, "/dev/spidev0.0").args == (0, 0)
    assert opened(monkeypatch, "/dev/spidev10.2").args == (10, 2)


def test_a_link_to_a_device_is_followed(monkeypatch, tmp_path):
    (tmp_path / "fpga").symlink_to("/dev/spidev3.1")
    assert opened(monkeypatch, str(tmp_path / "fpga")).args == (3, 1)


@each_row("device", ["/dev/spidev7.1", "/dev/none"])
def test_a_device_that_is_not_there_is_one_line(monkeypatch, device):
    error = opened(monkeypatch, device)
    assert isinstance(error, LinkError)
    assert str(error).startswith(f"there is no {device} (there are: ")


def test_another_device_is_refused(monkeypatch):
    assert str(opened(monkeypatch, "/dev/null")) == (
        "/dev/null is /dev/null, which is no device of spidev: give /dev/spidevB.C, or a link to it"
    )


@pytest.mark.interpreted
def test_an_sck_beyond_the_boards_is_refused():
    link = object.__new__(spi_link.SpiLink)
    link._settings = SETTINGS
    for sck_hz in (-1, 0, 25_000_001):
        with pytest.raises(ValueError, match="is not 1 to the board's 25000000"):
            link.set_sck_hz(sck_hz)
