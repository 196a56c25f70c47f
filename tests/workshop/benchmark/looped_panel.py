"""Recordings round and round as a panel's events, which the product's `LinuxInput` reads from a pipe in the device's place.

What is measured with it is the product's own reading, with its system call: of the panel itself only a comparison is in the turns.
"""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Callable, Sequence
from math import inf
from pathlib import Path
from unittest import mock

from controller.device.touch import event_codes as ev
from controller.device.touch.drivers import event_device
from controller.device.touch.drivers.event_device import BUFFERED_EVENTS, INPUT_EVENT, LinuxInput
from controller.device.touch.event_codes import Protocol
from controller.device.touch.event_reader import AxisInfo, DeviceDescription, Event
from controller.device.touch.recordings.recording import Recording

Given = Callable[[float, int, bytes, int, int], None]

PAUSE_S = 0.1  # between one recording and the next: all fingers are up
LAST_SLOT = 15
STATELESS = DeviceDescription("pipe", axes=dict.fromkeys(ev.POSITIONS, AxisInfo(0, 1)))  # of protocol A: no state is asked for


class _Pipe:
    """What `LinuxInput` has of an opened device; nothing waits in it unless it was sent."""

    def __init__(self) -> None:
        self.fd, self._sender = os.pipe()
        os.set_blocking(self.fd, False)

    def send(self, image: memoryview) -> None:
        os.write(self._sender, image)

    def close(self) -> None:
        os.close(self.fd)
        os.close(self._sender)


class _Reports:
    """One recording, report by report; ends with all fingers lifted.

    Before it comes a report without contacts: the state that a driver reports of a device that it has opened.
    """

    def __init__(self, recording: Recording) -> None:
        axes = {ev.ABS_MT_SLOT: AxisInfo(0, LAST_SLOT)}
        axes |= {code: AxisInfo(a.minimum, a.maximum) for code, a in zip(ev.POSITIONS, (recording.x, recording.y), strict=True)}
        self.description = DeviceDescription(recording.name, axes=axes)
        events = [(ev.EV_SYN, ev.SYN_REPORT, 0, -PAUSE_S / 2), *recording.events]
        end_s = recording.duration_s + 0.01
        used = {value for kind, code, value, _ in events if (kind, code) == (ev.EV_ABS, ev.ABS_MT_SLOT)}
        for slot in sorted(used):
            events += [(ev.EV_ABS, ev.ABS_MT_SLOT, slot, end_s), (ev.EV_ABS, ev.ABS_MT_TRACKING_ID, -1, end_s)]
        events.append((ev.EV_SYN, ev.SYN_REPORT, 0, end_s))
        ends = [i + 1 for i, (kind, code, _, _) in enumerate(events) if (kind, code) == (ev.EV_SYN, ev.SYN_REPORT)]
        self.reports = [events[begin:end] for begin, end in zip([0, *ends], ends, strict=False)]
        assert max(map(len, self.reports)) <= BUFFERED_EVENTS, "one read of the file takes a report"
        self.end_s = end_s

    def pack(self, image: bytearray, number: int, start_s: float) -> tuple[int, float]:
        """Pack a report of a recording that began at `start_s`, as struct input_event: its bytes, and its time."""
        size, time_s = 0, 0.0
        for kind, code, value, at_s in self.reports[number]:
            second, microsecond = divmod(round((start_s + at_s) * 1e6), 1_000_000)
            INPUT_EVENT.pack_into(image, size, second, microsecond, kind, code, value)
            size += INPUT_EVENT.size
            time_s = second + microsecond * 1e-6
        return size, time_s


class LoopedPanel:
    """An `EventReader` that plays recordings of protocol B again and again, until it is commanded to stop.

    Parameters
    ----------
    paths : sequence of Path
    start_s : float
        When the first one begins.
    given : callable, optional
        Called for every read: its time, recording, image of the report, first event that was read, events; of none without a
        report.
    """

    def __init__(self, paths: Sequence[Path], start_s: float, given: Given | None = None) -> None:
        recordings = [Recording.open(path) for path in paths]
        self._all = [_Reports(recording) for recording in recordings if recording.protocol is Protocol.B]
        self.names = [reports.description.name for reports in self._all]
        self.stopped = False
        self.rounds = 0
        self._which = 0
        self._next = -1
        self._start_s = start_s
        self._given = given
        self._pipe = _Pipe()
        with mock.patch.object(event_device, "open_touch_device", return_value=(self._pipe, STATELESS)):
            self._reader = LinuxInput("")
        self._read = self._reader.read
        self._read(0.0)  # the state of protocol A
        self._room = bytearray(BUFFERED_EVENTS * INPUT_EVENT.size)
        self._view = memoryview(self._room)
        self._image, self._at = b"", 0  # for whom it is given to
        self._time_s = -inf  # of the report in the pipe
        self._due_s = inf  # inf: it has been read

    @property
    def warnings(self) -> Counter[str]:
        """Those of the reader."""
        return self._reader.warnings

    @property
    def descriptions(self) -> list[DeviceDescription]:
        """Of all recordings."""
        return [reports.description for reports in self._all]

    @property
    def description(self) -> DeviceDescription:
        """Of the recording that plays."""
        return self._all[self._which].description

    @property
    def present(self) -> bool:
        """Always."""
        return True

    def fileno(self) -> None:
        """Nothing to wait on but time."""
        return

    def next_time_s(self) -> float | None:
        """When the next report is due. It is made here, after a turn's work, and not where it is read."""
        if self._due_s == inf:
            if self._reader.next_time_s() is not None:  # the rest of a long report
                self._due_s = self._time_s
            elif not self._advance():
                return None
        return self._due_s

    def read(self, now_s: float) -> Sequence[Event]:
        """Events of the report that is due, read by `LinuxInput`."""
        if now_s < self._due_s:
            if self._given is not None:
                self._given(now_s, self._which, b"", 0, 0)
            return ()
        events = self._read(now_s)
        self._due_s = inf
        if self._given is not None:
            self._given(now_s, self._which, self._image, self._at, len(events))
            self._at += len(events)
        return events

    def close(self) -> None:
        """Close the pipe."""
        self._reader.close()

    def _advance(self) -> bool:
        """Put the next report into the pipe; False at the end."""
        reports = self._all[self._which]
        if self._next + 1 < len(reports.reports):
            self._next += 1
        elif self.stopped:
            return False
        else:
            self._start_s += reports.end_s + PAUSE_S
            self._next = 0
            self._which += 1
            if self._which == len(self._all):
                self._which = 0
                self.rounds += 1
        size, self._time_s = self._all[self._which].pack(self._room, self._next, self._start_s)
        self._pipe.send(self._view[:size])
        if self._given is not None:
            self._image, self._at = bytes(self._view[:size]), 0
        self._due_s = self._time_s
        return True
