"""What an input device lacks to be a touch panel: mice, gamepads, touchpads, pens and keyboards have nodes of the same kind.

As systemd's input_id tells them apart, but that panels whose drivers declare little, as older ones do, are taken.
"""

from __future__ import annotations

from controller.device.touch import event_codes as ev
from controller.device.touch.event_codes import Protocol, protocol_of_device
from controller.device.touch.event_reader import DeviceDescription


def what_is_lacking(device: DeviceDescription) -> str:
    """What a device lacks to be a touch panel, and what it is taken for; empty: nothing."""
    axes = set(device.axes)
    keys = set(device.codes.get(ev.EV_KEY, ()))
    direct = ev.INPUT_PROP_DIRECT in device.properties
    if {ev.ABS_MT_SLOT - 1, ev.ABS_MT_SLOT} <= axes:  # a device that claims every axis has none of multi-touch
        axes = {code for code in axes if code < ev.ABS_MT_SLOT}
    single = protocol_of_device(axes) is Protocol.SINGLE
    if not axes >= set(ev.POSITIONS_SINGLE if single else ev.POSITIONS):
        if device.codes.get(ev.EV_REL):
            return "it has no position axes, only steps: a mouse?"
        return "it has no position axes" + (": a keyboard or buttons?" if keys else "")
    if single and keys & {ev.BTN_TOOL_PEN, ev.BTN_STYLUS} and ev.BTN_TOOL_FINGER not in keys:
        return "it has no touch of fingers (ABS_MT_POSITION_X, or BTN_TOUCH without BTN_TOOL_PEN): a pen or a tablet?"
    if ev.INPUT_PROP_POINTER in device.properties or (ev.BTN_TOOL_FINGER in keys and not direct):
        return "it lacks the property of a screen, INPUT_PROP_DIRECT, and points from beside it: a touchpad?"
    if single and ev.BTN_TOUCH not in keys:
        if keys & set(ev.BUTTONS_OF_JOYSTICKS):
            return "it has no BTN_TOUCH, which tells of contact: a gamepad or joystick?"
        if keys & set(ev.BUTTONS_OF_MICE):
            return "it has no BTN_TOUCH, which tells of contact: a mouse with absolute positions?"
        return "it has no BTN_TOUCH, which tells of contact"
    if keys & set(ev.BUTTONS_OF_JOYSTICKS) and ev.BTN_TOUCH not in keys and not direct:
        return "it has neither BTN_TOUCH nor INPUT_PROP_DIRECT: a gamepad or joystick?"
    return ""
