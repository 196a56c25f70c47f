"""The circuit of a board's stages: the reference stage once for each channel, the switch of their supply, drivers, connectors.

Connectivity is that of the netlists that ngspice checks, part for part; what is added are decoupling capacitors and connectors. R8
and L1 are those of the board's [driver].
"""

from collections.abc import Iterator, Sequence
from typing import Any, Final, NamedTuple

from controller.device.board.board import Board
from controller.device.board.plate.parts import made
from controller.device.board.plate.patches import discs
from controller.device.board.records import read_tables
from controller.workshop.bill.elements import Element, Subcircuit, stage_folder, subcircuit

E96: Final = tuple(float(f"{10 ** (step / 96):.2f}") for step in range(96))  # IEC 60063
GATES: Final = 8  # of a 74AHCT541
HEADER: Final = 16  # channels of a header: each with a ground beside it
SHARED: Final = {"0": "GND", "v60": "V60", "v5": "V5", "v60_in": "V60_IN", "hv_enable": "HV_ENABLE", "hv_alive": "HV_ALIVE"}
RESISTORS: Final = {0.1: "0603_1608", 0.25: "1206_3216", 0.5: "1210_3225", 0.75: "2010_5025", 1.0: "2512_6332"}  # W for good


class Component(NamedTuple):
    """A part on the circuit board."""

    reference: str
    value: str
    footprint: str
    text: str  # specification
    pads: dict[str, str]  # net by the number of a pad


def circuit(board: Board) -> list[Component]:
    """All parts of the stages of `board`, by reference within their kind."""
    parts = read_tables(stage_folder() / "parts.toml")
    channels = sorted(actuator.channel for actuator in board.actuators)
    found, gates = [], list[tuple[Element, dict[str, str]]]()
    for name, which in (("stage", channels), ("supply", [-1])):
        whole = subcircuit(name)
        wires = _joined(whole, parts["joined"])
        for channel in which:
            for element in whole.elements:
                if element.name in (*parts["joined"], *parts["omitted"]):
                    continue
                nets = {node: _net(wires.get(node, node), channel) for node in element.nodes}
                if element.value == "ahct":
                    gates.append((element, nets))
                else:
                    found.append(_component(board, element, nets, channel, parts))
    chips = list(_chips(gates, parts["ahct"]))
    return [*found, *chips, *_decoupling(len(chips)), *_connectors(board, channels)]


def _joined(whole: Subcircuit, names: Sequence[str]) -> dict[str, str]:
    """Nodes that are another one, since what lies between them is a wire; a terminal keeps its name."""
    ends = [element.nodes for element in whole.elements if element.name in names]
    return dict((first, second) if second in whole.terminals else (second, first) for first, second in ends)


def _net(node: str, channel: int) -> str:
    if node in SHARED:
        return SHARED[node]
    return f"SUPPLY_{node}" if channel < 0 else f"CH{channel:02d}" if node == "drive" else f"CH{channel:02d}_{node}"


def _component(board: Board, element: Element, nets: dict[str, str], channel: int, parts: dict[str, Any]) -> Component:
    """One of an element; of the stage of `channel`, counted from 1, with that number before its own."""
    kind = parts.get(element.value) or parts[element.name[0]]
    kind = kind | parts["references"].get(element.name, {})
    value, footprint, text = kind.get("value", element.value), kind["footprint"], kind["text"]
    if element.name == "R8":
        value, footprint, text = _series(board)
    elif element.name == "L1":
        value = _engineering(board.driver.inductance_h)
    letter, number = element.name[0], int(element.name[1:])
    reference = element.name if channel < 0 else f"{letter}{100 * (channel + 1) + number}"
    pads = {pad: nets[node] for pad, node in zip(kind["pads"], element.nodes, strict=True)}
    return Component(reference, value, footprint, text, pads)


def _series(board: Board) -> tuple[str, str, str]:
    """R8: what the legs and the winding leave of the board's resistance, in a case for the board's rating."""
    of = {element.name: element.value for element in subcircuit("stage").elements}
    rest_ohm = board.driver.resistance_ohm - _number(of["R6"]) - _number(of["RL1"])
    rating_w = board.limits.resistor_rating_w
    case = next((name for power_w, name in RESISTORS.items() if power_w >= rating_w), RESISTORS[1.0])
    text = f"1 %, {rating_w:g} W" + ("" if rating_w <= max(RESISTORS) else ": a 2512 of that rating")
    return _engineering(made(max(rest_ohm, 1.0), E96)), f"Resistor_SMD:R_{case}Metric", text


def _chips(gates: Sequence[tuple[Element, dict[str, str]]], kind: dict[str, Any]) -> Iterator[Component]:
    """Gates in chips of eight; inputs that are left over lie on ground, outputs are open."""
    number = 1
    for inverts, value in ((False, "74AHCT541"), (True, "74AHCT540")):
        same = [(element, nets) for element, nets in gates if element.inverts is inverts]
        for first in range(0, len(same), GATES):
            pads = dict.fromkeys((*kind["enables"], kind["ground"], *kind["inputs"]), "GND") | {kind["supply"]: "V5"}
            for place, (element, nets) in enumerate(same[first : first + GATES]):
                source, output, _ = element.nodes
                pads |= {kind["inputs"][place]: nets[source], kind["outputs"][place]: nets[output]}
            yield Component(f"U{number}", value, kind["footprint"], kind["text"], pads)
            number += 1


def _decoupling(chips: int) -> Iterator[Component]:
    """A capacitor beside each chip, and one where 5 V come in: not of the netlists, which have ideal supplies."""
    for number in range(1, chips + 1):
        pads = {"1": "V5", "2": "GND"}
        yield Component(f"C{number}", "100n", "Capacitor_SMD:C_0603_1608Metric", "16 V, X7R, 0603, beside its chip", pads)
    yield Component("C50", "10u", "Capacitor_SMD:C_1206_3216Metric", "16 V, X7R, 1206", {"1": "V5", "2": "GND"})


def _connectors(board: Board, channels: Sequence[int]) -> Iterator[Component]:
    """To the FPGA, the supplies and the discs: odd pins of a header carry signals, even ones ground."""
    for number, first in enumerate(range(0, len(channels), HEADER), 1):
        signals = [f"CH{channel:02d}" for channel in channels[first : first + HEADER]]
        signals += ["HV_ENABLE", "HV_ALIVE"] if number == 1 else []
        pads = {str(2 * place + 1): net for place, net in enumerate(signals)}
        pads |= {str(2 * place + 2): "GND" for place in range(len(signals))}
        footprint = f"Connector_PinHeader_2.54mm:PinHeader_2x{len(signals):02d}_P2.54mm_Vertical"
        yield Component(f"J{number}", f"FPGA {number}", footprint, f"pin header 2 x {len(signals)}, 2.54 mm", pads)
    for number, net in ((11, "V60_IN"), (12, "V5")):
        footprint = "TerminalBlock:TerminalBlock_bornier-2_P5.08mm"
        yield Component(f"J{number}", net, footprint, "terminal block of 2, 5.08 mm", {"1": net, "2": "GND"})
    for number, disc in enumerate(discs(board.actuators), 21):
        nets = [f"CH{channel:02d}_patch" for channel in sorted(actuator.channel for actuator in disc)] + ["GND"]
        footprint = f"Connector_PinHeader_2.54mm:PinHeader_1x{len(nets):02d}_P2.54mm_Vertical"
        text = f"pin header 1 x {len(nets)}, 2.54 mm: sectors, and the brass last"
        yield Component(f"J{number}", "disc", footprint, text, {str(pin): net for pin, net in enumerate(nets, 1)})


PREFIXES: Final = {"p": 1e-12, "n": 1e-9, "u": 1e-6, "m": 1e-3, "": 1.0, "k": 1e3, "meg": 1e6}


def _number(value: str) -> float:
    digits = value.rstrip("".join(PREFIXES))
    return float(digits) * PREFIXES[value[len(digits) :]]


def _engineering(value: float) -> str:
    """A number with SPICE's prefixes."""
    prefix = max((name for name, scale in PREFIXES.items() if scale <= value * (1 + 1e-9)), key=PREFIXES.__getitem__)
    return f"{value / PREFIXES[prefix]:.4g}{prefix}"
