"""Decisions that a live panel's source makes without a report: in time, after what waits to be read, forgotten with the panel."""

from collections import Counter

import pytest

from controller.device.board.board import load_board
from controller.device.board.lookup import data_folder
from controller.device.service.drivers import tracked
from controller.device.touch.event_reader import AxisInfo, DeviceDescription
from controller.device.touch.live_source import LiveSource

BOARD = load_board(data_folder("boards") / "simulated")
X, Y, ID, SLOT = 0x35, 0x36, 0x39, 0x2F
REPORT, MT_REPORT = (0, 0, 0), (0, 2, 0)


def description(*, slots):
    axes = {X: AxisInfo(0, 2100), Y: AxisInfo(0, 1480)}
    return DeviceDescription("panel", axes=axes | ({SLOT: AxisInfo(0, 9), ID: AxisInfo(0, 65535)} if slots else {}))


class Reader:
    """Gives reports as the kernel does, each at once, whenever it is asked after its time."""

    def __init__(self, *, slots):
        self.warnings, self.description, self.present = Counter(), description(slots=slots), True
        self.waiting, self.reads = [], 0

    def fileno(self):
        return None

    def next_time_s(self):
        return None

    def read(self, now_s):
        self.reads += 1
        return self.waiting.pop(0) if self.waiting and self.waiting[0][-1][3] <= now_s else ()

    def close(self):
        self.waiting.clear()

    def put(self, time_s, *events):
        self.waiting.append([(*event, time_s) for event in (*events, REPORT)])


def a(x_mm):
    return (3, X, 10 * x_mm), (3, Y, 500), MT_REPORT


REST = a(50)


def touched(reader, source, *times_s, events=REST):
    for time_s in times_s:
        reader.put(time_s, *events)
        yield from source.read(time_s)


def test_a_silence_is_decided_in_time_and_without_a_system_call():
    reader = Reader(slots=False)
    source = LiveSource(reader, BOARD)
    assert [s.contact for s in touched(reader, source, 1.0, 1.01, 1.02)] == [True]
    due_s = source.next_time_s()
    assert due_s == pytest.approx(1.08)
    source.silence.known = True
    reads = reader.reads
    assert source.read(due_s - 1e-6) == ()
    (released,) = source.read(due_s)
    assert (released.contact, released.time_s, reader.reads) == (False, due_s, reads)
    assert source.next_time_s() is None


def test_what_waits_to_be_read_comes_before_a_decision_of_a_loop_that_was_busy():
    reader = Reader(slots=False)
    source = LiveSource(reader, BOARD)
    list(touched(reader, source, 1.0, 1.01, 1.02))
    for k in range(20):
        reader.put(1.03 + 0.01 * k, *a(50))
    for _ in range(20):
        assert source.read(1.3) == ()
    assert [s.contact for s in source.read(1.3)] == [False], "the last report is 80 ms old"
    assert source.warnings["fallen_silent"] == 1


def test_a_step_that_waits_is_decided_by_a_live_panel_too():
    reader = Reader(slots=True)
    source = LiveSource(reader, BOARD)
    list(touched(reader, source, 1.0, events=[(3, ID, 1), (3, X, 500), (3, Y, 500)]))
    list(touched(reader, source, 1.01, events=[(3, X, 501)]))
    assert list(touched(reader, source, 1.02, events=[(3, X, 1500)])) == []
    due_s = source.next_time_s()
    assert due_s == pytest.approx(1.035)
    assert [round(s.x_m, 6) for s in source.read(due_s)] == [0.15]
    assert source.next_time_s() is None


def test_another_panel_on_the_same_port_is_measured_and_evaluated_anew():
    reader = Reader(slots=False)
    tracker = tracked(LiveSource(reader, BOARD), BOARD)
    for k in range(30):
        reader.put(1.0 + 0.03 * k, *a(50))
        tracker.read(1.0 + 0.03 * k)
    assert tracker.rate.period_s == pytest.approx(0.03, rel=0.02)
    reader.put(1.9, MT_REPORT)
    tracker.read(1.9)
    while (due_s := tracker.next_time_s()) is not None:
        tracker.read(due_s)
    before = tracker.figures()["plausibility"]["points"]
    reader.description = description(slots=True)
    for k in range(3):
        reader.put(3.0 + 0.005 * k, (3, ID, 1), (3, X, 500 + k), (3, Y, 500))
        tracker.read(3.0 + 0.005 * k)
    assert tracker.rate.period_s == pytest.approx(0.005, rel=0.02)
    assert tracker.next_time_s() is None, "it may be silent while a finger rests"
    assert tracker.figures()["plausibility"]["points"] == before + 3
