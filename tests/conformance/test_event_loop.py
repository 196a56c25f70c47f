"""A recorded session of the event loop, on each back-end: the same pins, the same bytes, the same figures."""

import numpy as np
import pytest
from pin_script import MODEL, assert_same_capture, open_gateware

from controller.device.bank.reader import Bank
from controller.device.scene.scene import load_scene
from controller.device.touch.recordings.recording import Recording
from controller.workshop.simulation.focus_evaluation import judge
from controller.workshop.simulation.run_figures import report
from controller.workshop.simulation.simulated_run import Hardware, play

SCENE = """
[[regions]]
name = "all"
shape = "rectangle"
x_mm = 20.0
y_mm = 20.0
width_mm = 170.0
height_mm = 108.0
effects = [{ effect = "train", rate_hz = 100.0, duration_ms = 400.0 }]
"""
REPORTS = [
    (0.00, {0: (60.0, 70.0)}),
    (0.03, {0: (70.0, 72.0), 1: (150.0, 60.0)}),
    (0.05, {1: (152.0, 64.0)}),
    (0.07, {0: None}),
    (0.09, {1: None}),
]
SAME = ("emissions", "triggers", "uploads", "resident", "heartbeats", "bytes_sent", "outputs_off", "focus", "skipped")
PLAYED = {}  # the session on each back-end, performed once


class Recorder:
    """A back-end that keeps every answer, as another pair of hands on the same wires would see it."""

    def __init__(self, gateware):
        self._gateware = gateware
        self.answers = []

    def __getattr__(self, name):
        return getattr(self._gateware, name)

    def exchange(self, select_tick, release_tick, mosi, miso):
        self._gateware.exchange(select_tick, release_tick, mosi, miso)
        self.answers.append((select_tick, release_tick, bytes(mosi), bytes(miso)))


@pytest.fixture
def session(board, bank_file, tmp_path, evemu_text):
    (tmp_path / "scene.toml").write_text(SCENE)
    scene = load_scene(tmp_path / "scene.toml", board)
    recording = Recording(evemu_text(*REPORTS))

    def run_on(back_end):
        if back_end in PLAYED:
            return PLAYED[back_end]
        recorders = []

        def recorded(*parameters):
            recorders.append(Recorder(back_end(*parameters)))
            return recorders[0]

        with Bank.open(bank_file, board) as bank:
            run = play(board, scene, bank, recording, real_time=False, hardware=Hardware(recorded))
        PLAYED[back_end] = run, recorders[0].answers
        return PLAYED[back_end]

    return run_on


def test_a_session_ends_with_outputs_off_and_every_focus_where_a_finger_was(session, back_end):
    run, _ = session(back_end)
    figures = report(run, judge(run).foci)
    assert figures["emissions"] > 5
    assert figures["outputs_off"]
    assert figures["focus"]["distance_mm"]["median"] < 2.5


def test_both_give_the_same_answers_pins_and_figures(session, rtl):
    (run, answers), (other, others) = session(MODEL), session(rtl)
    assert answers == others
    assert_same_capture(run.capture, other.capture)
    assert run.capture.words.size > 5000
    figures, other_figures = report(run, judge(run).foci), report(other, judge(other).foci)
    assert {name: figures[name] for name in SAME} == {name: other_figures[name] for name in SAME}


def test_captures_taken_at_any_time_add_up_to_the_same(back_end):
    gateware = open_gateware(back_end)
    gateware.advance(100)
    assert gateware.take_capture().ticks.size == gateware.take_capture().ticks.size == 0
    assert gateware.take_capture().hv.dtype == np.uint8
