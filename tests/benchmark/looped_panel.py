"""Recordings round and round as the events of a panel: bytes as the kernel gives them, unpacked report by report."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from pathlib import Path

from controller.touch import event_codes as ev
from controller.touch.event_codes import Protocol
from controller.touch.event_reader import AxisInfo, DeviceDescription, Event
from controller.touch.linux_input import INPUT_EVENT
from controller.touch.recording import Recording

Given = Callable[[float, float, int, bytes, int, int], None]

PAUSE_S = 0.1  # between one recording and the next: all fingers are up
LAST_SLOT = 15


class _Reports:
    """One recording as an image of struct input_event; ends with all fingers lifted."""

    def __init__(self, recording: Recording) -> None:
        axes = {ev.ABS_MT_SLOT: AxisInfo(0, LAST_SLOT)}
        axes |= {code: AxisInfo(a.minimum, a.maximum) for code, a in zip(ev.POSITIONS, (recording.x, recording.y), strict=True)}
        self.description = DeviceDescription(recording.name, axes=axes)
        events = [*recording.events]
        end_s = recording.duration_s + 0.01
        used = {value for kind, code, value, _ in events if (kind, code) == (ev.EV_ABS, ev.ABS_MT_SLOT)}
        for slot in sorted(used):
            events += [(ev.EV_ABS, ev.ABS_MT_SLOT, slot, end_s), (ev.EV_ABS, ev.ABS_MT_TRACKING_ID, -1, end_s)]
        events.append((ev.EV_SYN, ev.SYN_REPORT, 0, end_s))
        self.image = b"".join(INPUT_EVENT.pack(int(t), round(t % 1 * 1e6), kind, code, value) for kind, code, value, t in events)
        ends = [i + 1 for i, (kind, code, _, _) in enumerate(events) if (kind, code) == (ev.EV_SYN, ev.SYN_REPORT)]
        self.spans = list(zip([0, *ends], ends, strict=False))
        self.times_s = [events[end - 1][3] for end in ends]


class LoopedPanel:
    """An `EventReader` that plays recordings of protocol B again and again, until it is told to stop.

    Parameters
    ----------
    paths : sequence of Path
    start_s : float
        When the first one begins.
    given : callable, optional
        Told of every read: recording, start of it, image, first event of the report, events; of none without a report.
    """

    def __init__(self, paths: Sequence[Path], start_s: float, given: Given | None = None) -> None:
        self.warnings: Counter[str] = Counter()
        recordings = [Recording.open(path) for path in paths]
        self._all = [_Reports(recording) for recording in recordings if recording.protocol is Protocol.B]
        self.names = [reports.description.name for reports in self._all]
        self.stopped = False
        self.rounds = 0
        self._which = 0
        self._next = 0
        self._start_s = start_s
        self._given = given

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
        """When the next report is due."""
        if self.stopped and self._next == 0:
            return None
        return self._start_s + self._all[self._which].times_s[self._next]

    def read(self, now_s: float) -> Sequence[Event]:
        """Events of the report that is due, unpacked as `LinuxInput` does."""
        reports = self._all[self._which]
        if (self.stopped and self._next == 0) or self._start_s + reports.times_s[self._next] > now_s:
            if self._given is not None:
                self._given(now_s, self._start_s, self._which, b"", 0, 0)
            return ()
        first, end = reports.spans[self._next]
        unpack, image, start_s, events = INPUT_EVENT.unpack_from, reports.image, self._start_s, []
        for at in range(first * INPUT_EVENT.size, end * INPUT_EVENT.size, INPUT_EVENT.size):
            second, microsecond, kind, code, value = unpack(image, at)
            events.append((kind, code, value, start_s + second + microsecond * 1e-6))
        if self._given is not None:
            self._given(now_s, start_s, self._which, image, first, end - first)
        self._next += 1
        if self._next == len(reports.spans):
            self._start_s += reports.times_s[-1] + PAUSE_S
            self._next = 0
            self._which += 1
            if self._which == len(self._all):
                self._which = 0
                self.rounds += 1
        return events

    def close(self) -> None:
        """Nothing is held."""
