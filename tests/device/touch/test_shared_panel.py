"""Contacts handed on to other programs: the touch screen that they see says what the panel said, on the plate, or nothing."""

import socket
from types import SimpleNamespace

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st
from test_panel_process import Ends, Scripted

from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.device.touch import event_codes as ev
from controller.device.touch.axes import AxisRange, PanelAxes
from controller.device.touch.decoder import Decoder
from controller.device.touch.drivers import screen as kernel_screen
from controller.device.touch.drivers.contact_events import ContactEvents, ReportedContact, describe
from controller.device.touch.drivers.panel_process import PanelProcess, serve_panel
from controller.device.touch.drivers.screen import KernelScreen
from controller.device.touch.drivers.shared_panel import SharedPanel
from controller.device.touch.event_codes import Protocol
from controller.device.touch.event_reader import AxisInfo, DeviceDescription
from controller.device.touch.panels.gt911 import Gt911Touch
from controller.errors import TouchError

BOARD = load_board(find_board("simulated"))
LENGTH_MM, WIDTH_MM = BOARD.plate.length_mm, BOARD.plate.width_mm
PANEL = describe("GT911", 1, 1000, 500, sized=True)
AXES_MM = {"x_mm_from_axes": (LENGTH_MM, 0.0, 0.0), "y_mm_from_axes": (0.0, WIDTH_MM, 0.0)}


class Seen:
    """What a program that reads the touch screen sees; a screen of the kernel's has the same axes."""

    def __init__(self, name, length_mm, width_mm):
        self.name = name
        self.events = []
        self.closed = False
        self.fails = False
        plate = SimpleNamespace(length_m=length_mm * 1e-3, width_m=width_mm * 1e-3)
        touch = msgspec.structs.replace(BOARD.touch, x_mm_from_axes=(length_mm, 0, 0), y_mm_from_axes=(0, width_mm, 0))
        ranges = [AxisRange(0, round(side * kernel_screen.UNITS_PER_MM)) for side in (length_mm, width_mm)]
        self.decoder = Decoder(PanelAxes(SimpleNamespace(touch=touch, plate=plate), *ranges), Protocol.B, last_slot=9)
        self.fingers = {}

    def report(self, events):
        if self.fails:
            raise OSError(19, "No such device")
        assert events[-1][:2] == (ev.EV_SYN, ev.SYN_REPORT)
        self.events.append(events)
        for sample in self.decoder.feed_report(events, events[-1][3]):
            if sample.contact:
                self.fingers[sample.finger] = (sample.x_m * 1e3, sample.y_m * 1e3)
            else:
                self.fingers.pop(sample.finger)

    def close(self):
        self.closed = True


class Sharing:
    """A panel that is shared, and what is seen of it."""

    def __init__(self, description=PANEL, **keys):
        self.screens = []
        self.now_s = 1.0
        touch = Gt911Touch(bus="/dev/i2c-1", **(AXES_MM | keys))
        self.shared = SharedPanel(touch, LENGTH_MM * 1e-3, WIDTH_MM * 1e-3, self.open)
        self.panel = ContactEvents(sized=True)
        self.shared.follow(description)

    def open(self, *arguments):
        self.screens.append(Seen(*arguments))
        return self.screens[-1]

    def report(self, *contacts):
        """Contacts (number, raw x, raw y[, size]) 10 ms later; places in mm that a program sees then."""
        self.now_s += 0.01
        self.shared.hand_on(self.panel.report([ReportedContact(*contact) for contact in contacts], self.now_s), self.now_s)
        return sorted(self.screens[-1].fingers.values())


def near(places, expected):
    assert len(places) == len(expected)
    assert [place[0] for place in places] == pytest.approx([place[0] for place in expected], abs=0.006), "half of its unit"
    assert [place[1] for place in places] == pytest.approx([place[1] for place in expected], abs=0.006)


steps = st.lists(st.tuples(st.integers(0, 9), st.booleans()), max_size=25)


@given(steps, st.data())
def test_what_is_down_is_seen_at_its_place_on_the_plate(steps, data):
    sharing, down = Sharing(), {}
    for number, lifted in steps:
        if lifted:
            down.pop(number, None)
        elif number not in down:  # it stays where it is: how far a finger may jump is another matter
            down[number] = (data.draw(st.integers(0, 1000)), data.draw(st.integers(0, 500)))
        places = sharing.report(*[(key, *place, 50) for key, place in sorted(down.items()) if place != (0, 0)])
        near(places, sorted((x / 1000 * LENGTH_MM, y / 500 * WIDTH_MM) for x, y in down.values() if (x, y) != (0, 0)))


def test_mirrored_and_swapped_axes_are_those_of_the_plate():
    sharing = Sharing(x_mm_from_axes=(0.0, -LENGTH_MM, LENGTH_MM), y_mm_from_axes=(WIDTH_MM, 0.0, 0.0))
    near(sharing.report((0, 250, 100)), [(LENGTH_MM * 0.8, WIDTH_MM * 0.25)])
    assert sharing.screens[0].name == "GT911 (haptic-panel)"


def test_a_finger_that_takes_the_number_of_another_is_another_finger():
    sharing = Sharing()
    sharing.report((0, 100, 100))
    sharing.report()
    sharing.report((0, 900, 400))
    tracking = [value for report in sharing.screens[0].events for _, code, value, _ in report if code == ev.ABS_MT_TRACKING_ID]
    assert tracking == [0, -1, 1]


def test_palms_and_places_without_fingers_are_not_handed_on():
    sharing = Sharing(max_size_mm=20.0, no_finger_mm=((0.0, 0.0, 20.0, WIDTH_MM),))
    assert sharing.report((0, 500, 250, 400), (1, 10, 250, 20)) == []
    near(sharing.report((0, 500, 250, 400), (2, 700, 250, 20)), [(0.7 * LENGTH_MM, 0.5 * WIDTH_MM)])


def test_a_panel_of_one_finger_without_slots_is_seen_with_slots():
    """As a serial panel reports: BTN_TOUCH, ABS_X and ABS_Y."""
    axes = dict.fromkeys(ev.POSITIONS_SINGLE, AxisInfo(0, 4095))
    sharing = Sharing(DeviceDescription("Elo", ev.BUS_RS232, properties=(ev.INPUT_PROP_DIRECT,), axes=axes))
    press = [(ev.EV_ABS, ev.ABS_X, 4095, 1.0), (ev.EV_ABS, ev.ABS_Y, 0, 1.0), (ev.EV_KEY, ev.BTN_TOUCH, 1, 1.0), (0, 0, 0, 1.0)]
    sharing.shared.hand_on(press, 1.0)
    near(sorted(sharing.screens[0].fingers.values()), [(LENGTH_MM, 0)])
    sharing.shared.hand_on([(ev.EV_KEY, ev.BTN_TOUCH, 0, 1.1), (0, 0, 0, 1.1)], 1.1)
    assert sharing.screens[0].fingers == {}


def test_a_screen_that_fails_is_counted_once_and_made_again_with_the_panel():
    sharing = Sharing()
    sharing.report((0, 100, 100))
    sharing.screens[0].fails = True
    sharing.report((0, 110, 100))
    sharing.report((0, 120, 100))
    assert sharing.shared.warnings == {"share_lost": 1}
    assert sharing.screens[0].closed
    sharing.panel = ContactEvents(sized=True)
    assert sharing.shared.follow(describe("GT911", 1, 1000, 500, sized=True)).remark == ""
    near(sharing.report((0, 500, 100)), [(0.5 * LENGTH_MM, 0.2 * WIDTH_MM)])
    assert len(sharing.screens) == 2


def refuse(*_):
    raise TouchError("there is no /dev/uinput")


def test_a_screen_that_cannot_be_made_is_a_remark_and_the_loop_has_its_touches():
    ends = Ends()
    touch = Gt911Touch(bus="/dev/i2c-1", **AXES_MM)
    report = [(ev.EV_ABS, ev.ABS_MT_POSITION_X, 100, 1.0), (0, 0, 0, 1.0)]

    def last(_reader):
        ends.ours.shutdown(socket.SHUT_WR)
        return ()

    reader = Scripted(lambda _: report, last)
    serve_panel(lambda: reader, ends.theirs, SharedPanel(touch, 0.21, 0.148, refuse))
    ends.theirs.shutdown(socket.SHUT_WR)
    panel = PanelProcess(ends)
    assert panel.read(0.0) == ()
    assert panel.description == reader.description
    assert panel.description.remark == "touch.share: its contacts are not handed on to other programs: there is no /dev/uinput"
    assert panel.read(0.0) == report
    ends.close()


def test_the_loop_has_a_report_before_other_programs_and_the_screen_goes_with_the_panel():
    ends, order = Ends(), []
    sharing = Sharing()
    seen = sharing.screens[0]
    seen.report = lambda _events: order.append(bool(ends.receive()))
    contacts = ContactEvents(sized=True)

    def first(_reader):
        for _ in range(2):  # description and presence
            ends.receive()
        return contacts.report([ReportedContact(0, 100, 100)], 1.0)

    def last(_reader):
        ends.ours.shutdown(socket.SHUT_WR)
        return ()

    reader = Scripted(lambda _: (), first, last)
    reader.description = PANEL
    serve_panel(lambda: reader, ends.theirs, sharing.shared)
    assert order == [True]
    assert seen.closed
    ends.close()


def test_without_the_kernels_device_the_reason_is_one_line(tmp_path, monkeypatch):
    monkeypatch.setattr(kernel_screen, "NODE", tmp_path / "uinput")
    with pytest.raises(TouchError, match=r"there is no .*uinput: load the kernel module uinput"):
        KernelScreen("panel", 210, 148)
    (tmp_path / "uinput").touch()
    with pytest.raises(TouchError, match="makes no touch screen"):
        KernelScreen("panel", 210, 148)
