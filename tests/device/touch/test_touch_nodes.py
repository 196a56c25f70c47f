"""Which input devices are touch panels; nodes of the kernel: tests/kernel/guest_panels.py."""

import re
from pathlib import Path

from tables import each_row

from controller.device.touch.drivers.touch_nodes import what_is_lacking
from controller.device.touch.event_codes import POSITIONS, POSITIONS_SINGLE
from controller.device.touch.event_reader import AxisInfo, DeviceDescription

FOLDER = Path(__file__).parent / "recordings"
BTN_LEFT, BTN_A, BTN_TRIGGER, BTN_TOOL_PEN, BTN_TOOL_FINGER, BTN_TOUCH, BTN_STYLUS = 0x110, 0x130, 0x120, 0x140, 0x145, 0x14A, 0x14B
BTN_TOOL_DOUBLETAP, KEY_A, SLOT, TRACKING_ID = 0x14D, 30, 0x2F, 0x39
POINTER, DIRECT, BUTTONPAD = 0, 1, 2
MT = (SLOT, *POSITIONS, TRACKING_ID)


def node(axes=(), keys=(), properties=(), steps=()):
    codes = {1: tuple(keys), 2: tuple(steps), 3: tuple(axes)}
    listed = {kind: found for kind, found in codes.items() if found}
    return DeviceDescription("node", codes=listed, axes=dict.fromkeys(axes, AxisInfo(0, 100)), properties=tuple(properties))


PANELS = {  # as drivers of the kernel declare them
    "protocol B": node((*POSITIONS_SINGLE, *MT), (BTN_TOUCH,), (DIRECT,)),
    "protocol B without keys and properties": node(MT),
    "protocol A of an old driver": node(POSITIONS, (BTN_TOUCH,)),
    "protocol A without anything else": node(POSITIONS),
    "single touch": node(POSITIONS_SINGLE, (BTN_TOUCH,)),
    "single touch of a touchscreen with buttons": node(POSITIONS_SINGLE, (BTN_TOUCH, KEY_A, BTN_LEFT), (DIRECT,)),
    "a screen that counts fingers": node((*POSITIONS_SINGLE, *MT), (BTN_TOUCH, BTN_TOOL_FINGER, BTN_TOOL_DOUBLETAP), (DIRECT,)),
    "a screen for fingers and pen": node((*POSITIONS_SINGLE, *MT), (BTN_TOUCH, BTN_TOOL_PEN, BTN_STYLUS), (DIRECT,)),
}
OTHERS = {
    "mouse": (node(keys=(BTN_LEFT,), steps=(0, 1)), "only steps: a mouse?"),
    "keyboard": (node(keys=(KEY_A,)), "no position axes: a keyboard or buttons?"),
    "power button's lid": (node(), "it has no position axes"),
    "x without y": (node((0,), (BTN_TOUCH,)), "it has no position axes"),
    "gamepad": (node((0, 1, 3, 4, 16, 17), (BTN_A, BTN_A + 1)), "no BTN_TOUCH, which tells of contact: a gamepad or joystick?"),
    "joystick": (node((0, 1, 6), (BTN_TRIGGER,)), "a gamepad or joystick?"),
    "a gamepad with all axes": (node(range(0x40), (BTN_A,)), "a gamepad or joystick?"),
    "a gamepad with a pad": (node((0, 1, *MT), (BTN_A,)), "neither BTN_TOUCH nor INPUT_PROP_DIRECT"),
    "absolute mouse of a virtual machine": (node(POSITIONS_SINGLE, (BTN_LEFT,), steps=(8,)), "a mouse with absolute positions?"),
    "accelerometer": (node((0, 1, 2), properties=(6,)), "no BTN_TOUCH"),
    "touchpad": (node((0, 1, *MT), (BTN_LEFT, BTN_TOOL_FINGER, BTN_TOUCH), (POINTER, BUTTONPAD)), "INPUT_PROP_DIRECT"),
    "old touchpad": (node(POSITIONS_SINGLE, (BTN_LEFT, BTN_TOOL_FINGER, BTN_TOUCH)), "a touchpad?"),
    "pen of a screen": (node(POSITIONS_SINGLE, (BTN_TOOL_PEN, BTN_STYLUS, BTN_TOUCH), (DIRECT,)), "a pen or a tablet?"),
    "tablet": (node(POSITIONS_SINGLE, (BTN_TOOL_PEN, BTN_STYLUS), (POINTER,)), "a pen or a tablet?"),
    "buttons of a tablet": (node((0, 1), (BTN_STYLUS, 0x100)), "a pen or a tablet?"),
}


@each_row("name", PANELS)
def test_panels_lack_nothing(name):
    assert what_is_lacking(PANELS[name]) == ""


@each_row("name", OTHERS)
def test_other_nodes_are_reported_by_what_they_lack(name):
    device, words = OTHERS[name]
    said = what_is_lacking(device)
    assert words in said
    assert "\n" not in said


def set_bits(text, pattern):
    rows = [int.from_bytes(bytes.fromhex(row), "little") for row in re.findall(pattern, text, flags=re.MULTILINE)]
    mask = sum(row << 64 * k for k, row in enumerate(rows))
    return tuple(bit for bit in range(mask.bit_length()) if mask >> bit & 1)


@each_row("path", [path for path in sorted(FOLDER.glob("*.ev*")) if "A: 35" in path.read_text()], ids=lambda path: path.name)
def test_the_panels_of_real_recordings_lack_nothing(path):
    text = path.read_text(encoding="utf-8")
    axes = [int(code, 16) for code in re.findall(r"^A: (\w+) ", text, flags=re.MULTILINE)]
    device = node(axes, set_bits(text, "^B: 01 (.*)$"), set_bits(text, "^P: (.*)$"))
    assert 1 not in device.codes or BTN_TOUCH in device.codes[1]
    if 1 not in device.codes:  # a recording of before the kernel reported what a device has
        device = node(axes, (BTN_TOUCH,))
    assert what_is_lacking(device) == ""
