"""Touch recordings, of evemu, libinput record, evtest or getevent (`recording_format.py`), and the tracks of their fingers.

Recordings come from other people and tools: lines and values that are not valid are skipped or clamped, counted by kind
(`reports.WARNINGS`) and never fatal. A file that cannot be opened, one without a single event, and one of which it cannot be said
where fingers are, is an error.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Self

import numpy as np

from controller.arrays import Floats
from controller.device.board.board import Board
from controller.device.touch import event_codes as ev
from controller.device.touch.axes import AxisRange, PanelAxes
from controller.device.touch.decoder import Decoder
from controller.device.touch.event_codes import Protocol, protocol_of
from controller.device.touch.recordings.recorded_device import INT32_MAX, INT32_MIN, RecordedDevice
from controller.device.touch.recordings.recording_format import WAY_ON, decoded, read_recording
from controller.errors import ConfigError, TouchError
from controller.regular_file import read_regular

Event = tuple[int, int, int, float]  # type, code, value, time in s from the first event

MAX_BYTES = 256 << 20
MAX_GAP_S = 60.0
CLOCK_SET_EVENTS = 50  # if this many events later the times are still off, the clock was set while recording


@dataclass(frozen=True, slots=True, eq=False)
class Track:
    """Reported positions of one finger from its first report to its last."""

    finger: int  # number in the touch samples
    time_s: Floats  # time_s, x_m, y_m: (report,): one entry for each report while the finger was down
    x_m: Floats
    y_m: Floats

    @classmethod
    def of(cls, finger: int, reports: Sequence[tuple[float, float, float]]) -> Self:
        """Track of `finger` from `reports`, each (time_s, x_m, y_m), in order of time."""
        time_s, x_m, y_m = np.array(reports, np.float64).T
        return cls(finger, time_s, x_m, y_m)

    @classmethod
    def joined(cls, finger: int, parts: Iterable[Self]) -> Self:
        """Track of a `finger` that the panel lost and found again; `parts` are those of its contacts in order of time."""
        kept = list(parts)
        return cls(finger, *(np.concatenate([getattr(part, name) for part in kept]) for name in ("time_s", "x_m", "y_m")))

    @property
    def end_s(self) -> float:
        """Time of the last report before the finger was lifted."""
        return float(self.time_s[-1])

    def position(self, time_s: float) -> tuple[float, float]:
        """(x_m, y_m) at `time_s`, linear between reports and contacts, constant before the first and after the last."""
        return float(np.interp(time_s, self.time_s, self.x_m)), float(np.interp(time_s, self.time_s, self.y_m))


class Recording:
    """One parsed recording.

    `text` is the content of the file; `name` stands in messages, `path` in errors (left out: the name). Raises ConfigError as
    `read_recording`.
    """

    def __init__(self, text: str, name: str = "recording", path: str = "") -> None:
        self.name = name
        self.warnings: Counter[str] = Counter()  # anomalies in the text, by kind
        device = read_recording(text, self.warnings, path or name)
        self.valid = device is not None  # whether at least one line is of a recording
        device = device or RecordedDevice()
        self._declared = device.axes
        self._first_slot = device.slot
        times = rebased([event[3] for event in device.events], self.warnings)
        # each (type, code, value, time_s): time in s from the first event, never decreasing
        self.events: tuple[Event, ...] = tuple(
            [(kind, code, value, time_s) for (kind, code, value, _), time_s in zip(device.events, times, strict=True)]
        )
        # As the device declares it or the stream shows it
        self.protocol = protocol_of(self._declared, {(kind, code) for kind, code, _, _ in self.events})
        codes = ev.POSITIONS_SINGLE if self.protocol is Protocol.SINGLE else ev.POSITIONS
        # Ranges of the positions: as declared, else the smallest and largest value in the recording
        self.x, self.y = (self._range(code, single) for code, single in zip(codes, ev.POSITIONS_SINGLE, strict=True))

    @classmethod
    def open(cls, path: Path) -> Self:
        """Read the recording in the file `path`, at most `MAX_BYTES` long.

        Raises TouchError if the file cannot be read; ConfigError if it is no recording, holds no event, or see `read_recording`.
        """
        try:
            data = read_regular(path, MAX_BYTES, links=True)
        except OSError as error:
            raise TouchError(f"{path}: the recording cannot be read ({error.strerror})") from error
        except ValueError as error:  # a NUL in the name
            raise TouchError(f"{str(path)!r}: the recording cannot be read ({error})") from error
        text, damaged = decoded(data, str(path))
        recording = cls(text, path.name, str(path))
        if not recording.valid:
            raise ConfigError(
                f"{path}: is no touch recording: no line of it is of evemu, libinput record, evtest or getevent; {WAY_ON}"
            )
        if not recording.events:
            raise ConfigError(
                f"{path}: holds no event: was the device touched, and was no other program keeping its events? {WAY_ON}"
            )
        if damaged:
            recording.warnings["not_utf8"] = damaged
        return recording

    @property
    def duration_s(self) -> float:
        """Time from the first event to the last."""
        return self.events[-1][3] if self.events else 0.0

    def axes(self, board: Board) -> PanelAxes:
        """Map from the recording's axes to the plate of `board`."""
        return PanelAxes(board, self.x, self.y)

    def decoder(self, axes: PanelAxes) -> Decoder:
        """Decoder in the state at the recording's start, with `axes` from `self.axes`."""
        slots = self._declared.get(ev.ABS_MT_SLOT)
        return Decoder(axes, self.protocol, slot=self._first_slot, last_slot=slots.maximum if slots else None)

    def tracks(self, axes: PanelAxes, start_s: float = 0.0) -> dict[int, Track]:
        """Track of each finger by its number in a replay, with a position at every report while it is down.

        A decision at the very time of a report falls as in the replay that starts at `start_s`.
        """
        decoder = self.decoder(axes)
        points: dict[int, list[tuple[float, float, float]]] = {}
        for kind, code, value, time_s in self.events:
            if (kind, code) == (ev.EV_SYN, ev.SYN_REPORT):
                while decoder.due_s < start_s + time_s:
                    decoder.overdue(decoder.due_s)
            if decoder.feed(kind, code, value, start_s + time_s) is None:
                continue
            for finger, x_m, y_m in decoder.fingers():
                points.setdefault(finger, []).append((time_s, x_m, y_m))
        return {finger: Track.of(finger, seen) for finger, seen in points.items()}

    def _range(self, code: int, single: int) -> AxisRange:
        declared = self._declared.get(code) or self._declared.get(single)
        if declared:
            return declared
        seen = [v for kind, c, v, _ in self.events if kind == ev.EV_ABS and c == code and INT32_MIN < v < INT32_MAX]
        if seen:
            self.warnings["no_axis_lines"] = 1
        return AxisRange(min(seen, default=0), max(seen, default=0))


def rebased(raw_s: Sequence[float], warnings: Counter[str]) -> list[float]:
    """Times from the first event: from 0, never decreasing, without impossible gaps.

    An event earlier than the one before, or more than a minute later, or with a time that is not a number, takes the time
    of the one before. If the events after it stay off, the clock was set while recording: they keep their intervals.

    Counts `time_backwards` and `time_absurd`.
    """
    times: list[float] = []
    offset_s = 0.0
    now_s = -math.inf  # before the first event with a time
    for index, raw in enumerate(raw_s):
        time_s = raw - offset_s
        if not abs(time_s) < 1e15:
            warnings["time_absurd"] += 1
        elif now_s == -math.inf:
            offset_s, now_s = raw, 0.0
        elif now_s <= time_s <= now_s + MAX_GAP_S:
            now_s = time_s
        else:
            warnings["time_backwards" if time_s < now_s else "time_absurd"] += 1
            if not any(now_s <= later - offset_s <= now_s + MAX_GAP_S for later in raw_s[index + 1 : index + 1 + CLOCK_SET_EVENTS]):
                offset_s = raw - now_s
        times.append(max(now_s, 0.0))
    return times
