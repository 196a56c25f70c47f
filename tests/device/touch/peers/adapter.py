"""The far ends of an I2C bus and of GPIO lines, in the process under test: at the ioctl of smbus2, and in the place of gpiod.

The bytes that the driver sends and gets are the kernel's own structures; time does not pass by itself.
"""

import ctypes
import errno
import os
from types import SimpleNamespace

import smbus2
from gpiod.line import Direction, Edge, Value
from peers.i2c_chip import READ, BusHangs, NotAcknowledged

I2C_TIMEOUT, I2C_FUNCS, I2C_RDWR = 0x0702, 0x0705, 0x0707
PLAIN = int(smbus2.I2cFunc.I2C)
NAMES = ("INT", "RST", "", "NC", "NC")  # of the lines of the GPIO chip, by their numbers


class Adapter:
    """An adapter with one chip behind it, whose pins are on `lines`.

    `functions`: what I2C_FUNCS says.
    """

    def __init__(self, chip, functions=PLAIN):
        self.chip = chip
        self.functions = functions
        self.timeout_10ms = 100
        self.transfers = 0

    def ioctl(self, _fd, request, argument):
        """What the kernel does for i2c-dev."""
        if request == I2C_FUNCS:
            argument.value = self.functions
            return 0
        if request == I2C_TIMEOUT:
            self.timeout_10ms = argument
            return 0
        assert request == I2C_RDWR
        messages = argument.msgs[: argument.nmsgs]
        self.transfers += 1
        try:
            read = self.chip.transfer(
                [(m.addr, m.flags, m.len if m.flags & READ else ctypes.string_at(m.buf, m.len)) for m in messages]
            )
        except NotAcknowledged:
            raise OSError(errno.EREMOTEIO, os.strerror(errno.EREMOTEIO)) from None
        except BusHangs:
            raise OSError(errno.ETIMEDOUT, os.strerror(errno.ETIMEDOUT)) from None
        for message in messages:
            if message.flags & READ:
                ctypes.memmove(message.buf, read[: message.len], message.len)
                read = read[message.len :]
        return len(messages)


class Lines:
    """INT and RST of a chip; `request_lines`, `Chip` and `LineSettings` as `gpiod` has them.

    A line that nobody drives is pulled up, but an interrupt line whose chip signals by rising edges down. `driven`: name to level;
    `listening`: the edge that is waited for. `cut`: no edge comes; `held`: the level that the interrupt line has for ever.
    """

    LineSettings = SimpleNamespace

    def __init__(self, chip, now_s):
        self.chip = chip
        self.now_s = now_s
        self.driven = {}
        self.listening = None
        self.edges = []
        self.cut = False
        self.held = None
        self.history = []  # (time, name, level) that the host drove

    def pulse(self, edges=1):
        """The chip pulls its interrupt pin away from rest and back: one edge of either kind, if the host listens."""
        if self.listening is not None and not self.cut:
            self.edges += [self.now_s()] * edges

    def level(self, name):
        return self.driven.get(name, True)

    def request_lines(self, path, consumer, config):
        assert (path, consumer) == ("/dev/gpiochip0", "haptic-panel touch")
        ((number, settings),) = config.items()
        name = NAMES[number]
        if settings.direction is Direction.OUTPUT:
            return _Output(self, name, settings.output_value)
        assert name == "INT"
        assert settings.edge_detection in (Edge.RISING, Edge.FALLING)
        return _Input(self, settings.edge_detection)

    def drive(self, name, level):
        """Somebody drives a line, or lets it go (None)."""
        if level is None:
            del self.driven[name]
        else:
            self.driven[name] = level
            self.history.append((self.now_s(), name, level))
        if hasattr(self.chip, "pins"):
            self.chip.pins(reset=self.level("RST"), interrupt=self.level("INT"))

    def Chip(self, path):  # noqa: N802
        assert path == "/dev/gpiochip0"
        return _Chip()


class _Chip:
    def __enter__(self):
        return self

    def __exit__(self, *error):
        pass

    def get_info(self):
        return SimpleNamespace(num_lines=len(NAMES))

    def get_line_info(self, number):
        return SimpleNamespace(name=NAMES[number])


class _Output:
    def __init__(self, lines, name, value):
        assert name not in lines.driven
        self._lines, self._name = lines, name
        lines.drive(name, value is Value.ACTIVE)

    def set_value(self, number, value):
        self._lines.drive(NAMES[number], value is Value.ACTIVE)

    def release(self):
        self._lines.drive(self._name, None)


class _Input:
    def __init__(self, lines, edge):
        assert "INT" not in lines.driven
        assert lines.listening is None
        self._lines = lines
        self.fd = 1000
        lines.listening, lines.edges = edge, []

    def get_value(self, number):
        assert NAMES[number] == "INT"
        rests_high = self._lines.listening is Edge.FALLING
        return Value.ACTIVE if (rests_high if self._lines.held is None else self._lines.held) else Value.INACTIVE

    def wait_edge_events(self, _timeout):
        return bool(self._lines.edges)

    def read_edge_events(self, most):
        events, self._lines.edges = self._lines.edges[:most], self._lines.edges[most:]
        return [SimpleNamespace(timestamp_ns=round(at_s * 1e9)) for at_s in events]

    def release(self):
        self._lines.listening = None
