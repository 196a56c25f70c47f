"""From a plate that is not the board's model, by its measurements, to what fingers get on it: the README's walk."""

import json
import re

import pytest
from scripted_evemu import evemu

from controller.cli import main
from controller.device.board.lookup import find_board

CLICK = '[[regions]]\nname = "all"\nshape = "plate"\neffects = ["click"]\n'
REAL = ["--plate", "edges=free", "--plate", "theory=mindlin"]


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A panel of 70 x 50 mm with eight channels, whose fingers tap the cells of a bank of 2.5 mm."""
    monkeypatch.setenv("STATE_DIRECTORY", str(tmp_path / "state"))
    moved = {"26.5": "12.5", "31.5": "17.5", "90.5": "52.5", "95.5": "57.5"}
    lines = []
    for line in (find_board("simulated") / "board.toml").read_text().splitlines():
        patch = re.match(r"\s*\{ channel = +(\d+), x_mm = +([\d.]+)", line)
        if patch is None:
            lines.append(line.replace("210.0", "70.0").replace("148.0", "50.0").replace('"demo.evemu"', '"taps.evemu"'))
        elif int(patch[1]) < 8:
            lines.append(line.replace(patch[2], moved[patch[2]], 1))
    (tmp_path / "board.toml").write_text("\n".join(lines))
    (tmp_path / "scene.toml").write_text(CLICK)
    places = [(10.0 + 7.5 * k, 10.0 + 5.0 * (k * 4 % 7)) for k in range(7)]
    taps = [r for k, at in enumerate(places) for r in ((0.3 * k, {0: at}), (0.3 * k + 0.1, {0: None}))]
    (tmp_path / "taps.evemu").write_text(evemu(*taps).replace(" 2100 ", " 700 ").replace(" 1480 ", " 500 "))
    return tmp_path


def reported(capsys, *arguments):
    capsys.readouterr()
    assert main([*map(str, arguments), "--json"]) == 0, capsys.readouterr().err
    return json.loads(capsys.readouterr().out)


@pytest.mark.slow
@pytest.mark.parametrize(("points", "least", "worst"), [(["--grid"], 0.99, 0.985), (["--scattered", "130"], 0.98, 0.96)])
def test_a_bank_of_measurements_plays_on_the_plate_that_was_measured_and_the_models_does_not(folder, capsys, points, least, worst):
    """At 40 dB, by the same files, commands and gateware as a real panel; A_ref is that of the plate that was measured."""
    board = ["--board", folder]
    reported(capsys, "calibrate", "simulate", folder / "m", *board, *points, *REAL)
    reported(capsys, "calibrate", "bank", folder / "m", *board, "--out", folder / "m.bank")
    whole = reported(capsys, "run", *board, "--speed", "max", "--bank", folder / "m.bank", *REAL)
    measured, expected = whole["focus"], whole["expected"]
    assert expected["cause"] == ""
    assert expected["finger_um"][0] < measured["felt_light_touch_um"] < expected["finger_um"][2]
    elsewhere = reported(capsys, "bank", "info", folder / "m.bank", *board)["expected"]  # not the plate that was measured
    assert "measured on another panel" in elsewhere["cause"]
    assert elsewhere["finger_um"][:2] == [0, None]
    modelled = reported(capsys, "run", *board, "--speed", "max", *REAL)["focus"]
    same = reported(capsys, "run", *board, "--speed", "max")["focus"]
    for name, of in (("measured", measured), ("the model's, on the real plate", modelled), ("the model's, on its own", same)):
        print(f"{points[0][2:]}, bank {name}: {of['relative_amplitude']}")
    assert measured["count"] == modelled["count"] == 7
    assert measured["relative_amplitude"]["median"] >= least
    assert measured["relative_amplitude"]["worst"] >= worst
    assert modelled["relative_amplitude"]["median"] < 0.5
    assert same["relative_amplitude"]["median"] > 0.995
