"""A board folder from answers: whole, valid, and a board whose keys follow from them; or one line and nothing left behind."""

import itertools
import re
import shlex
import tomllib

import msgspec
import pytest
from commands.test_documented_commands import complaint
from tables import each_row

from controller.device.board.board import load_board
from controller.device.board.lookup import data_folder
from controller.device.board.plate.parts import catalogue
from controller.device.board.records import as_record
from controller.device.board.reference import attributes
from controller.device.board.relations.checked import judge
from controller.device.board.relations.stage_heat import worst_edge_j
from controller.device.doctor.finding import Finding
from controller.device.doctor.way import in_lines, way
from controller.device.setup.answers import HELD, SetupAnswers, glasses
from controller.device.setup.board_folder import write_board
from controller.errors import ConfigError
from controller.workshop.gateware.fpga_part import load_part

SIZE = {"length_mm": 217.0, "width_mm": 136.0, "thickness_mm": 1.1}
TOUCH = {
    "linux_input": {"device": 'Goodix "10"'},
    "gt911": {"bus": "/dev/i2c-1", "interrupt_chip": "pinctrl-bcm2711", "interrupt_line": "GPIO17"},
    "ft5x06": {"bus": "/dev/i2c-1", "width": 800, "height": 480},
    "serial_panel": {"device": "/dev/ttyUSB1"},
}


def answers(**more):
    return as_record("", {**SIZE, **more}, SetupAnswers)


def test_a_folder_holds_all_that_the_board_names(tmp_path):
    board = write_board(tmp_path / "boards" / "panel", answers(disc="7BB-20-6", discs=7, touch="gt911"), TOUCH["gt911"])
    assert board.name == board.key == "panel"
    assert sorted(file.name for file in board.folder.iterdir()) == ["board.toml", "fpga.toml", "pins.lpf", "scene.toml", "top.v"]
    assert sorted(file.name for file in (tmp_path / "boards").iterdir()) == ["panel"]
    assert (board.plate.length_mm, board.plate.width_mm, board.plate.thickness_mm) == (217, 136, 1.1)
    assert len(board.actuators) == 28
    assert (board.driver.capacitance_f, board.driver.inductance_h, board.driver.resistance_ohm) == (2.5e-9, 4.7e-3, 1500)
    assert board.touch.interrupt_line == "GPIO17"
    limits = board.limits
    assert 0.9 < limits.max_channel_edge_rate_hz * worst_edge_j(board.driver) / (limits.resistor_rating_w * limits.derating) <= 1
    assert not judge(board).odd


def test_the_question_for_a_disc_names_every_disc_of_the_catalogue():
    assert set(re.findall(r"\S+-\S+\w", attributes(SetupAnswers)["disc"])) == set(catalogue())


def test_a_simulated_board_is_delivered_without_a_bitstream(tmp_path):
    board = write_board(tmp_path / "panel", answers(fpga="simulated"), TOUCH["linux_input"])
    assert (board.link.kind, board.link.device) == ("simulated", "actual.toml")
    assert tomllib.loads((board.folder / "actual.toml").read_text()) == {"fpga": {"flash": "flash.bit"}}
    assert not (board.folder / "flash.bit").exists()


def test_every_glass_disc_edge_touch_panel_and_computer_makes_a_board(tmp_path):
    kinds = itertools.cycle(TOUCH)
    fpgas = [f"{name}{computer}" for name in ("ulx3s", "colorlight_i5", "tang_primer_20k") for computer in ("", "_pi5")]
    numbered = enumerate(itertools.product(glasses(), HELD, fpgas, catalogue()))
    for index, (glass, held, fpga, disc) in list(numbered)[::9]:
        kind = next(kinds)
        given = answers(glass=glass, held=held, fpga=fpga, disc=disc, discs=1 + index % 8, touch=kind, resistor_w=1.0)
        board = write_board(tmp_path / f"panel{index}", given, TOUCH[kind])
        assert board.plate.density_kg_m3 == glasses()[glass]["density_kg_m3"]
        own = data_folder("boards") / fpga.removesuffix("_pi5")
        host = load_board(own.with_name("ulx3s_pi5") if fpga.endswith("_pi5") else own)
        assert board.link == msgspec.structs.replace(host.link, clock_hz=load_board(own).link.clock_hz)
        assert board.gateware == load_board(own).gateware
        part = load_part(board.folder)
        assert part == load_part(own)
        assert {(board.folder / name).read_bytes() == (own / name).read_bytes() for name in part.files} == {True}
        assert not [odd for odd in judge(board).odd if not odd.startswith("actuators: a patch")]


def test_the_axes_of_a_smaller_screen_lie_in_the_middle_of_the_glass(tmp_path):
    board = write_board(tmp_path / "panel", answers(screen_length_mm=200.0, screen_width_mm=120.0), TOUCH["linux_input"])
    assert board.touch.x_mm_from_axes == (200.0, 0.0, 8.5)
    assert board.touch.y_mm_from_axes == (0.0, 120.0, 8.0)


def test_words_of_a_new_board_have_the_slope_that_is_felt_more_or_are_the_papers(tmp_path):
    felt, paper = (
        write_board(tmp_path / name, answers(**given), TOUCH["linux_input"])
        for name, given in (("felt", {}), ("paper", {"waveform": "paper"}))
    )
    assert felt.waveform == msgspec.structs.replace(paper.waveform, slope=-1.0)
    assert paper.waveform == load_board(data_folder("boards") / "ulx3s").waveform
    texts = [(board.folder / "board.toml").read_text() for board in (felt, paper)]
    assert re.sub(r"slope = -1  # felt .*\n", "", texts[0]).replace('"felt"', '"paper"') == texts[1]


@each_row(
    ("given", "said"),
    [
        ({"length_mm": 5.0}, "length_mm = 5.0: must be a number from 20 to 4000 mm"),
        ({"glass": "crown"}, "glass = 'crown': must be one of"),
        ({"disc": "7BB"}, "disc = '7BB' is not in the catalogue"),
        ({"discs": 9}, "discs = 9: must be a whole number from 1 to 8"),
        ({"screen_width_mm": 140.0}, "screen_width_mm = 140 is above the glass's width_mm = 136"),
        ({"thickness_mm": float("nan")}, "thickness_mm = nan: must be a finite number"),
    ],
)
def test_answers_that_are_none_are_refused_in_one_line(given, said):
    with pytest.raises(ConfigError) as refused:
        answers(**given)
    assert said in str(refused.value)
    assert "\n" not in str(refused.value)


@each_row(
    ("name", "given", "touch", "said"),
    [
        ("Panel", {}, {"device": "a"}, "has a name of lower case letters"),
        ("there", {}, {"device": "a"}, "exists already"),
        ("panel", {}, {}, "touch.device is missing"),
        ("panel", {}, {"device": "a", "buss": 1}, "touch.buss = 1: unknown key"),
        ("panel", {"thickness_mm": 16.0}, {"device": "a"}, "plate.thickness_mm = 16"),
    ],
)
def test_a_board_that_would_be_refused_leaves_nothing_behind(tmp_path, name, given, touch, said):
    (tmp_path / "there").mkdir(exist_ok=True)
    with pytest.raises(ConfigError) as refused:
        write_board(tmp_path / name, answers(**given), touch)
    assert said in str(refused.value)
    assert [file.name for file in tmp_path.iterdir()] == ["there"]


def test_the_way_is_made_of_whole_commands(tmp_path):
    """`calibrate measure` was shown without its folder, `calibrate-touch` without --write, which is not ticked off."""
    steps = way(write_board(tmp_path / "panel", answers(), TOUCH["linux_input"]))
    words = [shlex.split(one)[1:] for step in steps for one in step.command.split(", ")]
    assert [complaint(one) for one in words] == [None] * len(words)
    assert words[6][-1] == "--write"


def test_the_way_is_ticked_off_by_what_is_found(tmp_path):
    board = write_board(tmp_path / "panel", answers(), TOUCH["linux_input"])
    new = {step.name: step.done for step in way(board)}
    assert list(new.values()) == [True, False, None, None, None, None, False, None, None, None]
    found = [Finding("bank", True, ""), Finding("touch panel", False, ""), Finding("responses", True, "", warns=True)]
    later = {
        step.name: step.done for step in way(board, [*found, Finding("identity and settings", True, ""), Finding("bits", True, "")])
    }
    assert list(later.values()) == [True, False, True, True, True, False, False, None, False, None]
    measured = (board.folder / "board.toml").read_text().replace("[217, 0, 0]", "[216.731, 0.102, 0.250]")
    (board.folder / "board.toml").write_text(measured)
    axes = next(step for step in way(load_board(board.folder)) if step.name == "its axes are measured")
    assert axes.done
    assert in_lines([axes]) == ["[x] its axes are measured"]
