"""Touch panels on a serial port: Elo SmartSet, 10-byte packets (Elo "SmartSet Touchscreen Controllers Technical Reference").

A packet is 'U', a letter, seven bytes and a checksum. Touch packets are 'T': status, x, y and z, low byte first. The
controller sends one when a finger is put down (status bit 0), a stream of them while it stays (bit 1) and one when it is
lifted (bit 2).
"""

from __future__ import annotations

import contextlib
import errno
import os
import select
from collections import Counter
from collections.abc import Sequence
from typing import TYPE_CHECKING, Final

from controller.device.board.touch_panels import SerialTouch
from controller.device.touch import event_codes as ev
from controller.device.touch.event_reader import AxisInfo, DeviceDescription, Event
from controller.errors import TouchError

if TYPE_CHECKING:
    import serial

PACKET_BYTES: Final = 10
LEAD: Final = ord("U")
TOUCH: Final = ord("T")
CHECKSUM_SEED: Final = 0xAA
TOUCHED: Final = 0x03  # bits of status: initial touch, stream
MAX_COORDINATE: Final = 4095

RETRY_S: Final = 0.5  # between attempts to open a lost port
STUCK_TIMEOUT_S: Final = 0.5  # without a packet of the stream: the packet of the release must have been lost
READ_BYTES: Final = 64  # with one call
STRANGE_BYTES: Final = 100  # without a packet among them: another baud rate, or another protocol


class EloTouch(SerialTouch, frozen=True, kw_only=True, tag_field="kind", tag="serial_panel"):
    """A touch panel with the Elo SmartSet protocol on a serial port."""


class SmartSetParser:
    """Finds packets in a stream of bytes; after invalid bytes it synchronises with the next valid packet."""

    def __init__(self) -> None:
        self.skipped_bytes = 0  # bytes so far that belong to no packet
        self._buffer = bytearray()

    def feed(self, data: bytes) -> None:
        """Append `data` from the port."""
        self._buffer += data

    def next_packet(self) -> bytes | None:
        """Remove and return the next packet with a valid checksum; None if there is none yet."""
        buffer = self._buffer
        self._skip_to(buffer.find(LEAD))
        while len(buffer) >= PACKET_BYTES:
            if (CHECKSUM_SEED + sum(buffer[: PACKET_BYTES - 1])) & 0xFF == buffer[PACKET_BYTES - 1]:
                packet = bytes(buffer[:PACKET_BYTES])
                del buffer[:PACKET_BYTES]
                return packet
            self._skip_to(buffer.find(LEAD, 1))  # a packet may begin inside the invalid one
        return None

    def _skip_to(self, start: int) -> None:
        """Discard the bytes before `start`; all if it is negative."""
        start = len(self._buffer) if start < 0 else start
        self.skipped_bytes += start
        del self._buffer[:start]


class SerialPanel:
    """An `EventReader` of a SmartSet panel: one finger, by BTN_TOUCH, ABS_X and ABS_Y.

    Raises TouchError if the port cannot be opened.
    """

    def __init__(self, settings: EloTouch) -> None:
        self.warnings: Counter[str] = Counter()
        self._settings = settings
        self._parser = SmartSetParser()
        self._poll = select.poll()
        self._port: serial.Serial | None = None
        self._touched = False
        self._packet_s = 0.0
        self._strange = 0  # bytes since the last packet that belong to none
        self._next_s = 0.0
        try:
            self._open()
        except (OSError, ValueError) as error:
            raise TouchError(_open_error(settings, error)) from error

    @property
    def present(self) -> bool:
        """Whether the port is open; only packets show that a panel is connected to it."""
        return self._port is not None

    def fileno(self) -> int | None:
        """File of the port; None while it is closed."""
        return self._port.fileno() if self._port else None

    def next_time_s(self) -> float | None:
        """At once while packets are buffered; when a silent stream ends a touch; while the port is lost, when to open it again."""
        if self._port is None or self._more:
            return self._next_s if self._port is None else 0.0
        return self._packet_s + STUCK_TIMEOUT_S if self._touched else None

    def read(self, now_s: float) -> Sequence[Event]:
        """Events of at most one packet by `now_s`; see `EventReader.read`."""
        if self._port is None:
            if now_s >= self._next_s:
                self._next_s = now_s + RETRY_S
                with contextlib.suppress(OSError, ValueError):
                    self._open()
            return ()
        skipped = self._parser.skipped_bytes
        packet = self._parser.next_packet()
        if packet is None and not self._fill():
            return self._lost(now_s)
        packet = packet or self._parser.next_packet()
        if self._parser.skipped_bytes != skipped:
            self._count_skipped(self._parser.skipped_bytes - skipped)
        if packet is not None:
            self._strange = 0
        self._more = packet is not None
        if packet is not None and packet[1] == TOUCH:
            self._packet_s = now_s
            return self._events(packet, now_s)
        if packet is None and self._touched and now_s >= self._packet_s + STUCK_TIMEOUT_S:
            self.warnings["contact_stuck"] += 1
            return self._lifted(now_s)
        return ()

    def close(self) -> None:
        """Close the port."""
        if self._port:
            with contextlib.suppress(OSError, KeyError):
                self._poll.unregister(self._port.fileno())
            with contextlib.suppress(OSError):
                self._port.close()
            self._port = None

    def _open(self) -> None:
        import serial

        self._port = serial.Serial(self._settings.device, self._settings.baud, timeout=0, exclusive=True)
        self._poll.register(self._port.fileno(), select.POLLIN)
        self._parser = SmartSetParser()
        self._more = False
        self._strange = 0
        codes = {ev.EV_SYN: (ev.EV_SYN, ev.EV_KEY, ev.EV_ABS), ev.EV_KEY: (ev.BTN_TOUCH,), ev.EV_ABS: ev.POSITIONS_SINGLE}
        axes = dict.fromkeys(ev.POSITIONS_SINGLE, AxisInfo(0, MAX_COORDINATE))
        self.description = DeviceDescription(
            "Elo SmartSet", ev.BUS_RS232, properties=(ev.INPUT_PROP_DIRECT,), codes=codes, axes=axes
        )

    def _count_skipped(self, number: int) -> None:
        """Count bytes that belong to no packet, and once each time that nothing else comes."""
        self.warnings["bytes_skipped"] += number
        before, self._strange = self._strange, self._strange + number
        if before < STRANGE_BYTES <= self._strange:
            self.warnings["no_packets"] += 1

    def _fill(self) -> bool:
        """Read the bytes that have arrived; False if the port is lost."""
        assert self._port is not None
        try:
            for _, happened in self._poll.poll(0):
                if not happened & select.POLLIN:
                    return False  # hung up
                data = os.read(self._port.fileno(), READ_BYTES)
                self._parser.feed(data)
                return bool(data)
        except BlockingIOError:
            return True
        except OSError:
            return False
        return True

    def _events(self, packet: bytes, now_s: float) -> Sequence[Event]:
        if not packet[2] & TOUCHED:
            return self._lifted(now_s) if self._touched else ()
        self._touched = True
        return (
            (ev.EV_ABS, ev.ABS_X, packet[3] | packet[4] << 8, now_s),
            (ev.EV_ABS, ev.ABS_Y, packet[5] | packet[6] << 8, now_s),
            (ev.EV_KEY, ev.BTN_TOUCH, 1, now_s),
            (ev.EV_SYN, ev.SYN_REPORT, 0, now_s),
        )

    def _lifted(self, now_s: float) -> Sequence[Event]:
        self._touched = False
        return ((ev.EV_KEY, ev.BTN_TOUCH, 0, now_s), (ev.EV_SYN, ev.SYN_REPORT, 0, now_s))

    def _lost(self, now_s: float) -> Sequence[Event]:
        self.warnings["panel_lost"] += 1
        self.close()
        self._next_s = now_s + RETRY_S
        return self._lifted(now_s) if self._touched else ()


def _open_error(settings: EloTouch, error: Exception) -> str:
    device = settings.device
    number = getattr(error, "errno", None)
    if number in (errno.ENOENT, errno.ENXIO, errno.ENODEV, errno.EIO):
        return f"there is no serial port {device}: is the touch panel plugged in? Its name is below /dev/serial/by-id"
    if number in (errno.EACCES, errno.EPERM):
        return f"{device} may not be opened by this user: add it to the group that owns the device (on Debian: dialout)"
    if number in (errno.EBUSY, errno.EAGAIN):
        return f"{device} is in use by another program: end it first"
    return f"{device} could not be opened at {settings.baud} baud: {error}"


def open_panel(settings: EloTouch) -> SerialPanel:
    """Open the panel of a board with these `settings`; raises TouchError if the port cannot be opened."""
    return SerialPanel(settings)
