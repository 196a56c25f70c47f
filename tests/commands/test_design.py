"""`haptic-panel design`: tables, JSON, sweeps, pictures, and one line for what is not possible."""

import json

import pytest
from tables import each_row

from controller.cli import main
from controller.commands.design import FOUND, ROWS


def printed(capsys, *arguments, code=0):
    assert main(["design", *map(str, arguments)]) == code
    return capsys.readouterr()


def test_every_figure_stands_in_the_table_and_in_json(capsys):
    table = printed(capsys).out
    found = json.loads(printed(capsys, "--json").out)
    assert found["board"] == "simulated"
    assert set(ROWS) == set(found) - {"board", "inputs", "warnings"}
    assert all(title in table for title in ROWS.values())
    assert table.count("warning: ") == len(found["warnings"]) > 0


def test_numbers_take_the_place_of_the_boards(capsys):
    found = json.loads(printed(capsys, "--json", "--amplitude-um", 7.68, "--channels", 16, "--length-mm", 150).out)
    assert (found["inputs"]["channels"], found["inputs"]["length_mm"], found["inputs"]["width_mm"]) == (16, 150, 148)
    assert found["amplitude_um"] == pytest.approx(7.68)


def test_a_sweep_is_a_table_and_json(capsys):
    swept = ("--sweep", "thickness_mm=0.4:0.6:0.1")
    lines = printed(capsys, *swept).out.splitlines()
    assert [line.split()[0] for line in lines] == ["thickness_mm", "0.4", "0.5", "0.6"]
    found = json.loads(printed(capsys, *swept, "--json").out)
    assert found["values"] == [0.4, 0.5, 0.6]
    amplitudes = [row["amplitude_um"] for row in found["designs"]]
    assert amplitudes == sorted(amplitudes, reverse=True)
    assert found["designs"][1]["tc_ms"] == pytest.approx(19.54, abs=0.005)


def test_a_search_is_a_table_and_json_and_says_by_its_exit_code_whether_it_found_one(capsys):
    table = printed(capsys, "--find", "channels", "--felt-um", 1).out.splitlines()
    assert table[0] == "Fewest channels that reach a felt amplitude of 1 µm:"
    assert table[1].split() == list(FOUND)
    assert len({len(line) for line in table[1:]}) == 1
    found = json.loads(printed(capsys, "--find", "thickness", "--felt-um", 9, "--json", code=1).out)
    assert not found["reached"]
    assert len(found["designs"]) == 1


@pytest.mark.slow  # a command of the README draws one in the normal run
def test_a_sweep_is_a_picture(capsys, tmp_path):
    picture = tmp_path / "sweep.png"
    printed(capsys, "--sweep", "thickness_mm=0.4:0.6:0.1", "--plot", picture)
    assert picture.read_bytes().startswith(b"\x89PNG")


@each_row(
    ("arguments", "said"),
    [
        (("--thickness-mm", "-1"), "thickness_mm = -1"),
        (("--poisson-ratio", "0.5"), "poisson_ratio = 0.5"),
        (("--band-low-hz", "90e3"), "is not above band_low_hz"),
        (("--channels", "1.5"), "channels = 1.5: must be a whole number"),
        (("--period-ms", "1"), "emissions would overlap"),
        (("--size-mm", "200"), "of a patch is above the plate's"),
        (("--sweep", "thickness_mm=1:inf:1"), "--sweep thickness_mm=1:inf:1"),
        (("--sweep", "thickness_mm=1:0:-0.25"), "thickness_mm = 0"),
        (("--plot", "a.png"), "give --sweep"),
        (("--find", "thickness,width"), "'width' cannot be searched: one or more of thickness,channels,disc"),
        (("--find", "thickness", "--thickness-mm", "1"), "thickness is given too"),
        (("--find", "disc", "--disc", "7BB-20-6"), "disc is given too"),
        (("--find", "disc", "--sweep", "thickness_mm=1:2:1"), "--find and --sweep: give one of both"),
        (("--find", "disc", "--felt-um", "0"), "--felt-um 0: must be above 0"),
        (("--find", "disc", "--price", "stage=4"), "--price stage: must be one of channel, disc, 7BB-12-9"),
        (("--find", "disc", "--price", "channel=nan"), "--price channel=nan: must be NAME=COST, a number from 0"),
        (("--find", "disc", "--price", "channel"), "--price channel: must be NAME=COST"),
        (("--price", "channel=4"), "--price is of use with --find"),
        (("--find", "channels", "--length-mm", "3"), "no such panel is possible"),
        (("--disc", "7BB"), "is not in the catalogue: one of 7BB-12-9"),
        (("--sectors", "0"), "sectors = 0: must be a whole number from 1 to 32"),
        (("--sweep", "channels=8:32:8", "--plot", "a.txt"), "a.txt"),
    ],
)
def test_what_is_not_possible_is_refused_in_one_line(capsys, arguments, said):
    out, err = printed(capsys, *arguments, code=78)
    assert out == ""
    assert said in err
    assert err.count("\n") == 1
