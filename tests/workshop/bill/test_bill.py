"""Bill of materials and KiCad's netlist follow the board, and connect what the netlists that ngspice checks connect."""

import csv
import io
import json
import warnings
from collections import defaultdict

import kinparse
import msgspec
import pytest

from controller.cli import main
from controller.device.board.board import load_board
from controller.device.board.lookup import data_folder, find_board
from controller.device.board.plate.parts import followed
from controller.workshop.bill.bill import bill, supply_w
from controller.workshop.bill.circuit import circuit
from controller.workshop.bill.kicad import kicad_netlist

BOARD = load_board(find_board("ulx3s"))
replace = msgspec.structs.replace


def with_channels(count):
    return replace(BOARD, actuators=BOARD.actuators[:count])


EIGHT = with_channels(8)


def quantities(board, group="stages"):
    found = defaultdict(float)
    for item in bill(board):
        if item.group == group:
            found[item.item] += item.quantity
    return found


@pytest.fixture(scope="module")
def parsed():
    """Of KiCad's netlist, by another program: value and footprint by reference, nets as sets of (reference, pad)."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)  # names that pyparsing has other ones for
        netlist = kinparse.parse_netlist(kicad_netlist(circuit(EIGHT), "a test"))
    parts = {part.ref: (part.value, part.footprint) for part in netlist.parts}
    return parts, {net.name: {(pin.ref, pin.num) for pin in net.pins} for net in netlist.nets}


def test_quantities_are_those_of_the_netlist(parsed):
    parts, _ = parsed
    of_values = defaultdict(int)
    for value, _ in parts.values():
        of_values[value] += 1
    listed = defaultdict(float)
    for name, count in quantities(EIGHT).items():
        listed[name.split(" ", 1)[1]] += count
    del listed["board"]
    assert listed == of_values
    assert of_values["ZVP3310F"] == 8
    assert of_values["BSS123"] == 8 + 2
    assert of_values["6.8m"] == 8
    assert (of_values["74AHCT540"], of_values["74AHCT541"]) == (1, 2)  # the third one for the switch of the supply


def nodes_of(name):
    """Terminals, and (part, nodes) of a subcircuit; meters and the winding's resistance are wires."""
    lines = (data_folder("boards") / "stage" / f"{name}.cir").read_text().split(f".subckt {name} ")[1].splitlines()
    elements = [line.split() for line in lines[1 : lines.index(".ends")] if line and line[0] != "*"]
    same = {}
    for part, first, second, *_ in elements:
        if part[0] == "V" or part == "RL1":
            same[first] = second

    def one(node):
        return one(same[node]) if node in same else node

    count = {"M": 3, "Q": 3, "X": 2}
    return [
        (part, [one(node) for node in nodes[: count.get(part[0], 2)]])
        for part, *nodes in elements
        if part[0] != "V" and part not in ("RL1", "CL1", "Cpatch")
    ]


PADS = {  # by data sheets: of SOT-23, SOT-223 and SOD-123
    "M": ("3", "1", "2"), "Q": ("3", "1", "2"), "BAT54": ("1", "3"), "BZX84C12": ("1", "3"), "1N4148W": ("2", "1"),
    "FQT5P10": ("2", "1", "3"),
}  # fmt: skip


def test_connectivity_is_that_of_the_checked_netlists(parsed):
    """Pad by pad: each node of a subcircuit is one net, and no two nodes share one."""
    parts, nets = parsed
    net_of = {pin: name for name, pins in nets.items() for pin in pins}
    seen = set()
    for name, prefixes in (("stage", range(1, 9)), ("supply", [0])):
        for prefix in prefixes:
            of_node = {}
            gates = []
            for part, nodes in nodes_of(name):
                if part[0] == "X":
                    gates.append((part, nodes))
                    continue
                reference = f"{part[0]}{100 * prefix + int(part[1:])}"
                value = parts[reference][0]
                pads = PADS.get(value, PADS.get(part[0], ("1", "2")))
                for node, pad in zip(nodes, pads, strict=True):
                    seen.add((reference, pad))
                    assert of_node.setdefault(node, net_of[reference, pad]) == net_of[reference, pad], (reference, node)
            assert len(set(of_node.values())) == len(of_node)
            assert of_node["0"] == "GND"
            for part, (source, output) in gates:
                chip = "74AHCT540" if part == "XU2" else "74AHCT541"
                (driven,) = [pin for pin in nets[of_node[output]] if pin[0][0] == "U"]
                assert parts[driven[0]][0] == chip
                assert (driven[0], str(20 - int(driven[1]))) in nets[of_node[source]]  # the input across the chip
                seen |= {driven, (driven[0], str(20 - int(driven[1])))}
    left = {reference for pins in nets.values() for reference, pad in pins - seen if reference[0] != "U"}
    assert {reference[0] for reference in left} == {"J", "C"}  # connectors and decoupling alone
    assert all(parts[reference][0] in ("100n", "10u") for reference in left if reference[0] == "C")


def test_every_channel_comes_from_the_fpga_and_goes_to_its_disc(parsed):
    _, nets = parsed
    for channel in range(8):
        assert len([pin for pin in nets[f"CH{channel:02d}"] if pin[0] == "J1"]) == 1
        assert len([pin for pin in nets[f"CH{channel:02d}_patch"] if pin[0] == f"J{21 + channel // 4}"]) == 1
    assert {("J11", "1"), ("M23", "3")} <= nets["V60_IN"]
    assert {("J21", "5"), ("J22", "5"), ("J11", "2")} <= nets["GND"]


def test_another_board_has_another_bill():
    fewer, whole = quantities(with_channels(28)), quantities(BOARD)
    assert fewer["transistor ZVP3310F"] == 28
    assert whole["transistor ZVP3310F"] == 32
    assert quantities(with_channels(28), "panel")["piezo disc 7BB-12-9"] == 7
    parts = replace(BOARD.parts, disc="7BB-20-6")
    driver = followed(parts, BOARD.plate, BOARD.waveform, {"supply_v": 60.0})["driver"]
    other = replace(BOARD, parts=parts, driver=replace(BOARD.driver, **driver))
    assert other.driver.inductance_h != BOARD.driver.inductance_h
    names = {item.item for item in bill(other)}
    assert "piezo disc 7BB-20-6" in names
    assert f"inductor {other.driver.inductance_h * 1e3:g}m" in names
    assert "inductor 6.8m" not in names
    strong = replace(BOARD, limits=replace(BOARD.limits, resistor_rating_w=1.0))
    assert any("2512" in item.specification for item in bill(strong) if item.item == "resistor 1.87k")


def test_the_supply_bears_what_was_simulated():
    """boards/stage/README.md: 8.53 W at the edge limit of all channels, in its worst corner."""
    table = (data_folder("boards") / "stage" / "README.md").read_text()
    simulated_w = float(table.split("| from the 60 V supply at the edge limit of all channels | ")[1].split(" W")[0])
    assert simulated_w <= supply_w(BOARD) <= 1.15 * simulated_w


@pytest.mark.parametrize("board", ["simulated", "ulx3s_pi5"])
def test_the_command_prints_tables_and_writes_the_netlist(board, tmp_path, capsys):
    file = tmp_path / "stages.net"
    assert main(["board", "bom", board, "--netlist", str(file)]) == 0
    out, err = capsys.readouterr()
    assert "32  transistor ZVP3310F" in out
    assert "Import, Netlist" in err
    assert file.read_text().count("(comp (ref") == len(circuit(load_board(find_board(board))))
    assert main(["board", "bom", board, "--csv"]) == 0
    rows = list(csv.DictReader(io.StringIO(capsys.readouterr().out)))
    assert main(["board", "bom", board, "--json"]) == 0
    items = json.loads(capsys.readouterr().out)["items"]
    assert [row["item"] for row in rows] == [item["item"] for item in items]
    assert main(["board", "bom", board, "--netlist", str(tmp_path)]) == 78
    assert "cannot be written" in capsys.readouterr().err
