"""Which program has made a recording, and which of its devices is the touch panel."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from typing import Final

from controller.device.touch import event_codes as ev
from controller.device.touch.drivers.touch_nodes import what_is_lacking
from controller.device.touch.recordings.evemu_text import read_evemu
from controller.device.touch.recordings.evtest_text import read_evtest
from controller.device.touch.recordings.getevent_text import read_getevent
from controller.device.touch.recordings.libinput_text import read_libinput
from controller.device.touch.recordings.recorded_device import RecordedDevice
from controller.errors import ConfigError

WAY_ON: Final = "record the device with haptic-panel record, evemu-record or libinput record"
# By the first line of a file that only one of these programs prints; what has none is read as evemu's, whose lines vary most
SIGNS: Final = re.compile(
    r"^[ \t]*(?:"
    r"(?P<evemu># EVEMU \d|E: ?[\d.]+ [0-9a-f]{4} [0-9a-f]{4} )"
    r"|(?P<hid>R:[ \t]+\d+(?: [0-9a-f]{2})+|E: \d{6}\.\d{6} \d+(?: [0-9a-f]{2}){3,})"
    r"|(?P<libinput>ndevices: \d|libinput:\s*$|- node: /dev/input/|- \[ *\d+, *\d+, *\d+, *\d+, *-?\d+ *\])"
    r"|(?P<debug_events>[- ]?event\d+[ \t]+(?:DEVICE_ADDED|TOUCH_|POINTER_|KEYBOARD_|GESTURE_))"
    r"|(?P<evtest>Input driver version is |Event: time \d)"
    r"|(?P<getevent>add device \d+: |\[ *\d+\.\d{6}\] +(?:/dev/input/\S+: +)?[\dE]|\d+-\d+: +(?:/dev/input/\S+: +)?[\dE]"
    r"|/dev/input/event\d+: +(?:[0-9a-f]{4}|EV_[A-Z]+) )"
    r")",
    re.ASCII | re.M,
)
PACKED: Final[Mapping[bytes, str]] = {
    b"\x1f\x8b": "gzip",
    b"\xfd7zXZ\0": "xz",
    b"(\xb5/\xfd": "zstd",
    b"BZh": "bzip2",
    b"PK\x03\x04": "zip",
}
UTF_16: Final = (b"\xff\xfe", b"\xfe\xff")  # what PowerShell makes of a redirected output


def decoded(data: bytes, name: str) -> tuple[str, int]:
    """Text of a file, and how many of its lines have bytes that are no text; raises ConfigError if it is compressed."""
    for sign, program in PACKED.items():
        if data.startswith(sign):
            raise ConfigError(f"{name}: is compressed ({program}): unpack it first")
    encoding = "utf-16" if data.startswith(UTF_16) else "utf-8-sig"
    try:
        return data.decode(encoding), 0
    except UnicodeDecodeError:
        text = data.decode(encoding.removesuffix("-sig"), errors="replace")
        return text, sum("\ufffd" in line for line in text.split("\n"))


def read_recording(text: str, warnings: Counter[str], name: str) -> RecordedDevice | None:
    """The touch panel of a recording with its events; None if no line is of a recording.

    `text` is evemu text, versions 1.0 to 1.3, YAML of libinput record, or what evtest or getevent has printed; `warnings` counts
    what was skipped or clamped. Raises ConfigError if it is of another program, lacks what it takes to know where fingers are and
    when they are lifted, or holds no touch panel or several; the message says how to go on.
    """
    sign = SIGNS.search(text)
    program = sign.lastgroup if sign else "evemu"
    if program == "hid":
        raise ConfigError(
            f"{name}: is of hid-recorder, whose reports are from before the kernel makes events of them: "
            f"replay it with hid-replay, and {WAY_ON}"
        )
    if program == "debug_events":
        raise ConfigError(f"{name}: is of libinput debug-events, which leaves out what the device has sent: {WAY_ON}")
    if program == "getevent":
        devices, untimed = read_getevent(text, warnings)
        if untimed and not any(device.events for device in devices):
            raise ConfigError(f"{name}: is of getevent without times: record with `getevent -lt`")
        return _complete(_panel_of(devices, name), "getevent", name)
    reader = OTHERS.get(program or "")
    if reader is not None:
        return _complete(_panel_of(reader(text, warnings), name), program or "", name)
    return next(iter(read_evemu(text, warnings)), None)


OTHERS: Final[Mapping[str, Callable[[str, Counter[str]], list[RecordedDevice]]]] = {
    "libinput": read_libinput,
    "evtest": read_evtest,
}


def _panel_of(devices: Sequence[RecordedDevice], name: str) -> RecordedDevice:
    """The only device that was touched; of several, the only one that is a touch panel by its head."""
    active = [device for device in devices if device.events]
    touched = [device for device in active if _seen(device) & {(ev.EV_ABS, code) for code in (*ev.POSITIONS, *ev.POSITIONS_SINGLE)}]
    if len(touched) > 1:
        panels = [device for device in touched if device.axes and not what_is_lacking(device.description)]
        if len(panels) != 1:
            listed = ", ".join(repr(device.name) for device in panels or touched)
            raise ConfigError(f"{name}: holds several touch panels, {listed}: record one alone")
        return panels[0]
    if active and not touched:
        listed = ", ".join(repr(device.name or "without a name") for device in active)
        raise ConfigError(f"{name}: holds no positions, only other events of {listed}: is it of a touch panel?")
    return touched[0] if touched else devices[0]


def _complete(device: RecordedDevice, program: str, name: str) -> RecordedDevice:
    """The device, if its events tell when a finger is lifted.

    Multi-touch positions without tracking ids and without SYN_MT_REPORT are those of one finger, if BTN_TOUCH tells of its contact.
    """
    seen = _seen(device)
    multi_touch = bool(seen & {(ev.EV_ABS, code) for code in ev.POSITIONS})
    if not device.events or (multi_touch and seen & {(ev.EV_ABS, ev.ABS_MT_TRACKING_ID), (ev.EV_SYN, ev.SYN_MT_REPORT)}):
        return device
    if (ev.EV_KEY, ev.BTN_TOUCH) not in seen:
        raise ConfigError(
            f"{name}: this text of {program} has no tracking ids, SYN_MT_REPORT or BTN_TOUCH: "
            f"nothing tells when a finger is lifted; {WAY_ON}"
        )
    if multi_touch:
        single = dict(zip(ev.POSITIONS, ev.POSITIONS_SINGLE, strict=True))
        both = seen >= {(ev.EV_ABS, code) for code in ev.POSITIONS_SINGLE}
        device.events = [
            (kind, single[code] if kind == ev.EV_ABS and code in single else code, value, time_s)
            for kind, code, value, time_s in device.events
            if not (kind == ev.EV_ABS and (code == ev.ABS_MT_SLOT or (both and code in single)))
        ]
        ranges = {single.get(code, code): its for code, its in device.axes.items() if not (both and code in single)}
        device.axes = {code: its for code, its in ranges.items() if code in ev.POSITIONS_SINGLE}
    return device


def _seen(device: RecordedDevice) -> set[tuple[int, int]]:
    return {(kind, code) for kind, code, _, _ in device.events}
