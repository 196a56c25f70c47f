"""A GT911 on a simulated bus, in virtual time: the driver is the device's own, its far end is built from the programming guide.

The chip scans for fingers at a fixed rate, keeps one report until the host has cleared it, and announces it by its interrupt line,
unless that is dead.
"""

import ctypes
import errno
import os
from collections import Counter
from collections.abc import Callable, Sequence
from typing import Any, Final, cast

import numpy as np
from gpiod.line import Edge

from controller.device.board.board import Board
from controller.device.touch.drivers.i2c_bus import I2cBus
from controller.device.touch.drivers.i2c_reader import I2cReader
from controller.device.touch.drivers.panel_lines import PanelLines
from controller.device.touch.event_reader import DeviceDescription, Event
from controller.device.touch.panels.gt911 import CONFIG, PRODUCT_ID, READY, STATUS, Gt911, Gt911Touch
from controller.workshop.simulation.ghostly_panel import Finger, finger_places

READ: Final = 0x0001  # I2C_M_RD
UNITS: Final = (4096, 4096)  # largest position along its axes
SCAN_S: Final = 10e-3
SIZE: Final = 20  # of a contact
POINT_BYTES: Final = 8
CONFIGURATION: Final = bytes([0x41, *(byte for units in UNITS for byte in units.to_bytes(2, "little")), 5, 0x3D])  # falling edge


class SimulatedGt911:
    """`EventReader` of a GT911 that finds `fingers`; `watch` is called at each scan, with its time."""

    def __init__(
        self, board: Board, fingers: Sequence[Finger], watch: Callable[[float], object], *, interrupt: bool, from_s: float
    ) -> None:
        assert isinstance(board.touch, Gt911Touch)
        self._chip = _Chip(board.touch.address)
        self._fingers, self._watch, self._interrupt = fingers, watch, interrupt
        self._board, self._scan_s = board, from_s
        self._lines = _Lines(board.touch)
        self.warnings: Counter[str] = Counter()
        self._reader = I2cReader(
            board.touch, Gt911(board.touch, self.warnings), self.warnings, (self._lines, _Bus(self._chip, self.warnings))
        )

    @property
    def description(self) -> DeviceDescription:
        """As in `EventReader`."""
        return self._reader.description

    @property
    def present(self) -> bool:
        """As in `EventReader`."""
        return self._reader.present

    def fileno(self) -> None:
        """None: in virtual time an edge wakes nobody, `next_time_s` does."""
        return

    def next_time_s(self) -> float | None:
        """The next scan, or when the driver reads without an edge."""
        read_s = self._reader.next_time_s()
        return self._scan_s if read_s is None else min(read_s, self._scan_s)

    def read(self, now_s: float) -> Sequence[Event]:
        """Scan, if that is due, and let the driver read."""
        if now_s >= self._scan_s:
            at_s, self._scan_s = self._scan_s, self._scan_s + SCAN_S
            self._watch(at_s)
            if self._chip.scanned(self._contacts(at_s)) and self._interrupt:
                self._lines.edge_s = at_s
        return self._reader.read(now_s)

    def close(self) -> None:
        """As in `EventReader`."""
        self._reader.close()

    def _contacts(self, at_s: float) -> list[tuple[int, int]]:
        """Where fingers are, on the panel's axes."""
        touch = self._board.touch
        by_axes = np.array([touch.x_mm_from_axes[:2], touch.y_mm_from_axes[:2]])
        corner_mm = np.array([touch.x_mm_from_axes[2], touch.y_mm_from_axes[2]])
        on_axes = [np.linalg.solve(by_axes, np.array(place) - corner_mm) for place in finger_places(self._fingers, at_s).values()]
        return [(round(float(x) * UNITS[0]), round(float(y) * UNITS[1])) for x, y in on_axes]


class _Chip:
    """Registers of the chip, in the place of the kernel's adapter."""

    def __init__(self, address: int) -> None:
        self._address, self._pointer, self._touched = address, 0, False
        self._registers = bytearray(1 << 16)
        for register, content in ((CONFIG, CONFIGURATION), (PRODUCT_ID, b"911\0\x60\x10")):
            start = int.from_bytes(register, "big")
            self._registers[start : start + len(content)] = content

    def scanned(self, contacts: Sequence[tuple[int, int]]) -> bool:
        """One scan found these; whether there is a report of them, which there is not while the last one was not cleared."""
        status = int.from_bytes(STATUS, "big")
        was, self._touched = self._touched, bool(contacts)
        if self._registers[status] & READY or not (contacts or was):
            return False
        points = [bytes([number, *_two(x), *_two(y), *_two(SIZE), 0]) for number, (x, y) in enumerate(contacts)]
        self._registers[status + 1 : status + 1 + POINT_BYTES * len(points)] = b"".join(points)
        self._registers[status] = READY | len(points)
        return True

    def i2c_rdwr(self, *messages: Any) -> None:
        """As in smbus2."""
        for message in messages:
            if message.addr != self._address:
                raise OSError(errno.EREMOTEIO, os.strerror(errno.EREMOTEIO))
            if message.flags & READ:
                ctypes.memmove(message.buf, bytes(self._registers[self._pointer : self._pointer + message.len]), message.len)
            else:
                content = bytes(message)
                self._pointer = int.from_bytes(content[:2], "big")
                self._registers[self._pointer : self._pointer + len(content) - 2] = content[2:]

    def close(self) -> None:
        """Nothing is open."""


class _Bus(I2cBus):
    """The driver's bus, with the chip at its end."""

    def __init__(self, chip: _Chip, warnings: Counter[str]) -> None:
        self._bus, self._warnings = cast(Any, chip), warnings


class _Lines(PanelLines):
    """Interrupt line that rests high, without a GPIO chip."""

    def __init__(self, touch: Gt911Touch) -> None:
        super().__init__("", "")
        self.has_interrupt = bool(touch.interrupt_line)
        self.edge_s: float | None = None  # of the last edge that was not read

    def listen(self, edge: Edge) -> None:
        """The driver listens always."""

    def interrupt_high(self) -> bool | None:
        """It rests high; None: there is none."""
        return True if self.has_interrupt else None

    def read_edges(self) -> float | None:
        """As in `PanelLines`."""
        edge_s, self.edge_s = self.edge_s, None
        if edge_s is None or not self.has_interrupt:
            return None
        self.edges += 1
        return edge_s


def _two(value: int) -> bytes:
    return value.to_bytes(2, "little")
