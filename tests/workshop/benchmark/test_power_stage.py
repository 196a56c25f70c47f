"""boards/stage: table, schematics and waveforms are of its netlists; ngspice finds them within limits, and wrong parts beyond."""

import re

import pytest
from tables import each_row

from controller.device.board.board import load_board
from controller.device.board.lookup import data_folder, find_board
from controller.errors import ControllerError
from controller.workshop.benchmark.stage import stage_waveforms
from controller.workshop.benchmark.stage.power_stage import BEGIN, BENCHES, END, WRONG_PARTS, limits, measure
from controller.workshop.benchmark.stage.stage_circuit import digest, parameters
from controller.workshop.simulation import ngspice

FOLDER = data_folder("boards") / "stage"
UNITS = {"ohm": "Ω", "f": "F", "h": "H"}


@pytest.fixture
def ulx3s():
    return load_board(find_board("ulx3s"))


def reported():
    """{figure: value} of the README's table."""
    table = (FOLDER / "README.md").read_text().partition(f"{BEGIN} {digest()} -->")[2].partition(END)[0]
    return {name: float(value) for name, value in re.findall(r"^\| (.+?) \| ([\d.e+-]+) \S+ \| at ", table, re.MULTILINE)}


def test_the_table_is_of_these_netlists_and_has_every_figure(ulx3s):
    assert list(reported()) == list(limits(ulx3s))


def labels(name):
    """Label of each part of a netlist: its name, and its value or kind."""
    text = (FOLDER / f"{name}.cir").read_text()
    values = dict(re.findall(r"(\w+)=(\S+)", " ".join(re.findall(r"^\.param (.*)", text, re.MULTILINE))))
    found = {}
    for line in re.findall(r"^[RCLDQMX]\w+ .*$", text, re.MULTILINE):
        part, *rest = line.split()
        last = rest[-2] if "=" in rest[-1] else rest[-1]
        value = last.strip("{}")
        if last.startswith("{"):
            unit = UNITS[value.rpartition("_")[2]]
            value = re.sub(r"(\d)([munpkM]?)$", r"\1 \2", values[value].replace("meg", "M")) + unit
        elif part.startswith(("R", "C", "L")):
            value = re.sub(r"(\d)([munpkM]?)$", r"\1 \2", value) + "Ω"
        found[part.removeprefix("X")] = (
            f"{part.removeprefix('X')} {value.replace('u', 'µ').replace('D4148', '1N4148W').replace('ahct', '74AHCT')}"
        )
    return found


def test_the_waveforms_are_of_these_netlists():
    assert f"netlists {digest()}" in (FOLDER / "waveforms.svg").read_text()


@each_row("name", ["stage", "supply"])
def test_the_schematic_shows_each_part_with_its_value_and_no_other(name):
    drawn = " ".join(re.findall(r">([^<>\n]+)</t", (FOLDER / f"{name}.svg").read_text()))
    parts = labels(name)
    assert len(parts) > 15
    for part, label in parts.items():
        if part not in ("RL1", "CL1"):  # the coil's own
            assert label.replace("Cpatch", "patch") in drawn, part
    assert set(re.findall(r"\b[RCLDQMU]\d+\b", drawn)) == set(parts) - {"RL1", "CL1", "Cpatch"}


def test_resistors_coil_and_patch_make_the_driver_of_the_board(ulx3s):
    part = parameters()
    switch_ohm = 13  # M2, or M1, at 10 and 5 V
    assert part["series_ohm"] + part["leg_ohm"] + part["winding_ohm"] + switch_ohm == pytest.approx(
        ulx3s.driver.resistance_ohm, rel=0.01
    )
    assert (part["inductance_h"], part["patch_f"]) == (ulx3s.driver.inductance_h, ulx3s.driver.capacitance_f)


def test_a_wrong_part_is_one_that_there_is_and_another():
    for what, parts, bench in WRONG_PARTS:
        assert bench in BENCHES
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
    assert {figure.name: figure.value for figure in figures} == pytest.approx(reported(), rel=0.03, abs=0.02)


@pytest.mark.slow
@pytest.mark.parametrize(("what", "parts", "bench"), WRONG_PARTS, ids=[what for what, *_ in WRONG_PARTS])
def test_a_wrong_part_is_found(ulx3s, what, parts, bench):
    assert any(not figure.good for figure in measure(ulx3s, parts, [bench]))


@pytest.mark.slow
def test_the_waveforms_are_drawn_again_as_they_are():
    """Texts and shapes the same; numbers within a point, as another machine may round otherwise."""
    number = re.compile(r"-?\d+\.?\d*(?:e-?\d+)?")
    drawn, kept = stage_waveforms.waveforms(), (FOLDER / "waveforms.svg").read_text()
    assert number.sub("#", drawn) == number.sub("#", kept)
    assert [*map(float, number.findall(drawn))] == pytest.approx([*map(float, number.findall(kept))], rel=1e-3, abs=1)
