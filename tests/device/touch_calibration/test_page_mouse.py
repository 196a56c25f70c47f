"""A mouse of a web page as reference for the lag: messages compare its clock with ours, and the lag is found as by our own."""

import random
from types import SimpleNamespace

import numpy as np
import pytest
from tables import each_row

from controller.device.board.board import load_board
from controller.device.board.lookup import data_folder
from controller.device.page.mouse_steps import ArrivedSteps
from controller.device.touch.recordings.recording import Recording
from controller.device.touch_calibration import lag_figures, running_lag
from controller.device.touch_calibration.clock_offset import ClockOffset
from controller.device.touch_calibration.lag_figures import TimedPlaces, lag_of
from controller.device.touch_calibration.page_mouse import MAX_CLOCK_ERROR_S, PageMouse
from controller.errors import CalibrationError
from controller.workshop.simulation.simulated_strokes import SimulatedStrokes

BOARD = load_board(data_folder("boards") / "simulated")
LAG_S = 12e-3
RANGE_S = lag_figures.LAGS_S[-1] - lag_figures.LAGS_S[0]
OFFSET_S = 1234.5  # of the page's clock
QUICKEST_S = 0.2e-3  # way of a message


def strokes(**changed):
    """Tracks of a finger and of the mouse beside it, by one clock."""
    recording = Recording(SimulatedStrokes(lag_s=LAG_S, duration_s=10.0, **changed).recording(BOARD))
    return lag_figures._finger(recording, BOARD), lag_figures._mouse(recording)


def told(mouse, *, seed=0, quickest_s=QUICKEST_S, stamped=lambda ms: ms):
    """A page that says where its mouse was, 20 times a second, over a way whose times are chance."""
    source, found, answered = random.Random(seed), PageMouse(), None
    at_ms = (mouse.at_s - OFFSET_S) * 1e3
    steps = np.diff(mouse.places, axis=0, prepend=np.zeros((1, 2)))
    for now_s in np.arange(mouse.at_s[0], mouse.at_s[-1] + 0.05, 0.05):
        there_s, back_s = (quickest_s + source.expovariate(1 / 3e-3) for _ in range(2))
        sent_ms = (now_s - OFFSET_S) * 1e3
        these = (at_ms > sent_ms - 50) & (at_ms <= sent_ms)
        rows = tuple((stamped(float(ms)), float(x), float(y)) for ms, (x, y) in zip(at_ms[these], steps[these], strict=True))
        found.take(ArrivedSteps(sent_ms=sent_ms, steps=rows, answered=answered, arrived_s=now_s + there_s))
        answered = now_s + there_s, (now_s + there_s + back_s - OFFSET_S) * 1e3
    return found


@pytest.mark.slow
@each_row("seed", range(6))
def test_the_lag_is_found_within_what_is_said_and_an_error_of_a_hundredth_of_the_range_is_not(seed):
    finger, mouse = strokes(seed=seed)
    seen, clock_s = told(mouse, seed=seed).track()
    assert clock_s < MAX_CLOCK_ERROR_S
    figures = lag_of(finger, seen)
    within_ms = figures.error_ms + figures.mouse_ms / 2 + clock_s * 1e3 + 0.3
    assert figures.lag_ms == pytest.approx(LAG_S * 1e3, abs=within_ms)
    for wrong_s in (0.01 * RANGE_S, -0.01 * RANGE_S):
        late = lag_of(finger, TimedPlaces(seen.at_s + wrong_s, seen.places))
        assert late.lag_ms == pytest.approx(figures.lag_ms - wrong_s * 1e3, abs=0.1)
        assert abs(late.lag_ms - LAG_S * 1e3) > 0.5


def test_a_clock_of_the_other_sign_finds_nothing():
    finger, mouse = strokes()
    seen, _ = told(mouse).track()
    assert np.array_equal(seen.places, mouse.places)
    with pytest.raises(CalibrationError):
        lag_of(finger, TimedPlaces(seen.at_s - 2 * OFFSET_S, seen.places))
    with pytest.raises(CalibrationError, match="did not move together"):
        lag_of(finger, TimedPlaces(2 * seen.at_s.mean() - seen.at_s[::-1], seen.places[::-1]))


def test_the_offset_is_where_it_is_said_to_be_however_long_messages_take():
    source = random.Random(5)
    for quickest_s in (0.0, 1e-3, 5e-3):
        for _ in range(50):
            offset, clock = source.uniform(-1e4, 1e4), ClockOffset()
            assert clock.error_s == float("inf")
            for now_s in range(20):
                there_s, back_s = (quickest_s + source.expovariate(1e3) for _ in range(2))
                clock.heard(now_s - offset, now_s + there_s)
                clock.answered(now_s + there_s, now_s + there_s + back_s - offset)
            assert abs(clock.offset_s - offset) <= clock.error_s + 1e-9
            assert clock.error_s >= quickest_s - 1e-9


@each_row(
    ("changed", "what"),
    [
        ({"quickest_s": 3e-3}, r"the page's clock is known within [34]\.\d ms only, 2 ms are needed"),
        ({"stamped": lambda ms: ms + 1.7e12}, "are not of the clock of its page"),  # since 1970
        ({"stamped": lambda ms: ms - 5e3}, "are not of the clock of its page"),
    ],
)
def test_clocks_that_cannot_be_compared_are_refused(changed, what):
    with pytest.raises(CalibrationError, match=what):
        told(strokes()[1], **changed).track()


def test_times_as_coarse_as_frames_are_refused_and_those_of_a_millisecond_are_not():
    finger, mouse = strokes()
    with pytest.raises(CalibrationError, match="the mouse reports every 17 ms"):
        lag_of(finger, told(mouse, stamped=lambda ms: ms // (50 / 3) * (50 / 3)).track()[0])
    coarse = lag_of(finger, told(mouse, stamped=lambda ms: float(int(ms))).track()[0])
    assert coarse.lag_ms == pytest.approx(LAG_S * 1e3, abs=1.5)


def test_clocks_that_drift_apart_are_refused_and_nobody_is_waited_for_beyond_a_minute(monkeypatch):
    clock = ClockOffset()
    for now_s in range(10):
        clock.heard(now_s * 1.01, now_s + 1e-3)
        clock.answered(now_s + 1e-3, now_s * 1.01 + 2e-3)
    assert clock.error_s < 0
    now_s = 0.0

    def heard(*_):
        nonlocal now_s
        now_s += 7.0
        return ()

    monkeypatch.setattr(running_lag.time, "monotonic", lambda: now_s)
    panel = SimpleNamespace(state=lambda: SimpleNamespace(panel_present=True), subscribe=lambda _: None, heard=heard)
    with pytest.raises(CalibrationError, match="no finger touched the panel within 60 s"):
        running_lag.running_lag(panel, SimpleNamespace(read=list), lambda *_: None, 20.0)
    assert now_s == 63.0
