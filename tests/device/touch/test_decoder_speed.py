"""Benchmark: `pytest -o addopts=--import-mode=importlib --benchmark-only tests/device/touch/test_decoder_speed.py`."""

from controller.device.touch.axes import AxisRange, PanelAxes
from controller.device.touch.decoder import Decoder
from controller.device.touch.event_codes import Protocol


def report(moved, *, first=False):
    """Four fingers as a kernel driver tells them: 19 events, 23 when they begin."""
    events = []
    for slot in range(4):
        events += [(3, 0x2F, slot), *([(3, 0x39, slot)] if first else [])]
        events += [(3, 0x35, 100 + 200 * slot + moved), (3, 0x36, 100 + 100 * slot + moved), (3, 0x30, 40 + moved)]
    return [*events, (3, 0, 100 + moved), (3, 1, 100 + moved), (0, 0, 0)]


def test_a_report_of_four_moving_fingers(benchmark, board):
    decoder = Decoder(PanelAxes(board, AxisRange(0, 2100), AxisRange(0, 1480)), Protocol.B)
    for event in report(0, first=True):
        decoder.feed(*event, 0.0)
    reports = [report(1), report(2)]

    def two_reports():
        for events in reports:
            for kind, code, value in events:
                samples = decoder.feed(kind, code, value, 0.0)
        return samples

    assert len(benchmark(two_reports)) == 4


def test_a_report_of_ten_moving_fingers_without_identities(benchmark, board):
    decoder = Decoder(PanelAxes(board, AxisRange(0, 2100), AxisRange(0, 1480)), Protocol.A)

    def report_of_ten(moved):
        places = ((100 + 200 * finger + moved, 100 + 100 * finger + moved) for finger in range(10))
        return [event for x, y in places for event in ((3, 0x35, x), (3, 0x36, y), (0, 2, 0))] + [(0, 0, 0)]

    reports = [report_of_ten(0), report_of_ten(1)]

    def two_reports():
        for events in reports:
            for kind, code, value in events:
                samples = decoder.feed(kind, code, value, 0.0)
        return samples

    assert len(benchmark(two_reports)) == 10
