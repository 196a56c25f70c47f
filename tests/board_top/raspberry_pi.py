"""A Raspberry Pi at the header of the compiled board, up to its system calls: what spidev, flock, ioctl and gpiod do there.

All of SpiLink is the product's own; time is the board's.
"""

import contextlib
import ctypes
import errno
import fcntl
import os
import struct
from pathlib import Path
from types import SimpleNamespace

from compiled_top import CompiledTop, files, signal_pins
from gpiod.line import Direction, Value

from controller.device.board import gpio_chip
from controller.device.fpga.links import gpio_lines, spi_device, spi_link
from controller.device.fpga.links.spi_messages import TRANSFER, message_request

CHIP = "pinctrl-bcm2711"
BUS = "/dev/spidev0.0"
SOURCE_HZ = 500_000_000
SPI = ("GPIO11", "GPIO8", "GPIO10", "GPIO9")  # SCLK, CE0, MOSI, MISO
BETWEEN_FRAMES_PS = 10_000_000  # the kernel's pause, spi.c
CALL_PS = 1_000_000  # that a system call on a line takes


class RaspberryPi:
    """Installed by `install`; the temperature switch at the board is closed."""

    def __init__(self, folder, name="ulx3s", library=None):
        self.name = name
        self.files = files(name)
        self.wires = self.files.wires
        self.board = CompiledTop(name, library)
        self.answers = []  # of all frames
        self.board.drive(signal_pins()["temperature good"], 1)
        self.board.drive(self.wires["GPIO8"], 1)  # the controller's chip select at rest
        self._device = folder / "spidev0.0"
        self._device.touch()
        (folder / "gpiochip0").touch()
        self._folder = folder
        self.damage = lambda frame: frame  # on its way to the FPGA
        self.now_s = lambda: self.board.now_s

    def install(self, patch):
        """Take the place of the machine's interfaces."""
        patch.setattr(gpio_chip, "DEVICES", self._folder)
        patch.setattr(gpio_chip.gpiod, "Chip", lambda path: Chip(self, path))
        patch.setattr(spi_device.spidev, "SpiDev", lambda: SpiDev(self._device))
        system = {name: getattr(fcntl, name) for name in ("flock", "LOCK_EX", "LOCK_NB")}
        for module in (spi_device, spi_link):
            patch.setattr(module, "fcntl", SimpleNamespace(ioctl=self._ioctl, **system))
        patch.setattr(gpio_lines, "fcntl", SimpleNamespace(ioctl=Request.ioctl))

    def _ioctl(self, fd, request, argument):
        if request in SpiDev.READ:
            name, layout = SpiDev.READ[request]
            return struct.pack(layout, getattr(SpiDev.opened[fd], name))
        transfers = list(TRANSFER.iter_unpack(argument))
        assert request == message_request(len(transfers))
        for number, (sent, received, length, _, _, _, release, *_) in enumerate(transfers):
            assert bool(release) == (number < len(transfers) - 1), "each frame under its own chip select"
            self._transfer(SpiDev.opened[fd], sent, received, length)
        return 0

    def _transfer(self, spi, sent, received, length):
        divider = -(-SOURCE_HZ // spi.max_speed_hz)
        frame = self.damage(ctypes.string_at(sent, length))
        answer = self.board.exchange([self.wires[name] for name in SPI], frame, SOURCE_HZ / (divider + divider % 2))
        ctypes.memmove(received, answer, length)
        self.answers.append(answer)
        self.board.run(BETWEEN_FRAMES_PS)


class SpiDev:
    """The extension module's object, with what version 3.6 has of it."""

    READ = {  # noqa: RUF012
        spi_device.RD_MODE32: ("mode", "=I"),
        spi_device.RD_BITS_PER_WORD: ("bits_per_word", "=B"),
        spi_device.RD_MAX_SPEED_HZ: ("max_speed_hz", "=I"),
    }
    opened = {}  # noqa: RUF012

    def __init__(self, device):
        self._device = device
        self._fd = -1
        self.mode, self.bits_per_word, self.max_speed_hz = 0, 8, 500_000
        self.lsbfirst = self.cshigh = self.threewire = self.loop = self.no_cs = False

    def open(self, bus, device):
        if f"/dev/spidev{bus}.{device}" != BUS:
            raise FileNotFoundError(errno.ENOENT, "No such file or directory")
        self._fd = os.open(self._device, os.O_RDWR)
        self.opened[self._fd] = self

    def fileno(self):
        return self._fd

    def close(self):
        if self._fd >= 0:
            del self.opened[self._fd]
            os.close(self._fd)
            self._fd = -1


class Chip(contextlib.nullcontext):
    """The Pi's GPIO chip, of whose lines only those with a wire do anything."""

    def __init__(self, pi, path):
        super().__init__(self)
        assert Path(path).name == "gpiochip0"
        self._pi = pi

    def get_info(self):
        return SimpleNamespace(label=CHIP, num_lines=28)

    def get_line_info(self, line):
        names = [f"GPIO{number}" for number in range(28)]
        name = names[line] if isinstance(line, int) else line
        if name not in names:
            raise OSError(errno.ENOENT, "No such file or directory")
        return SimpleNamespace(name=name, used=False, consumer="")

    def request_lines(self, config, **_):
        return Request(self._pi, config)


def name_of(line):
    """Name of a line that is given by its name or its number, as libgpiod takes both."""
    return f"GPIO{line}" if isinstance(line, int) else line


class Request:
    """Lines held: outputs drive their wires until they are released."""

    held = {}  # noqa: RUF012 -- by file number

    def __init__(self, pi, config):
        self._board, self._wires = pi.board, pi.wires
        self.offsets = [int(name_of(line).removeprefix("GPIO")) for line in config]
        config = {name_of(line): settings for line, settings in config.items()}
        self.lines = list(config)
        self.fd = os.open(os.devnull, os.O_RDWR)
        self.held[self.fd] = self
        self._outputs = {name for name, line in config.items() if line.direction == Direction.OUTPUT}
        for name in self._outputs:
            self.set_value(name, config[name].output_value)

    def set_value(self, line, value):
        name = name_of(line)
        assert name in self._outputs
        self._board.drive(self._wires[name], value == Value.ACTIVE)
        self._board.run(CALL_PS)

    def get_value(self, line):
        name = name_of(line)
        assert name not in self._outputs
        self._board.run(CALL_PS)
        return Value.ACTIVE if self._board.high(self._wires[name]) else Value.INACTIVE

    @classmethod
    def ioctl(cls, fd, request, argument):
        """The kernel's call that sets lines, by their bits in the order in which they were requested."""
        assert request == gpio_lines.SET_VALUES
        values, which = gpio_lines.LINE_VALUES.unpack(argument)
        lines = cls.held[fd].lines
        assert 0 < which < 1 << len(lines)
        for bit, name in enumerate(lines):
            if which >> bit & 1:
                cls.held[fd].set_value(name, Value.ACTIVE if values >> bit & 1 else Value.INACTIVE)
        return 0

    def release(self):
        for name in self._outputs:
            self._board.drive(self._wires[name], None)
        del self.held[self.fd]
        os.close(self.fd)
