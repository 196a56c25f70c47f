"""A GT911 read by a process of its own: the driver, its process's end, and a bus that hangs when it is commanded to.

usage: python gt911_process.py CONTROL     lines of this FIFO: "touch X Y", "lift", "hang": no transfer ends before "go"
"""

import os
import select
import socket
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))

import smbus2.smbus2
from peers import adapter
from peers.gt911_chip import Gt911Chip

from controller.device.touch.drivers import i2c_bus, panel_lines
from controller.device.touch.drivers.panel_process import serve_panel
from controller.device.touch.panels.gt911 import Gt911Touch, open_panel


class Control:
    """What the test says; each contact makes an edge of the interrupt line."""

    def __init__(self, path, chip):
        self.fd = os.open(path, os.O_RDONLY)
        self.chip = chip
        self.hangs = False
        self.lines = []

    def waits(self):
        """Whether there is a contact: done."""
        if not self.lines and select.select([self.fd], [], [], 0)[0]:
            self.read()
        while self.lines:
            what, *place = self.lines.pop(0).split()
            if what == b"hang":
                self.hangs = True
            else:
                self.chip.touch({0: tuple(map(int, place))} if what == b"touch" else {})
                return True
        return False

    def until_go(self):
        """Hang."""
        self.hangs = False
        while b"go" not in self.lines:
            self.read()
        self.lines.remove(b"go")

    def read(self):
        """A write is whole lines, and read whole."""
        said = os.read(self.fd, 4096)
        if not said:
            sys.exit()
        self.lines += said.splitlines()


def main():
    chip = Gt911Chip(width=2100, height=1480)
    control = Control(sys.argv[1], chip)
    lines = adapter.Lines(chip, lambda: 0.0)
    bus = adapter.Adapter(chip)

    def ioctl(*request):
        if control.hangs:
            control.until_go()
        return bus.ioctl(*request)

    class Input(adapter._Input):
        """Readable as the FIFO is."""

        def __init__(self, *settings):
            super().__init__(*settings)
            self.fd = control.fd

        def wait_edge_events(self, _timeout):
            if control.waits():
                lines.pulse()
            return super().wait_edge_events(0)

    adapter._Input = Input
    smbus2.smbus2.ioctl = i2c_bus.fcntl.ioctl = ioctl
    panel_lines.gpiod = lines
    panel_lines.find_chip = lambda *_: "/dev/gpiochip0"
    axes_mm = {"x_mm_from_axes": (210.0, 0.0, 0.0), "y_mm_from_axes": (0.0, 148.0, 0.0)}
    settings = Gt911Touch(bus=sys.argv[1] + ".bus", interrupt_chip="panel", interrupt_line="INT", **axes_mm)
    with socket.socket(fileno=sys.stdin.fileno()) as loop:
        serve_panel(lambda: open_panel(settings), loop)


main()
