"""One line to the log, without ever waiting for it: what finds it full is left out and counted.

Standard error is the log. Where it is the journal's ($JOURNAL_STREAM, systemd.exec(5)), each line begins with its
priority, as sd-daemon(3) has it; elsewhere people read it.
"""

from __future__ import annotations

import io
import os
import select
import sys
from enum import IntEnum

LONGEST_BYTES = 2048  # whatever can be written to takes so much at once: the kernel's least is a page


class Priority(IntEnum):
    """Of syslog(3)."""

    ERROR = 3
    WARNING = 4
    INFO = 6


class Log:
    """Lines to standard error.

    Attributes
    ----------
    lost : int
        Lines that found it full, or gone.
    """

    def __init__(self) -> None:
        self.lost = 0
        self._untold = 0

    def tell(self, sentence: str, priority: Priority = Priority.INFO) -> None:
        """Write one line, if the log takes it at once; one that was full is told how much it has missed."""
        if self._untold and _written(f"{self._untold} lines before this one were lost: the log was full", Priority.WARNING):
            self._untold = 0
        if not _written(sentence, priority):
            self.lost += 1
            self._untold += 1


def line(sentence: str, priority: Priority = Priority.INFO) -> str:
    """A sentence as one line of the log, without its end."""
    return f"{f'<{priority:d}>' if _is_journal() else ''}haptic-panel: {' '.join(sentence.splitlines())}"


def _written(sentence: str, priority: Priority) -> bool:
    whole = line(sentence, priority).encode(errors="backslashreplace")[: LONGEST_BYTES - 1] + b"\n"
    poll = select.poll()
    try:
        fd = sys.stderr.fileno()
    except io.UnsupportedOperation:  # no file, but something that takes all
        sys.stderr.write(whole.decode(errors="replace"))
        return True
    except (AttributeError, ValueError):  # none at all, or closed
        return False
    poll.register(fd, select.POLLOUT)
    try:
        return bool(poll.poll(0)) and os.write(fd, whole) == len(whole)
    except OSError:
        return False


def _is_journal() -> bool:
    """Whether standard error goes to the journal, with nothing in between."""
    named = os.environ.get("JOURNAL_STREAM", "")
    try:
        at = os.fstat(sys.stderr.fileno())
    except (AttributeError, OSError, ValueError):  # none, no file, or closed
        return False
    return named == f"{at.st_dev}:{at.st_ino}"


LOG = Log()
tell = LOG.tell
