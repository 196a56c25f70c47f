"""Clips of designers: what is played when, what is left out; no file gives a traceback or an effect that no scene takes."""

import copy
import json
import tomllib
from collections import Counter
from pathlib import Path

import msgspec
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tables import each_row

from controller.cli import main
from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.device.scene.scene import load_scene
from controller.errors import ConfigError
from controller.workshop.clips.ahap import read_ahap
from controller.workshop.clips.clip import Curve, DesignedClip, Tap, Vibration
from controller.workshop.clips.importing import READERS, imported
from controller.workshop.clips.lofelt import read_haptic
from controller.workshop.clips.rhythm import rhythm_of

FILES = sorted(file for file in (Path(__file__).parent / "files").iterdir() if file.suffix in READERS)
BOARD = load_board(find_board("simulated"))
NARROW = msgspec.structs.replace(BOARD, limits=msgspec.structs.replace(BOARD.limits, max_duty=0.3))
LEAST_MS = 2.0 / 0.3


def vibrating(end_s, amplitude, sharpness, start_s=0.0):
    return Vibration(start_s, end_s, Curve(*amplitude), Curve(*sharpness))


def of(taps=(), vibrations=()):
    return DesignedClip(tuple(taps), tuple(vibrations), Counter())


def test_a_heartbeat_of_irregular_transients_is_played_at_their_times():
    pulses, report = rhythm_of(read_ahap(FILES[0].with_name("own_heartbeat.ahap")), LEAST_MS, 50, 150)
    assert pulses[:4] == [[0, 0.8], [13, 1], [220, 0.7], [300, 0.8]]
    assert (report.taps, report.taps_kept, report.wanted) == (3, 3, 19)
    assert report.kept + report.silent + report.too_close == 19


def test_pulses_of_a_vibration_are_where_its_rate_has_made_whole_turns():
    """Against the closed form of a rate that rises linearly, 50 + 100 t Hz: turn n at (sqrt(2500 + 200 n) - 50) / 100."""
    pulses, _ = rhythm_of(of(vibrations=[vibrating(1.0, ((0,), (1,)), ((0, 1), (0, 1)))]), LEAST_MS, 50, 150)
    expected = (np.sqrt(2500 + 200 * np.arange(100)) - 50) / 100 * 1e3
    assert [amplitude for _, amplitude in pulses] == [1] * 100
    assert np.abs(np.array(pulses)[:, 0] - expected).max() < 0.01, "10 us; a rate 1 % higher would be 10 ms off at the end"


def test_amplitudes_are_linear_for_ahap_and_of_power_for_haptic(tmp_path):
    breakpoints = [{"time": 0.0, "amplitude": 0.49}, {"time": 1.0, "amplitude": 0.49}]
    (tmp_path / "a.haptic").write_text(json.dumps(haptic(breakpoints)))
    event = {"EventType": "HapticContinuous", "EventDuration": 1, "EventParameters": [values("HapticIntensity", 0.49)]}
    (tmp_path / "a.ahap").write_text(json.dumps({"Pattern": [{"Event": event}]}))
    for clip, amplitude in ((read_haptic(tmp_path / "a.haptic"), 0.7), (read_ahap(tmp_path / "a.ahap"), 0.49)):
        pulses, _ = rhythm_of(clip, LEAST_MS, 50, 150)
        assert {level for _, level in pulses} == {amplitude}
        assert len(pulses) == 100, "of the middle rate"


def haptic(breakpoints):
    return {"version": {"major": 1}, "signals": {"continuous": {"envelopes": {"amplitude": breakpoints, "frequency": []}}}}


def long_event(at_s):
    return {
        "Event": {
            "EventType": "HapticContinuous",
            "EventDuration": 30,
            "Time": at_s,
            "EventParameters": [values("HapticSharpness", 1)],
        }
    }


def values(name, value):
    return {"ParameterID": name, "ParameterValue": value}


def test_controls_of_ahap_act_on_what_sounds_and_the_last_that_began_is_in_force(tmp_path):
    file = tmp_path / "a.ahap"
    pattern = [
        {"Event": {"Time": at, "EventType": "HapticTransient", "EventParameters": [values("HapticIntensity", 0.8), values("X", 1)]}}
        for at in (0.0, 1.0, 2.5, 4.0, 6.0)
    ]
    curve = [{"Time": 0, "ParameterValue": 1.0}, {"Time": 2, "ParameterValue": 0.5}]
    pattern += [
        {"Parameter": values("HapticIntensityControl", 0.5) | {"Time": 0.5}},
        {"ParameterCurve": {"ParameterID": "HapticIntensityControl", "Time": 2.0, "ParameterCurveControlPoints": curve}},
        {"Parameter": values("HapticIntensityControl", 7.0) | {"Time": 5.0}},
        {"Parameter": values("AudioVolumeControl", 0.1) | {"Time": 0.0}},
        {"Event": {"EventType": "AudioCustom", "Time": 0}},
    ]
    file.write_text(json.dumps({"Pattern": pattern, "Unknown": 1}).replace("}]}", "},]}"))
    clip = read_ahap(file)
    assert [tap.amplitude for tap in clip.taps] == pytest.approx([0.8, 0.4, 0.8 * 0.875, 0.4, 0.8])
    assert clip.ignored == {"AudioVolumeControl": 1, "AudioCustom": 1}


def test_the_highest_rate_of_a_board_loses_no_pulse_to_rounding():
    pulses, report = rhythm_of(of(vibrations=[vibrating(1.0, ((0,), (1,)), ((0,), (1,)))]), LEAST_MS, 50, 150)
    assert (report.wanted, report.kept, report.too_close, report.slowed) == (150, 150, 0, 0)
    assert np.diff(np.array(pulses)[:, 0]).min() >= LEAST_MS
    exact, _ = rhythm_of(of([Tap(0.013002, 1, 0.5), Tap(0.015002, 1, 0.5)]), 2.0, 50, 150)
    assert [at_ms for at_ms, _ in exact] == [13.002, 15.002], "2 ms apart, though not in floating point"


def test_a_frequency_of_a_file_is_played_as_it_is_up_to_what_the_duty_allows():
    for wanted_hz, played, slowed in ((20, 20, 0), (120, 120, 0), (300, 150, 150)):
        buzz = vibrating(1.0, ((0,), (1,)), ((0,), (0.5,)))._replace(rate_hz=Curve((0,), (wanted_hz,)), phase=0.5)
        pulses, report = rhythm_of(of(vibrations=[buzz]), LEAST_MS, 50, 150)
        assert (len(pulses), report.slowed) == (played, slowed)
        assert pulses[0][0] == pytest.approx(500 / min(wanted_hz, 149.97), abs=0.01), "half a turn after the start"


def test_the_stronger_of_two_taps_stays_and_a_tap_displaces_a_vibration():
    taps = [Tap(0.1, 0.5, 0.5), Tap(0.105, 0.9, 0.5), Tap(0.3, 0.04, 0.5), Tap(0.4, 0.08, 0.5)]
    pulses, report = rhythm_of(of(taps, [vibrating(0.12, ((0,), (1,)), ((0,), (0,)))]), LEAST_MS, 50, 150)
    assert pulses == [[0, 1], [20, 1], [40, 1], [60, 1], [80, 1], [105, 0.9], [400, 0.1]]
    assert report._asdict() == {
        "taps": 4, "taps_kept": 2, "wanted": 6, "kept": 5, "silent": 1, "lifted": 1, "too_close": 2, "slowed": 0, "ignored": {},
    }  # fmt: skip


@pytest.mark.parametrize("board", [BOARD, NARROW], ids=["duty 1", "duty 0.3"])
def test_every_real_clip_is_an_effect_of_a_scene_and_the_same_to_the_byte_each_time(board, tmp_path):
    text, figures = imported(FILES, board, "press", 50, 150)
    assert imported(FILES, board, "press", 50, 150)[0] == text
    names = list(tomllib.loads(text)["effects"])
    assert names == [clip["effect"] for clip in figures]
    assert len(set(names)) == len(FILES) >= 9
    for clip in figures:
        assert clip["pulses"] == clip["taps_kept"] + clip["kept"]
        assert clip["taps"] + clip["wanted"] == clip["pulses"] + clip["silent"] + clip["too_close"]
    (tmp_path / "scene.toml").write_text(f'{text}\n[[regions]]\nname = "r"\nshape = "plate"\neffects = ["{names[0]}"]\n')
    assert set(names) <= set(load_scene(tmp_path / "scene.toml", board).effects)


def places(value, path=()):
    """Every key and index below."""
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, inner in items:
        yield (*path, key)
        yield from places(inner, (*path, key))


WHOLE = [(file, json.loads(file.read_text())) for file in FILES if file.stat().st_size < 2500 and file.suffix != ".xml"]
ANYTHING = st.one_of(
    st.none(), st.booleans(), st.integers(), st.floats(), st.text(max_size=5), st.just({}), st.just([]), st.just([{}])
)


@settings(max_examples=60)
@given(st.data())
def test_no_damage_of_a_file_gives_a_traceback_or_an_effect_that_no_scene_takes(tmp_path_factory, data):
    file, whole = data.draw(st.sampled_from(WHOLE))
    damaged = copy.deepcopy(whole)
    for _ in range(data.draw(st.integers(1, 3))):
        *way, last = data.draw(st.sampled_from(list(places(damaged)) or [("Pattern",)]))
        inside = damaged
        for key in way:
            inside = inside[key]
        if isinstance(inside, dict | list) and data.draw(st.booleans()):
            del inside[last]
        else:
            inside[last] = data.draw(ANYTHING)
    text = json.dumps(damaged)
    copied = tmp_path_factory.getbasetemp() / f"damaged{file.suffix}"
    copied.write_text(text[: data.draw(st.just(len(text)) | st.integers(0, len(text)))])
    refused = ""
    try:
        toml, _ = imported([copied], NARROW, "command", 50, 150)
    except ConfigError as error:
        refused = str(error)
    if refused:
        assert refused.startswith(str(copied))
        assert "\n" not in refused
        return
    scene = copied.with_name("scene.toml")
    scene.write_text(f'{toml}\n[[regions]]\nname = "r"\nshape = "plate"\neffects = []\n')
    assert "damaged" in load_scene(scene, NARROW).effects


@each_row(
    ("name", "content", "said"),
    [
        ("a.txt", "{}", ".txt is no known format; there are: .ahap, .haptic, .hjif, .haps, .xml"),
        ("a", "{}", "a file without a suffix is no known format"),
        ("a.ahap", None, "cannot be read (No such file or directory)"),
        ("a.ahap", "", "Input data was truncated"),
        ("a.ahap", '{"Pattern": []}', "nothing of it is felt"),
        ("a.ahap", '{"Pattern": [{"Event": {"EventType": "HapticContinuous"}}]}', "Pattern[0].Event.EventDuration is missing"),
        ("a.ahap", '{"Pattern": [{"Event": {"EventType": "HapticTransient", "Time": 1e999}}]}', "out of range"),
        ("a.ahap", json.dumps({"Pattern": 21 * [long_event(0)]}), "vibrates for 630 s in all, a clip for 600 s at most"),
        ("a.ahap", json.dumps({"Pattern": [long_event(0), long_event(31)]}), "pulses, an effect has at most 4,000"),
        ("a.haptic", json.dumps(haptic([{"time": 0, "amplitude": 1}]) | {"version": {"major": 2}}), "version.major = 2: only 1"),
        ("a.haptic", json.dumps(haptic([])), "length >= 1"),
        ("a.haptic", json.dumps(haptic([{"time": at, "amplitude": 1} for at in (1, 0)])), "amplitude[1].time = 0 is earlier"),
    ],
)  # fmt: skip
def test_what_cannot_be_meant_is_refused_in_one_line(name, content, said, tmp_path, capsys):
    if content is not None:
        (tmp_path / name).write_text(content)
    assert main(["effect", "import", str(tmp_path / name)]) == 78
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith(f"haptic-panel: {tmp_path / name}: ")
    assert said in err
    assert err.count("\n") == 1


@pytest.mark.slow
def test_a_hundred_thousand_events_and_controls_take_seconds(tmp_path):
    file = tmp_path / "many.ahap"
    tap = [{"Event": {"EventType": "HapticTransient", "Time": 0.01 * k}} for k in range(50_000)]
    step = [{"Parameter": values("HapticIntensityControl", 0.5 + k % 2 / 2) | {"Time": 0.01 * k - 1e-4}} for k in range(1, 50_000)]
    file.write_text(json.dumps({"Pattern": tap + step}))
    assert [tap.amplitude for tap in read_ahap(file).taps[:4]] == [1, 1, 0.5, 1]


def test_a_file_that_exists_is_not_overwritten_and_json_has_it_all(tmp_path, capsys):
    out = tmp_path / "effects.toml"
    assert main(["effect", "import", str(FILES[0]), "--out", str(out), "--json"]) == 0
    (clip,) = json.loads(capsys.readouterr().out)["clips"]
    (effect,) = tomllib.loads(out.read_text())["effects"].values()
    assert len(effect["pulses"]) == clip["pulses"]
    before = out.read_text()
    assert main(["effect", "import", str(FILES[1]), "--out", str(out)]) == 78
    assert "exists already, and is left as it is" in capsys.readouterr().err
    assert out.read_text() == before
