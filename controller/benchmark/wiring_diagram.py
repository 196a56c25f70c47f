"""Wiring of the ULX3S, drawn from its own tables: header pins (pins.lpf), lines of the host (board.toml), parts of the stage.

    .venv/bin/python -m controller.benchmark.wiring_diagram        # boards/ulx3s/wiring.svg

The picture contains the hash of what it was drawn from, so that a test finds one that is out of date.
"""

from __future__ import annotations

import hashlib
import math
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import matplotlib as mpl
from matplotlib.figure import Figure
from matplotlib.patches import FancyBboxPatch

from controller.benchmark.power_stage import parameters
from controller.board.board import load_board
from controller.board.lookup import data_folder

FOLDER: Final = data_folder("boards") / "ulx3s"
PICTURE: Final = FOLDER / "wiring.svg"
# Of the 40-pin header of every Raspberry Pi
PI_PINS: Final = {
    "GPIO8": 24,
    "GPIO9": 21,
    "GPIO10": 19,
    "GPIO11": 23,
    "GPIO22": 15,
    "GPIO23": 16,
    "GPIO24": 18,
    "GPIO25": 22,
    "GPIO27": 13,
}
SPI_LINES: Final = {"SCK": "GPIO11", "chip select": "GPIO8", "MOSI": "GPIO10", "MISO": "GPIO9"}  # spidev0.0
COLOURS: Final = {"host": "#1f4e79", "stage": "#7a1f1f", "safety": "#b45309", "plain": "0.35"}
NOTE: Final = (
    "A resistor to ground at the input of each stage (boards/stage), while the FPGA is not configured. All grounds are joined."
)
EMERGENCY: Final = "The switch is the emergency stop: with the wire of the run permit open, its resistor takes the permit away."
ROW: Final = 0.34
ABOVE: Final = 1.2


@dataclass(frozen=True)
class Pin:
    """One pin of a header: its name on the board (GP0), header (J1) and contact (5+), and the signal on it."""

    name: str
    header: str
    contact: str
    signal: str


@dataclass(frozen=True)
class Wire:
    """One wire from a pin of the FPGA: the other end, what kind it is, and the resistor to ground on it in ohm, if any."""

    pin: Pin
    end: str
    kind: str
    pull_down_ohm: float | None = None


def pins() -> list[Pin]:
    """Pins of both headers that have a signal, in the order of pins.lpf."""
    row = re.compile(r'^LOCATE COMP "(g[pn])\[(\d+)\]" .*; # (J\d)_(\d+[+-]) (.*)$', re.MULTILINE)
    found = [
        Pin(f"{side.upper()}{number}", header, contact, text.partition(":")[0])
        for side, number, header, contact, text in row.findall((FOLDER / "pins.lpf").read_text())
    ]
    return [pin for pin in found if pin.signal != "not used"]


def wires() -> list[Wire]:
    """What is connected to each of these pins."""
    link, part = load_board(FOLDER / "board.toml").link, parameters()
    lines = SPI_LINES | {"trigger": link.trigger_line, "configured": link.configured_line, "run permit": link.permit_line}
    made = []
    for pin in pins():
        if channel := re.fullmatch(r"channel (\d+)", pin.signal):
            made.append(Wire(pin, f"stage {channel[1]}", "stage", part["pull_down_ohm"]))
        elif pin.signal in ("hv_enable", "hv_alive"):
            made.append(
                Wire(
                    pin,
                    f"{'switch' if pin.signal == 'hv_enable' else 'charge pump'} of the 60 V supply",
                    "safety",
                    part["supply_pull_down_ohm"],
                )
            )
        elif pin.signal == "temperature good":
            made.append(Wire(pin, "3.3 V by the switch that opens when hot", "safety", 10e3))
        elif pin.signal in lines:
            line = str(lines[pin.signal])
            made.append(Wire(pin, f"{line}, pin {PI_PINS[line]}", "host", 10e3 if pin.signal == "run permit" else None))
        else:
            made.append(Wire(pin, "test point", "plain"))
    return made


def digest() -> str:
    """Hash of all wires, by which the picture says what it shows."""
    return hashlib.sha256(repr(wires()).encode()).hexdigest()[:16]


def draw(path: Path) -> None:
    """Draw all wires to an SVG or PNG file."""
    made = wires()
    headers = sorted({wire.pin.header for wire in made})
    height = ABOVE + sum(ROW * (len([wire for wire in made if wire.pin.header == header]) + 2.2) for header in headers) + 0.9
    with mpl.rc_context({"svg.hashsalt": "wiring", "font.size": 8.5, "font.family": "DejaVu Sans", "svg.fonttype": "none"}):
        picture = Figure(figsize=(11, height * 0.72))
        plot = picture.add_axes((0, 0, 1, 1))
        plot.set(xlim=(0, 15.3), ylim=(-height, 0))
        plot.axis("off")
        plot.text(0.3, -0.45, "ULX3S: host on the left, stages and supply on the right", size=12, weight="bold", va="center")
        plot.text(
            0.3,
            -0.85,
            NOTE,
            va="center",
        )
        top = ABOVE
        for header in headers:
            own = [wire for wire in made if wire.pin.header == header]
            _header(plot, header, own, top)
            top += ROW * (len(own) + 2.2)
        plot.text(
            0.3,
            -(top + 0.1),
            EMERGENCY,
            va="center",
        )
        metadata = {"Description": f"wires {digest()}"}
        picture.savefig(path, dpi=110, metadata=metadata | ({"Date": None, "Creator": None} if path.suffix == ".svg" else {}))


def _header(plot: Any, header: str, own: list[Wire], top: float) -> None:
    """One header of the board as a box, and its wires to both sides."""
    left, right = 5.6, 9.4
    bottom = top + ROW * (len(own) + 1.2)
    plot.add_patch(
        FancyBboxPatch(
            (left, -bottom), right - left, bottom - top, boxstyle="round,pad=0,rounding_size=0.1", fc="#e0ecfb", ec="0.3", lw=1
        )
    )
    plot.text((left + right) / 2, -(top + 0.6 * ROW), f"ULX3S {header}", ha="center", va="center", weight="bold")
    lines: dict[str, list[list[tuple[float, float]]]] = {}
    resistors: list[list[tuple[float, float]]] = []
    dots: list[tuple[float, float]] = []
    for number, wire in enumerate(own):
        y = -(top + ROW * (number + 1.5))
        colour = COLOURS[wire.kind]
        to_left = wire.kind == "host"
        plot.text(left + 0.15, y, wire.pin.contact, va="center", size=7, color="0.4")
        plot.text(left + 0.75, y, wire.pin.name, va="center", weight="bold")
        plot.text(left + 1.55, y, wire.pin.signal, va="center")
        begin, end = (left, 3.6) if to_left else (right, 11.6)
        drawn = [[(begin, y), (end, y)]]
        if wire.pin.signal == "run permit":
            drawn = [[(begin, y), (4.0, y)], [(4.0, y), (3.78, y + 0.14)], [(3.8, y), (end, y)]]
        lines.setdefault(colour, []).extend(drawn)
        label = f"Pi {wire.end}" if to_left else wire.end
        plot.text(end + (-0.12 if to_left else 0.12), y, label, ha="right" if to_left else "left", va="center", color=colour)
        if wire.pull_down_ohm is not None:
            x = (begin + end) / 2 + (-0.4 if to_left else -0.75)
            dots.append((x, y))
            resistors += _pull_down(x, y)
            plot.text(x + 0.95, y - 0.3 * ROW, f"{wire.pull_down_ohm / 1e3:g} kΩ", size=6.5, va="center")
    for colour, drawn in lines.items():
        _lines(plot, drawn, colour, 1.3)
    _lines(plot, resistors, "0.1", 0.9)
    plot.plot(*zip(*dots, strict=True), "o", ms=2.6, color="0.1")


def _pull_down(x: float, y: float) -> list[list[tuple[float, float]]]:
    """Lines of a resistor to ground, lying, beside a wire."""
    y_0 = y - 0.3 * ROW
    box = [
        (x + 0.15, y_0 - 0.045),
        (x + 0.57, y_0 - 0.045),
        (x + 0.57, y_0 + 0.045),
        (x + 0.15, y_0 + 0.045),
        (x + 0.15, y_0 - 0.045),
    ]
    ground = [
        [(x + 0.75 + 0.05 * step, y_0 - half), (x + 0.75 + 0.05 * step, y_0 + half)]
        for step, half in enumerate((0.07, 0.045, 0.02))
    ]
    return [[(x, y), (x, y_0), (x + 0.15, y_0)], box, [(x + 0.57, y_0), (x + 0.75, y_0)], *ground]


def _lines(plot: Any, lines: list[list[tuple[float, float]]], colour: str, width: float) -> None:
    """Draw lines as one path, which keeps the file small."""
    gap = (math.nan, math.nan)
    points = [point for line in lines for point in (*line, gap)]
    plot.plot(*zip(*points, strict=True), color=colour, lw=width, solid_capstyle="butt")


def main() -> None:
    """Draw boards/ulx3s/wiring.svg again."""
    draw(PICTURE)


if __name__ == "__main__":
    main()
