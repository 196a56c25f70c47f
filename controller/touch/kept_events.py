"""A driver of a panel whose events are kept, to be judged, and stored, when a measurement is over.

What happened besides is kept as events that evemu knows and the decoder passes over: an emission as a click of EV_SND with its
length in us, the way of a pointing device as EV_REL.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from pathlib import Path

from controller.touch.evemu_writer import event_line, head
from controller.touch.event_reader import DeviceDescription, Event, EventReader
from controller.touch.recorder import open_recording
from controller.touch.report_times import ReportTimes

EV_REL, REL_X, REL_Y = 0x02, 0x00, 0x01
EV_SND, SND_CLICK = 0x12, 0x00


class KeptEvents:
    """An `EventReader` that keeps what it gives.

    Parameters
    ----------
    reader : EventReader
        The driver.

    Attributes
    ----------
    events : list of Event
        All so far, each with the time at which its report is taken to be made.
    warnings : Counter of str
        Of the driver.
    """

    def __init__(self, reader: EventReader) -> None:
        self.events: list[Event] = []
        self.warnings = reader.warnings
        self._reader = reader
        self._times = ReportTimes(Counter())

    @property
    def description(self) -> DeviceDescription:
        """Of the driver."""
        return self._reader.description

    @property
    def present(self) -> bool:
        """Of the driver."""
        return self._reader.present

    def fileno(self) -> int | None:
        """Of the driver."""
        return self._reader.fileno()

    def next_time_s(self) -> float | None:
        """Of the driver."""
        return self._reader.next_time_s()

    def read(self, now_s: float) -> Sequence[Event]:
        """Events of at most one report; see `EventReader.read`."""
        events = self._reader.read(now_s)
        if events:
            time_s = self._times.settled(events[-1][3], now_s)
            self.events += [(kind, code, value, time_s) for kind, code, value, _ in events]
        return events

    def close(self) -> None:
        """Give the device back."""
        self._reader.close()


def emission_event(start_s: float, duration_s: float) -> Event:
    """An emission as an event."""
    return EV_SND, SND_CLICK, round(duration_s * 1e6), start_s


def recording_text(description: DeviceDescription, events: Iterable[Event]) -> str:
    """Events of several devices as one recording, in order of time."""
    ordered = sorted(events, key=lambda event: event[3])
    first_s = ordered[0][3] if ordered else 0.0
    lines = [event_line(kind, code, value, round((time_s - first_s) * 1e6)) for kind, code, value, time_s in ordered]
    return head(description) + "".join(lines)


def store(path: Path, text: str) -> None:
    """Write a recording; see `recorder.open_recording` for what is refused.

    Raises
    ------
    TouchError, OSError
        If it cannot be written.
    """
    with open_recording(path) as file:
        left = memoryview(text.encode())
        while left:
            left = left[file.write(left) or 0 :]
