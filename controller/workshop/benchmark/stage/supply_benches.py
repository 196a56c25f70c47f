"""Benches of the reference stage's supply with the stages behind it; each figure is the worst of the corners."""

import math
from typing import Final

from controller.device.board.board import Board
from controller.workshop.benchmark.stage.stage_circuit import (
    ALIVE_HZ,
    CORNERS,
    DEAD_TIME_S,
    LEGS,
    PIN_V,
    SOURCES,
    STAGES,
    SUPPLY,
    Measured,
    Parts,
    alive,
    levels,
    netlist,
    through_both,
    worst,
)
from controller.workshop.simulation.ngspice import transient

PULL_UP_OHM: Final = 22e3  # to PIN_V: 150 uA, the most with which a pin that is not configured may pull up


def all_off(_board: Board, parts: Parts) -> Measured:
    """All channels and the supply go low in the same clock, with every channel high before and 200 nH to the stages."""
    off_s = 60e-6
    drive = levels([(5e-6, 1), (off_s, 0)])
    lines = [*SOURCES, f"Vdrive drive 0 {drive}", f"Venable enable 0 {levels([(0, 1), (off_s, 0)])}"]
    lines += [alive(0.0, off_s), SUPPLY, ".ic v(v60)={high_v} v(xsupply.store)=4", "Lwire v60 rail 200n", "Crail rail 0 100n"]
    lines += [f"X{'s' if n == 0 else n} drive rail v5 {'patch' if n == 0 else f'patch{n}'} stage" for n in range(STAGES)]
    vectors = ("v(v60)", "v(rail)", "v(patch)", "v(xs.out)", *LEGS)
    rows = [transient(netlist(CORNERS[name], parts, *lines), vectors, 10e-9, 130e-6) for name in ("both early", "both late")]
    after = [traces.between(off_s, 130e-6) for traces in rows]
    return {
        "rail when 32 channels rise and fall together, most": worst([traces["v(rail)"].max() for traces in rows]),
        "through both switches then": 1e3 * worst([through_both(part.between(off_s, off_s + DEAD_TIME_S)).max() for part in after]),
        "patches 50 us after": worst([abs(part.at("v(patch)", off_s + 50e-6)) for part in after]),
    }


def start_up(_board: Board, parts: Parts) -> Measured:
    """Supplies rise in either order, the FPGA is not configured, and its pins pull up as strongly as they may."""
    pulls = [f"Vpin pin 0 {PIN_V}"] + [f"R{name}_pin pin {name} {PULL_UP_OHM:g}" for name in ("drive", "enable", "alive")]
    rails, outs, pins = [], [], []
    for corner in (CORNERS["both early"], CORNERS["both late"]):
        for high_s, logic_s in ((1e-4, 2e-3), (2e-3, 1e-4)):
            sources = [
                f"Vhv v60_in 0 PWL(0 0 {high_s:g} 0 {high_s + 1e-4:g} {{high_v}})",
                f"Vlogic v5 0 PWL(0 0 {logic_s:g} 0 {logic_s + 1e-3:g} {{logic_v}})",
            ]
            # one stage behind the supply as it is, one on 60 V for good: both protections hold alone
            parts_of = [SUPPLY, "Xs drive v60 v5 patch stage", "Xdirect drive v60_in v5 patch_direct stage"]
            vectors = ("v(v60)", "v(xs.out)", "v(xdirect.out)", "v(drive)", "v(enable)")
            traces = transient(netlist(corner, parts, *sources, *pulls, *parts_of), vectors, 2e-6, 5e-3)
            rails.append(traces["v(v60)"].max())
            outs.append(traces["v(xdirect.out)"].max())
            pins.append(max(traces["v(drive)"].max(), traces["v(enable)"].max()))
    return {
        "pins of an FPGA that is not configured": worst(pins),
        "switched supply then": worst(rails),
        "stage then, were the switch shorted": worst(outs),
    }


def supply_gone(_board: Board, parts: Parts) -> Measured:
    """One of the two supplies of the stages breaks down while a channel is high and armed."""
    gone_s, end_s = 2e-3, 12.5e-3
    left: dict[str, list[float]] = {"5": [], "60": []}
    for corner in (CORNERS["both early"], CORNERS["both late"]):
        for name, values in left.items():
            falls = f"{gone_s:g} {{0}} {gone_s + 5e-4:g} 0"
            high = f"PWL(0 {{high_v}} {falls.format('{high_v}')})" if name == "60" else "{high_v}"
            logic = f"PWL(0 {{logic_v}} {falls.format('{logic_v}')})" if name == "5" else "{logic_v}"
            lines = [f"Vhv v60_in 0 {high}", f"Vlogic v5 0 {logic}", f"Vdrive drive 0 {levels([(1e-3, 1)])}"]
            lines += [f"Venable enable 0 {levels([(0, 1)])}", alive(0.0, end_s), SUPPLY, "Xs drive v60 v5 patch stage"]
            traces = transient(netlist(corner, parts, *lines), ("v(patch)", "v(v60)"), 1e-6, end_s)
            high_before = traces.at("v(patch)", gone_s) > 0.9 * corner["high_v"]
            values.append(abs(traces.at("v(patch)", gone_s + 10e-3)) if high_before else math.nan)
    return {f"patch 10 ms after the {name} V are gone, channel high": worst(values) for name, values in left.items()}


def supply(_board: Board, parts: Parts) -> Measured:
    """From hv_enable to a supply that is up, and from a lost beat to one that is off."""
    begin_s, stop_s, end_s = 1e-4, 3e-3, 9e-3
    half_s = 0.5 / ALIVE_HZ
    settled, opened, energies = [], [], []
    for corner in CORNERS.values():
        for level in (0, 1):  # at which hv_alive stops, with hv_enable high for ever
            enable = f"Venable enable 0 {levels([(begin_s, 1)])}"
            lines = [*SOURCES, enable, alive(begin_s + half_s, stop_s, level), SUPPLY]
            traces = transient(netlist(corner, parts, *lines), ("v(v60)", "v(v60_in)", "i(vhv)"), 1e-6, end_s)
            settled.append(traces.crossing_s("v(v60)", 0.98 * corner["high_v"], rising=True, after_s=begin_s) - begin_s)
            opened.append(traces.crossing_s("v(v60)", 0.95 * corner["high_v"], rising=False, after_s=stop_s) - stop_s)
            up = traces.between(begin_s, begin_s + 2e-3)
            energies.append(up.integral(-up["i(vhv)"] * (up["v(v60_in)"] - up["v(v60)"])))
    return {
        "from hv_enable to 98 % of the supply": 1e6 * worst(settled),
        "from the last beat of hv_alive to an open switch": 1e3 * worst(opened),
        "heat in the switch at switching on": 1e3 * worst(energies),
    }
