"""The ring of turns and starts: what was put in comes out, the oldest first; only a late pulse asks to be explained."""

from types import SimpleNamespace

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tables import each_row

from controller.device.loop.rings.trace_ring import RECORD_BYTES, START, TURN, StartRecord, TraceRing, records_of

seconds = st.floats(0, 1e6)


def accepted(times_s, pulses, resident=False, by_clock=False):
    emissions = [SimpleNamespace(time_s=time_s, pulse=pulse) for time_s, pulse in zip(times_s, pulses, strict=True)]
    plan = SimpleNamespace(
        batch=SimpleNamespace(emissions=emissions), resident=1 if resident else None, start_ticks=5 if by_clock else None
    )
    return SimpleNamespace(plan=plan, ready_s=10.0, decide_ns=20_000, frame_ns=50_000, wire_ns=1_356_000)


@given(st.lists(st.tuples(seconds, seconds, st.integers(-1, 10**9), st.integers(0, 10**6), st.booleans()), max_size=20))
def test_the_newest_records_come_out_the_oldest_first(turns):
    ring = TraceRing(8)
    for began_s, ended_s, report_ns, due, started in turns:
        ring.turn(began_s, ended_s, report_ns, due, started=started)
    found = list(records_of(ring.bytes, ring.at))
    assert [(record.began_s, record.ended_s, record.started) for record in found] == [(b, e, s) for b, e, _, _, s in turns[-8:]]
    assert [record.due for record in found] == [min(due, 65535) for *_, due, _ in turns[-8:]]
    assert [record.report_age_s for record in found] == pytest.approx([ns * 1e-9 for *_, ns, _, _ in turns[-8:]], rel=1e-6)


def test_a_start_is_kept_with_its_parts_and_a_record_is_small():
    ring = TraceRing(4)
    ring.started(accepted([3.5, 3.0], [0, 0], resident=True, by_clock=True), 12.0, 1.0)
    (found,) = records_of(ring.bytes, ring.at)
    assert isinstance(found, StartRecord)
    assert (found.due_s, found.ready_s, found.start_s, found.foci) == (2.0, 10.0, 12.0, 2)
    assert (found.pulse, found.resident, found.by_clock) == (False, True, True)
    assert (found.decide_s, found.frame_s, found.wire_s) == pytest.approx((2e-5, 5e-5, 1.356e-3))
    assert START.size == TURN.size == RECORD_BYTES == 48


@each_row(("pulses", "late_s", "asked"), [((0, 7), 2.1e-3, True), ((0, 7), 1.9e-3, False), ((0, 0), 1.0, False)])
def test_a_pulse_that_is_more_than_2_ms_late_asks_and_nothing_else(pulses, late_s, asked):
    ring, reasons = TraceRing(4), []
    ring.asked = reasons.append
    ring.started(accepted([1.0, 5.0], pulses), 5.0 + late_s, 0.0)
    assert reasons == (["a pulse was 2.1 ms late"] if asked else [])
