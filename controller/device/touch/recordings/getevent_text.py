"""What Android's getevent prints with times: `getevent -lt` (names) and `getevent -t` (numbers), of one device or of all."""

from __future__ import annotations

import re
from collections import Counter
from typing import Final

from controller.device.touch import event_codes as ev
from controller.device.touch.recordings.recorded_device import RecordedDevice, int32, seconds

# Newer versions print the time in brackets, before the device; older ones "seconds-microseconds:"
EVENT = re.compile(
    r"(?:\[\s*(\d+)\.(\d{6})\]|(\d+)-(\d+):)\s+(?:(/dev/input/\S+):\s+)?(\S+)\s+(\S+)\s+(\S+)(?:\s+rate \d+)?", re.ASCII
)
UNTIMED = re.compile(r"(?:/dev/input/\S+:\s+)?(?:[0-9a-f]{4}|EV_[A-Z]+)\s+(?:[0-9a-f]{4}|[A-Z][A-Z0-9_]+)\s+\S+", re.ASCII)
ADDED = re.compile(r"add device \d+:\s+(/dev/input/\S+)", re.ASCII)
NAME = re.compile(r'name:\s+"(.*)"')
AXIS = re.compile(r"(?:ABS \(0003\):\s+)?([0-9a-f]{4}|ABS_\w+)\s*: value (-?\d+), min (-?\d+), max (-?\d+)\b.*", re.ASCII)
GROUP = re.compile(r"([A-Z]+)\s+\([0-9a-f]{4}\):(.*)", re.ASCII)
WORD = re.compile(r"[0-9a-f]{4}|[A-Z][A-Z0-9_]*", re.ASCII)
NUMBER = re.compile(r"[0-9a-f]{1,8}", re.ASCII)

CODES: Final = {
    name: number
    for name, number in vars(ev).items()
    if isinstance(number, int) and name.startswith(("EV_", "SYN_", "ABS_", "BTN_", "INPUT_PROP_"))
}
"""Numbers of names, of what the decoder and the search for a touch panel know; events with other names are nobody's."""
VALUES: Final = {"UP": 0, "DOWN": 1, "REPEAT": 2, "MT_TOOL_FINGER": 0, "MT_TOOL_PEN": 1, "MT_TOOL_PALM": ev.MT_TOOL_PALM}


def read_getevent(text: str, warnings: Counter[str]) -> tuple[list[RecordedDevice], int]:
    """The devices, and how many events have no time; counts `garbage_lines`."""
    devices: dict[str, RecordedDevice] = {}
    device = RecordedDevice()  # of whose head the lines are, or that is alone
    untimed = 0
    group = ""
    for raw_line in text.split("\n"):
        line = raw_line.strip()
        if event := EVENT.fullmatch(line):
            its = devices.setdefault(event[5], RecordedDevice(event[5])) if event[5] else device
            _take(its, event, warnings)
        elif added := ADDED.fullmatch(line):
            device = devices.setdefault(added[1], RecordedDevice(added[1]))
            group = ""
        elif name := NAME.fullmatch(line):
            device.name = name[1]
        elif axis := AXIS.fullmatch(line):
            group = "ABS"
            code = _number(axis[1])
            if code is not None:
                device.declare(code, int32(axis[3], warnings), int32(axis[4], warnings))
                if code == ev.ABS_MT_SLOT:
                    device.slot = max(int32(axis[2], warnings), 0)
        elif (found := GROUP.fullmatch(line)) or line == "input props:":
            group = found[1] if found else "PROPS"
            _declare(device, group, found[2] if found else "")
        elif line.startswith("["):
            warnings["garbage_lines"] += 1
        elif UNTIMED.fullmatch(line) and group in ("", "PROPS"):
            untimed += 1
        else:
            _declare(device, group, line)
    return [*devices.values()] if device in devices.values() else [*devices.values(), device], untimed


def _take(device: RecordedDevice, event: re.Match[str], warnings: Counter[str]) -> None:
    """Append an event; one with a name that nothing here knows is left out."""
    kind, code = _number(event[6]), _number(event[7])
    value = VALUES.get(event[8])
    if value is None and NUMBER.fullmatch(event[8]):
        value = int(event[8], 16)
        value -= (value & 0x80000000) << 1
    if kind is not None and code is not None and value is not None:
        device.events.append((kind, code, value, seconds(event[1] or event[3], event[2] or event[4])))
    elif not all(WORD.fullmatch(word) for word in (event[6], event[7])):
        warnings["garbage_lines"] += 1


def _declare(device: RecordedDevice, group: str, listed: str) -> None:
    """Take in the keys or properties of a line of the head."""
    if group in ("KEY", "PROPS"):
        numbers = {number for word in WORD.findall(listed) if (number := _number(word)) is not None}
        (device.keys if group == "KEY" else device.properties).update(numbers)


def _number(word: str) -> int | None:
    """Number of a name or of four hexadecimal digits; None for a name that is not known."""
    return int(word, 16) if re.fullmatch(r"[0-9a-f]{4}", word) else CODES.get(word)
