"""What evtest prints, stored: the device's codes and axes, then one line an event."""

from __future__ import annotations

import re
from collections import Counter

from controller.device.touch import event_codes as ev
from controller.device.touch.recordings.recorded_device import RecordedDevice, int32, seconds

EVENT = re.compile(
    r"Event: time (\d+)\.(\d{6}), type (\d{1,5}) \([^)]*\), code (\d{1,5}) \([^)]*\), value (-?\d+|[0-9a-f]+)", re.ASCII
)
SYNC = re.compile(r"Event: time (\d+)\.(\d{6}), [-+> ]+([A-Za-z_ ]+?)[-+< ]+", re.ASCII)
SYNCS = {
    "SYN_REPORT": ev.SYN_REPORT,
    "Report Sync": ev.SYN_REPORT,  # of evtest before 1.30
    "SYN_CONFIG": ev.SYN_CONFIG,
    "Config Sync": ev.SYN_CONFIG,
    "SYN_MT_REPORT": ev.SYN_MT_REPORT,
    "SYN_DROPPED": ev.SYN_DROPPED,
}
BEGINS = re.compile(r"Input driver version is .*", re.ASCII)
NAME = re.compile(r'Input device name: "(.*)"')
TYPE = re.compile(r"Event type (\d{1,5}) .*", re.ASCII)
CODE = re.compile(r"Event code (\d{1,5}) .*", re.ASCII)
VALUE = re.compile(r"(Value|Min|Max)\s+(-?\d+)", re.ASCII)
PROPERTY = re.compile(r"Property\s+type (\d{1,5}) .*", re.ASCII)


def read_evtest(text: str, warnings: Counter[str]) -> list[RecordedDevice]:
    """The devices of one or several calls of evtest.

    Counts `garbage_lines` (of events alone: people store what else a terminal shows) and `value_absurd`.
    """
    device = RecordedDevice()
    devices = [device]
    kind = code = -1
    minimum = 0
    for raw_line in text.split("\n"):
        line = raw_line.strip()
        if line.startswith("Event: "):
            if event := EVENT.fullmatch(line):
                _take(device, event, warnings)
            elif (sync := SYNC.fullmatch(line)) and sync[3] in SYNCS:
                device.events.append((ev.EV_SYN, SYNCS[sync[3]], 0, seconds(sync[1], sync[2])))
            else:
                warnings["garbage_lines"] += 1
        elif BEGINS.fullmatch(line):
            if device.events or device.axes or device.name:
                device = RecordedDevice()
                devices.append(device)
            kind = code = -1
        elif name := NAME.fullmatch(line):
            device.name = name[1]
        elif found := TYPE.fullmatch(line):
            kind = int(found[1])
        elif found := CODE.fullmatch(line):
            code = int(found[1])
            if kind == ev.EV_KEY:
                device.keys.add(code)
        elif kind == ev.EV_ABS and (value := VALUE.fullmatch(line)):
            number = int32(value[2], warnings)
            if value[1] == "Min":
                minimum = number
            elif value[1] == "Max":
                device.declare(code, minimum, number)
            elif code == ev.ABS_MT_SLOT:
                device.slot = max(number, 0)
        elif found := PROPERTY.fullmatch(line):
            device.properties.add(int(found[1]))
    return devices


def _take(device: RecordedDevice, event: re.Match[str], warnings: Counter[str]) -> None:
    """Append an event with a value; scan codes, in hexadecimal digits, are nobody's."""
    kind, code = int(event[3]), int(event[4])
    if max(kind, code) > 0xFFFF or not event[5].lstrip("-").isdecimal():
        if kind != ev.EV_MSC:
            warnings["garbage_lines"] += 1
        return
    device.events.append((kind, code, int32(event[5], warnings), seconds(event[1], event[2])))
