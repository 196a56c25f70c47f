import gc
import math
import sys
import tracemalloc
from functools import partial
from pathlib import Path

import msgspec
import pytest
from alone import alone
from hypothesis import given
from hypothesis import strategies as st

from controller.device.board.touch_panels import TouchPanel
from controller.device.touch.recordings.recording import Recording
from controller.device.touch.recordings.replay import RecordingSource
from controller.device.touch.tracker import Tracker

sys.path.insert(0, str(Path(__file__).parent))

from scripted_source import ScriptedSource, played, touch
from tables import each_row

TOUCH = TouchPanel(x_mm_from_axes=(210.0, 0.0, 0.0), y_mm_from_axes=(0.0, 148.0, 0.0), max_size_mm=30.0)
PERIOD_S = 10e-3


def tracker(*reports, **settings):
    return Tracker(ScriptedSource(*reports), msgspec.structs.replace(TOUCH, **settings), 0.210, 0.148)


def in_short(samples):
    return [(s.finger, round(s.x_m * 1e3, 6), round(s.time_s, 6), s.contact) for s in samples]


def reports(*places_mm, finger=0, start_s=1.0):
    """One finger along x, a report each 10 ms; None: it is away."""
    return [(start_s + k * PERIOD_S, [] if x is None else [touch(finger, x)]) for k, x in enumerate(places_mm)]


def test_a_finger_passes_through_at_once_and_is_released_after_the_time_for_coming_back():
    t = tracker(*reports(100, 101, 102, None))
    assert in_short(t.read(1.0)) == [(0, 100, 1.0, True)]
    assert in_short(t.read(1.01)) == [(0, 101, 1.01, True)]
    assert in_short(t.read(1.02)) == [(0, 102, 1.02, True)]
    assert t.read(1.03) == ()
    due_s = t.next_time_s()
    assert due_s == pytest.approx(1.03 + 1.5 * t.rate.period_s)
    assert t.read(due_s - 1e-6) == ()
    assert in_short(t.read(due_s)) == [(0, 102, 1.03, False)]  # with the time at which the panel reported it
    assert t.next_time_s() is None


def test_a_finger_lost_for_one_report_stays_the_same():
    t = tracker((1.0, [touch(0, 100)]), (1.01, []), (1.02, [touch(1, 101)]), (1.03, [touch(1, 102)]), (1.04, []))
    assert in_short(played(t)) == [(0, 100, 1.0, True), (0, 101, 1.02, True), (0, 102, 1.03, True), (0, 102, 1.04, False)]
    assert t.tracking.bridged == 1


def test_a_contact_whose_release_waits_to_be_read_is_not_confirmed_by_the_time_that_the_loop_was_busy():
    t = tracker((1.0, [touch(0, 100)]), (1.01, []))
    t.read(1.1)
    assert not t.confirmed(0)
    t = tracker((1.0, [touch(0, 100)]))
    t.read(1.0)
    t.read(1.1)
    assert t.confirmed(0)


def test_a_fast_finger_that_is_lost_for_a_report_is_the_same_where_it_would_be_by_now():
    steps = [(1 + k * PERIOD_S, [touch(k > 6, 50 + 10 * k)] if k != 6 else []) for k in range(12)]  # 1 m/s
    t = tracker(*steps)
    assert {s.finger for s in played(t, 1.115)} == {0}
    assert t.tracking.bridged == 1


def test_two_fingers_that_are_lost_together_while_they_pass_each_other_are_not_swapped():
    def passing(k):  # 150 mm/s each, 2 mm apart; the panel tells first the one that it reported last before
        places = [touch(0, 80 + 1.5 * k, 50.0), touch(1, 98 - 1.5 * k, 52.0)]
        return places if k < 6 else [] if k == 6 else [places[1]._replace(finger=2), places[0]._replace(finger=3)]

    t = tracker(*[(1 + k * PERIOD_S, passing(k)) for k in range(12)])
    samples = played(t, 1.115)
    assert t.tracking.bridged == 2
    for finger, y_mm in ((0, 50), (1, 52)):
        assert {round(s.y_m * 1e3, 6) for s in samples if s.finger == finger} == {y_mm}


def test_a_finger_found_again_is_predicted_again():
    steps = [(1 + k * PERIOD_S, [touch(k > 20, 50 + k)] if k != 20 else []) for k in range(60)]
    t = tracker(*steps, lag_ms=10.0)
    played(t, 1.585)
    assert t.predict(0, 1.59)[0] * 1e3 == pytest.approx(110, abs=0.01)


@pytest.mark.parametrize(("where_mm", "back_s"), [(106, 1.02), (101, 1.0251)])
def test_who_comes_back_too_far_off_or_too_late_is_another_finger(where_mm, back_s):
    found = in_short(played(tracker((1.0, [touch(0, 100)]), (1.01, []), (back_s, [touch(1, where_mm)]), (back_s + 0.01, []))))
    assert [sample for sample in found if sample[0] == 0] == [(0, 100, 1.0, True), (0, 100, 1.01, False)]
    assert (1, where_mm, back_s, True) in found


def test_another_number_at_the_same_place_in_the_same_report_is_the_same_finger():
    assert in_short(played(tracker((1.0, [touch(0, 100)]), (1.01, [touch(5, 100.5)]), (1.02, [])))) == [
        (0, 100, 1.0, True),
        (0, 100.5, 1.01, True),
        (0, 100.5, 1.02, False),
    ]


def test_of_two_lost_fingers_each_is_found_at_its_own_place():
    t = tracker((1.0, [touch(0, 100), touch(1, 120)]), (1.01, []), (1.02, [touch(2, 121), touch(3, 99)]), (1.03, []))
    assert sorted(in_short(played(t))) == sorted(
        [(finger, x_mm, at_s, at_s < 1.03) for finger, x_mm, at_s in ((0, 100, 1.0), (0, 99, 1.02), (0, 99, 1.03))]
        + [(finger, x_mm, at_s, at_s < 1.03) for finger, x_mm, at_s in ((1, 120, 1.0), (1, 121, 1.02), (1, 121, 1.03))]
    )
    assert t.tracking.bridged == 2


def test_a_contact_lost_before_it_was_confirmed_is_not_confirmed_by_the_time_it_has_to_come_back():
    t = tracker((1.0, [touch(0, 100)]), (1.004, []), (1.1, []))
    t.read(1.0)
    t.read(1.004)
    assert not t.read(1.018)
    assert not t.confirmed(0)
    assert in_short(played(t, 1.05)) == [(0, 100, 1.004, False)]
    assert not t.confirmed(0)


def test_a_contact_is_a_finger_from_its_nth_report_on():
    t = tracker(*reports(100, 101, 102, 103, None), confirm_reports=3)
    assert in_short(played(t)) == [(0, 102, 1.02, True), (0, 103, 1.03, True), (0, 103, 1.04, False)]


def test_a_contact_gone_before_is_never_given():
    t = tracker(*reports(100, 101, None, None, 150, 151, None), confirm_reports=3)
    assert played(t) == []
    assert t.tracking.flickers == 2


def test_silence_counts_as_reports_that_found_the_contact_still_there():
    """A panel of protocol B does not report a still finger again."""
    t = tracker((1.0, [touch(0, 100)]), (2.0, []), confirm_reports=3)
    assert t.read(1.0) == ()
    assert in_short(played(t, 1.5)) == [(0, 100, 1.03, True)]


def test_reports_of_another_finger_count_for_one_that_keeps_still():
    still = touch(0, 100)
    t = tracker(*[(1 + k * PERIOD_S, [still, touch(1, 20 + k)]) for k in range(3)], confirm_reports=2)
    assert in_short(t.read(1.0)) == []
    assert sorted(in_short(t.read(1.01))) == [(0, 100, 1.01, True), (1, 21, 1.01, True)]


def test_a_finger_that_is_played_wakes_nobody_when_something_sounds():
    t = tracker(*reports(100), ghost_ms=30.0)
    t.read(1.0)
    t.emitted(1.001, 1.003)
    assert t.next_time_s() is None


def test_each_report_of_another_finger_counts_once():
    still = touch(0, 100)
    t = tracker(*[(1 + k * PERIOD_S, [still, touch(1, 20 + k)]) for k in range(4)], confirm_reports=4)
    assert [len(t.read(1 + k * PERIOD_S)) for k in range(4)] == [0, 0, 0, 2]


def test_what_the_panel_reports_is_heard_before_ghosts_are_rejected():
    t = tracker(*reports(100, None), ghost_ms=30.0)
    t.heard = (heard := []).append
    t.emitted(0.999, 1.001)
    assert t.read(1.0) == t.read(1.01) == ()
    assert [in_short(samples) for samples in heard] == [[(0, 100, 1.0, True)], [(0, 100, 1.01, False)]]
    assert t.tracking.ghosts == 1
    t.heard = None
    t.read(1.02)


def test_a_finger_that_becomes_a_palm_is_released_at_once_and_a_suspect_is_no_ghost_then():
    palm = touch(0, 100)._replace(size_m=math.inf)  # what the stage before says of it

    class Source(ScriptedSource):
        def read(self, now_s):
            samples = super().read(now_s)
            return tuple([s if s.contact else s._replace(size_m=palm.size_m) for s in samples])

    t = Tracker(Source((1.0, [touch(0, 100)]), (1.01, [])), TOUCH, 0.210, 0.148)
    t.read(1.0)
    assert in_short(t.read(1.01)) == [(0, 100, 1.01, False)]
    t = Tracker(Source((1.0, [touch(0, 100)]), (1.01, [])), TOUCH, 0.210, 0.148)
    t.emitted(0.999, 1.001)
    assert played(t) == []
    assert (t.tracking.held_back, t.tracking.ghosts, t.tracking.flickers) == (1, 0, 0)


def test_the_place_of_a_lost_finger_is_the_last_one_and_that_of_a_released_one_is_unknown():
    t = tracker(*reports(100, 103, 106, None), lag_ms=20.0)
    for at_s in (1.0, 1.01, 1.02):
        t.read(at_s)
    assert t.predict(0, 1.023)[0] > 0.107
    t.read(1.03)
    assert t.predict(0, 1.033) == (0.106, 0.05)
    played(t)
    assert t.predict(0, 1.05) is None
    assert t.predict(7, 1.05) is None
    assert t.confirmed(0), "what it feels as it is lifted is still to be decided"
    t.read(1.06)
    assert not t.confirmed(0)
    assert not t.confirmed(7)


@each_row(
    ("from_mm", "step_mm", "held_m"),
    [
        ((190, 50), (5, 0), (0.210, 0.05)),
        ((20, 50), (-5, 0), (0.0, 0.05)),
        ((100, 128), (0, 5), (0.1, 0.148)),
        ((100, 20), (0, -5), (0.1, 0.0)),
    ],
)
def test_predicted_places_are_held_to_the_plate(from_mm, step_mm, held_m):
    places = [[start + k * step for start, step in zip(from_mm, step_mm, strict=True)] for k in range(5)]
    t = tracker(*[(1.0 + k * PERIOD_S, [touch(0, *place)]) for k, place in enumerate(places)], lag_ms=30.0)
    played(t)
    assert t.predict(0, 1.05) == pytest.approx(held_m)


def test_the_lag_of_the_panel_is_made_up_for():
    for lag_ms, x_mm in ((0.0, 199.0), (10.0, 200.0), (20.0, 201.0)):
        t = tracker(*reports(*range(100, 200)), lag_ms=lag_ms)
        played(t)
        assert t.predict(0, 1.99)[0] * 1e3 == pytest.approx(x_mm, abs=0.005)


def test_a_contact_is_confirmed_by_its_second_report_or_by_silence_for_as_long():
    t = tracker(*reports(100, 101))
    t.read(1.0)
    assert not t.confirmed(0)
    t.read(1.01)
    assert t.confirmed(0)
    t = tracker(*reports(100))
    t.read(1.0)
    t.read(1.0149)
    assert not t.confirmed(0)
    t.read(1.0151)
    assert t.confirmed(0)


def test_rate_and_jitter_are_those_of_the_panel():
    at_s, times_s = 1.0, []
    for k in range(500):
        at_s += 8e-3 + (1e-3 if k % 10 == 0 else 0) - (1e-3 if k % 10 == 5 else 0)
        times_s.append(at_s)
    t = tracker(*[(time_s, [touch(0, 50 + 0.1 * k)]) for k, time_s in enumerate(times_s)])
    played(t)
    assert t.rate.median_s == pytest.approx(8.1e-3, abs=0.13e-3)
    assert t.rate.jitter_s == pytest.approx(2e-3, abs=0.26e-3)
    assert t.rate.period_s == pytest.approx(8e-3, rel=0.05)


def test_a_slow_panel_that_reports_changes_only_shows_its_period_by_the_first_finger_that_comes_back():
    """A finger that rests, found at 0, 0.6, … s, lost for 30 ms each time."""
    t = tracker(*[report for k in range(9) for report in ((1 + 0.63 * k, [touch(k, 100)]), (1.6 + 0.63 * k, []))])
    assert len({sample.finger for sample in played(t)}) == 2
    assert t.rate.period_s == pytest.approx(0.03)
    assert t.tracking.bridged == 7


def test_taps_50_ms_apart_are_taps_whatever_is_known_of_the_panel():
    t = tracker(*[report for k in range(9) for report in ((1 + 0.1 * k, [touch(k, 100)]), (1.05 + 0.1 * k, []))])
    assert len({sample.finger for sample in played(t)}) == 9
    assert t.rate.measured == t.tracking.bridged == 0


def test_pauses_between_touches_are_not_in_the_rate():
    t = tracker(*[report for k in range(9) for report in reports(50, 51, None, start_s=1 + 0.05 * k)])
    played(t)
    assert t.rate.median_s == pytest.approx(10e-3, abs=0.13e-3)
    assert t.rate.jitter_s == 0
    assert t.figures()["report_period_ms"] == pytest.approx(10, abs=0.13)
    assert t.figures()["report_jitter_ms"] == 0


def test_a_panel_never_touched_has_no_rate():
    assert tracker().rate.median_s is None
    assert tracker().rate.jitter_s is None


@given(
    st.lists(
        st.tuples(
            st.floats(1e-4, 0.05),
            st.dictionaries(st.integers(0, 5), st.tuples(st.floats(0, 210), st.floats(0, 40)), max_size=4),
        ),
        max_size=30,
    ),
    st.integers(1, 4),
    st.lists(st.tuples(st.floats(0, 1), st.floats(1e-4, 0.1)), max_size=5),
)
def test_whatever_comes_each_finger_begins_moves_and_is_released_once(steps, confirm_reports, emissions):
    at_s, script, used, down = 0.0, [], {}, {}
    for step_s, contacts in steps:
        at_s += step_s
        down = {key: down.get(key, (key, len(script))) for key in contacts}  # a number is never used twice
        for number in down.values():
            used.setdefault(number, len(used))
        script.append((at_s, [touch(used[down[key]], x_mm, size_mm=size_mm) for key, (x_mm, size_mm) in contacts.items()]))
    script.append((at_s + 0.01, []))
    t = tracker(*script, confirm_reports=confirm_reports)
    for start_s, duration_s in sorted(emissions):
        t.emitted(start_s, start_s + duration_s)
    begun, ended, last = set(), set(), {}
    for sample in played(t):
        assert sample.finger not in ended
        assert sample.contact or sample.finger in begun
        assert sample.contact or (sample.x_m, sample.y_m) == last[sample.finger]
        (begun if sample.contact else ended).add(sample.finger)
        last[sample.finger] = (sample.x_m, sample.y_m)
    assert begun == ended
    assert t.next_time_s() is None


@pytest.mark.parametrize("name", ["dell_canvas_touch.evemu", "ep0430m09.4-finger-drag-down.events"])
def test_a_recording_passes_through_but_for_what_is_bridged(board, name):
    recording = Recording.open(Path(__file__).parent / "recordings" / name)
    axes = recording.axes(board)
    bare = played(RecordingSource(recording, axes, 0.0))
    t = Tracker(RecordingSource(recording, axes, 0.0), board.touch, board.plate.length_m, board.plate.width_m)
    found = played(t)
    assert t.tracking.bridged == t.tracking.ghosts == t.figures()["palms"] == 0
    assert sorted(found) == sorted(bare)
    assert [s for s in found if s.contact] == [s for s in bare if s.contact]
    assert t.counts.contacts == len({s.finger for s in bare})


def peak_of_a_turn_bytes(fingers):
    """Largest growth of memory within a turn, and what is kept from 200 of them; it goes on tracing."""
    script = [(k * PERIOD_S, [touch(finger, 20 + 0.1 * k, 10 + 10 * finger) for finger in range(fingers)]) for k in range(400)]
    t = tracker(*script)
    samples = [t._source.read(k * PERIOD_S) for k in range(400)]
    turn = iter(range(400))
    t._source.read = lambda _: samples[next(turn)]
    largest = before = 0
    for k in range(400):
        if k == 200:
            gc.collect()
            gc.disable()
            tracemalloc.start()
            before, _ = tracemalloc.get_traced_memory()
        at_s = k * PERIOD_S
        tracemalloc.reset_peak()
        held, _ = tracemalloc.get_traced_memory()
        t.read(at_s)
        t.predict(0, at_s + 3e-3)
        t.confirmed(0)
        t.emitted(at_s, at_s + 2e-3)
        largest = max(largest, tracemalloc.get_traced_memory()[1] - held)
    after, _ = tracemalloc.get_traced_memory()
    return largest, after - before


def test_no_block_over_512_bytes_and_nothing_kept_from_report_to_report():
    """One finger's turn makes less in all; with ten only a list of ten pointers is larger."""
    largest, _ = alone(partial(peak_of_a_turn_bytes, 1))
    assert largest <= (512 if sys.version_info < (3, 14) else 640), "a tuple keeps its hash since Python 3.14"
    _, kept_by_few = alone(partial(peak_of_a_turn_bytes, 4))
    _, kept_by_many = alone(partial(peak_of_a_turn_bytes, 10))
    assert kept_by_few < 2048 > kept_by_many
