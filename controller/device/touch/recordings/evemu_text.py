"""Recordings in evemu's text format, versions 1.0 to 1.3: evemu-record, evemu-convert and `haptic-panel record` write it."""

from __future__ import annotations

import re
from collections import Counter

from controller.device.touch.recordings.recorded_device import RecordedDevice, int32

NEWEST_VERSION = (1, 3)

VERSION = re.compile(r"#\s*EVEMU\s+(\d{1,9})\.(\d{1,9})\s*", re.ASCII)
EVENT = re.compile(r"E:\s*(\S+)\s+(?:0x)?([0-9a-f]{1,4})\s+(?:0x)?([0-9a-f]{1,4})\s+([-+]?\d+)\s*(?:#.*)?", re.ASCII | re.I)
AXIS = re.compile(r"A:\s*(?:0x)?([0-9a-f]{1,2})\s+([-+]?\d+)\s+([-+]?\d+)(?:\s+[-+]?\d+){0,4}\s*(?:#.*)?", re.ASCII | re.I)
OTHER = re.compile(r"(N:.*)|[IPBLS]:[\s0-9a-f]*(?:#.*)?", re.ASCII | re.I)
TIME = re.compile(r"[-+]?\d+(\.\d*)?(e[-+]?\d+)?|nan|[-+]?inf", re.ASCII | re.I)
# Version 1.3 gives the state at the start in comments; the current slot stands nowhere else.
FIRST_SLOT = re.compile(r"^#\s+Event code 47 [^\n]*\n#\s+Value\s+(\d{1,3})\s*$", re.ASCII | re.M)


def read_evemu(text: str, warnings: Counter[str]) -> list[RecordedDevice]:
    """The device of a recording; none if no line is evemu text. Counts `garbage_lines`, `value_absurd` and `unknown_version`."""
    device = RecordedDevice()
    valid = False
    for raw_line in text.split("\n"):
        line = raw_line.strip()
        event = EVENT.fullmatch(line)
        if event and TIME.fullmatch(event[1]):
            valid = True
            device.events.append((int(event[2], 16), int(event[3], 16), int32(event[4], warnings), float(event[1])))
        elif axis := AXIS.fullmatch(line):
            valid = True
            device.declare(int(axis[1], 16), int32(axis[2], warnings), int32(axis[3], warnings))
        elif version := VERSION.fullmatch(line):
            valid = True
            if (int(version[1]), int(version[2])) > NEWEST_VERSION:
                warnings["unknown_version"] += 1
        elif other := OTHER.fullmatch(line):
            valid = True
            device.name = other[1][2:].strip() if other[1] else device.name
        elif line and not line.startswith("#"):
            warnings["garbage_lines"] += 1
    if first_slot := FIRST_SLOT.search(text):
        device.slot = int(first_slot[1])
    return [device] if valid else []
