"""`LinuxInput` on a pipe in place of an event device: one report a read, however many wait, and the state after a loss."""

import errno
import os
import select
from types import SimpleNamespace

import pytest

from controller.device.touch import event_codes as ev
from controller.device.touch.drivers import event_device, input_device
from controller.device.touch.drivers.event_device import BUFFERED_EVENTS, INPUT_EVENT, LinuxInput
from controller.device.touch.event_reader import AxisInfo, DeviceDescription
from controller.errors import TouchError

END, DROPPED, PACKET = (ev.EV_SYN, ev.SYN_REPORT, 0), (ev.EV_SYN, ev.SYN_DROPPED, 0), (ev.EV_SYN, ev.SYN_MT_REPORT, 0)
STATE = [PACKET, END]  # of protocol A, of which the kernel keeps none


def x(value):
    return (ev.EV_ABS, ev.ABS_MT_POSITION_X, value)


@pytest.fixture
def panel(monkeypatch):
    """A reader that has given its first state, and what sends events to it."""
    reading, writing = os.pipe()
    os.set_blocking(reading, False)
    opened = SimpleNamespace(fd=reading, close=lambda: os.close(reading))
    description = DeviceDescription("pipe", axes=dict.fromkeys(ev.POSITIONS, AxisInfo(0, 1)))
    monkeypatch.setattr(event_device, "open_touch_device", lambda *_, **__: (opened, description))
    reader = LinuxInput("")
    assert read(reader) == STATE
    yield reader, lambda *events: os.write(writing, b"".join(INPUT_EVENT.pack(1, 500_000, *event) for event in events))
    reader.close()
    os.close(writing)


def read(reader):
    events = reader.read(2.0)
    assert all(time_s == (2.0 if [e[:3] for e in events] == STATE else 1.5) for *_, time_s in events)
    return [event[:3] for event in events]


def test_each_read_gives_one_report_and_the_time_for_the_next_is_now_while_one_waits(panel, monkeypatch):
    reader, send = panel
    assert (read(reader), reader.next_time_s()) == ([], None)
    send(x(1), END, x(2), PACKET, x(3), END, x(4))
    assert (read(reader), reader.next_time_s()) == ([x(1), END], 0.0)
    assert read(reader) == [x(2), PACKET, x(3), END]
    assert (read(reader), reader.next_time_s()) == ([x(4)], None)
    assert not reader.warnings
    # What is refused once it is open is closed again
    closed = []

    def refuse(error):
        raise error

    for error in (OSError(errno.EBUSY, "Device or resource busy"), ValueError("no axes")):
        device = SimpleNamespace(fd=-1, name="panel", grab=lambda error=error: refuse(error), close=lambda: closed.append(1))
        monkeypatch.setattr(input_device.evdev, "InputDevice", lambda _, device=device: device)
        monkeypatch.setattr(input_device, "_describe", lambda _: None)
        with pytest.raises(TouchError):
            input_device.open_touch_device("/dev/input/event9", grab=True)
    assert closed == [1, 1]


def test_a_report_longer_than_40_events_comes_in_parts(panel):
    reader, send = panel
    report = [x(value) for value in range(BUFFERED_EVENTS + 10)] + [END]
    send(*report)
    parts = [read(reader) for _ in range(3)]
    assert [event for part in parts for event in part] == report
    assert max(map(len, parts)) == 40


@pytest.mark.parametrize("rest", [[END], [x(2), END], [x(2), DROPPED, x(3), END, x(4), END]])
def test_after_a_loss_what_waits_is_left_out_up_to_the_end_of_its_report_and_the_state_given(panel, rest):
    reader, send = panel
    send(x(1), DROPPED, *rest)
    assert read(reader) == STATE
    assert (read(reader), reader.warnings["dropped"]) == ([], 1 + rest.count(DROPPED))


def test_a_loss_whose_report_has_not_ended_gives_nothing_until_it_has(panel):
    reader, send = panel
    send(x(1), DROPPED, x(2))
    assert read(reader) == []
    send(x(3), END)
    assert read(reader) == STATE


def test_a_loss_without_an_end_in_a_flood_leaves_the_loop_its_turn(panel):
    reader, send = panel
    send(DROPPED, *[x(value) for value in range(2000)])
    assert read(reader) == []
    assert select.select([reader.fileno()], [], [], 0)[0], "not all was read at once"
    assert read(reader) == []
    send(END)
    assert read(reader) == STATE


def test_a_device_that_is_gone_lifts_its_contacts(panel, monkeypatch):
    reader, _ = panel

    def gone(*_):
        raise OSError

    monkeypatch.setattr(os, "readv", gone)
    assert (read(reader), reader.present, reader.warnings) == (STATE, False, {"panel_lost": 1})
