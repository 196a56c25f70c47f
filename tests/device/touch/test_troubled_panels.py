"""What panels of public bug reports say, played to the end: how many emissions, and where. Own numbers, nothing copied.

Reports: raspberrypi/linux#4749 (an idle panel far outside its axes, and in its corner), koreader/koreader#9324 (taps in the
corner, nobody there), Bodmer/TFT_eSPI#366 and DustinWatts/FT6236#3 ((0, 0) between right positions), hyprwm/aquamarine#208 (one
contact is finger, palm, finger), libinput's "Touch jump detected"; polled panels, and drivers of protocol A without empty report.
"""

import json
import math
from random import Random

import msgspec
import pytest
from scripted_evemu import AXES, evemu
from tables import each_row

from controller.cli import main
from controller.commands.common.tables import run_table
from controller.device.bank.reader import Bank
from controller.device.scene.scene import load_scene
from controller.device.service.drivers import tracked
from controller.device.touch.recordings.recording import Recording
from controller.device.touch.recordings.replay import RecordingSource
from controller.workshop.simulation.simulated_run import play

CLICK = '[[regions]]\nname = "all"\nshape = "plate"\neffects = ["click"]\n'
TEXTURE = '[[regions]]\nname = "all"\nshape = "plate"\neffects = [{ effect = "texture", spacing_mm = 3.0 }]\n'
CORNER = ((200.0, 138.0, 10.0, 10.0), (0.0, 138.0, 4.0, 10.0))


@pytest.fixture
def felt(board, bank_file, tmp_path):
    """Places in mm of all emissions of a recording, and the run."""

    def play_text(text, scene=CLICK, no_finger_mm=()):
        file = tmp_path / "scene.toml"
        file.write_text(scene)
        on = msgspec.structs.replace(board, touch=msgspec.structs.replace(board.touch, no_finger_mm=no_finger_mm))
        with Bank.open(bank_file, on) as bank:
            run = play(on, load_scene(file, on), bank, Recording(text), real_time=False)
        places = [(1e3 * e.x_m, 1e3 * e.y_m) for played in run.played for e in played.emissions]
        return places, run

    return play_text


def tracked_fingers(board, text):
    """Numbers of all fingers of a recording behind the tracker, and the tracker."""
    recording = Recording(text)
    tracker = tracked(RecordingSource(recording, recording.axes(board), 0.0), board)
    fingers = set()
    while (at_s := tracker.next_time_s()) is not None:
        fingers |= {sample.finger for sample in tracker.read(at_s)}
    return fingers, tracker


def taps(*places_mm, down_s=0.06, up_s=0.08):
    """One tap after another, in protocol B."""
    reports = []
    for number, place in enumerate(places_mm):
        at_s = 0.05 + number * (down_s + up_s)
        reports += [(at_s, {0: place}), (at_s + down_s, {0: None})]
    return reports


def stroke(places_mm, period_s=10e-3):
    """A finger that is reported at each of these places, None: it is not found."""
    reports = [(0.05 + k * period_s, {0: place}) for k, place in enumerate(places_mm)]
    return [*reports, (0.05 + len(places_mm) * period_s, {0: None})]


def protocol_a(reports):
    """Text of `(time_s, places_mm)` reports without tracking ids; no empty report."""
    lines = [AXES.replace("A: 2f 0 9 0 0 0\n", "").replace("A: 39 0 65535 0 0 0\n", "")]
    for at_s, places in reports:
        for x_mm, y_mm in places:
            values = (3, 0x35, round(10 * x_mm)), (3, 0x36, round(10 * y_mm)), (0, 2, 0)
            lines += [f"E: {at_s:.6f} {kind:04x} {code:04x} {value}\n" for kind, code, value in values]
        lines.append(f"E: {at_s:.6f} 0000 0000 0\n")
    return "".join(lines)


def test_an_idle_panel_that_reports_far_outside_its_axes_and_its_corner_is_not_felt(felt):
    idle = taps((131, -1116), (210, 148), (210, 148), (131, -1116), (210, 147.9), up_s=0.1)
    assert len(felt(evemu(*idle))[0]) == 3, "the corner is a place like any other"
    places, run = felt(evemu(*idle), no_finger_mm=CORNER)
    assert places == []
    assert run.touch["plausibility"] == {
        "points": 5,
        "believed": 0,
        "held": 0,
        "confirmed": 0,
        "far_outside": 2,
        "no_finger": 3,
        "too_fast": 0,
        "more_than_played": 0,
        "fallen_silent": 0,
    }


def test_a_finger_beside_the_phantom_in_the_corner_is_felt_as_if_alone(felt):
    reports = [(0.05, {1: (0, 147)}), (0.06, {0: (100, 74)}), (0.16, {0: None}), (0.3, {0: (50, 74)}), (0.4, {0: None, 1: None})]
    places, _ = felt(evemu(*reports), no_finger_mm=CORNER)
    assert places == [(pytest.approx(100), pytest.approx(74)), (pytest.approx(50), pytest.approx(74))]


@pytest.mark.parametrize("period_s", [7e-3, 30e-3])
@pytest.mark.parametrize(
    "outlier", ["anywhere", *(pytest.param(kind, marks=pytest.mark.slow) for kind in ("zero", "corner", "outside"))]
)
def test_a_drag_with_one_outlier_in_ten_reports_is_felt_where_it_went(felt, period_s, outlier):
    random = Random(7)
    count = round(1.0 / period_s)
    true = [(20 + 0.1 * 1e3 * k * period_s, 74) for k in range(count)]
    wrong = {
        "zero": lambda *_: (0, 0),
        "corner": lambda *_: (210, 148),
        "anywhere": lambda x, y: (x + random.uniform(25, 45), y + random.uniform(-45, 45)),
        "outside": lambda x, _: (x, -1116),
    }[outlier]
    mixed = [wrong(*place) if k % 10 == 7 else place for k, place in enumerate(true)]
    clean, _ = felt(evemu(*stroke(true, period_s)), TEXTURE)
    places, run = felt(evemu(*stroke(mixed, period_s)), TEXTURE)
    outliers = sum(a != b for a, b in zip(true, mixed, strict=True))
    assert outliers >= 3
    assert len(clean) - outliers <= len(places) <= len(clean), "on a slow panel a report is an emission"
    assert all(abs(y_mm - 74) < 0.5 and 19 < x_mm < 175 for x_mm, y_mm in places)
    assert {emission.finger for played in run.played for emission in played.emissions} == {0}
    found = run.touch["plausibility"]
    assert found["too_fast"] + found["far_outside"] == outliers


def test_one_contact_that_is_finger_palm_and_finger_clicks_once(felt):
    lines = [AXES, "A: 37 0 2 0 0 0\n"]
    for k in range(60):
        tool = {0: 0, 7: 2, 10: 0, 17: 2, 20: 0, 50: 2}.get(k)
        events = [(3, 0x39, 5)] if k == 0 else []
        events += [(3, 0x35, 1000 + k % 2), (3, 0x36, 700)] + ([] if tool is None else [(3, 0x37, tool)]) + [(0, 0, 0)]
        lines += [f"E: {0.05 + k * 10e-3:.6f} {kind:04x} {code:04x} {value}\n" for kind, code, value in events]
    places, run = felt("".join(lines))
    assert len(places) == 1
    assert run.touch["palms"] == 1


@pytest.mark.parametrize("place", [lambda _: (100, 74), lambda k: (50 + 30 * math.sin(k), 74)], ids=["still", "elsewhere"])
def test_three_taps_of_protocol_a_without_empty_reports_are_three_clicks(felt, place):
    reports = [(0.05 + 0.2 * tap + 10e-3 * k, [place(tap)]) for tap in range(3) for k in range(6)]
    places, run = felt(protocol_a(reports))
    assert len(places) == 3
    assert run.touch["plausibility"]["fallen_silent"] >= 2, "the last one may end with the recording"
    assert len(run.tracks) == 3


@each_row("period_s", [6e-3, 10e-3, 17e-3, 30e-3, 40e-3])
@each_row("lost_every", [2, 3, 7])
@each_row("metres_per_s", [0.0, 0.1])
def test_a_touch_that_is_lost_for_single_polls_is_one_click(board, felt, period_s, lost_every, metres_per_s):
    count = round(0.6 / period_s)
    at = [(50 + 1e3 * metres_per_s * k * period_s, 74) for k in range(count)]
    text = evemu(*stroke([None if k % lost_every == lost_every - 1 else place for k, place in enumerate(at)], period_s))
    fingers, tracker = tracked_fingers(board, text)
    assert len(fingers) == 1
    assert tracker.tracking.bridged >= count // lost_every - 1
    if (period_s, lost_every) == (30e-3, 3):
        assert len(felt(text)[0]) == 1


@each_row("changes_only", [False, True])
@each_row("period_s", [8e-3, 17e-3, 30e-3])
def test_two_taps_at_one_place_are_two_fingers_on_any_panel(board, period_s, changes_only):
    reports = []
    for tap in range(5):
        begin_s = 0.05 + tap * (4 * period_s + 0.08)
        still = [] if changes_only else [(begin_s + k * period_s, {0: (100 + 0.1 * (k % 2), 74)}) for k in (1, 2, 3)]
        reports += [(begin_s, {0: (100, 74)}), *still, (begin_s + 4 * period_s, {0: None})]
    assert len(tracked_fingers(board, evemu(*reports))[0]) == 5


def test_a_second_finger_elsewhere_in_the_next_report_clicks_at_once(felt):
    reports = [(0.05, {0: (100, 74)}), (0.06, {0: None, 1: (160, 74)}), (0.07, {1: None, 0: (60, 74)}), (0.2, {0: None})]
    places, run = felt(evemu(*reports))
    assert [round(x_mm) for x_mm, _ in places] == [100, 160, 60]
    assert run.touch["plausibility"]["held"] == 0


@pytest.mark.parametrize("metres_per_s", [0.8, 2.5])
def test_a_fast_swipe_is_felt_along_its_way(felt, metres_per_s):
    way = [(10 + 1e3 * metres_per_s * k * 5e-3, 74) for k in range(round(0.18 / metres_per_s / 5e-3))]
    places, run = felt(evemu(*stroke([way[0]] * 2 + way, 5e-3)), TEXTURE)
    assert len(places) >= 0.7 * len(way)
    assert max(x_mm for x_mm, _ in places) > 150
    assert run.touch["plausibility"]["too_fast"] == 0


def test_the_figures_are_shown(capsys, board, bank_file, tmp_path):
    (tmp_path / "idle.evemu").write_text(evemu(*taps((131, -1116), (100, 74))))
    (tmp_path / "click.toml").write_text(CLICK)
    files = ("--replay", str(tmp_path / "idle.evemu"), "--scene", str(tmp_path / "click.toml"), "--bank", str(bank_file))
    assert main(["run", "--speed", "max", "--json", *files]) == 0
    out, err = capsys.readouterr()
    assert "1 × positions far outside the axes were taken for no finger" in err
    found = json.loads(out)
    assert found["emissions"] == 1
    assert (found["touch"]["plausibility"]["points"], found["touch"]["plausibility"]["far_outside"]) == (2, 1)
    assert "1 of 2 positions of the touch panel were no finger's: far outside 1" in run_table(found)
