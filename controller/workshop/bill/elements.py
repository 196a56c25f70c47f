"""Elements of the subcircuits of boards/stage: the netlists that ngspice checks, read for those who build them."""

import re
from pathlib import Path
from typing import NamedTuple

from controller.device.board.lookup import data_folder

FOLDER = "stage"  # below boards/
NODES = {"R": 2, "C": 2, "L": 2, "D": 2, "V": 2, "M": 3, "Q": 3, "X": 3}  # of each letter; of X those of a gate


class Element(NamedTuple):
    """A line of a netlist."""

    name: str  # as it stands there, such as R1
    nodes: tuple[str, ...]
    value: str  # of a passive part, or the name of its model
    inverts: bool  # a gate whose output is the inverse of its input


class Subcircuit(NamedTuple):
    """A subcircuit: its terminals and elements."""

    terminals: tuple[str, ...]
    elements: tuple[Element, ...]


def stage_folder() -> Path:
    """Folder of the reference stage."""
    return data_folder("boards") / FOLDER


def subcircuit(name: str) -> Subcircuit:
    """Read NAME.cir, which defines a subcircuit of this name."""
    lines = (stage_folder() / f"{name}.cir").read_text(encoding="utf-8").splitlines()
    values = dict(setting.split("=") for line in lines if line.startswith(".param ") for setting in line.split()[1:])
    begin = next(number for number, line in enumerate(lines) if line.split()[:2] == [".subckt", name])
    end = lines.index(".ends", begin)
    elements = [_element(line, values) for line in lines[begin + 1 : end] if line and not line.startswith("*")]
    return Subcircuit(tuple(lines[begin].split()[2:]), tuple(elements))


def _element(line: str, values: dict[str, str]) -> Element:
    name, *words = line.split()
    count = NODES[name[0]]
    value = re.sub(r"\{(\w+)\}", lambda found: values[found[1]], words[count])
    return Element(name, tuple(words[:count]), value, "high=0" in words[count + 1 :])
