"""A trace as a file: what Chrome's format asks for, a few records between two turns, and no file that nobody needs."""

import json
from types import SimpleNamespace

import pytest

from controller.clocks import NEVER
from controller.device.loop.rings.trace_ring import TraceRing
from controller.device.service.tracing.trace_file import AFTER_S, APART_S, FILES, TRACKS, TraceFile

FAR_S = 1.0


def ring_of(turns=100):
    ring = TraceRing(256)
    for number in range(turns):
        ring.turn(100 + number * 1e-3, 100 + number * 1e-3 + 2e-4, 50_000 if number % 2 else -1, number % 3, started=False)
    emission = SimpleNamespace(time_s=100.05, pulse=3)
    plan = SimpleNamespace(batch=SimpleNamespace(emissions=[emission]), resident=None, start_ticks=None)
    accepted = SimpleNamespace(plan=plan, ready_s=100.053, decide_ns=20_000, frame_ns=80_000, wire_ns=1_400_000)
    ring.started(accepted, 100.0545, 0.0)
    return ring


def traced(folder, ring):
    trace = TraceFile(folder, "simulated", 2e-3)
    trace.watch(ring)
    return trace


def used(trace, now_s, gap_s=FAR_S):
    """Turns with spare time until nothing is due; how many."""
    for number in range(1000):
        if trace.due_s > now_s:
            return number
        trace.use(now_s, now_s + gap_s)
        now_s += 0.01
    raise AssertionError("it never ends")


def test_the_file_is_a_trace_of_chromes_format(tmp_path):
    ring = ring_of()
    trace = traced(tmp_path, ring)
    ring.asked("a pulse was 4.5 ms late")
    trace.use(101.0, 101.0 + FAR_S)
    assert not list(tmp_path.iterdir()), "what comes after is kept too"
    assert used(trace, 101.0 + AFTER_S) > 2
    assert trace.due_s == NEVER
    (file,) = tmp_path.iterdir()
    assert file.name == "trace-1.json"
    assert file.stat().st_mode & 0o777 == 0o644
    read = json.loads(file.read_text())
    assert read["otherData"] == {"reason": "a pulse was 4.5 ms late", "board": "simulated", "release": "checkout"}
    names = {event["tid"]: event["args"]["name"] for event in read["traceEvents"] if event["name"] == "thread_name"}
    assert names == TRACKS
    events = [event for event in read["traceEvents"] if event["ph"] == "X"]
    assert all(event["dur"] >= 0 and event["ts"] >= -1 and event["pid"] == 1 and event["tid"] in TRACKS for event in events)
    assert sum(event["name"] == "turn" for event in events) == 100
    by_name = {event["name"]: event for event in events}
    assert by_name["upload and play"]["ts"] == pytest.approx(51_600, abs=0.2)
    assert by_name["upload and play"]["dur"] == pytest.approx(1400, abs=0.2)
    assert by_name["decide and pack"]["ts"] == pytest.approx(51_500, abs=0.2)
    assert by_name["wait"]["dur"] == pytest.approx(1500, abs=0.2)
    assert (by_name["pulse"]["ts"], by_name["pulse"]["dur"]) == pytest.approx((54_500, 2000), abs=0.2)
    assert by_name["pulse"]["args"]["late_us"] == pytest.approx(4500, abs=0.2)


def test_without_spare_time_it_waits_but_not_for_ever(tmp_path):
    trace = traced(tmp_path, ring_of())
    trace.ask("a pulse was late")
    trace.use(10.0, 10.0 + 1e-3)
    for now_s in (10.3, 10.9, 11.15):
        trace.use(now_s, now_s + 1e-3)
        assert not list(tmp_path.iterdir())
    trace.use(11.3, 11.3 + 1e-3)
    assert [file.suffix for file in tmp_path.iterdir()] == [".new"]


def test_what_nobody_asked_for_is_written_once_a_minute_and_the_newest_stay(tmp_path):
    ring = ring_of()
    trace = traced(tmp_path, ring)
    now_s = 200.0
    for _ in range(FILES + 2):
        ring.asked("a pulse was late")
        used(trace, now_s)
        used(trace, now_s + AFTER_S)
        ring.asked("a pulse was late")
        used(trace, now_s + APART_S / 2)
        assert trace.due_s == NEVER
        now_s += APART_S + 1.0
    assert {file.name for file in tmp_path.iterdir()} == {f"trace-{number}.json" for number in range(1, FILES + 1)}
    trace.ask("it was asked for (SIGUSR1)", by_hand=True)
    used(trace, now_s - APART_S)
    assert trace.due_s < NEVER, "at once, whenever the one before was"


def test_the_end_of_the_service_ends_the_file(tmp_path):
    trace = traced(tmp_path, ring_of())
    trace.ask("FAULT: OVER_TEMPERATURE")
    trace.close(300.0)
    assert json.loads((tmp_path / "trace-1.json").read_text())["otherData"]["reason"] == "FAULT: OVER_TEMPERATURE"
    trace.close(301.0)
    assert len(list(tmp_path.iterdir())) == 1


def test_a_folder_that_takes_nothing_costs_a_line_and_the_trace(tmp_path):
    trace = traced(tmp_path / "gone", ring_of())
    trace.ask("a pulse was late")
    trace.use(1.0, 2.0)
    trace.use(1.0 + AFTER_S, 2.0)
    assert trace.due_s == NEVER
    trace.ask("it was asked for (SIGUSR1)", by_hand=True)
    trace.close(5.0)


def test_without_a_folder_nothing_is_kept(tmp_path):
    ring = ring_of()
    trace = traced(None, ring)
    ring.asked("a pulse was late")
    assert trace.due_s == NEVER
    trace.close(1.0)
