"""Recordings of `libinput record` (version 1 of its format), read line by line.

The format is YAML, written by printf in one shape: each event is one line, `- [seconds, microseconds, type, code, value]`. A minute
of five fingers is 8 MB, for which PyYAML takes 23 times as long with libyaml (5.6 s), 75 times without it, and 11 times the memory;
and it refuses the whole of a file that ends in the middle of a line, as one does whose program was killed. What the lines mean is
compared with PyYAML by the tests.
"""

from __future__ import annotations

import re
from collections import Counter

from controller.device.touch import event_codes as ev
from controller.device.touch.recordings.recorded_device import RecordedDevice, int32, seconds

VERSION = 1

EVENT = re.compile(r"- \[\s*(\d+),\s*(\d+),\s*(\d{1,5}),\s*(\d{1,5}),\s*(-?\d+)\s*\]\s*(?:#.*)?", re.ASCII)
NUMBERS = re.compile(r"(\d{1,5}): \[([-\d,\s]*)\]\s*(?:#.*)?", re.ASCII)
SECTION = re.compile(r"(codes|absinfo):\s*(?:#.*)?", re.ASCII)
PROPERTIES = re.compile(r"properties: \[([\d,\s]*)\]\s*(?:#.*)?", re.ASCII)
NODE = re.compile(r"- node: (\S+)\s*(?:#.*)?", re.ASCII)
NAME = re.compile(r'name: "(.*)"\s*')
FORMAT = re.compile(r"version:\s*(\d{1,9})\s*(?:#.*)?", re.ASCII)
SLOT = re.compile(r"#\s*Event code 47\b.*", re.ASCII)
VALUE = re.compile(r"#\s*Value\s+(\d{1,3})", re.ASCII)


def read_libinput(text: str, warnings: Counter[str]) -> list[RecordedDevice]:
    """The devices of a recording, each with its own events.

    Counts `garbage_lines` (of events alone: descriptors and libinput's own events are not needed), `value_absurd` and
    `unknown_version`.
    """
    devices: list[RecordedDevice] = []
    device = RecordedDevice()
    section = ""
    slot_follows = False
    for raw_line in text.split("\n"):
        line = raw_line.strip()
        if line.startswith("- ["):
            event = EVENT.fullmatch(line)
            if event is None or int(event[3]) > 0xFFFF or int(event[4]) > 0xFFFF:
                warnings["garbage_lines"] += 1
                continue
            kind, code, value = int(event[3]), int(event[4]), int32(event[5], warnings)
            device.events.append((kind, code, value, seconds(event[1], event[2])))
        elif node := NODE.fullmatch(line):
            device = RecordedDevice(node[1])
            devices.append(device)
            section = ""
        elif not device.events:  # the head
            if found := SECTION.fullmatch(line):
                section = found[1]
            elif numbers := NUMBERS.fullmatch(line):
                _declare(device, section, int(numbers[1]), numbers[2])
            elif properties := PROPERTIES.fullmatch(line):
                device.properties.update(_numbers(properties[1]))
            elif name := NAME.fullmatch(line):
                device.name = name[1]
            elif (slot := VALUE.fullmatch(line)) and slot_follows:
                device.slot = int(slot[1])
            elif (version := FORMAT.fullmatch(raw_line.rstrip())) and int(version[1]) != VERSION:
                warnings["unknown_version"] += 1
        slot_follows = bool(SLOT.fullmatch(line))
    return devices or [device]  # of a part of a file, without its head


def _declare(device: RecordedDevice, section: str, number: int, listed: str) -> None:
    """Take in one line of the codes of an event type, or of the range of an axis."""
    values = _numbers(listed)
    if section == "codes" and number == ev.EV_KEY:
        device.keys.update(values)
    elif section == "absinfo" and len(values) >= 2:
        device.declare(number, values[0], values[1])


def _numbers(listed: str) -> list[int]:
    warnings: Counter[str] = Counter()
    return [int32(part, warnings) for part in (part.strip() for part in listed.split(",")) if part.lstrip("-").isdecimal()]
