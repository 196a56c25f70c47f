"""Log lines on standard error, written without blocking: a line that finds the log full is dropped and counted.

Where standard error is connected to the journal ($JOURNAL_STREAM, systemd.exec(5)), lines are sent by its own protocol
(systemd.io/JOURNAL_NATIVE_PROTOCOL), with their priority and, if they tell of an `Event`, its MESSAGE_ID; elsewhere they are text.
"""

from __future__ import annotations

import io
import os
import select
import socket
import sys
import time
from collections import deque
from enum import Enum, IntEnum
from pathlib import Path
from typing import Final, NamedTuple

JOURNAL: Final = Path("/run/systemd/journal/socket")
LAST_LINES: Final = 50  # kept, for those who ask later
MAX_LINE_BYTES = 2048  # a pipe that polls writable takes at least a page in one write


class Priority(IntEnum):
    """Priority of a line, as numbered by syslog(3)."""

    ERROR = 3
    WARNING = 4
    INFO = 6


class Event(Enum):
    """What a line of the log tells of: MESSAGE_ID, and priority. The catalogue (systemd/haptic-panel.catalog) explains each."""

    STARTED = "951af1c5c0fc407685ef3334bbc57a8b", Priority.INFO
    OUTPUTS_ON = "ba69b70d137d498680f6e688d15050d1", Priority.INFO
    OUTPUTS_OFF = "d622f8685a1141c9913bdc2d7199936e", Priority.INFO
    FAULTED = "910f79b476ca4eca918f1e73bb7f1f68", Priority.WARNING
    NO_PERMIT = "f9c85debb3c84917bfaadefcba88d64c", Priority.WARNING
    WAITING_FOR_FPGA = "93380f541dfc47dd9eb5c764618f1126", Priority.WARNING
    WAITING_FOR_PANEL = "1441b107ffef44c0b09c284e47bf9a2f", Priority.WARNING
    PANEL_BACK = "566a7b4d6cb44465b45150328d70f7d1", Priority.INFO
    TOUCH_FAULT = "6b1d0e0f2f5c4e0f9a7f3b8d5c1e4a92", Priority.WARNING
    OFF_PLATE = "880fa3d675984deea21e9afe1ce6ffbe", Priority.WARNING
    OPERATED = "6e12038aec354c93a4a0ba4353ad18e5", Priority.INFO
    SCENE_LOADED = "55890fa4d677428e95360f2275169c57", Priority.INFO
    SCENE_REFUSED = "c3ed4c4d97354f0383ea0ead3a5a0fee", Priority.WARNING
    BANK_DAMAGED = "8642203292654d6cb50639ea091ae3dd", Priority.WARNING
    SENSOR_LOST = "c5beff7756f44984b3b55718e4334f8c", Priority.WARNING
    SENSOR_BACK = "34160c712e8f4496aa39b71b5a6712c7", Priority.INFO
    NOT_REALTIME = "67cbea14efe346768fc5c8a879caf6e8", Priority.WARNING
    SLOW_HOST = "fc13180b2b5242e2a31372155b690c9b", Priority.INFO
    EMISSIONS_LOST = "f18b7626705b4625a7da8d7e2d10fc5e", Priority.WARNING
    RELEASE_INSTALLED = "ea305786e20540daa242b8c82c8e30ec", Priority.INFO
    LINES_LOST = "2d17095811e240e1b23a82b876f1835a", Priority.WARNING

    def __init__(self, message_id: str, priority: Priority) -> None:
        self.message_id = message_id
        self.priority = priority


class Line(NamedTuple):
    """A line of the log: when it was written (CLOCK_MONOTONIC), its priority, its text."""

    time_s: float
    priority: Priority
    text: str


class Log:
    """Lines to standard error."""

    def __init__(self) -> None:
        self.lost = 0  # lines dropped so far because standard error was full or closed
        self.count = 0  # lines so far, those included
        self.last: deque[Line] = deque(maxlen=LAST_LINES)  # the last of them, the oldest first
        self._unreported = 0

    def write(self, message: str, about: Priority | Event = Priority.INFO) -> None:
        """Write one line if standard error accepts it at once, else drop it.

        The first line accepted after a loss is preceded by one that states how many were dropped.

        Line breaks are replaced by spaces; what exceeds `MAX_LINE_BYTES` is cut off. `about` is what the line reports, which has a
        priority, or the priority alone.
        """
        priority = about.priority if isinstance(about, Event) else about
        self.last.append(Line(time.monotonic(), priority, " ".join(message.splitlines())[:MAX_LINE_BYTES]))
        self.count += 1
        if self._unreported and _written(f"{self._unreported} lines before this one were lost: the log was full", Event.LINES_LOST):
            self._unreported = 0
        if not _written(message, about):
            self.lost += 1
            self._unreported += 1


def line(message: str, priority: Priority = Priority.INFO) -> str:
    """Format a message as one line of the log, without a newline at its end."""
    return f"{f'<{priority:d}>' if _is_journal() else ''}haptic-panel: {' '.join(message.splitlines())}"


def _written(message: str, about: Priority | Event) -> bool:
    """Whether the log took the whole line at once."""
    priority = about.priority if isinstance(about, Event) else about
    if _is_journal() and (sent := _sent(message, priority, about)) is not None:
        return sent
    whole = _cut(line(message, priority)) + b"\n"
    poll = select.poll()
    try:
        fd = sys.stderr.fileno()
    except io.UnsupportedOperation:  # a stream without a file, such as a test's: it never blocks
        sys.stderr.write(whole.decode(errors="replace"))
        return True
    except (AttributeError, ValueError):  # no standard error, or closed
        return False
    poll.register(fd, select.POLLOUT)
    try:
        return bool(poll.poll(0)) and os.write(fd, whole) == len(whole)
    except OSError:
        return False


def _sent(message: str, priority: Priority, about: Priority | Event) -> bool | None:
    """Whether the journal took the line at once; None: it has no socket here."""
    text = _cut(f"haptic-panel: {' '.join(message.splitlines())}")
    fields = [b"MESSAGE=" + text, b"PRIORITY=%d" % priority, b"SYSLOG_IDENTIFIER=haptic-panel"]
    if isinstance(about, Event):
        fields.append(f"MESSAGE_ID={about.message_id}".encode())
    try:
        with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as journal:
            journal.sendto(b"\n".join(fields) + b"\n", socket.MSG_DONTWAIT, str(JOURNAL))
    except BlockingIOError:
        return False
    except OSError:
        return None
    return True


def _cut(text: str) -> bytes:
    """A line as UTF-8, cut off between two characters where it is too long."""
    return text.encode(errors="backslashreplace")[: MAX_LINE_BYTES - 1].decode(errors="ignore").encode()


def _is_journal() -> bool:
    """Whether standard error is the journal's own stream, not a pipe to another program."""
    named = os.environ.get("JOURNAL_STREAM", "")
    try:
        at = os.fstat(sys.stderr.fileno())
    except (AttributeError, OSError, ValueError):  # none, no file, or closed
        return False
    return named == f"{at.st_dev}:{at.st_ino}"


LOG = Log()
log = LOG.write
