"""boards/stage: its table and pictures are of its netlists; ngspice finds them within limits, and wrong parts beyond."""

import re

import pytest

from controller.benchmark import power_stage, power_stage_pictures
from controller.benchmark.power_stage import BEGIN, END, WRONG_PARTS, digest, limits, measure, parameters
from controller.board.board import load_board
from controller.board.lookup import data_folder, find_board
from controller.errors import ControllerError
from controller.simulation import ngspice

FOLDER = data_folder("boards") / "stage"
PICTURES = ("stage.svg", "supply.svg", "waveforms.svg")


@pytest.fixture
def ulx3s():
    return load_board(find_board("ulx3s"))


def told():
    """{figure: value} of the README's table."""
    table = (FOLDER / "README.md").read_text().partition(f"{BEGIN} {digest()} -->")[2].partition(END)[0]
    return {name: float(value) for name, value in re.findall(r"^\| (.+?) \| ([\d.e+-]+) \S+ \| at ", table, re.MULTILINE)}


def test_the_table_is_of_these_netlists_and_has_every_figure(ulx3s):
    assert list(told()) == list(limits(ulx3s))


@pytest.mark.parametrize("name", PICTURES)
def test_the_picture_is_of_these_netlists(name):
    assert power_stage_pictures.picture_digest(FOLDER / name) == digest()


@pytest.mark.parametrize("name", ["stage", "supply"])
def test_the_schematic_shows_each_part_with_its_value(name):
    drawn = " ".join(re.findall(r">([^<>\n]+)</t", (FOLDER / f"{name}.svg").read_text()))
    parts = power_stage_pictures.labels(name)
    assert len(parts) > 15
    for part, label in parts.items():
        if part not in ("RL1", "CL1"):  # the coil's own
            assert label.replace("\n", " ").replace("Cpatch", "patch") in drawn, part


def test_resistors_coil_and_patch_make_the_driver_of_the_board(ulx3s):
    part = parameters()
    switch_ohm = 13  # M2, or M1, at 10 and 5 V
    assert part["series_ohm"] + part["leg_ohm"] + part["winding_ohm"] + switch_ohm == pytest.approx(
        ulx3s.driver.resistance_ohm, rel=0.01
    )
    assert (part["inductance_h"], part["patch_f"]) == (ulx3s.driver.inductance_h, ulx3s.driver.capacitance_f)


def test_a_wrong_part_is_one_that_there_is_and_another():
    for what, parts, bench in WRONG_PARTS:
        assert bench in power_stage.BENCHES
        for name, value in parts.items():
            assert not 0.6 < value / parameters()[name] < 1.5, what


def test_without_ngspice_it_says_what_to_install(monkeypatch):
    monkeypatch.setenv("PATH", "/nowhere")
    with pytest.raises(ControllerError, match="apt-get install ngspice"):
        ngspice.transient("", ["v(a)"], 1e-6, 1e-3)


@pytest.mark.slow
def test_what_ngspice_does_not_understand_is_an_error():
    with pytest.raises(ControllerError, match="did not simulate"):
        ngspice.transient("R1 a 0 nonsense\nX1 a nothing", ["v(a)"], 1e-6, 1e-3)


@pytest.mark.slow
def test_every_figure_is_within_its_limit_and_in_the_table(ulx3s):
    figures = measure(ulx3s)
    assert [figure.name for figure in figures if not figure.good] == []
    assert {figure.name: figure.value for figure in figures} == pytest.approx(told(), rel=0.03, abs=0.02)


@pytest.mark.slow
@pytest.mark.parametrize(("what", "parts", "bench"), WRONG_PARTS, ids=[what for what, *_ in WRONG_PARTS])
def test_a_wrong_part_is_found(ulx3s, what, parts, bench):
    assert any(not figure.good for figure in measure(ulx3s, parts, [bench]))


@pytest.mark.slow
def test_the_pictures_are_drawn_again_as_they_are(tmp_path):
    """Texts and shapes the same; numbers within a point, as another machine may round otherwise."""
    power_stage_pictures.main(tmp_path)
    number = re.compile(r"-?\d+\.?\d*(?:e-?\d+)?")
    for name in PICTURES:
        drawn, kept = ((folder / name).read_text() for folder in (tmp_path, FOLDER))
        assert number.sub("#", drawn) == number.sub("#", kept), name
        assert [*map(float, number.findall(drawn))] == pytest.approx([*map(float, number.findall(kept))], rel=1e-3, abs=1), name
