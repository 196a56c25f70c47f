"""The wiring.svg of each board: what its pins, board.toml and the netlists say; `test_board_top` compares them with the README."""

import re

from compiled_top import BOARDS, files
from tables import each_row
from wiring import drawing, wires_of

from controller.workshop.benchmark.stage.stage_circuit import parameters


@each_row("name", BOARDS)
def test_the_drawing_has_a_line_for_each_wire_and_no_other(name):
    """`python tests/board_top/wiring.py` draws it again."""
    text = (files(name).folder / "wiring.svg").read_text()
    assert text == drawing(name)
    made = wires_of(name)
    assert len(made) == 32 + 13
    assert text.count("<path") == len(made) + sum(wire.pull_down_ohm is not None for wire in made)


@each_row("name", BOARDS)
def test_each_line_of_the_host_goes_where_the_readme_says(name):
    board = files(name)
    of_host = [wire for wire in wires_of(name) if wire.kind == "host"]
    assert {re.search(r"GPIO\d+", wire.end)[0]: board.named[wire.pin.name] for wire in of_host} == board.wires
    text = (board.folder / "README.md").read_text()
    for wire in of_host:
        assert re.search(rf"\b{re.search('pin ([0-9]+)', wire.end)[1]}\b", text)


@each_row("name", BOARDS)
def test_whatever_switches_60_v_has_a_pull_down_and_so_have_the_permits(name):
    for wire in wires_of(name):
        if wire.kind in ("stage", "safety") or wire.signal == "run permit":
            assert wire.pull_down_ohm in (parameters()["pull_down_ohm"], 10e3), wire
