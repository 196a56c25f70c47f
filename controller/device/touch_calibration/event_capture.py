"""Captures the events of a panel during a measurement, to evaluate and store them when it is over.

Other data of the measurement are stored as event types that evemu knows and the decoder ignores: an emission as EV_SND,
SND_CLICK with its length in us, the steps of a mouse as EV_REL.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from pathlib import Path

from controller.device.touch.event_reader import DeviceDescription, Event, EventReader
from controller.device.touch.recordings.recorder import event_line, head, open_recording
from controller.device.touch.reports import ReportClock

EV_REL, REL_X, REL_Y = 0x02, 0x00, 0x01
EV_SND, SND_CLICK = 0x12, 0x00


class EventCapture:
    """An `EventReader` that keeps a copy of every event."""

    def __init__(self, reader: EventReader) -> None:
        self.events: list[Event] = []  # all so far, each with the corrected time of its report
        self.warnings = reader.warnings  # anomalies found by the driver, by kind
        self._reader = reader
        self._clock = ReportClock(Counter())

    @property
    def description(self) -> DeviceDescription:
        """Description of the driver's device."""
        return self._reader.description

    @property
    def present(self) -> bool:
        """Whether the driver's device is connected."""
        return self._reader.present

    def fileno(self) -> int | None:
        """File of the driver; see `EventReader.fileno`."""
        return self._reader.fileno()

    def next_time_s(self) -> float | None:
        """When the driver wants to be read; see `EventReader.next_time_s`."""
        return self._reader.next_time_s()

    def read(self, now_s: float) -> Sequence[Event]:
        """Events of at most one report by `now_s`; see `EventReader.read`."""
        events = self._reader.read(now_s)
        if events:
            time_s = self._clock.corrected_s(events[-1][3], now_s)
            self.events += [(kind, code, value, time_s) for kind, code, value, _ in events]
        return events

    def close(self) -> None:
        """Close the device."""
        self._reader.close()


def emission_event(start_s: float, duration_s: float) -> Event:
    """Event that stores an emission: its start on the loop's clock, and its length to a microsecond."""
    return EV_SND, SND_CLICK, round(duration_s * 1e6), start_s


def recording_text(description: DeviceDescription, events: Iterable[Event]) -> str:
    """Recording (evemu text) of the events of several devices, in any order; sorted by time."""
    ordered = sorted(events, key=lambda event: event[3])
    first_s = ordered[0][3] if ordered else 0.0
    lines = [event_line(kind, code, value, round((time_s - first_s) * 1e6)) for kind, code, value, time_s in ordered]
    return head(description) + "".join(lines)


def write_recording(path: Path, text: str) -> None:
    """Write a recording.

    `path` is a new file or an existing recording; see `recorder.open_recording`. Raises ConfigError if a file that is no recording
    has this name; TouchError or OSError if it cannot be written.
    """
    with open_recording(path) as file:
        left = memoryview(text.encode())
        while left:
            left = left[file.write(left) or 0 :]
