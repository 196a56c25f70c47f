"""Log lines on standard error, written without blocking: a line that finds the log full is dropped and counted.

Where standard error is connected to the journal ($JOURNAL_STREAM, systemd.exec(5)), each line begins with its priority as
sd-daemon(3) defines it; elsewhere it is plain text.
"""

from __future__ import annotations

import io
import os
import select
import sys
from enum import IntEnum

MAX_LINE_BYTES = 2048  # a pipe that polls writable takes at least a page in one write


class Priority(IntEnum):
    """Priority of a line, as numbered by syslog(3)."""

    ERROR = 3
    WARNING = 4
    INFO = 6


class Log:
    """Lines to standard error.

    Attributes
    ----------
    lost : int
        Lines dropped so far because standard error was full or closed.
    """

    def __init__(self) -> None:
        self.lost = 0
        self._unreported = 0

    def write(self, message: str, priority: Priority = Priority.INFO) -> None:
        """Write one line if standard error accepts it at once, else drop it.

        The first line accepted after a loss is preceded by one that states how many were dropped.

        Parameters
        ----------
        message : str
            Line breaks are replaced by spaces; what exceeds `MAX_LINE_BYTES` is cut off.
        """
        if self._unreported and _written(f"{self._unreported} lines before this one were lost: the log was full", Priority.WARNING):
            self._unreported = 0
        if not _written(message, priority):
            self.lost += 1
            self._unreported += 1


def line(message: str, priority: Priority = Priority.INFO) -> str:
    """Format a message as one line of the log, without a newline at its end."""
    return f"{f'<{priority:d}>' if _is_journal() else ''}haptic-panel: {' '.join(message.splitlines())}"


def _written(message: str, priority: Priority) -> bool:
    """Whether standard error took the whole line at once."""
    whole = line(message, priority).encode(errors="backslashreplace")[: MAX_LINE_BYTES - 1] + b"\n"
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
