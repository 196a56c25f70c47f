"""A touch panel whose bus may hang, read by a process of its own: what hangs there costs touches, never a heartbeat.

A transfer of a report takes 1 ms of the bus, and an adapter that hangs up to a second, which no call to the kernel can
bound for all adapters; the loop waits for neither.
"""

from __future__ import annotations

import math
import select
import socket
import time
from collections import Counter
from collections.abc import Callable, Sequence
from typing import Final

from controller.board.worker import Worker
from controller.errors import TouchError
from controller.touch import panel_messages as messages
from controller.touch.awaited_reader import LOST, RETRY_S, UNSEEN
from controller.touch.event_reader import DeviceDescription, Event, EventReader

HANGS_S: Final = 5.0  # without a first word


class PanelProcess:
    """The loop's end; an `EventReader` of a panel that may be absent.

    Parameters
    ----------
    worker : Worker
        Runs `serve_panel`.

    Attributes
    ----------
    warnings : Counter of str
        Of the driver.
    description : DeviceDescription
        Of the device as it was opened last; `UNSEEN` before.
    present : bool
        Whether the panel was there when its process said so last.
    cause : str
        Why it is not; empty while it is, and before it was looked for.
    """

    def __init__(self, worker: Worker) -> None:
        self.warnings: Counter[str] = Counter()
        self.description: DeviceDescription = UNSEEN
        self.present = False
        self.cause = ""
        self._worker = worker
        self._silent_s = math.inf  # when it is taken to hang before it has said anything

    def fileno(self) -> int:
        """The way from its process."""
        return self._worker.fileno()

    def next_time_s(self) -> None:
        """Never: what is due is said."""

    def read(self, now_s: float) -> Sequence[Event]:
        """Events of at most one report; see `EventReader.read`.

        Raises
        ------
        WorkerEnded
            If its process has ended: no panel does that.
        """
        message = self._worker.receive()
        if message is None:
            if self.description is UNSEEN and not self.cause:
                self._silent_s = min(self._silent_s, now_s + HANGS_S)
                if now_s >= self._silent_s:
                    self.cause = "what reads it says nothing: its bus hangs"
            return ()
        kind, body = message[0], message[1:]
        if kind == messages.EVENTS:
            return messages.events_of(body)
        if kind == messages.DESCRIPTION:
            self.description = messages.description_of(body)
        elif kind == messages.PRESENT:
            self.present, self.cause = True, ""
        elif kind == messages.ABSENT:
            self.present, self.cause = False, bytes(body).decode(errors="replace")
        elif kind == messages.WARNINGS:
            self.warnings = Counter(messages.warnings_of(body))
        return ()

    def close(self) -> None:
        """End its process."""
        self._worker.close()


def serve_panel(open_reader: Callable[[], EventReader], loop: socket.socket) -> None:
    """Read a panel, and tell the loop, for as long as there is one.

    Parameters
    ----------
    open_reader : callable
        Makes the driver, or raises TouchError; it may block.
    loop : socket
        The other end of `Worker`.
    """
    poll = select.poll()
    poll.register(loop, select.POLLIN)
    while True:
        try:
            reader = open_reader()
            break
        except TouchError as error:
            loop.send(messages.presence_message(str(error)))
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
            loop.send(messages.description_message(description))
        if events:
            loop.send(messages.events_message(events))
        if reader.present is not present:
            present = reader.present
            loop.send(messages.presence_message(None if present else LOST))
        if reader.warnings != warnings:
            warnings = reader.warnings.copy()
            loop.send(messages.warnings_message(warnings))
        file = reader.fileno()
        if file != watched:
            if watched is not None:
                poll.unregister(watched)
            if file is not None:
                poll.register(file, select.POLLIN)
            watched = file
        next_s = reader.next_time_s()
        wait_ms = None if next_s is None else max(next_s - time.monotonic(), 0.0) * 1e3
        if any(fd == loop.fileno() for fd, _ in poll.poll(wait_ms)):
            reader.close()
            return
