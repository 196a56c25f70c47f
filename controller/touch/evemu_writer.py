"""Touch recordings in evemu's text format, version 1.3: what `recording.Recording` and evemu's own tools read.

The description of the device comes first, then events as they are read. A file that was cut short at the end of any
line is a recording too, so nothing has to be done at the end.
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterable
from io import FileIO
from typing import Final

from controller.touch import event_codes as ev
from controller.touch.event_reader import DeviceDescription, Event

# Bytes of the bit mask of each event type that evemu knows: one bit for each code the kernel has room for
MASK_BYTES: Final = {0x00: 8, 0x01: 96, 0x02: 8, 0x03: 8, 0x04: 8, 0x05: 8, 0x11: 8, 0x12: 8, 0x14: 8, 0x15: 16}
PROPERTY_BYTES: Final = 8
LONGEST_PAUSE_US: Final = 50_000_000  # readers take a gap of more than a minute for a damaged time: empty reports bridge it
LONGEST_NAME: Final = 79  # of the buffer that evemu reads names into


def head(description: DeviceDescription) -> str:
    """Lines that describe a device: N: name, I: bus and numbers, P: properties, B: what it can send, A: its axes."""
    name = "".join([character if character.isprintable() else "?" for character in description.name])[:LONGEST_NAME]
    numbers = (description.bus, description.vendor, description.product, description.version)
    lines = ["# EVEMU 1.3", f"N: {name}", "I: " + " ".join([f"{number & 0xFFFF:04x}" for number in numbers])]
    lines += [f"P: {row}" for row in _mask(description.properties, PROPERTY_BYTES)]
    for kind, size_bytes in MASK_BYTES.items():
        lines += [f"B: {kind:02x} {row}" for row in _mask(description.codes.get(kind, ()), size_bytes)]
    for code, axis in sorted(description.axes.items()):
        lines.append(f"A: {code:02x} {axis.minimum} {axis.maximum} {axis.fuzz} {axis.flat} {axis.resolution}")
    return "\n".join(lines) + "\n"


def event_line(kind: int, code: int, value: int, microseconds: int) -> str:
    """One event, `microseconds` after the first."""
    return f"E: {microseconds // 1_000_000}.{microseconds % 1_000_000:06d} {kind:04x} {code:04x} {value:04d}\n"


class EvemuWriter:
    """A recording that is being written; every line of it is whole at any time.

    Parameters
    ----------
    file : FileIO
        Where to write to, unbuffered: what has gone wrong shows with the report it has gone wrong with.
    description : DeviceDescription
        Of the device.

    Raises
    ------
    OSError
        If the disk is full or gone.
    """

    def __init__(self, file: FileIO, description: DeviceDescription) -> None:
        self._file = file
        self._size_bytes = 0
        self._first_s: float | None = None
        self._last_us = 0
        self._append(head(description))

    def write(self, events: Iterable[Event], time_s: float) -> None:
        """Append a report, all of it at `time_s`, to a microsecond.

        Raises
        ------
        OSError
            If the disk is full or gone; what was written before stays.
        """
        if self._first_s is None:
            self._first_s = time_s
        microseconds = round((time_s - self._first_s) * 1e6)
        while microseconds - self._last_us > LONGEST_PAUSE_US:
            self._last_us += LONGEST_PAUSE_US
            self._append(event_line(ev.EV_SYN, ev.SYN_REPORT, 0, self._last_us))
        self._last_us = microseconds
        self._append("".join([event_line(kind, code, value, microseconds) for kind, code, value, _ in events]))

    def _append(self, text: str) -> None:
        """Write all of it, or nothing."""
        left = memoryview(text.encode())
        try:
            while left:
                left = left[self._file.write(left) or 0 :]
        except OSError:
            with contextlib.suppress(OSError):
                self._file.truncate(self._size_bytes)
            raise
        self._size_bytes += len(text.encode())


def _mask(numbers: Iterable[int], size_bytes: int) -> list[str]:
    """A bit mask, least significant byte first, in rows of eight bytes."""
    mask = sum([1 << number for number in set(numbers) if 0 <= number < 8 * size_bytes])
    data = mask.to_bytes(size_bytes, "little")
    return [data[start : start + 8].hex(" ") for start in range(0, size_bytes, 8)]
