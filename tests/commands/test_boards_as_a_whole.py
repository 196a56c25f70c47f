"""Boards whose keys are valid one by one and do not go together: what each command says of them."""

import json
import re
import shutil

import pytest
from device.board.changed_board import rewritten
from tables import each_row

from controller.cli import main
from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.device.touch_calibration.calibration import default_targets

SHIPPED = {name: (find_board(name) / "board.toml").read_text() for name in ("simulated", "ulx3s")}
ALL_HIGH = re.sub(r"idle = 0", "idle = 1", SHIPPED["simulated"])
# The examples of the issue: what is written, and what is said of it
REFUSED = {
    "axes all zero": (
        {"x_mm_from_axes": "[0.0, 0.0, 0.0]", "y_mm_from_axes": "[0.0, 0.0, 0.0]"},
        "touch.x_mm_from_axes = [0, 0, 0] and y_mm_from_axes = [0, 0, 0] put all touches onto one line or point",
    ),
    "axes mirrored without an offset": (
        {"x_mm_from_axes": "[-210.0, 0.0, 0.0]"},
        "put every touch off the plate: x from -210 to 0 mm and y from 0 to 148 mm, on a plate of 210 × 148 mm",
    ),
    "axes in centimetres": (
        {"x_mm_from_axes": "[21.0, 0.0, 0.0]", "y_mm_from_axes": "[0.0, 14.8, 0.0]"},
        "reach 1 % of the plate: x from 0 to 21 mm and y from 0 to 14.8 mm",
    ),
    "permit line = trigger line": (
        {"permit_line": '"GPIO25"'},
        "link.permit_line = 'GPIO25' is link.trigger_line already, on pinctrl-bcm2711: the run permit would follow",
    ),
    "a pitch that no bank is built of": (
        {"pitch_mm": "5.0"},
        "bank.pitch_mm = 5 is above 4.22 mm, half a wavelength of the plate at waveform.band_high_hz = 70000",
    ),
    "0.42 W in a resistor that may have 0.25": (
        {"max_channel_edge_rate_hz": "89.5e3"},
        "limits.max_channel_edge_rate_hz = 89500 lets a stage burn 0.42 W (4.69 uJ an edge at most, of driver.supply_v = 60,"
        " capacitance_f = 2e-09) in a resistor that may have 0.25 W (resistor_rating_w = 0.5 times derating = 0.5): allow at most"
        " 53290 edges a second",
    ),
    "patches of 18 nF": ({"capacitance_f": "18e-9"}, "capacitance_f = 1.8e-08) in a resistor that may have 0.25 W"),
    "11 mm of glass": ({"thickness_mm": "11.0"}, "plate.thickness_mm = 11 is 0.34 of the wave of 32.1 mm"),
}
COMMANDS = {
    "board check": ("board", "check", "--board"),
    "bank build": ("bank", "build", "--board"),
    "run": ("run", "--link", "model", "--speed", "max", "--board"),
    "gateware build": ("gateware", "build", "--board"),
    "doctor": ("doctor", "--board"),
}


def copy_of(name, folder, text):
    """A folder with a board's files beside the shipped ones that it names, and another board.toml."""
    shutil.copytree(find_board(name), folder)
    (folder / "board.toml").write_text(text.replace('"../simulated/', f'"{find_board("simulated")}/'))
    return folder


@each_row("command", COMMANDS)
@each_row("example", REFUSED)
def test_what_is_unsafe_or_impossible_is_refused_by_every_command(example, command, tmp_path, capsys):
    keys, said = REFUSED[example]
    folder = copy_of("ulx3s", tmp_path / "panel", rewritten(SHIPPED["ulx3s"], **keys))
    assert main([*COMMANDS[command], str(folder)]) == 78
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith(f"haptic-panel: {folder / 'board.toml'}: ")
    assert err.count("\n") == 1
    assert said in err


def test_all_that_is_refused_is_said_at_once(tmp_path, capsys):
    text = rewritten(SHIPPED["ulx3s"], capacitance_f="18e-9", permit_line='"GPIO25"', pitch_mm="5.0")
    assert main(["board", "check", str(copy_of("ulx3s", tmp_path / "panel", text))]) == 78
    err = capsys.readouterr().err
    assert err.count("\n") == 1
    for said in ("link.permit_line", "bank.pitch_mm", "limits.max_channel_edge_rate_hz"):
        assert said in err


def test_a_board_is_checked_with_what_is_odd_of_it(tmp_path, capsys):
    folder = copy_of("simulated", tmp_path / "panel", ALL_HIGH)
    assert main(["board", "check", str(folder)]) == 0
    *_, warning, verdict = capsys.readouterr().out.splitlines()
    assert warning.startswith("WARNING: actuators: all 32 have idle = 1: ")
    assert verdict == "PASS: every key is valid, and they go together, with 1 warning"
    assert main(["board", "check", str(folder), "--json"]) == 0
    (odd,) = json.loads(capsys.readouterr().out)["warnings"]
    assert odd in warning


@pytest.mark.parametrize(
    ("command", "refusal"),
    [
        (("bank", "build", "--memory-mb", "1"), "MB"),
        (("run", "--speed", "max", "--bank", "nothing.bank"), "nothing.bank"),
    ],
)
def test_what_is_odd_is_a_warning_of_bank_build_and_run(command, refusal, tmp_path, capsys):
    """Said before the work, which is refused here for another reason."""
    folder = copy_of("simulated", tmp_path / "panel", ALL_HIGH)
    assert main([*command, "--board", str(folder)]) == 78
    warning, refused = capsys.readouterr().err.splitlines()
    assert warning.startswith(f"haptic-panel: {folder / 'board.toml'}: actuators: all 32 have idle = 1")
    assert refusal in refused


def test_what_is_odd_is_a_warning_of_gateware_build_and_doctor(tmp_path, capsys):
    folder = copy_of("ulx3s", tmp_path / "panel", re.sub(r"idle = 0", "idle = 1", SHIPPED["ulx3s"]))
    assert main(["gateware", "build", "--board", str(folder), "--out", str(tmp_path)]) == 78, "before minutes of work"
    warning, refusal = capsys.readouterr().err.splitlines()
    assert "actuators: all 32 have idle = 1" in warning
    assert refusal.endswith("cannot be written; give another file with --out")
    main(["doctor", "--board", str(folder), "--json"])
    (finding,) = [one for one in json.loads(capsys.readouterr().out)["findings"] if one["about"] == "board.toml"]
    assert finding["warns"]
    assert finding["good"]
    assert finding["said"].startswith("actuators: all 32 have idle = 1")


def test_touches_off_the_plate_are_said_with_figures_while_it_runs(tmp_path, capsys):
    """Axes of another panel, of which the plate's corner is a tenth: valid, and nobody is served."""
    text = rewritten(SHIPPED["simulated"], x_mm_from_axes="[210.0, 0.0, 190.0]", pitch_mm="10.0\ncoarse = true")
    folder = copy_of("simulated", tmp_path / "panel", text)
    (folder / "scene.toml").write_text(
        '[[regions]]\nname = "dot"\nshape = "circle"\nx_mm = 105.0\ny_mm = 74.0\nradius_mm = 1.0\neffects = ["click"]\n'
    )
    (folder / "demo.evemu").write_text("A: 00 0 210 0 0 0\nA: 01 0 148 0 0 0\n" + "".join(_drag(21, 31)))
    assert main(["run", "--board", str(folder), "--speed", "max", "--json"]) == 0
    out, err = capsys.readouterr()
    figures = json.loads(out)
    assert figures["positions"] == {"reported": 10, "off_plate": 8}, "the first two are within 2 mm of the edge"
    assert "reach only 9.5 % of the plate" in err.splitlines()[0]
    said = "8 of 10 positions lie off the plate by touch.x_mm_from_axes"
    assert said in err
    assert any(said in warning for warning in figures["warnings"])


def test_a_panel_whose_axes_are_wrong_can_be_calibrated(tmp_path, capsys):
    """The command that finds the axes reads a board that every other command refuses for them."""
    keys, _ = REFUSED["axes all zero"]
    folder = copy_of("simulated", tmp_path / "panel", rewritten(SHIPPED["simulated"], **keys))
    (folder / "touches.evemu").write_text("".join(_taps()))
    asked = ["calibrate-touch", "--board", str(folder), "--targets", "3", "--replay", str(folder / "touches.evemu"), "--write"]
    code = main(asked)
    err = capsys.readouterr().err
    assert code == 0, err
    assert load_board(folder).touch.x_mm_from_axes[0] == pytest.approx(210, abs=1)


def _drag(first, last):
    """A finger that moves through these values of x, and is lifted."""
    for number, x in enumerate(range(first, last)):
        yield f"E: {0.01 * number:.2f} 0003 0000 {x:04d}\nE: {0.01 * number:.2f} 0003 0001 0074\n"
        yield f"E: {0.01 * number:.2f} 0001 014a 0001\nE: {0.01 * number:.2f} 0000 0000 0000\n"
    yield "E: 1.0 0001 014a 0000\nE: 1.0 0000 0000 0000\n"


def _taps():
    """Three taps of a panel that covers the plate, at the targets that are asked for."""
    plate = load_board(find_board("simulated")).plate
    yield "A: 00 0 2100 0 0 0\nA: 01 0 1480 0 0 0\n"
    for number, (x_mm, y_mm) in enumerate(default_targets(plate, 3)):
        at_s = 2.0 * number
        yield f"E: {at_s} 0003 0000 {round(10 * x_mm):04d}\nE: {at_s} 0003 0001 {round(10 * y_mm):04d}\n"
        yield f"E: {at_s} 0001 014a 0001\nE: {at_s} 0000 0000 0000\n"
        yield f"E: {at_s + 1} 0001 014a 0000\nE: {at_s + 1} 0000 0000 0000\n"
