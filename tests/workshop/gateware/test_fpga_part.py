"""fpga.toml: what goes together in it, and with board.toml and top.v."""

import re
import shutil

import msgspec
import pytest
from tables import each_row

from controller.cli import main
from controller.device.board.board import load_board
from controller.device.board.lookup import data_folder, find_board
from controller.errors import ConfigError
from controller.workshop.gateware.fpga_part import BAUD, PLL, check_top, find_part, load_part

BOARDS = data_folder("boards")
SHIPPED = sorted(file.parent.name for file in BOARDS.glob("*/top.v"))


@pytest.fixture
def copied(tmp_path):
    folder = tmp_path / "panel"
    shutil.copytree(find_board("ulx3s"), folder)
    text = (folder / "board.toml").read_text()
    (folder / "board.toml").write_text(text.replace('"../simulated/', f'"{find_board("simulated")}/'))
    return folder


def rewrite(file, was, becomes):
    text = file.read_text()
    assert was in text
    file.write_text(text.replace(was, becomes, 1))


@each_row(
    ("was", "becomes", "said"),
    [
        ('family = "ecp5"', 'family = "gowin"', "devices: '25k' is no size of family 'gowin', such as 'GW2A-18'"),
        ('"25k"', '"GW2A-18"', "devices: 'GW2A-18' is no size of family 'ecp5', such as '25k'"),
        ('"pins.lpf"', '"pins.cst"', "constraints = 'pins.cst': pins of family 'ecp5' are in a file .lpf"),
    ],
    afresh=[copied],
)
def test_keys_that_do_not_go_together_are_refused(copied, was, becomes, said):
    rewrite(copied / "fpga.toml", was, becomes)
    with pytest.raises(ConfigError) as caught:
        load_part(copied)
    assert said in str(caught.value)


def test_a_gowin_has_its_speed_in_its_package(tmp_path):
    text = (BOARDS / "tang_primer_20k" / "fpga.toml").read_text()
    (tmp_path / "fpga.toml").write_text(text)
    assert load_part(tmp_path).speed is None
    (tmp_path / "fpga.toml").write_text(text + "speed = 6\n")
    with pytest.raises(ConfigError, match="speed = 6: a Gowin has its speed in `package`; leave it out"):
        load_part(tmp_path)


@each_row(
    ("board", "name"), [("ulx3s", "top.v"), ("ulx3s", "pins.lpf"), ("tang_primer_20k", "pins.cst"), ("tang_primer_20k", "pins.sdc")]
)
def test_a_file_that_it_needs_and_has_not_is_named(board, name, tmp_path):
    folder = tmp_path / f"{board}_{name}"
    shutil.copytree(find_board(board), folder)
    (folder / name).unlink()
    with pytest.raises(ConfigError, match=re.escape(f"there is no {name} beside it")):
        find_part(folder, None)


@each_row("name", SHIPPED)
def test_an_sck_that_its_clocks_do_not_allow_is_refused(name, tmp_path):
    board = load_board(BOARDS / name)
    clocks = load_part(BOARDS / name).clocks
    check_top(board, BOARDS / name, clocks)
    fast = msgspec.structs.replace(board, link=msgspec.structs.replace(board.link, sck_hz=28_000_000))
    with pytest.raises(ConfigError, match=rf"link\.sck_hz = 28000000, but .*{re.escape(clocks)} constrains SCK to (25|27\.8) MHz"):
        check_top(fast, BOARDS / name, clocks)


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        (
            [("clock_hz = 62_500_000", "clock_hz = 50_000_000"), ("sck_hz = 27_7", "sck_hz = 20_7")],
            "link.clock_hz = 50000000, but ",
        ),
        (
            [
                *(('kind = "spi"\ndevice = "/dev/spidev0.0"', 'kind = "serial"\nbaud = 500_000\ndevice = "/dev/ttyUSB0"'),),
                *((f'{key}_line = "GPIO{pin}"\n', "") for key, pin in (("trigger", 25), ("configured", 24), ("permit", 23))),
            ],
            "link.baud = 500000, but ",
        ),
    ],
)
def test_a_clock_or_baud_rate_that_top_v_does_not_make_is_refused_before_minutes_of_work(copied, changes, said, capsys):
    for was, becomes in changes:
        rewrite(copied / "board.toml", was, becomes)
    load_board(copied)
    for command in (("board", "check"), ("gateware", "build")):
        assert main([*command, "--board", str(copied)]) == 78
        err = capsys.readouterr().err
        assert f"{said}{copied / 'top.v'} makes " in err
        assert err.count("\n") == 1


@pytest.mark.parametrize("name", SHIPPED)
def test_what_a_shipped_top_v_makes_is_found_in_it(name):
    text = (BOARDS / name / "top.v").read_text()
    assert int(PLL.search(text)[1].replace("_", "")) == load_board(BOARDS / name).link.clock_hz
    assert BAUD.search(text) or name != "ulx3s"
