"""Recordings again and again as one run of the loop: all of them are played, and nothing is kept."""

import json

import pytest
from figures import soak

from controller.device.bank.reader import Bank
from controller.device.scene.scene import load_scene
from controller.device.touch.recordings.recording import Recording

CLICK = '[[regions]]\nname = "all"\nshape = "plate"\neffects = ["click"]\n'


@pytest.fixture
def scene(board, tmp_path):
    file = tmp_path / "clicks.toml"
    file.write_text(CLICK)
    return load_scene(file, board)


def tap(x_mm, evemu_text):
    return Recording(evemu_text((0.0, {0: (x_mm, 70.0)}), (0.2, {0: None})))


def test_every_touch_of_every_round_is_played_once(board, bank_file, scene, evemu_text):
    reported = []
    with Bank.open(bank_file, board) as bank:
        soak.soak(board, scene, bank, [tap(40.0, evemu_text), tap(120.0, evemu_text)], 60 / 3600, reported.append)
    (hour,) = reported
    rounds = 60 / (0.2 + soak.PAUSE_S)
    assert hour.emissions == pytest.approx(rounds, abs=2)


def test_an_hour_is_reported_by_itself(board, bank_file, scene, evemu_text, monkeypatch):
    reported = []
    monkeypatch.setattr(soak, "HOUR_S", 20.0)
    with Bank.open(bank_file, board) as bank:
        soak.soak(board, scene, bank, [tap(40.0, evemu_text)], 3.0, reported.append)
    assert len(reported) == 4, "three, and what is left"
    assert max(hour.emissions for hour in reported) <= 30, "each tells of itself alone"


def test_a_bank_that_is_not_there_is_one_line(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(soak, "bank_path", lambda *_: tmp_path / "no.bank")
    recording = tmp_path / "r.evemu"
    recording.write_text("# EVEMU 1.3\nA: 35 0 10 0 0 0\nE: 0.0 0003 0035 1\nE: 0.0 0000 0000 0\n")
    assert soak.main([str(recording), "--json"]) == 78
    out, err = capsys.readouterr()
    assert out == ""
    assert err.count("\n") == 1
    assert "bank build" in err


def test_figures_for_machines(board, bank_file, monkeypatch, capsys, tmp_path, evemu_text):
    monkeypatch.setattr(soak, "bank_path", lambda *_: bank_file)
    recording = tmp_path / "r.evemu"
    recording.write_text(evemu_text((0.0, {0: (40.0, 70.0)}), (0.2, {0: None})))
    assert soak.main([str(recording), "--json", "--hours", "0.003"]) == 0
    figures = json.loads(capsys.readouterr().out)
    assert figures["grown_bytes"] == 0
    assert sum(hour["emissions"] for hour in figures["hours"]) > 0
