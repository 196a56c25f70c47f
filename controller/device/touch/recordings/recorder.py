"""Records a touch panel in evemu's text format, version 1.3, as `recording.Recording` and evemu's own tools read it.

The description of the device comes first, then events as they are read. A file cut short at the end of any line is a valid
recording too, so nothing has to be written at the end.
"""

from __future__ import annotations

import contextlib
import selectors
import signal
import time
from collections.abc import Iterable
from dataclasses import dataclass
from functools import partial
from io import FileIO
from pathlib import Path
from typing import Final

from controller.device.touch import event_codes as ev
from controller.device.touch.event_reader import DeviceDescription, Event, EventReader
from controller.device.touch.reports import ReportClock, describe_warnings
from controller.errors import ConfigError, TouchError
from controller.signals import handled_signals

MAX_WAIT_S: Final = 3600.0
FIRST_LINE: Final = b"# EVEMU "
# Bytes of the bit mask of each event type that evemu knows: one bit for each code the kernel has room for
MASK_BYTES: Final = {0x00: 8, 0x01: 96, 0x02: 8, 0x03: 8, 0x04: 8, 0x05: 8, 0x11: 8, 0x12: 8, 0x14: 8, 0x15: 16}
PROPERTY_BYTES: Final = 8
MAX_PAUSE_US: Final = 50_000_000  # readers take a gap of more than a minute for a damaged time: empty reports bridge it
MAX_NAME_CHARACTERS: Final = 79  # of the buffer that evemu reads names into


def head(description: DeviceDescription) -> str:
    """Head of a recording from the device's `description`: N: name, I: bus and numbers, P: properties, B: events, A: axes."""
    name = "".join([character if character.isprintable() else "?" for character in description.name])[:MAX_NAME_CHARACTERS]
    numbers = (description.bus, description.vendor, description.product, description.version)
    lines = ["# EVEMU 1.3", f"N: {name}", "I: " + " ".join([f"{number & 0xFFFF:04x}" for number in numbers])]
    lines += [f"P: {row}" for row in _mask(description.properties, PROPERTY_BYTES)]
    for kind, size_bytes in MASK_BYTES.items():
        lines += [f"B: {kind:02x} {row}" for row in _mask(description.codes.get(kind, ()), size_bytes)]
    for code, axis in sorted(description.axes.items()):
        lines.append(f"A: {code:02x} {axis.minimum} {axis.maximum} {axis.fuzz} {axis.flat} {axis.resolution}")
    return "\n".join(lines) + "\n"


def event_line(kind: int, code: int, value: int, microseconds: int) -> str:
    """Line of an event with `kind`, `code` and `value` of struct input_event, `microseconds` after the first event."""
    return f"E: {microseconds // 1_000_000}.{microseconds % 1_000_000:06d} {kind:04x} {code:04x} {value:04d}\n"


class EvemuWriter:
    """Writes a recording; the file ends with a complete line at any time.

    `file` is unbuffered, so that an error shows at the report that causes it. Raises OSError if the disk is full or gone.
    """

    def __init__(self, file: FileIO, description: DeviceDescription) -> None:
        self._file = file
        self._size_bytes = 0
        self._first_s: float | None = None
        self._last_us = 0
        self._append(head(description))

    def write(self, events: Iterable[Event], time_s: float) -> None:
        """Append a report; the time of all its events is written to a microsecond.

        Raises OSError if the disk is full or gone; earlier reports stay in the file.
        """
        if self._first_s is None:
            self._first_s = time_s
        microseconds = round((time_s - self._first_s) * 1e6)
        while microseconds - self._last_us > MAX_PAUSE_US:
            self._last_us += MAX_PAUSE_US
            self._append(event_line(ev.EV_SYN, ev.SYN_REPORT, 0, self._last_us))
        self._last_us = microseconds
        self._append("".join([event_line(kind, code, value, microseconds) for kind, code, value, _ in events]))

    def _append(self, text: str) -> None:
        """Write all of the text, or nothing."""
        left = memoryview(text.encode())
        try:
            while left:
                left = left[self._file.write(left) or 0 :]
        except OSError:
            with contextlib.suppress(OSError):
                self._file.truncate(self._size_bytes)
            raise
        self._size_bytes += len(text.encode())


@dataclass(frozen=True, slots=True)
class Recorded:
    """Summary of a finished recording."""

    device: str  # name of the panel
    events: int  # events, reports: written; each part of a long report counts
    reports: int
    duration_s: float  # from the start to the last look
    warnings: list[str]  # anomalies, one line a kind


def record(reader: EventReader, file: FileIO, seconds: float | None) -> Recorded:
    """Record until a time is over or SIGINT or SIGTERM comes; the last report is complete.

    A panel that is disconnected and comes back continues the same recording.

    `seconds` None: until a signal. Raises TouchError if the disk is full, or another panel takes the place of this one.
    """
    description = reader.description
    clock = ReportClock(reader.warnings)
    events_written = reports = 0
    begin_s = now_s = time.monotonic()
    end_s = begin_s + (seconds if seconds is not None else float("inf"))
    try:
        writer = EvemuWriter(file, description)
        stopped: list[bool] = []
        stop = partial(stopped.append, True)
        with selectors.DefaultSelector() as selector, handled_signals({signal.SIGINT: stop, signal.SIGTERM: stop}, selector):
            while not stopped and now_s < end_s:
                events = reader.read(now_s)
                if events and reader.description != description:
                    raise TouchError(f"another panel, {reader.description.name!r}, has taken the place of {description.name!r}")
                if events:
                    writer.write(events, clock.corrected_s(events[-1][3], time.monotonic()))  # it may be later than now_s
                    events_written += len(events)
                    reports += 1
                else:
                    _wait(selector, reader, now_s, end_s)
                now_s = time.monotonic()
    except OSError as error:
        raise TouchError(
            f"{file.name}: cannot be written ({error.strerror}); the recording ends after {reports} complete reports"
        ) from error
    return Recorded(description.name, events_written, reports, min(now_s, end_s) - begin_s, describe_warnings(reader.warnings))


def open_recording(path: Path) -> FileIO:
    """Create the file of a new recording; an existing recording is overwritten, any other file is refused.

    Raises TouchError if the file cannot be created; ConfigError if a file that is no recording has this name.
    """
    try:
        if path.is_file():
            with path.open("rb") as old:
                start = old.read(len(FIRST_LINE))
            if start and start != FIRST_LINE:
                raise ConfigError(
                    f"{path}: exists and is no recording: it is left unchanged; give another --out or remove it first"
                )
        return FileIO(path, "w")
    except (OSError, ValueError) as error:
        raise TouchError(f"{path}: cannot be written ({getattr(error, 'strerror', error)})") from error


def _mask(numbers: Iterable[int], size_bytes: int) -> list[str]:
    """A bit mask, least significant byte first, in rows of eight bytes."""
    mask = sum([1 << number for number in set(numbers) if 0 <= number < 8 * size_bytes])
    data = mask.to_bytes(size_bytes, "little")
    return [data[start : start + 8].hex(" ") for start in range(0, size_bytes, 8)]


def _wait(selector: selectors.BaseSelector, reader: EventReader, now_s: float, end_s: float) -> None:
    """Sleep until the reader has something to do."""
    fileno = reader.fileno()
    next_s = reader.next_time_s()
    until_s = min(end_s, now_s + MAX_WAIT_S) if next_s is None else min(end_s, next_s)
    if fileno is not None:
        selector.register(fileno, selectors.EVENT_READ)
    try:
        selector.select(max(until_s - now_s, 0.0))
    finally:
        if fileno is not None:
            selector.unregister(fileno)
