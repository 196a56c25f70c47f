"""Pictures of the reference stage (boards/stage): its schematics with the values of the netlists, and what ngspice computes.

    .venv/bin/python -m controller.benchmark.power_stage_pictures        # draws them all again

Each picture contains the hash of the netlists, so that a test finds pictures that are out of date.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any, Final

import matplotlib as mpl
import numpy as np
import schemdraw
from matplotlib.figure import Figure as Picture
from schemdraw import elements as elm
from schemdraw import logic

from controller.benchmark import power_stage
from controller.benchmark.power_stage import ALIVE_HZ, CORNERS, FAULT_PULSE_S, digest, levels, netlist, stage
from controller.board.lookup import data_folder
from controller.simulation.ngspice import Floats, Traces, transient

SCHEMATICS: Final = {"stage": "stage.cir", "supply": "supply.cir"}
WAVEFORMS: Final = "waveforms.svg"
COLOURS: Final = ("#1f4e79", "#7a1f1f", "#2e7d32", "#b45309")
POINTS: Final = 400  # of a trace, at most
UNITS: Final = {"ohm": "Ω", "f": "F", "h": "H"}


def labels(name: str) -> dict[str, str]:
    """Label of each part of a netlist: its name, and its value or kind."""
    text = (data_folder("boards") / "stage" / SCHEMATICS[name]).read_text()
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
            f"{part.removeprefix('X')}\n{value.replace('u', 'µ').replace('D4148', '1N4148W').replace('ahct', '74AHCT')}"
        )
    return found


def draw_stage(path: Path) -> None:
    """Draw the schematic of one stage."""
    label = labels("stage")
    with schemdraw.Drawing(file=str(path), show=False, fontsize=11, unit=2.2, lw=1.4, margin=0.5) as drawing:
        _stage(drawing, label)


def _stage(drawing: Any, label: dict[str, str]) -> None:
    drawing += elm.Dot(open=True).at((0, 0)).label("channel\nof the FPGA", "left")
    drawing += elm.Line().at((0, 0)).to((1.2, 0))
    drawing += elm.Dot().at((1.2, 0))
    drawing += elm.Resistor().at((1.2, 0)).down().length(2.2).label(label["R1"], "top")
    drawing += elm.Ground()
    drawing += elm.Line().at((1.2, 0)).to((2.2, 0))
    drawing += elm.Dot().at((2.2, 0))
    drawing += elm.Line().at((2.2, 0)).to((2.2, 3))
    drawing += elm.Line().at((2.2, 0)).to((2.2, -4))
    high = logic.Buf().right().at((2.2, 3)).label(label["U1"], "top")
    drawing += high
    low = logic.Not().right().at((2.2, -4)).label(label["U2"] + ",\ninverting", "bottom", ofst=(0.0, 0))
    drawing += low

    for place, part in (((4.2, high.out[1]), "R11"), ((4.6, low.out[1]), "R12")):
        drawing += elm.Dot().at(place)
        drawing += elm.Resistor().at(place).down().length(1.6).label(label[part], "top" if part == "R11" else "bottom")
        drawing += elm.Ground()

    # level shifter
    sink = elm.BjtNpn(circle=False).right().at((6.4, 3)).anchor("base").label(label["Q1"], "right")
    drawing += sink
    drawing += elm.Line().at(high.out).to(sink.base)
    x = sink.emitter[0]
    drawing += elm.Dot().at((x, 1.6))
    drawing += elm.Line().at(sink.emitter).to((x, 1.6))
    drawing += elm.Resistor().at((x, 1.6)).down().length(2.2).label(label["R3"], "top")
    drawing += elm.Ground()
    drawing += elm.Line().at((x, 1.6)).to((x + 2.2, 1.6))
    drawing += elm.Resistor().at((x + 2.2, 1.6)).down().length(1.6).label(label["R4"], "bottom")
    drawing += elm.Capacitor().down().length(1.4).label(label["C2"], "bottom")
    drawing += elm.Ground()
    drawing += elm.Dot().at((5.2, high.out[1]))
    drawing += elm.Line().at((x, 1.6)).to((5.2, 1.6))
    drawing += elm.Schottky().at((5.2, 1.6)).to((5.2, high.out[1])).label(label["D2"], "bottom")

    # high side
    top = 9.0
    x = sink.collector[0]
    drawing += elm.Line().at(sink.collector).to((x, 5.4))
    drawing += elm.Dot().at((x, 5.4))
    drawing += elm.Resistor().at((x, 5.4)).to((x, top)).label(label["R5"], "top")
    drawing += elm.Dot().at((x, top))
    follower = elm.BjtNpn(circle=False).right().at((9.6, 6.8)).anchor("base").label(label["Q2"], "right")
    drawing += follower
    drawing += elm.Line().at((x, 5.4)).to((8.4, 5.4))
    drawing += elm.Line().at((8.4, 5.4)).to((8.4, 6.8))
    drawing += elm.Line().at((8.4, 6.8)).to(follower.base)
    drawing += elm.Line().at(follower.collector).to((follower.collector[0], top))
    drawing += elm.Dot().at((follower.collector[0], top))
    gate = (follower.emitter[0], 5.4)
    drawing += elm.Line().at(follower.emitter).to(gate)
    drawing += elm.Dot().at(gate)
    drawing += elm.Dot().at((8.4, 5.4))
    drawing += elm.Diode().reverse().at((8.4, 5.4)).to(gate).label(label["D3"], "bottom", ofst=(0, -0.3))
    switch = elm.PFet().right().reverse().at((13.2, 5.4)).anchor("gate").label(label["M2"], "right", ofst=(-0.75, 0))
    drawing += switch
    drawing += elm.Line().at(gate).to(switch.gate)
    drawing += elm.Line().at(switch.source).to((switch.source[0], top))
    drawing += elm.Line().at((x, top)).to((switch.source[0], top))
    drawing += elm.Dot().at((switch.source[0], top))
    drawing += elm.Vdd().at((switch.source[0], top)).label("60 V, switched")

    # legs and low side
    column = switch.source[0]
    out = (column, 1.6)
    drawing += elm.Resistor().at(switch.drain).to(out).label(label["R6"], "bottom")
    drawing += elm.Dot().at(out)
    lower = elm.NFet().right().reverse().at((13.2, -4)).anchor("gate").label(label["M1"], "right", ofst=(-0.75, 0))
    drawing += lower
    drawing += elm.Resistor().at(out).to((column, -1.2)).label(label["R7"], "bottom")
    drawing += elm.Line().at((column, -1.2)).to(lower.drain)
    drawing += elm.Line().at(lower.source).to((column, -6.0))
    drawing += elm.Ground().at((column, -6.0))
    begin = (5.6, low.out[1])
    end = (9.2, low.out[1])
    drawing += elm.Line().at(low.out).to(begin)
    drawing += elm.Dot().at(begin)
    drawing += elm.Resistor().at(begin).to(end).label(label["R2"], "bottom", ofst=(0, -0.3))
    drawing += elm.Line().at(begin).to((begin[0], begin[1] + 1.2))
    drawing += elm.Schottky().reverse().at((begin[0], begin[1] + 1.2)).to((end[0], end[1] + 1.2)).label(label["D1"], "top")
    drawing += elm.Line().at((end[0], end[1] + 1.2)).to(end)
    drawing += elm.Dot().at(end)
    drawing += elm.Line().at(end).to(lower.gate)
    drawing += elm.Dot().at((10.6, low.out[1]))
    drawing += elm.Capacitor().at((10.6, low.out[1])).down().length(1.8).label(label["C1"], "bottom")
    drawing += elm.Ground()

    # filter and patch
    drawing += elm.Resistor().at(out).right().length(3).label(label["R8"], "top")
    drawing += elm.Inductor2().right().length(3).label(label["L1"], "top")
    patch = (column + 6, 1.6)
    drawing += elm.Dot().at(patch)
    drawing += elm.Resistor().at(patch).down().length(2.4).label(label["R9"], "top")
    drawing += elm.Ground()
    drawing += elm.Line().at(patch).right().length(2.2)
    drawing += elm.Capacitor().down().length(2.4).label(label["Cpatch"].replace("Cpatch", "patch"), "bottom")
    drawing += elm.Ground()


def draw_supply(path: Path) -> None:
    """Draw the schematic of the supply's switch."""
    label = labels("supply")
    with schemdraw.Drawing(file=str(path), show=False, fontsize=11, unit=2.2, lw=1.4, margin=0.5) as drawing:
        _supply(drawing, label)


def _supply(drawing: Any, label: dict[str, str]) -> None:
    gates = {}
    for name, pull, gate, y in (("hv_alive", "R22", "U4", 2.0), ("hv_enable", "R21", "U3", -2.6)):
        drawing += elm.Dot(open=True).at((0, y)).label(name, "left")
        drawing += elm.Line().at((0, y)).to((2.4, y))
        drawing += elm.Dot().at((1.2, y))
        drawing += elm.Resistor().at((1.2, y)).down().length(2.0).label(label[pull], "bottom")
        drawing += elm.Ground()
        buffer = logic.Buf().right().at((2.4, y)).anchor("in1").label(label[gate], "top")
        drawing += buffer
        gates[name] = buffer.out
        drawing += elm.Dot().at((4.6, y))
        drawing += elm.Resistor().at((4.6, y)).down().length(2.0).label(label["R29" if gate == "U4" else "R28"], "bottom")
        drawing += elm.Ground()
    # charge pump
    y = gates["hv_alive"][1]
    drawing += elm.Line().at(gates["hv_alive"]).to((5.0, y))
    drawing += elm.Capacitor().at((5.0, y)).to((7.0, y)).label(label["C21"], "top")
    drawing += elm.Dot().at((7.0, y))
    drawing += elm.Schottky().at((7.0, y - 2.2)).to((7.0, y)).label(label["D21"], "bottom")
    drawing += elm.Ground().at((7.0, y - 2.2))
    drawing += elm.Schottky().at((7.0, y)).to((9.4, y)).label(label["D22"], "top")
    drawing += elm.Line().at((9.4, y)).to((12.6, y))
    for x, part in ((9.6, "C22"), (11.4, "R23")):
        drawing += elm.Dot().at((x, y))
        kind = elm.Capacitor if part == "C22" else elm.Resistor
        drawing += kind().at((x, y)).down().length(2.2).label(label[part], "bottom")
        drawing += elm.Ground()
    upper = elm.NFet().right().reverse().at((12.8, y)).anchor("gate").label(label["M21"], "right", ofst=(-0.75, 0))
    drawing += upper
    lower = (
        elm.NFet().right().reverse().at((12.8, gates["hv_enable"][1])).anchor("gate").label(label["M22"], "right", ofst=(-0.75, 0))
    )
    drawing += lower
    drawing += elm.Line().at((12.6, y)).to(upper.gate)
    drawing += elm.Line().at(gates["hv_enable"]).to(lower.gate)
    drawing += elm.Line().at(upper.source).to(lower.drain)
    drawing += elm.Ground().at(lower.source)
    # switch
    x = upper.drain[0]
    drawing += elm.Resistor().at(upper.drain).to((x, 5.4)).label(label["R24"], "bottom")
    drawing += elm.Dot().at((x, 5.4))
    drawing += elm.Line().at((x, 5.4)).to((x + 6.4, 5.4))
    top = 8.0
    drawing += elm.Resistor().at((x, 5.4)).to((x, top)).label(label["R25"], "top")
    drawing += elm.Zener().at((x + 2.2, 5.4)).to((x + 2.2, top)).label(label["D23"], "bottom")
    drawing += elm.Capacitor().at((x + 4.6, 5.4)).to((x + 4.6, top)).label(label["C23"], "bottom")
    for place in (x + 2.2, x + 4.6):
        drawing += elm.Dot().at((place, 5.4))
        drawing += elm.Dot().at((place, top))
    drawing += elm.Dot().at((x, top))
    drawing += elm.Dot(open=True).at((x - 1.4, top)).label("60 V", "left")
    switch = elm.PFet().right().reverse().at((x + 6.4, 5.4)).anchor("gate").label(label["M23"], "right", ofst=(-0.75, 0))
    drawing += switch
    drawing += elm.Line().at((x - 1.4, top)).to((switch.source[0], top))
    drawing += elm.Line().at((switch.source[0], top)).to(switch.source)
    rail = (switch.drain[0], 2.8)
    drawing += elm.Line().at(switch.drain).to(rail)
    drawing += elm.Dot().at(rail)
    drawing += elm.Line().at(rail).to((rail[0] + 4.4, rail[1]))
    drawing += elm.Dot(open=True).at((rail[0] + 4.4, rail[1])).label("60 V, switched,\nto 32 stages", "right")
    drawing += elm.Capacitor().at(rail).down().length(2.4).label(label["C24"], "top")
    drawing += elm.Ground()
    drawing += elm.Dot().at((rail[0] + 2.2, rail[1]))
    drawing += elm.Resistor().at((rail[0] + 2.2, rail[1])).down().length(2.4).label(label["R26"], "bottom")
    drawing += elm.Ground()


def draw_waveforms(path: Path) -> None:
    """Draw what ngspice computes of the typical stage and supply."""
    corner = CORNERS["typical"]
    edge = stage(corner, {}, levels([(5e-6, 1), (45e-6, 0)]), 85e-6)
    pulse = stage(
        corner,
        {},
        levels(
            [
                (1e-6, 1),
                (1e-6 + FAULT_PULSE_S, 0),
                (21e-6, 1),
                (61e-6, 0),
                (61e-6 + FAULT_PULSE_S, 1),
                (61e-6 + 2 * FAULT_PULSE_S, 0),
            ]
        ),
        64e-6,
    )
    no_delay = stage(corner, {"low_gate_ohm": 100}, levels([(5e-6, 1), (45e-6, 0)]), 48e-6)
    rails = _supply_traces(corner)
    with mpl.rc_context({"svg.hashsalt": "stage", "font.size": 8.5, "font.family": "DejaVu Sans", "svg.fonttype": "none"}):
        picture = Picture(figsize=(10, 6.2), layout="constrained")
        plots = picture.subplots(2, 2)
        _plot(plots[0, 0], "One pulse of 40 µs", edge, 0, 85e-6, 1e6, "µs", {"v(xs.out)": "stage, V", "v(patch)": "patch, V"})
        _plot(
            plots[0, 1],
            "The end of a fault: low for 16 ns, high for 16 ns, low",
            pulse,
            60.9e-6,
            62.4e-6,
            1e6,
            "µs",
            {"v(drive)": "pin of the FPGA, V", "v(xs.low_gate)": "gate of the low side, V", "v(xs.out)": "stage, V"},
        )
        both = {
            "through both": Traces(pulse.time_s - 61e-6, {"mA": 1e3 * power_stage.through_both(pulse)}),
            "no dead time": Traces(no_delay.time_s - 45e-6, {"mA": 1e3 * power_stage.through_both(no_delay)}),
        }
        plot = plots[1, 0]
        for (name, traces), colour in zip(both.items(), (COLOURS[0], COLOURS[1]), strict=True):
            times = np.linspace(-0.1e-6, 0.7e-6, POINTS)
            plot.plot(
                times * 1e6,
                np.interp(times, traces.time_s, traces["mA"]),
                color=colour,
                lw=1.2,
                label={"through both": "at the fault above", "no dead time": "falling edge with R2 of 100 Ω: a wrong part"}[name],
            )
        plot.set(title="Current through both switches", xlabel="µs", ylabel="mA")
        plot.legend(frameon=False)
        _plot(
            plots[1, 1],
            "The supply: hv_enable at 0, hv_alive lost at 3 ms",
            rails,
            0,
            8e-3,
            1e3,
            "ms",
            {"v(enable)": "hv_enable, V", "v(xsupply.store)": "charge pump, V", "v(v60)": "60 V to the stages, V"},
        )
        for each in plots.flat:
            each.grid(color="0.9", lw=0.6)
            each.spines[["top", "right"]].set_visible(False)
        picture.savefig(path, metadata={"Description": f"netlists {digest()}", "Date": None, "Creator": None})


def _supply_traces(corner: Any) -> Traces:
    half_s = 0.5 / ALIVE_HZ
    beats = [(half_s * n, n % 2) for n in range(1, int(3e-3 / half_s))]
    lines = (
        "Vhv v60_in 0 {high_v}",
        "Vlogic v5 0 {logic_v}",
        f"Venable enable 0 {levels([(1e-9, 1)])}",
        f"Valive alive 0 {levels(beats)}",
        "Xsupply enable alive v60_in v5 v60 supply",
    )
    return transient(netlist(corner, {}, *lines), ("v(enable)", "v(v60)", "v(xsupply.store)"), 2e-6, 8e-3)


def _plot(
    plot: Any, title: str, traces: Traces, begin_s: float, end_s: float, scale: float, unit: str, names: dict[str, str]
) -> None:
    times: Floats = np.linspace(begin_s, end_s, POINTS)
    for (name, label), colour in zip(names.items(), COLOURS, strict=False):
        plot.plot((times - begin_s) * scale, np.interp(times, traces.time_s, traces[name]), color=colour, lw=1.2, label=label)
    plot.set(title=title, xlabel=unit)
    plot.legend(frameon=False)


def picture_digest(path: Path) -> str | None:
    """Hash of the netlists from which a picture was drawn; None if the file is absent or contains none."""
    found = re.search(r"netlists ([0-9a-f]{16})", path.read_text()) if path.exists() else None
    return found[1] if found else None


def main(folder: Path | None = None) -> None:
    """Draw all pictures of the stage, into boards/stage by default."""
    folder = folder or data_folder("boards") / "stage"
    schemdraw.use("svg")  # text stays text, and no other program is needed
    for name, draw in (("stage", draw_stage), ("supply", draw_supply)):
        path = folder / f"{name}.svg"
        draw(path)
        head, _, rest = path.read_text().partition(">")  # of the svg element, which is first
        path.write_text(f"{head}><desc>netlists {digest()}</desc>{rest}")
    draw_waveforms(folder / WAVEFORMS)


if __name__ == "__main__":
    main()
