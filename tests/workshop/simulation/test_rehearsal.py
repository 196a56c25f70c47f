"""`haptic-panel rehearse`: the whole way of the page "A panel of your own", on a panel that is wrong as real ones are."""

import json
import re
from pathlib import Path

import pytest

from controller.cli import main
from controller.device.board.records import load_toml
from controller.workshop.simulation.rehearsal import SETUP
from controller.workshop.simulation.remedies import faults_of
from controller.workshop.simulation.wrong_panel import SHIPPED, WrongPanel

ROOT = Path(__file__).parents[3]
LEFT_OUT = {"record", "tolerance"}  # a finger's strokes (tests/kernel/container_commissioning.py); of panels that are not made yet


@pytest.fixture
def rehearsed(tmp_path, capsys, monkeypatch):
    """What a rehearsal with this that is wrong has found, and its commands."""
    monkeypatch.setenv("STATE_DIRECTORY", str(tmp_path / "state"))

    def rehearsed(text=None):
        wrong = []
        if text is not None:
            (tmp_path / "wrong.toml").write_text(text)
            wrong = ["--wrong", str(tmp_path / "wrong.toml")]
        assert main(["rehearse", str(tmp_path / "panel"), *wrong, "--json"]) == 0, capsys.readouterr().err
        return json.loads(capsys.readouterr().out)

    return rehearsed


@pytest.mark.slow
def test_each_fault_is_named_and_mended_and_a_finger_feels_it(rehearsed):
    """The command itself asks for 0.97 of what the plate that is there can do."""
    done = rehearsed()
    assert set(done["found"]) >= faults_of(load_toml(SHIPPED, WrongPanel))
    assert "felt 7 pulses" in done["steps"][-1]["said"][0]


@pytest.mark.slow
def test_a_swap_within_a_disc_is_named_by_the_sensor(rehearsed):
    done = rehearsed("swapped = [[1, 2]]\n")
    assert "swapped wires" in done["found"]


def test_the_walk_has_each_command_of_the_page():
    page = (ROOT / "boards/README.md").read_text().split("## A panel of your own")[1].split("```")[1]
    walked = (ROOT / "controller/workshop/simulation/rehearsal.py").read_text()
    for command, option in re.findall(r"^haptic-panel ([\w-]+) ?([\w-]*)", page, re.MULTILINE):
        if command in LEFT_OUT:
            continue
        said = rf'"{command}"' if option.startswith("--") or command in ("setup", "run") else rf'"{command}", "{option}"'
        assert said in walked, f"{command} {option}"


def test_marks_are_touched_on_the_simulated_panel(tmp_path, capsys):
    """A finger misses each by half a millimetre along each axis; the panel's x axis runs the other way."""
    folder = tmp_path / "panel"
    assert main(["setup", str(folder), *SETUP]) == 0
    file = folder / "board.toml"
    file.write_text(file.read_text().replace("x_mm_from_axes = [110, 0, 0]", "x_mm_from_axes = [-110, 0, 110]"))
    capsys.readouterr()
    assert main(["calibrate-touch", "--board", str(folder), "--write", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["x_mm_from_axes"] == pytest.approx([-110, 0, 110], abs=1.5)
    assert found["y_mm_from_axes"] == pytest.approx([0, 80, 0], abs=1.5)
    assert 0.1 < found["residual_mm"]["rms"] < 1.5
    assert found["lines"][0] in file.read_text()


def test_a_folder_that_is_there_is_one_line(tmp_path, capsys):
    assert main(["rehearse", str(tmp_path)]) == 1
    err = capsys.readouterr().err
    assert "exists already" in err
    assert err.count("\n") == 1
