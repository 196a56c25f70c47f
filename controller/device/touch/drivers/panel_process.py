"""A touch panel read by a process of its own, so that a bus that hangs delays touches and never a heartbeat.

Reading a report takes 1 ms of an I2C bus, and a bus that hangs blocks for up to a second, which no system call can limit on
all adapters. The process sends messages of one letter and a body over a socket of the kind SOCK_SEQPACKET.
"""

from __future__ import annotations

import math
import select
import socket
import struct
import time
from collections import Counter
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, Final

import msgspec

from controller.device.board.worker import Worker
from controller.device.touch.drivers.awaited_reader import LOST, NO_DEVICE, RETRY_S
from controller.device.touch.event_reader import DeviceDescription, Event, EventReader
from controller.errors import TouchError

if TYPE_CHECKING:
    from controller.device.touch.drivers.shared_panel import SharedPanel

HANG_S: Final = 5.0  # without any message after the start

# Messages
EVENTS: Final = ord("E")  # of one report
DESCRIPTION: Final = ord("D")  # of the device that has been opened
PRESENT: Final = ord("P")
ABSENT: Final = ord("A")  # with the cause
WARNINGS: Final = ord("W")  # all so far, by kind
EVENT: Final = struct.Struct("=HHid")
MAX_CAUSE_BYTES: Final = 1024


class PanelSettings(msgspec.Struct):
    """What the process is given: the table [touch], and the sides of the plate that its axes map to."""

    touch: Any
    length_m: float
    width_m: float


_descriptions = msgspec.json.Decoder(DeviceDescription)
_warnings = msgspec.json.Decoder(dict[str, int])


def events_message(events: Sequence[Event]) -> bytes:
    """Message with the `events` of one report."""
    return bytes([EVENTS]) + b"".join([EVENT.pack(*event) for event in events])


def events_of(body: memoryview) -> list[Event]:
    """Events of the `body` of an `EVENTS` message."""
    return list(EVENT.iter_unpack(body))


def presence_message(cause: str | None) -> bytes:
    """Message that the panel is connected (`cause` None), or why it is not."""
    return bytes([PRESENT]) if cause is None else bytes([ABSENT]) + cause.encode(errors="replace")[:MAX_CAUSE_BYTES]


class PanelProcess:
    """The loop's end: an `EventReader` of a panel that may be absent; `worker` runs `serve_panel`."""

    def __init__(self, worker: Worker) -> None:
        self.warnings: Counter[str] = Counter()  # anomalies found by the driver, by kind
        self.description: DeviceDescription = NO_DEVICE  # of the device as it was opened last; `NO_DEVICE` before
        self.present = False  # whether the panel was connected when the process last reported it
        self.cause = ""  # why it is not connected; empty while it is, and before the first attempt to open it
        self._worker = worker
        self.fileno, self.close = worker.fileno, worker.close
        self._hangs_s = math.inf  # when the process is taken to hang unless it has sent a message

    def next_time_s(self) -> None:
        """None: the process sends a message when something is due."""

    def read(self, now_s: float) -> Sequence[Event]:
        """Events of at most one report received by `now_s`; see `EventReader.read`.

        Raises WorkerEnded if the process has ended: no behaviour of a panel ends it.
        """
        message = self._worker.receive()
        if message is None:
            if self.description is NO_DEVICE and not self.cause:
                self._hangs_s = min(self._hangs_s, now_s + HANG_S)
                if now_s >= self._hangs_s:
                    self.cause = "the process that reads it does not answer: its bus hangs"
            return ()
        kind, body = message[0], message[1:]
        if kind == EVENTS:
            return events_of(body)
        if kind == DESCRIPTION:
            self.description = _descriptions.decode(body)  # another object each time
        elif kind == PRESENT:
            self.present, self.cause = True, ""
        elif kind == ABSENT:
            self.present, self.cause = False, bytes(body).decode(errors="replace")
        elif kind == WARNINGS:
            self.warnings = Counter(_warnings.decode(body))
        return ()


def serve_panel(open_reader: Callable[[], EventReader], loop: socket.socket, shared: SharedPanel | None = None) -> None:
    """Read a panel and send what it reports, until the loop closes its end.

    `open_reader` opens the driver, or raises TouchError; it may block. `loop` is the other end of `Worker`. `shared` hands the
    contacts on to other programs, once the loop has them.
    """
    try:
        _serve(open_reader, loop, shared)
    finally:
        if shared is not None:
            shared.close()


def _serve(open_reader: Callable[[], EventReader], loop: socket.socket, shared: SharedPanel | None) -> None:
    poll = select.poll()
    poll.register(loop, select.POLLIN)
    while True:
        try:
            reader = open_reader()
            break
        except TouchError as error:
            loop.send(presence_message(str(error)))
        if poll.poll(RETRY_S * 1e3):
            return
    present: bool | None = None
    description: DeviceDescription | None = None
    warnings: Counter[str] = Counter()
    watched: int | None = None
    while True:
        events = reader.read(time.monotonic())
        if reader.present and reader.description is not description:
            description = reader.description
            reported = description if shared is None else shared.follow(description)
            loop.send(bytes([DESCRIPTION]) + msgspec.json.encode(reported))
        if events:
            loop.send(events_message(events))
        if reader.present is not present:
            present = reader.present
            loop.send(presence_message(None if present else LOST))
        if shared is not None:
            shared.hand_on(events, time.monotonic())
        found = reader.warnings if shared is None else reader.warnings + shared.warnings
        if found != warnings:
            warnings = found.copy()
            loop.send(bytes([WARNINGS]) + msgspec.json.encode(warnings))
        file = reader.fileno()
        if file != watched:
            if watched is not None:
                poll.unregister(watched)
            if file is not None:
                poll.register(file, select.POLLIN)
            watched = file
        due_s = (reader.next_time_s(), None if shared is None else shared.next_time_s())
        next_s = min((at_s for at_s in due_s if at_s is not None), default=None)
        wait_ms = None if next_s is None else max(next_s - time.monotonic(), 0.0) * 1e3
        if any(fd == loop.fileno() for fd, _ in poll.poll(wait_ms)):
            reader.close()
            return
