"""How late a panel is, against a mouse that moves with the finger: on panels whose lag is known."""

import contextlib
import random

import pytest
from tables import each_row

from controller.device.board.board import load_board
from controller.device.board.lookup import data_folder
from controller.device.touch.recordings.recording import Recording
from controller.device.touch_calibration.lag_figures import lag_figures
from controller.errors import CalibrationError
from controller.workshop.simulation.simulated_strokes import SimulatedStrokes

BOARD = load_board(data_folder("boards") / "simulated")
METHOD_MS = 0.3  # beyond chance and mouse: smoothing bends the strokes a little


def found(**strokes):
    strokes = {"duration_s": 10.0} | strokes
    return lag_figures(Recording(SimulatedStrokes(**strokes).recording(BOARD)), BOARD)


PANELS = [
    {},
    {"smoothed_s": 6e-3},
    {"period_s": 16e-3, "noise_mm": 0.2},
    {"mouse_period_s": 8e-3, "mouse_age_s": 8e-3},
    {"mouse_period_s": 8e-3, "mouse_age_s": 0.0},
    {"strokes_hz": 1.2, "turned_deg": 130.0},
    {"strokes_hz": 3.0, "reach_mm": 25.0, "noise_mm": 0.3},
]


def check(panel, seed, **strokes):
    lag_s = random.Random(seed).uniform(panel.get("smoothed_s", 0.0), 60e-3)
    figures = found(lag_s=lag_s, seed=seed, **strokes, **panel)
    assert figures.lag_ms == pytest.approx(lag_s * 1e3, abs=figures.error_ms + figures.mouse_ms / 2 + METHOD_MS)
    assert figures.error_ms < 1.0


@each_row("seed", range(len(PANELS)))
def test_the_lag_is_found_within_the_error_that_is_reported(seed):
    check(PANELS[seed], seed)


@pytest.mark.slow
@pytest.mark.parametrize("panel", PANELS)
def test_the_lag_of_many_is_found_within_the_error_that_is_reported(panel):
    for seed in range(40):
        check(panel, seed, duration_s=20.0)


def test_a_millisecond_more_is_seen():
    assert found(lag_s=13e-3).lag_ms - found(lag_s=12e-3).lag_ms == pytest.approx(1.0, abs=0.2)


@each_row(
    ("strokes", "what"),
    [
        ({"duration_s": 2.5}, "only . turns: slide to and fro"),
        ({"reach_mm": 4.0}, "only 0 turns"),
        ({"duration_s": 5.0}, "only . s of strokes fast enough"),
        ({"mouse_period_s": 16e-3}, "the mouse reports every 16 ms"),
    ],
)
def test_strokes_that_tell_nothing_are_refused(strokes, what):
    with pytest.raises(CalibrationError, match=what):
        found(lag_s=12e-3, **strokes)


def lines(text):
    return text.splitlines(keepends=True)


def test_a_mouse_that_did_not_move_with_the_finger_is_refused():
    mine, other = (SimulatedStrokes(lag_s=12e-3, strokes_hz=hz, seed=int(hz), duration_s=8.0).recording(BOARD) for hz in (2.0, 3.0))
    body = [line for line in lines(mine) if not (line.startswith("E:") and line.split()[2] == "0002")]
    mouse = [line for line in lines(other) if line.startswith("E:") and line.split()[2] == "0002"]
    events = sorted([line for line in body + mouse if line.startswith("E:")], key=lambda line: float(line.split()[1]))
    mixed = "".join([line for line in body if not line.startswith("E:")] + events)
    with pytest.raises(CalibrationError, match="did not move together"):
        lag_figures(Recording(mixed), BOARD)


def test_a_recording_without_a_mouse_or_without_a_finger_is_refused():
    text = SimulatedStrokes(lag_s=12e-3, duration_s=3.0).recording(BOARD)
    for kind, what in (("0002", "has no mouse in it"), ("0003", "no finger slid")):
        left = "".join(line for line in lines(text) if not (line.startswith("E:") and line.split()[2] == kind))
        with pytest.raises(CalibrationError, match=what):
            lag_figures(Recording(left), BOARD)


def test_two_fingers_are_refused():
    text = lines(SimulatedStrokes(lag_s=12e-3, duration_s=3.0).recording(BOARD))
    at = next(k for k, line in enumerate(text) if line.startswith("E: 2."))
    stamp = text[at].split()[1]
    second = [f"E: {stamp} 0003 {code:04x} {value}\n" for code, value in ((0x2F, 1), (0x39, 7), (0x35, 200), (0x36, 200))]
    with pytest.raises(CalibrationError, match="several fingers"):
        lag_figures(
            Recording("".join(text[:at] + second + [f"E: {stamp} 0003 002f 0\n", f"E: {stamp} 0000 0000 0\n"] + text[at:])), BOARD
        )


def test_whatever_is_in_a_recording_a_lag_is_a_number_or_refused():
    r = random.Random(2)
    text = lines(SimulatedStrokes(lag_s=12e-3, duration_s=7.0, mouse_period_s=8e-3, mouse_age_s=4e-3).recording(BOARD))
    evaluated = 0
    for _ in range(6):
        kept_share = r.choice((1.0, 0.95))
        kept = [line for line in text if not line.startswith("E:") or r.random() < kept_share]
        for _ in range(r.choice((0, 1, 30))):
            k = r.randrange(len(kept))
            if kept[k].startswith("E:"):
                kind, when, *event = kept[k].split()
                kept[k] = " ".join([kind, when, *event[:2], str(r.randint(-(1 << 31), (1 << 31) - 1))]) + "\n"
        with contextlib.suppress(CalibrationError):
            evaluated += 0 <= lag_figures(Recording("".join(kept)), BOARD).lag_ms < 151
    assert evaluated
