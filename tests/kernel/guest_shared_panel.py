"""Runs in the guest: contacts of a GT911 and of a serial panel, handed on to other programs as a touch screen by uinput.

As the service does it: the panel is read by its own process. The other program is an evdev reader, as libinput is.
"""

import contextlib
import select
import sys
import time
from pathlib import Path

import msgspec

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent / "device/touch"))

from evdev import InputDevice, list_devices  # noqa: E402
from evdev import ecodes as e  # noqa: E402
from far_end_i2c import bus_path  # noqa: E402
from guest_panels import AXES_MM, bench, places  # noqa: E402
from peers.gt911_chip import Gt911Chip  # noqa: E402
from serial_finger import SerialPanel  # noqa: E402

from controller.device.board.board import load_board  # noqa: E402
from controller.device.board.lookup import find_board  # noqa: E402
from controller.device.service.drivers import await_panel  # noqa: E402
from controller.device.touch.drivers.event_device import LinuxInput  # noqa: E402
from controller.device.touch.drivers.screen import NODE  # noqa: E402
from controller.device.touch.live_source import LiveSource  # noqa: E402
from controller.device.touch.panels.gt911 import Gt911Touch  # noqa: E402
from controller.device.touch.panels.serial_panel import EloTouch  # noqa: E402

SIMULATED = load_board(find_board("simulated"))
DEADLINE_S = 60.0  # the process has much to import


def board_of(touch):
    return msgspec.structs.replace(SIMULATED, touch=touch)


def gt911_board():
    return board_of(Gt911Touch(bus=bus_path(), interrupt_chip="panel", interrupt_line="TOUCH_INT", share=True, **AXES_MM))


@contextlib.contextmanager
def served(board):
    """The loop's end of a panel in its own process, connected."""
    panel = await_panel(board)
    source = LiveSource(panel, board)
    try:
        read_until(source, lambda _: panel.present)
        yield panel, source
    finally:
        source.close()


def read_until(source, condition):
    """Samples read until they, or something else, are what is waited for."""
    samples, ends_s = [], time.monotonic() + DEADLINE_S
    while not condition(samples):
        assert time.monotonic() < ends_s, (samples, dict(source.warnings))
        select.select([source.fileno()], [], [], 0.2)
        samples += source.read(time.monotonic())
    return samples


def screens():
    """Paths of the touch screens that were made, by name."""
    return {InputDevice(path).name: path for path in list_devices() if "(haptic-panel)" in InputDevice(path).name}


def gone(name):
    ends_s = time.monotonic() + DEADLINE_S
    while name in screens():
        assert time.monotonic() < ends_s, f"{name} is still there"


def seen_by_others(name):
    """What another program reads of the touch screen, whose axes are the plate's."""
    other = msgspec.structs.replace(SIMULATED.touch, **AXES_MM)
    return LiveSource(LinuxInput(name), board_of(other))


def test_fingers_of_a_gt911_are_those_of_a_touch_screen_with_the_plates_axes():
    chip = Gt911Chip(width=2100, height=1480)
    with bench(chip) as far_end, served(gt911_board()) as (panel, source):
        assert panel.description.remark == ""
        assert list(screens()) == ["GT911 (haptic-panel)"]
        device = InputDevice(screens()["GT911 (haptic-panel)"])
        axes = dict(device.capabilities()[e.EV_ABS])
        extents = [(axes[code].min, axes[code].max, axes[code].resolution) for code in (e.ABS_MT_POSITION_X, e.ABS_MT_POSITION_Y)]
        assert extents == [(0, 21000, 100), (0, 14800, 100)]
        assert axes[e.ABS_MT_SLOT].max == 9
        assert device.input_props() == [e.INPUT_PROP_DIRECT]
        other = seen_by_others("GT911 (haptic-panel)")
        far_end.touch({0: (100, 200), 3: (300, 400)})
        wanted = [(0, 10, 20, True), (1, 30, 40, True)]
        assert places(read_until(source, lambda samples: len(samples) >= 2)) == wanted
        assert places(read_until(other, lambda samples: len(samples) >= 2)) == wanted
        assert e.BTN_TOUCH in device.active_keys()
        far_end.touch({3: (310, 400)})
        assert places(read_until(other, lambda samples: len(samples) >= 2)) == [(0, 10, 20, False), (1, 31, 40, True)]
        far_end.touch({})
        assert places(read_until(other, bool)) == [(1, 31, 40, False)]
        assert e.BTN_TOUCH not in device.active_keys()
        other.close()
        device.close()


def test_the_screen_goes_with_the_service_and_lifts_what_was_down():
    chip = Gt911Chip(width=2100, height=1480)
    with bench(chip) as far_end:
        with served(gt911_board()):
            other = seen_by_others("GT911 (haptic-panel)")
            far_end.touch({0: (100, 200)})
            assert places(read_until(other, bool)) == [(0, 10, 20, True)]
        assert places(read_until(other, bool)) == [(0, 10, 20, False)], "lifted for the other program too"
        gone("GT911 (haptic-panel)")
        other.close()


def test_without_uinput_the_panel_works_and_says_why_it_is_not_shared():
    chip = Gt911Chip(width=2100, height=1480)
    away = NODE.with_name("uinput.away")
    NODE.rename(away)
    try:
        with bench(chip) as far_end, served(gt911_board()) as (panel, source):
            assert panel.description.remark == (
                "touch.share: its contacts are not handed on to other programs: "
                "there is no /dev/uinput: load the kernel module uinput (modprobe uinput)"
            )
            far_end.touch({0: (100, 200)})
            assert places(read_until(source, bool)) == [(0, 10, 20, True)]
    finally:
        away.rename(NODE)
    assert not screens()


def test_a_serial_panel_is_shared_from_a_process_of_its_own():
    port = SerialPanel()
    board = board_of(EloTouch(device=port.device, share=True, **AXES_MM))
    with served(board) as (_, source):
        other = seen_by_others("Elo SmartSet (haptic-panel)")
        with port.finger([(4095, 0)] * 3):
            for each in (source, other):
                assert places(read_until(each, bool))[0] == (0, 210, 0, True)
        assert places(read_until(other, lambda samples: not samples or not samples[-1].contact))[-1:] in ([], [(0, 210, 0, False)])
        other.close()
