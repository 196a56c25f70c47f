"""Touch recordings in evemu's text format, versions 1.0 to 1.3.

A recording is somebody else's file: what is not understood is skipped or clamped, counted by kind
(`warnings.KINDS`) and never fatal. Only a file that cannot be opened, or of which nothing is a recording's, is an error.
"""

from __future__ import annotations

import os
import re
import stat
from collections import Counter
from pathlib import Path

from controller.board.board import Board
from controller.errors import ConfigError, TouchError
from controller.touch import event_codes as ev
from controller.touch.axes import Axes, AxisRange
from controller.touch.decoder import Decoder
from controller.touch.panel import Protocol, protocol_of
from controller.touch.recorded_time import rebased
from controller.touch.tracks import Track

Event = tuple[int, int, int, float]  # type, code, value, time in s from the first event

INT32_MIN, INT32_MAX = -(1 << 31), (1 << 31) - 1
NEWEST_VERSION = (1, 3)
LARGEST_BYTES = 256 << 20
LONGEST_NUMBER = 20  # digits; Python refuses to read numbers of thousands

VERSION = re.compile(r"#\s*EVEMU\s+(\d{1,9})\.(\d{1,9})\s*", re.ASCII)
EVENT = re.compile(r"E:\s*(\S+)\s+(?:0x)?([0-9a-f]{1,4})\s+(?:0x)?([0-9a-f]{1,4})\s+([-+]?\d+)\s*(?:#.*)?", re.ASCII | re.I)
AXIS = re.compile(r"A:\s*(?:0x)?([0-9a-f]{1,2})\s+([-+]?\d+)\s+([-+]?\d+)(?:\s+[-+]?\d+){0,4}\s*(?:#.*)?", re.ASCII | re.I)
OTHER = re.compile(r"N:.*|[IPBLS]:[\s0-9a-f]*(?:#.*)?", re.ASCII | re.I)
TIME = re.compile(r"[-+]?\d+(\.\d*)?(e[-+]?\d+)?|nan|[-+]?inf", re.ASCII | re.I)
# Version 1.3 tells the state at the start in comments, and the current slot is told nowhere else.
FIRST_SLOT = re.compile(r"^#\s+Event code 47 [^\n]*\n#\s+Value\s+(\d{1,3})\s*$", re.ASCII | re.M)


class Recording:
    """One parsed recording.

    Parameters
    ----------
    text : str
        The file's text.
    name : str
        What to call it in messages.

    Attributes
    ----------
    events : tuple of (type, code, value, time_s)
        Time in s from the first event, never decreasing.
    x, y : AxisRange
        Ranges of the positions: as declared, else the smallest and largest value seen.
    protocol : Protocol
        What the device declares or the stream shows.
    warnings : Counter of str
        What was skipped or clamped in reading, by kind.
    understood : bool
        Whether any line of the text is a recording's.
    """

    def __init__(self, text: str, name: str = "recording") -> None:
        self.name = name
        self.warnings: Counter[str] = Counter()
        self.understood = False
        self._declared: dict[int, AxisRange] = {}
        self.events = self._parse(text)
        self.protocol = protocol_of(self._declared, {(kind, code) for kind, code, _, _ in self.events})
        codes = ev.POSITIONS_SINGLE if self.protocol is Protocol.SINGLE else ev.POSITIONS
        self.x, self.y = (self._range(code, single) for code, single in zip(codes, ev.POSITIONS_SINGLE, strict=True))
        first_slot = FIRST_SLOT.search(text)
        self._first_slot = int(first_slot[1]) if first_slot else 0

    @classmethod
    def open(cls, path: Path) -> Recording:
        """Read a recording.

        Raises
        ------
        TouchError
            If the file cannot be read, naming it.
        ConfigError
            If nothing in it is a line of a recording.
        """
        try:
            fd = os.open(path, os.O_RDONLY | os.O_CLOEXEC | os.O_NONBLOCK)  # a pipe nobody writes to must not hang us
            with os.fdopen(fd, "rb") as file:
                if not stat.S_ISREG(os.fstat(fd).st_mode):
                    raise TouchError(f"{path}: the recording cannot be read (not a regular file)")
                data = file.read(LARGEST_BYTES + 1)
            if len(data) > LARGEST_BYTES:
                raise TouchError(f"{path}: the recording cannot be read (more than {LARGEST_BYTES >> 20} MiB)")
        except OSError as error:
            raise TouchError(f"{path}: the recording cannot be read ({error.strerror})") from error
        except ValueError as error:  # a NUL in the name
            raise TouchError(f"{str(path)!r}: the recording cannot be read ({error})") from error
        damaged = 0
        try:
            text = data.decode("utf-8-sig")
        except UnicodeDecodeError:
            text = data.decode("utf-8", errors="replace")
            damaged = sum("\ufffd" in line for line in text.split("\n"))
        recording = cls(text, path.name)
        if not recording.understood:
            raise ConfigError(
                f"{path}: is no touch recording: none of its lines is one of evemu's (haptic-panel record makes them)"
            )
        if damaged:
            recording.warnings["not_utf8"] = damaged
        return recording

    @property
    def duration_s(self) -> float:
        """Time from the first event to the last."""
        return self.events[-1][3] if self.events else 0.0

    def axes(self, board: Board) -> Axes:
        """The recording's axes on a board's plate."""
        return Axes(board, self.x, self.y)

    def decoder(self, axes: Axes) -> Decoder:
        """A decoder in the state at the recording's start."""
        slots = self._declared.get(ev.ABS_MT_SLOT)
        return Decoder(axes, self.protocol, slot=self._first_slot, last_slot=slots.maximum if slots else None)

    def tracks(self, axes: Axes) -> dict[int, Track]:
        """Where each finger was, by the numbers that a replay gives, in the recording's own time.

        A finger has a point at every report while it is down, moving or not.
        """
        decoder = self.decoder(axes)
        points: dict[int, list[tuple[float, float, float]]] = {}
        for kind, code, value, time_s in self.events:
            if decoder.feed(kind, code, value, time_s) is None:
                continue
            for finger, x_m, y_m in decoder.fingers():
                points.setdefault(finger, []).append((time_s, x_m, y_m))
        return {finger: Track.of(finger, seen) for finger, seen in points.items()}

    def _parse(self, text: str) -> tuple[Event, ...]:
        found = []
        for raw_line in text.split("\n"):
            line = raw_line.strip()
            event = EVENT.fullmatch(line)
            if event and TIME.fullmatch(event[1]):
                self.understood = True
                found.append((int(event[2], 16), int(event[3], 16), self._int32(event[4]), float(event[1])))
            elif axis := AXIS.fullmatch(line):
                self.understood = True
                declared = AxisRange(self._int32(axis[2]), self._int32(axis[3]))
                if declared.minimum < declared.maximum:
                    self._declared[int(axis[1], 16)] = declared
            elif version := VERSION.fullmatch(line):
                self.understood = True
                if (int(version[1]), int(version[2])) > NEWEST_VERSION:
                    self.warnings["unknown_version"] += 1
            elif OTHER.fullmatch(line):
                self.understood = True
            elif line and not line.startswith("#"):
                self.warnings["garbage_lines"] += 1
        times = rebased([event[3] for event in found], self.warnings)
        return tuple([(kind, code, value, time_s) for (kind, code, value, _), time_s in zip(found, times, strict=True)])

    def _int32(self, digits: str) -> int:
        value = int(digits[:LONGEST_NUMBER])
        if INT32_MIN <= value <= INT32_MAX:
            return value
        self.warnings["value_absurd"] += 1
        return INT32_MIN if value < 0 else INT32_MAX

    def _range(self, code: int, single: int) -> AxisRange:
        declared = self._declared.get(code) or self._declared.get(single)
        if declared:
            return declared
        seen = [v for kind, c, v, _ in self.events if kind == ev.EV_ABS and c == code and INT32_MIN < v < INT32_MAX]
        if seen:
            self.warnings["no_axis_lines"] = 1
        return AxisRange(min(seen, default=0), max(seen, default=0))
