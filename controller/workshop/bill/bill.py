"""Bill of materials of a panel: quantities and specifications, from its board.toml and the circuit of its stages."""

import math
from collections import defaultdict
from collections.abc import Iterator
from typing import Final, NamedTuple

from controller.device.board.board import Board
from controller.device.board.devices import LinkSettings
from controller.device.board.plate.patches import discs
from controller.device.board.relations.stage_heat import worst_edge_j
from controller.device.board.touch_panels import I2cTouch, SerialTouch
from controller.workshop.bill.circuit import Component, circuit

SHIFTER_A: Final = 1e-3  # of a channel that idles high: Q1's
CHIP_A: Final = 10e-3  # of a 74AHCT541 and what its outputs drive
MARGIN: Final = 1.5
FPGA_BOARDS: Final = (
    "an ULX3S (boards/ulx3s), a Colorlight i5 or i9 in its extension board (boards/colorlight_i5),"
    " or a Tang Primer 20K in its Lite extension board (boards/tang_primer_20k)"
)
NAMES: Final = {
    "R": "resistor",
    "C": "capacitor",
    "L": "inductor",
    "D": "diode",
    "M": "transistor",
    "Q": "transistor",
    "U": "chip",
    "J": "connector",
}
HELD: Final = {
    "foam": "strip of soft foam under the edges, closed-cell, self-adhesive",
    "free": "four soft feet near the corners, or a frame that touches nothing between",
    "simply_supported": "frame whose edge carries the glass on a line",
    "clamped": "frame that holds the glass from both sides",
}


class Item(NamedTuple):
    """A line of the bill."""

    group: str  # "panel", "stages", "supplies", "control"
    item: str
    quantity: float
    unit: str  # "pieces", "mm", "mm3"
    specification: str
    references: str  # on the circuit board


def bill(board: Board) -> list[Item]:
    """All that a panel of `board` takes, but tools and the sensor that calibrates it."""
    parts = circuit(board)
    return [*_panel(board), *_stages(parts), *_supplies(board, parts), *_control(board)]


def supply_w(board: Board) -> float:
    """Most that the stages draw from the high supply for good: their permitted edges, and the level shifters."""
    edges_hz = min(board.limits.max_total_edge_rate_hz, len(board.actuators) * board.limits.max_channel_edge_rate_hz)
    return edges_hz * worst_edge_j(board.driver) + len(board.actuators) * SHIFTER_A * board.driver.supply_v


def _panel(board: Board) -> Iterator[Item]:
    plate, sectors = board.plate, [len(disc) for disc in discs(board.actuators)]
    glass = f"{plate.length_mm:g} x {plate.width_mm:g} x {plate.thickness_mm:g} mm, edges ground; {plate.density_kg_m3:g} kg/m3,"
    yield Item("panel", "glass", 1, "pieces", f"{glass} {plate.young_modulus_pa / 1e9:.3g} GPa", "")
    cut = "not cut" if max(sectors) == 1 else f"electrode cut in {max(sectors)}, a wire to each sector and one to the brass"
    c_nf = f"{board.driver.capacitance_f * 1e9:.3g} nF a sector"
    if board.parts is None:
        yield Item("panel", "piezo disc", len(sectors), "pieces", f"[parts] of board.toml names none; {c_nf}; {cut}", "")
    else:
        disc, of = board.parts.data, board.parts
        brass = f"brass {disc.brass_mm:g} x {disc.brass_thickness_mm:g} mm"
        ceramic = f"ceramic {disc.ceramic_mm:g} x {disc.ceramic_thickness_mm:g} mm"
        yield Item("panel", f"piezo {of.called}", len(sectors), "pieces", f"{brass}, {ceramic}; {c_nf}; {cut}", "")
        glue_mm3 = len(sectors) * math.pi / 4 * disc.brass_mm**2 * of.glue_mm
        text = f"epoxy of low viscosity, cured hard at room temperature; {of.glue_mm:g} mm under each disc"
        yield Item("panel", "glue", round(glue_mm3, 1), "mm3", text, "")
    held = plate.sides
    sides = [(held.x0, plate.width_mm), (held.x1, plate.width_mm), (held.y0, plate.length_mm), (held.y1, plate.length_mm)]
    for kind in sorted({kind for kind, _ in sides}):
        length_mm = sum(side_mm for how, side_mm in sides if how == kind)
        yield Item("panel", f"edge, {kind}", length_mm, "mm", HELD[kind], "")


def _stages(parts: list[Component]) -> Iterator[Item]:
    """Parts of one value, case and specification together."""
    alike: defaultdict[tuple[str, str, str, str], list[str]] = defaultdict(list)
    for one in parts:
        alike[one.reference[0], one.value, one.text, one.footprint].append(one.reference)
    for (_, value, text, footprint), references in sorted(alike.items(), key=lambda kind: kind[0]):
        shown = references if len(references) <= 4 else [*references[:3], f"… {references[-1]}"]
        name = f"{NAMES[references[0][0]]} {value}"
        yield Item("stages", name, len(references), "pieces", f"{text} ({footprint.split(':')[1]})", " ".join(shown))
    yield Item("stages", "circuit board", 1, "pieces", "from the netlist (--netlist FILE), with a layer of ground", "")


def _supplies(board: Board, parts: list[Component]) -> Iterator[Item]:
    volts = board.driver.supply_v
    needed_a = supply_w(board) / volts
    text = f"{volts:g} V DC, {needed_a * 1e3:.0f} mA at the limits of board.toml: {_rounded(MARGIN * needed_a):g} A,"
    text += " limited and isolated (SELV)"
    yield Item("supplies", "high supply", 1, "pieces", text, "J11")
    chips = sum(one.reference[0] == "U" for one in parts)
    yield Item("supplies", "logic supply", 1, "pieces", f"5 V DC, {_rounded(MARGIN * chips * CHIP_A):g} A", "J12")
    fuse = f"{_rounded(2 * needed_a):g} A, slow, before the switch of the high supply: nothing else stops a shorted transistor"
    yield Item("supplies", "fuse", 1, "pieces", fuse, "")


def _control(board: Board) -> Iterator[Item]:
    link = board.link
    if link.kind != "simulated":
        yield Item("control", "host", 1, "pieces", f"Raspberry-Pi-class computer with {link.gpio_chip or link.device}", "")
    yield Item("control", "FPGA board", 1, "pieces", _fpga(board), "")
    wires = _wires(link)
    if wires:
        text = f"{', '.join(wires)}; short, with as many grounds: SCK is {link.sck_hz / 1e6:g} MHz"
        yield Item("control", "wire, host to FPGA", len(wires), "pieces", text, "")
    channels, grounds = len(board.actuators), len(discs(board.actuators))
    yield Item("control", "wire, FPGA to stages", channels + 2, "pieces", "channels, hv_enable, hv_alive; each beside a ground", "")
    yield Item("control", "wire, stages to discs", channels, "pieces", "one a sector, along the ground of its disc", "")
    yield Item("control", "wire, ground to discs", grounds, "pieces", "one a disc, to its brass", "")
    if link.permit_line or link.kind == "simulated":
        text = "contact that closes when the case is shut, from 3.3 V to `run permit`, with a 10 kOhm pull-down"
        yield Item("control", "interlock", 1, "pieces", text, "")
        text = "opens at 70 C, at the hottest stages, from 3.3 V to `temperature good`, with a 10 kOhm pull-down"
        yield Item("control", "temperature switch", 1, "pieces", text, "")
    kind = str(board.touch.__struct_config__.tag)
    yield Item("control", "touch panel", 1, "pieces", f"kind {kind}{_bus(board)}", "")


def _fpga(board: Board) -> str:
    if board.link.kind == "simulated":
        return f"simulated here; gateware is made for {FPGA_BOARDS}"
    return f"{board.link.slots} slots at {board.link.clock_hz / 1e6:g} MHz; {FPGA_BOARDS}"


def _wires(link: LinkSettings) -> list[str]:
    if link.kind == "spi":
        lines = {"trigger": link.trigger_line, "configured": link.configured_line, "permit": link.permit_line}
        return ["SCK", "CS", "MOSI", "MISO", *(name for name, line in lines.items() if line)]
    return ["USB"] if link.kind == "serial" else []


def _bus(board: Board) -> str:
    touch = board.touch
    if isinstance(touch, I2cTouch):
        lines = ["SDA", "SCL", *(["interrupt"] if touch.interrupt_line else []), *(["reset"] if touch.reset_line else [])]
        return f" on {touch.bus}: {', '.join(lines)}, 3.3 V, ground; a pull-up each on SDA and SCL, which a Raspberry Pi has"
    return f" on {touch.device}" if isinstance(touch, SerialTouch) else ""


def _rounded(value: float) -> float:
    """Upwards, to the next of 1, 2, 5."""
    decade = 10.0 ** math.floor(math.log10(value))
    return next(step * decade for step in (1, 2, 5, 10) if step * decade >= value * (1 - 1e-9))
