import math
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from prediction_error import HORIZONS_MS, measure, overshoot_m, rest_m
from scripted_source import ScriptedSource, touch

from controller.device.board.touch_panels import TouchPanel
from controller.device.touch.prediction import (
    MAX_EXTRAPOLATION_M,
    MAX_HORIZON_S,
    MAX_INTERVAL_S,
    MAX_SPEED_RATIO,
    REST_RADIUS_M,
    REST_REPORTS,
    Motion,
)
from controller.device.touch.recordings.recording import Recording
from controller.device.touch.tracker import Tracker

TOUCH = TouchPanel(x_mm_from_axes=(210.0, 0.0, 0.0), y_mm_from_axes=(0.0, 148.0, 0.0))
PERIOD_S = 8e-3
FOLDER = Path(__file__).parent / "recordings"
DEMO = Path(__file__).parents[3] / "boards" / "simulated" / "demo.evemu"
CLICK = '[[regions]]\nname = "all"\nshape = "plate"\neffects = [{ effect = "texture", spacing_mm = 5.0 }]\n'


def moved(way, period_s=PERIOD_S):
    """A motion that was given the places `way` gives at each report, from time 0 on."""
    motion = Motion(*way(0.0), 0.0)
    for k in range(1, 100):
        motion.report(*way(k * period_s), k * period_s)
    return motion


def place(motion, ahead_s, lag_s=0.0, known_s=None, period_s=PERIOD_S):
    """Its place so long after its last report; unless set otherwise, nothing later is known."""
    return motion.predict(motion.time_s + ahead_s, motion.time_s if known_s is None else known_s, lag_s, period_s)


@pytest.fixture(scope="module")
def recorded():
    return [Recording.open(path) for path in [*sorted(FOLDER.glob("*.ev*")), DEMO]]


@pytest.fixture(scope="module")
def ours(recorded):
    return measure(recorded)


@given(st.floats(-0.5, 0.5), st.floats(-0.5, 0.5), st.floats(0, 0.015), st.floats(0.004, 0.012))
def test_a_finger_of_constant_velocity_is_met_exactly(vx, vy, lag_s, period_s):
    end_s = 99 * period_s
    motion = moved(lambda time_s: (vx * time_s, vy * time_s), period_s)
    at_s = end_s + 0.7 * period_s
    x_m, y_m = motion.predict(at_s, end_s, lag_s, period_s)
    resting = REST_RADIUS_M if math.hypot(vx, vy) * 9 * period_s < 2 * REST_RADIUS_M else 0  # so slow that it may count as at rest
    assert math.hypot(x_m - vx * (at_s + lag_s), y_m - vy * (at_s + lag_s)) <= 1e-6 + 3 * resting


def test_one_percent_more_or_less_ahead_is_seen():
    motion = moved(lambda time_s: (0.3 * time_s, 0.0))
    x_m, _ = place(motion, 5e-3, 10e-3)
    assert x_m - motion.x_m == pytest.approx(0.3 * 15e-3, rel=1e-4)


@given(st.lists(st.tuples(st.floats(-1.7e-4, 1.7e-4), st.floats(-1.7e-4, 1.7e-4)), min_size=20, max_size=60))
def test_a_finger_at_rest_has_one_place_whatever_noise_its_reports_have(noise):
    motion = Motion(0.1, 0.05, 0.0)
    places = set()
    for k, (x_m, y_m) in enumerate(noise, 1):
        motion.report(0.1 + x_m / 2, 0.05 + y_m / 2, k * PERIOD_S)
        if k >= REST_REPORTS:
            places.add(place(motion, 5e-3, 10e-3))
    assert len(places) == 1
    assert math.dist(places.pop(), (0.1, 0.05)) < REST_RADIUS_M


def test_the_place_of_rest_is_that_of_the_reports_not_of_the_first_alone():
    motion = Motion(0.1 + 0.3e-3, 0.05, 0.0)
    for k in range(1, 20):
        motion.report(0.1, 0.05, k * PERIOD_S)
    assert place(motion, PERIOD_S) == pytest.approx((0.1, 0.05), abs=0.05e-3)


def test_a_finger_leaves_its_rest_with_the_first_report_beyond_the_dead_band():
    motion = moved(lambda _: (0.1, 0.05))
    motion.report(0.1 + REST_RADIUS_M + 1e-6, 0.05, 100 * PERIOD_S)
    assert place(motion, 0.0)[0] == 0.1 + REST_RADIUS_M + 1e-6


def test_a_finger_that_is_not_reported_any_more_rests_where_it_was_reported_last():
    motion = moved(lambda time_s: (0.3 * time_s, 0.0))
    known_s = motion.time_s + 2.5 * PERIOD_S
    assert place(motion, 2.5 * PERIOD_S, 20e-3, known_s) == (motion.x_m, motion.y_m)
    halfway_m = place(motion, 2 * PERIOD_S, 0.0, motion.time_s + 2 * PERIOD_S)[0] - motion.x_m
    assert halfway_m == pytest.approx(0.3 * 2 * PERIOD_S / 2, rel=1e-3)


def test_a_far_horizon_is_no_silence():
    motion = moved(lambda time_s: (0.3 * time_s, 0.0))
    for ahead_s in (5e-3, 20e-3, 30e-3, MAX_HORIZON_S):
        assert place(motion, ahead_s)[0] - motion.x_m == pytest.approx(0.3 * ahead_s, rel=1e-3)


def test_reports_that_wait_behind_the_one_just_read_are_no_silence():
    tracker = Tracker(ScriptedSource(*[(k * PERIOD_S, [touch(0, 50 + 2 * k)]) for k in range(20)]), TOUCH, 0.210, 0.148)
    late_s = 19 * PERIOD_S  # the loop was busy: it finds all of them at once
    for k in range(19):
        tracker.read(late_s)
        assert tracker.predict(0, late_s)[0] > 0.050 + 2e-3 * k or k == 0
    assert tracker.predict(0, late_s)[0] == pytest.approx(0.050 + 2e-3 * 19, abs=0.3e-3)


def test_once_a_report_shows_a_stop_the_prediction_is_close_to_it():
    motion = moved(lambda time_s: (0.3 * time_s, 0.0))
    stop_m = motion.x_m
    motion.report(stop_m, 0.0, motion.time_s + PERIOD_S)
    assert place(motion, 0.0, 20e-3) == (stop_m, 0.0)


def test_a_step_that_is_shorter_than_those_before_limits_the_speed():
    motion = moved(lambda time_s: (0.3 * time_s, 0.0))
    motion.report(motion.x_m + 0.3e-3, 0.0, motion.time_s + PERIOD_S)
    assert motion.vx == pytest.approx(MAX_SPEED_RATIO * 0.3e-3 / PERIOD_S)


def test_a_finger_that_turns_is_not_sent_on():
    motion = moved(lambda time_s: (0.3 * time_s, 0.0))
    motion.report(motion.x_m - 0.5e-3, 0.0, motion.time_s + PERIOD_S)
    assert place(motion, 0.0, 20e-3) == (motion.x_m, motion.y_m)


def test_neither_time_nor_way_ahead_is_without_limit():
    motion = moved(lambda time_s: (0.3 * time_s, 0.0))
    assert place(motion, 0.0, 0.2)[0] - motion.x_m == pytest.approx(0.3 * MAX_HORIZON_S, rel=1e-3)
    fast = moved(lambda time_s: (3.0 * time_s, 4.0 * time_s))
    assert math.dist(place(fast, 0.0, 20e-3), (fast.x_m, fast.y_m)) == pytest.approx(MAX_EXTRAPOLATION_M)


def test_a_time_before_the_last_report_is_that_of_the_report():
    motion = moved(lambda time_s: (0.3 * time_s, 0.0))
    assert place(motion, -5e-3) == (motion.x_m, motion.y_m)


def test_after_a_pause_the_velocity_of_before_is_forgotten():
    motion = moved(lambda time_s: (0.3 * time_s, 0.0))
    motion.report(motion.x_m, 1e-3, motion.time_s + MAX_INTERVAL_S + 1e-3)
    assert motion.vx == 0
    assert 0 < motion.vy <= 1e-3 / MAX_INTERVAL_S


@given(
    st.lists(st.tuples(st.floats(0, 0.3), st.floats(0, 0.2), st.floats(-1, 1)), max_size=40),
    st.floats(-1, 2),
    st.floats(-1, 2),
    st.floats(0, 0.2),
)
def test_whatever_is_reported_and_however_time_jumps_the_place_is_not_far_from_the_last_report(reports, at_s, known_s, lag_s):
    motion = Motion(0.1, 0.1, 0.0)
    for x_m, y_m, time_s in reports:
        motion.report(x_m, y_m, time_s)
    assert math.dist(motion.predict(at_s, known_s, lag_s, PERIOD_S), (motion.x_m, motion.y_m)) <= MAX_EXTRAPOLATION_M * (1 + 1e-9)


def test_on_the_recordings_it_is_as_good_as_the_readme_says(ours):
    for horizon_ms, p95_mm, worst_mm in (("5", 0.36, 3.4), ("10", 0.6, 6.0), ("20", 1.1, 9.0), ("30", 1.6, 11.5)):
        assert ours[horizon_ms]["p95"] < p95_mm
        assert ours[horizon_ms]["worst"] < worst_mm


def test_on_the_recordings_it_is_several_times_better_than_no_prediction(ours, recorded):
    for horizon_ms, none in measure(recorded, predicted=False).items():
        assert ours[horizon_ms]["p95"] < none["p95"] / 3
        assert ours[horizon_ms]["median"] < none["median"] / 4


def test_the_figures_are_of_the_call_that_the_loop_makes(perform, evemu_text, monkeypatch):
    """Both ask `Tracker.predict`, so far ahead of what they have read; a change of it changes both."""
    asked_ahead_s = []

    def elsewhere(self, finger, at_s):
        assert finger == 0
        asked_ahead_s.append(at_s - self._known_s)
        return 0.105, 0.074

    monkeypatch.setattr(Tracker, "predict", elsewhere)
    reports = [(k * PERIOD_S, {0: (85.0, 54.0 + 0.5 * k)}) for k in range(60)]
    for error_mm in measure([Recording(evemu_text(*reports))]).values():
        assert error_mm["median"] == pytest.approx(20.6, abs=1.0)
    assert {round(ahead_s * 1e3, 6) for ahead_s in asked_ahead_s} == {*HORIZONS_MS}
    asked_ahead_s.clear()
    run = perform([*reports, (0.6, {0: None})], CLICK)
    assert {(e.x_m, e.y_m) for played in run.played for e in played.emissions} == {(0.105, 0.074)}
    upload_s = 1.4e-3  # what is sent ahead waits for the wire, and begins at the last report
    assert -upload_s < min(asked_ahead_s) < max(asked_ahead_s) < max(HORIZONS_MS) * 1e-3


def test_stops_turns_and_rest_are_met_as_the_readme_says():
    assert overshoot_m(turns=False) < 0.7e-3
    assert overshoot_m(turns=True) < 0
    assert rest_m() == 0
    assert rest_m(predicted=False) > 0.2e-3


def test_it_is_exact_on_a_straight_line_and_an_error_of_one_percent_is_seen(evemu_text):
    recording = Recording(evemu_text(*[(k * 8e-3, {0: (20 + 1.6 * k, 50)}) for k in range(90)]))
    assert measure([recording], predicted=False)["10"]["median"] == pytest.approx(2.0, rel=0.009)
    assert measure([recording])["10"]["median"] < 0.02


def test_a_finger_that_the_panel_loses_in_between_is_measured_as_one(evemu_text):
    recording = Recording(evemu_text(*[(k * 8e-3, {0: None if k == 30 else (20 + 1.6 * k, 50)}) for k in range(90)]))
    assert measure([recording], predicted=False)["20"]["median"] == pytest.approx(4.0, rel=0.009)
    assert measure([recording])["20"]["worst"] < 4.1  # at its first report
