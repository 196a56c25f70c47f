"""Stores what a touch panel sends, until told to stop."""

from __future__ import annotations

import contextlib
import selectors
import signal
import socket
import time
from collections.abc import Iterator
from dataclasses import dataclass
from io import FileIO
from pathlib import Path

from controller.errors import ConfigError, TouchError
from controller.touch.evemu_writer import EvemuWriter
from controller.touch.event_reader import EventReader
from controller.touch.report_times import ReportTimes
from controller.touch.warnings import in_words

LONGEST_WAIT_S = 3600.0
FIRST_LINE = b"# EVEMU "


@dataclass(frozen=True, slots=True)
class Recorded:
    """What has been stored."""

    device: str
    events: int
    reports: int  # parts of long ones counted one by one
    duration_s: float
    warnings: list[str]


def record(reader: EventReader, file: FileIO, seconds: float | None) -> Recorded:
    """Store events until `seconds` are over, or SIGINT or SIGTERM comes; then every report is whole.

    A panel that goes away and comes back goes on in the same recording.

    Raises
    ------
    TouchError
        If the disk is full, or another panel comes in the place of this one.
    """
    description = reader.description
    times = ReportTimes(reader.warnings)
    events_written = reports = 0
    begin_s = now_s = time.monotonic()
    end_s = begin_s + (seconds if seconds is not None else float("inf"))
    try:
        writer = EvemuWriter(file, description)
        with selectors.DefaultSelector() as selector, _stopped_by_signals(selector) as stopped:
            while not stopped and now_s < end_s:
                events = reader.read(now_s)
                if events and reader.description != description:
                    raise TouchError(f"another panel, {reader.description.name!r}, came in the place of {description.name!r}")
                if events:
                    writer.write(events, times.settled(events[-1][3], time.monotonic()))  # it may have come since now_s
                    events_written += len(events)
                    reports += 1
                else:
                    _wait(selector, reader, now_s, end_s)
                now_s = time.monotonic()
    except OSError as error:
        raise TouchError(
            f"{file.name}: cannot be written ({error.strerror}); the recording ends after {reports} reports, which are whole"
        ) from error
    return Recorded(description.name, events_written, reports, min(now_s, end_s) - begin_s, in_words(reader.warnings))


def open_recording(path: Path) -> FileIO:
    """Make the file of a new recording; a recording that is there is overwritten, and nothing else.

    Raises
    ------
    TouchError
        If it cannot be.
    ConfigError
        If something else is there.
    """
    try:
        if path.is_file():
            with path.open("rb") as old:
                start = old.read(len(FIRST_LINE))
            if start and start != FIRST_LINE:
                raise ConfigError(
                    f"{path}: is there and is no recording: it is left as it is, give another --out, or remove it first"
                )
        return FileIO(path, "w")
    except (OSError, ValueError) as error:
        raise TouchError(f"{path}: cannot be written ({getattr(error, 'strerror', error)})") from error


def _wait(selector: selectors.BaseSelector, reader: EventReader, now_s: float, end_s: float) -> None:
    """Sleep until the reader has something to do."""
    fileno = reader.fileno()
    next_s = reader.next_time_s()
    until_s = min(end_s, now_s + LONGEST_WAIT_S) if next_s is None else min(end_s, next_s)
    if fileno is not None:
        selector.register(fileno, selectors.EVENT_READ)
    try:
        selector.select(max(until_s - now_s, 0.0))
    finally:
        if fileno is not None:
            selector.unregister(fileno)


@contextlib.contextmanager
def _stopped_by_signals(selector: selectors.BaseSelector) -> Iterator[list[int]]:
    """A list that is empty until SIGINT or SIGTERM comes, which wakes the selector too."""
    stopped: list[int] = []
    woken, wakes = socket.socketpair()
    woken.setblocking(False)
    wakes.setblocking(False)
    selector.register(woken, selectors.EVENT_READ)
    old_fd = signal.set_wakeup_fd(wakes.fileno())
    old = {number: signal.signal(number, lambda number, _: stopped.append(number)) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        yield stopped
    finally:
        for number, handler in old.items():
            signal.signal(number, handler)
        signal.set_wakeup_fd(old_fd)
        selector.unregister(woken)
        woken.close()
        wakes.close()
