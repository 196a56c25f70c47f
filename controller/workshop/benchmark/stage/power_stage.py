"""What the reference stage and its supply (boards/stage) do, by ngspice, and whether the gateware's limits protect them.

    .venv/bin/python -m controller.workshop.benchmark.stage.power_stage  # the figures; exit 1 if one is beyond its limit
    .venv/bin/python -m controller.workshop.benchmark.stage.power_stage --wrong-parts  # which check finds which wrong part

`controller.generate` writes them into boards/stage/README.md. Each figure is the worst of the corners: thresholds of the
transistors and both supplies at the ends of what data sheets allow.
"""

from __future__ import annotations

import argparse
import hashlib
import math
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from controller.console import program, say, tell
from controller.device.board.board import Board, load_board
from controller.device.board.lookup import data_folder, find_board
from controller.device.board.relations.stage_heat import worst_edge_j
from controller.device.fpga.build_parameters import BuildParameters
from controller.workshop.physics.responses.driver import DriverResponse
from controller.workshop.simulation.ngspice import Floats, Traces, transient

BOARD: Final = "ulx3s"
NETLISTS: Final = ("models.lib", "stage.cir", "supply.cir")
BEGIN: Final = "<!-- figures of the netlists"
END: Final = "<!-- end of figures -->"
Parts = Mapping[str, float]
Measured = dict[str, float]
# Thresholds of the N and P transistors, logic supply, high voltage: in V
CORNERS: Final = {
    "typical": {"n_threshold_v": 1.6, "p_threshold_v": 2.5, "logic_v": 5.0, "high_v": 60.0},
    "both early": {"n_threshold_v": 0.8, "p_threshold_v": 1.5, "logic_v": 5.5, "high_v": 63.0},
    "both late": {"n_threshold_v": 2.8, "p_threshold_v": 3.5, "logic_v": 4.5, "high_v": 57.0},
    "low side early": {"n_threshold_v": 0.8, "p_threshold_v": 3.5, "logic_v": 5.5, "high_v": 63.0},
    "high side early": {"n_threshold_v": 2.8, "p_threshold_v": 1.5, "logic_v": 4.5, "high_v": 57.0},
}
PIN_V: Final = 3.3  # high level of the FPGA's pins
PIN_EDGE_S: Final = 3e-9
PULL_UP_OHM: Final = 22e3  # to PIN_V: 150 uA, the most with which a pin that is not configured may pull up
INPUT_LOW_V: Final = 0.8  # what every input of the 74AHCT family takes for low
ALIVE_HZ: Final = 20e3
STAGES: Final = 32
DEAD_TIME_S: Final = 2e-6  # both legs are watched for so long behind an edge
WIDTHS_S: Final = (4e-9, 8e-9, 16e-9, 32e-9, 64e-9, 128e-9, 256e-9, 512e-9)  # of pulses that a fault may leave
FAULT_PULSE_S: Final = 16e-9  # a clock at 62.5 MHz

LEGS: Final = ("i(v.xs.vhigh)", "i(v.xs.vlow)")
STAGE_VECTORS: Final = (
    *(
        "v(drive)",
        "v(v60)",
        "v(xs.out)",
        "v(patch)",
        "v(xs.filter)",
        "v(xs.low_gate)",
        "v(xs.high_gate)",
        "v(xs.level)",
        "v(xs.sink)",
    ),
    *("v(xs.high_leg)", "v(xs.low_leg)", *LEGS),
)


@dataclass(frozen=True)
class Figure:
    """One measured figure and its limit."""

    name: str  # what was measured
    value: float  # value, limit: in `unit`
    unit: str
    limit: float
    most: bool  # whether the limit is the most that the figure may be, or the least
    why: str  # where the limit comes from

    @property
    def good(self) -> bool:
        """Whether the figure is within its limit; a figure that could not be measured is not."""
        return bool(self.value <= self.limit if self.most else self.value >= self.limit)


def limits(board: Board) -> dict[str, tuple[str, float, bool, str]]:
    """Unit, limit, whether it is the most or the least, and its reason, for each figure by name."""
    shortest_us, rate_hz = board.limits.min_pulse_us, board.limits.max_channel_edge_rate_hz
    permitted_w = board.limits.resistor_rating_w * board.limits.derating
    settle_us = BuildParameters.of(board, 0).hv_settle_ticks / board.link.clock_hz * 1e6
    most, least = True, False
    return {
        "rise and fall of the stage, 10 to 90 %": ("ns", 500, most, "a quarter of a bit at 500 kHz"),
        "rise of the patch, 10 to 90 %, typical": ("us", 7, most, "the filter of board.toml: 6.4 us"),
        "patch against the driver of board.toml, typical": ("%", 2, most, "banks are computed with it"),
        "delay of the two edges apart": ("ns", 500, most, "a quarter of a bit"),
        "through both switches, at an edge": ("mA", 75, most, "what a ZVP3310F carries for good"),
        "charge through both switches, an edge": ("nC", 5, most, "16 mW at the edge limit"),
        "gate of the high side": ("V", 16, most, "20 V is its rating"),
        "held high, of the supply": ("%", 99, least, "half of the channels idle high for hours"),
        "through both switches, pulses of 4 to 512 ns": ("mA", 170, most, "what a BSS123 carries for good"),
        "charge through both, pulses of 4 to 512 ns": ("nC", 20, most, "1 uJ, once a fault"),
        "patch after a pulse of 16 ns": ("V", 6, most, "not felt, nothing latches"),
        "stage after the last pulse": ("V", 0.1, most, "low is 0 V"),
        "shortest pulse of board.toml, at the stage": ("us", shortest_us * 2 / 3, least, "two thirds of what went in"),
        "series resistor at the edge limit of a channel": ("W", permitted_w, most, "half of its 0.5 W for good"),
        "the same by the formula of `bank info --power`": ("W", permitted_w, most, "of R, L, C alone"),
        "edge limit that this resistor would bear": ("kHz", rate_hz * 1e-3, least, "max_channel_edge_rate_hz"),
        "hotter switch at the edge limit": ("mW", 165, most, "half of 0.33 W"),
        "level shifter of a channel that idles high": ("mW", 175, most, "half of an MMBT5551's 0.35 W"),
        "from the 60 V supply at the edge limit of all channels": ("W", 15, most, "60 V, 0.25 A"),
        "rail when 32 channels rise and fall together, most": ("V", 80, most, "100 V parts"),
        "through both switches then": ("mA", 75, most, "as at one edge"),
        "patches 50 us after": ("V", 1, most, "off is off"),
        "pins of an FPGA that is not configured": ("V", INPUT_LOW_V, most, "low for a 74AHCT"),
        "switched supply then": ("V", 1, most, "hv_enable off"),
        "stage then, were the switch shorted": ("V", 2, most, "the second protection alone"),
        "patch 10 ms after the 5 V are gone, channel high": ("V", 1, most, "both switches open, R9"),
        "patch 10 ms after the 60 V are gone, channel high": ("V", 1, most, "the rail follows its source"),
        "from hv_enable to 98 % of the supply": ("us", settle_us, most, "limits.hv_settle_us: the first edge comes then"),
        "from the last beat of hv_alive to an open switch": ("ms", 10, most, "it stops high or low, hv_enable still high"),
        "heat in the switch at switching on": ("mJ", 10, most, "a SOT-223 takes 10 mJ in 1 ms"),
    }


def levels(changes: Sequence[tuple[float, int]]) -> str:
    """A source's piecewise linear voltage of a pin of the FPGA: (time in s, level from then on), 0 before."""
    points, before = ["0 0"], 0
    for time_s, level in changes:
        points += [f"{time_s:.12g} {before * PIN_V:g}", f"{time_s + PIN_EDGE_S:.12g} {level * PIN_V:g}"]
        before = level
    return f"PWL({' '.join(points)})"


def netlist(corner: Mapping[str, float], parts: Parts, *lines: str) -> str:
    """Stage, supply and models with some parts exchanged, and what is around them."""
    folder = data_folder("boards") / "stage"
    texts = [(folder / name).read_text() for name in NETLISTS]
    given = {**corner, **parts}
    parameters = [f".param {name}={value:.12g}" for name, value in given.items()]
    return "\n".join([*texts, *parameters, *lines])


def stage(corner: Mapping[str, float], parts: Parts, drive: str, end_s: float, step_s: float = 4e-9) -> Traces:
    """One stage on supplies that are there, driven by `drive`."""
    lines = ("Vhv v60 0 {high_v}", "Vlogic v5 0 {logic_v}", f"Vdrive drive 0 {drive}", "Xs drive v60 v5 patch stage")
    return transient(netlist(corner, parts, *lines), STAGE_VECTORS, step_s, end_s)


def through_both(traces: Traces) -> Floats:
    """Current in A that flows through both switches at once."""
    both: Floats = np.maximum(np.minimum(traces[LEGS[0]], traces[LEGS[1]]), 0.0)
    return both


def worst(values: Sequence[float], *, most: bool = True) -> float:
    """The worst of the corners; nan if one is missing."""
    if any(map(math.isnan, values)):
        return float("nan")
    return max(values) if most else min(values)


def edges(board: Board, parts: Parts) -> Measured:
    """Figures of one edge up and one edge down, far apart."""
    up_s, down_s, end_s = 5e-6, 85e-6, 165e-6
    rows = [stage(corner, parts, levels([(up_s, 1), (down_s, 0)]), end_s) for corner in CORNERS.values()]
    high_v = [corner["high_v"] for corner in CORNERS.values()]
    after = [(up_s, True), (down_s, False)]

    def time_s(name: str, low: float, high: float) -> list[float]:
        return [
            abs(
                traces.crossing_s(name, high * volts, rising=rising, after_s=begin)
                - traces.crossing_s(name, low * volts, rising=rising, after_s=begin)
            )
            for traces, volts in zip(rows, high_v, strict=True)
            for begin, rising in after
        ]

    delays = [
        [traces.crossing_s("v(xs.out)", volts / 2, rising=rising, after_s=begin) - begin for begin, rising in after]
        for traces, volts in zip(rows, high_v, strict=True)
    ]
    behind = [traces.between(begin, begin + DEAD_TIME_S) for traces in rows for begin, _ in after]
    response, shift_s = DriverResponse.of(board.driver), delays[0][0]
    model_s = rows[0].time_s - up_s - shift_s
    ideal = 1 + (response.residues @ np.exp(np.outer(response.poles, np.clip(model_s, 0.0, None)))).real
    rising = (model_s > 0) & (rows[0].time_s < down_s)
    error = np.abs(rows[0]["v(patch)"] / high_v[0] - ideal)[rising].max()
    gates = [float((traces["v(v60)"] - traces["v(xs.high_gate)"]).max()) for traces in rows]
    held = [traces.at("v(xs.out)", down_s - 1e-6) / volts for traces, volts in zip(rows, high_v, strict=True)]
    return {
        "rise and fall of the stage, 10 to 90 %": 1e9 * worst(time_s("v(xs.out)", 0.1, 0.9)),
        "rise of the patch, 10 to 90 %, typical": 1e6 * time_s("v(patch)", 0.1, 0.9)[0],
        "patch against the driver of board.toml, typical": 100 * error,
        "delay of the two edges apart": 1e9 * worst([abs(up - down) for up, down in delays]),
        "through both switches, at an edge": 1e3 * worst([through_both(part).max() for part in behind]),
        "charge through both switches, an edge": 1e9 * worst([part.integral(through_both(part)) for part in behind]),
        "gate of the high side": worst(gates),
        "held high, of the supply": 100 * worst(held, most=False),
    }


def faults(board: Board, parts: Parts) -> Measured:
    """Figures of the pulses that a fault leaves: any width, high from low and low from high, and then low for good."""
    gap_s, begin_s = 30e-6, 5e-6
    high_at_s = begin_s + gap_s * (len(WIDTHS_S) + 1)
    changes = [edge for n, width in enumerate(WIDTHS_S) for edge in ((begin_s + n * gap_s, 1), (begin_s + n * gap_s + width, 0))]
    starts = [begin_s + n * gap_s for n in range(len(WIDTHS_S))]
    for n, width in enumerate(WIDTHS_S):  # up, low for a moment, high for a moment, down: the fault's last clocks
        at = high_at_s + n * gap_s
        changes += [(at - 0.4 * gap_s, 1), (at, 0), (at + width, 1), (at + 2 * width, 0)]
        starts.append(at)
    end_s = changes[-1][0] + gap_s
    rows = [stage(corner, parts, levels(changes), end_s) for corner in CORNERS.values()]
    behind = [traces.between(start, start + DEAD_TIME_S) for traces in rows for start in starts]
    fault = starts[WIDTHS_S.index(FAULT_PULSE_S)]
    reached = [traces.between(fault, fault + gap_s / 2)["v(patch)"].max() for traces in rows]
    shortest_s = board.limits.min_pulse_us * 1e-6
    widths: list[float] = []
    for corner in CORNERS.values():
        for first in (1, 0):
            at = 45e-6
            traces = stage(corner, parts, levels([(5e-6, 1 - first), (at, first), (at + shortest_s, 1 - first)]), 60e-6)
            begin = traces.crossing_s("v(xs.out)", corner["high_v"] / 2, rising=bool(first), after_s=at)
            widths.append(traces.crossing_s("v(xs.out)", corner["high_v"] / 2, rising=not first, after_s=begin) - begin)
    ended = [np.abs(traces.between(end_s - 1e-6, end_s)["v(xs.out)"]).max() for traces in rows]
    return {
        "through both switches, pulses of 4 to 512 ns": 1e3 * worst([through_both(part).max() for part in behind]),
        "charge through both, pulses of 4 to 512 ns": 1e9 * worst([part.integral(through_both(part)) for part in behind]),
        "patch after a pulse of 16 ns": worst(reached),
        "stage after the last pulse": worst(ended),
        "shortest pulse of board.toml, at the stage": 1e6 * worst(widths, most=False),
    }


def heat(board: Board, parts: Parts) -> Measured:
    """Watts at the limits of edges, with the waveform that heats most: edges at multiples of half the filter's damped period."""
    pole = DriverResponse.of(board.driver).poles[0]
    half_s = math.pi / abs(pole.imag)
    edge_count, skipped = 24, 8
    changes = [(5e-6 + n * half_s, 1 - n % 2) for n in range(edge_count)]
    begin_s, end_s = changes[skipped][0], changes[-1][0]
    traces = stage(CORNERS["typical"], parts, levels(changes), end_s + 1e-6).between(begin_s, end_s)
    count = edge_count - 1 - skipped
    high, low = (traces[leg] for leg in LEGS)
    across = traces["v(xs.out)"] - traces["v(xs.filter)"]
    resistor_j = traces.integral(across * (high - low)) / count
    rate_hz = board.limits.max_channel_edge_rate_hz
    permitted_w = board.limits.resistor_rating_w * board.limits.derating
    switches = [
        traces.integral(high * (traces["v(v60)"] - traces["v(xs.high_leg)"])) / count * rate_hz,
        traces.integral(low * traces["v(xs.low_leg)"]) / count * rate_hz,
    ]
    rest_w = CORNERS["typical"]["high_v"] * _hold_a(parts)
    supply_w = traces.integral(high * traces["v(v60)"]) / count * board.limits.max_total_edge_rate_hz + STAGES / 2 * rest_w
    return {
        "series resistor at the edge limit of a channel": resistor_j * rate_hz,
        "the same by the formula of `bank info --power`": worst_edge_j(board.driver) * rate_hz,
        "edge limit that this resistor would bear": 1e-3 * permitted_w / resistor_j,
        "hotter switch at the edge limit": 1e3 * max(switches),
        "level shifter of a channel that idles high": 1e3 * rest_w,
        "from the 60 V supply at the edge limit of all channels": supply_w,
    }


def _hold_a(parts: Parts) -> float:
    """Current in A of the level shifter of a stage that is high."""
    traces = stage(CORNERS["typical"], parts, levels([(1e-6, 1)]), 100e-6)
    resistance = parts.get("hold_ohm", parameters()["hold_ohm"])
    return traces.at("v(xs.sink)", 99e-6) / resistance


def all_off(_board: Board, parts: Parts) -> Measured:
    """All channels and the supply go low in the same clock, with every channel high before and 200 nH to the stages."""
    off_s = 60e-6
    drive = levels([(5e-6, 1), (off_s, 0)])
    lines = [
        "Vhv v60_in 0 {high_v}",
        "Vlogic v5 0 {logic_v}",
        f"Vdrive drive 0 {drive}",
        f"Venable enable 0 {levels([(0, 1), (off_s, 0)])}",
    ]
    lines += [
        _alive(0.0, off_s),
        "Xsupply enable alive v60_in v5 v60 supply",
        ".ic v(v60)={high_v} v(xsupply.store)=4",
        "Lwire v60 rail 200n",
        "Crail rail 0 100n",
    ]
    lines += [f"X{'s' if n == 0 else n} drive rail v5 {'patch' if n == 0 else f'patch{n}'} stage" for n in range(STAGES)]
    vectors = ("v(v60)", "v(rail)", "v(patch)", "v(xs.out)", *LEGS)
    rows = [transient(netlist(CORNERS[name], parts, *lines), vectors, 10e-9, 130e-6) for name in ("both early", "both late")]
    after = [traces.between(off_s, 130e-6) for traces in rows]
    return {
        "rail when 32 channels rise and fall together, most": worst([traces["v(rail)"].max() for traces in rows]),
        "through both switches then": 1e3 * worst([through_both(part.between(off_s, off_s + DEAD_TIME_S)).max() for part in after]),
        "patches 50 us after": worst([abs(part.at("v(patch)", off_s + 50e-6)) for part in after]),
    }


def _alive(begin_s: float, stop_s: float, level: int = 0) -> str:
    """hv_alive between two times, and its level from then on."""
    half_s = 0.5 / ALIVE_HZ
    changes = [(begin_s + n * half_s, 1 - n % 2) for n in range(max(1, int((stop_s - begin_s) / half_s)))]
    return f"Valive alive 0 {levels([*changes, (stop_s, level)])}"


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
            parts_of = [
                "Xsupply enable alive v60_in v5 v60 supply",
                "Xs drive v60 v5 patch stage",
                "Xdirect drive v60_in v5 patch_direct stage",
            ]
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
            lines += [f"Venable enable 0 {levels([(0, 1)])}", _alive(0.0, end_s), "Xsupply enable alive v60_in v5 v60 supply"]
            lines += ["Xs drive v60 v5 patch stage"]
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
            lines = [
                "Vhv v60_in 0 {high_v}",
                "Vlogic v5 0 {logic_v}",
                f"Venable enable 0 {levels([(begin_s, 1)])}",
                _alive(begin_s + half_s, stop_s, level),
            ]
            lines += ["Xsupply enable alive v60_in v5 v60 supply"]
            vectors = (
                "v(v60)",
                "v(v60_in)",
                "v(xsupply.pulled)",
                "v(xsupply.switch_gate)",
                "v(xsupply.store)",
                "v(enable)",
                "v(alive)",
                "i(vhv)",
            )
            traces = transient(netlist(corner, parts, *lines), vectors, 1e-6, end_s)
            settled.append(traces.crossing_s("v(v60)", 0.98 * corner["high_v"], rising=True, after_s=begin_s) - begin_s)
            opened.append(traces.crossing_s("v(v60)", 0.95 * corner["high_v"], rising=False, after_s=stop_s) - stop_s)
            up = traces.between(begin_s, begin_s + 2e-3)
            energies.append(up.integral(-up["i(vhv)"] * (up["v(v60_in)"] - up["v(v60)"])))
    return {
        "from hv_enable to 98 % of the supply": 1e6 * worst(settled),
        "from the last beat of hv_alive to an open switch": 1e3 * worst(opened),
        "heat in the switch at switching on": 1e3 * worst(energies),
    }


def digest() -> str:
    """Hash of the netlists, by which table and pictures say what they show."""
    texts = b"".join((data_folder("boards") / "stage" / name).read_bytes() for name in NETLISTS)
    return hashlib.sha256(texts).hexdigest()[:16]


Bench = Callable[[Board, Parts], Measured]
BENCHES: Final[dict[str, Bench]] = {
    "edges": edges,
    "faults": faults,
    "heat": heat,
    "all off": all_off,
    "start-up": start_up,
    "supply gone": supply_gone,
    "supply": supply,
}
# (what is wrong, parts, bench that finds it)
WRONG_PARTS: Final[tuple[tuple[str, dict[str, float], str], ...]] = (
    ("no dead time (R2 100 ohm)", {"low_gate_ohm": 100}, "edges"),
    ("gate resistor R2 ten times too large", {"low_gate_ohm": 39e3}, "edges"),
    ("series resistor 1 kohm", {"series_ohm": 1000}, "edges"),
    ("gate pull-up R5 ten times too large", {"gate_pull_up_ohm": 120e3}, "edges"),
    ("hold resistor R3 ten times too large", {"hold_ohm": 47e3}, "edges"),
    ("boost capacitor C2 ten times too large", {"boost_f": 2.2e-9}, "edges"),
    ("no leg resistors, no dead time", {"leg_ohm": 1, "low_gate_ohm": 100}, "faults"),
    ("no dead time, at a fault", {"low_gate_ohm": 100}, "faults"),
    ("series resistor 1 kohm, by its heat", {"series_ohm": 1000, "leg_ohm": 20}, "heat"),
    ("patch of 4 nF", {"patch_f": 4e-9}, "edges"),
    ("no pull-downs", {"pull_down_ohm": 1e9, "supply_pull_down_ohm": 1e9}, "start-up"),
    ("pull-downs of 10 kohm", {"pull_down_ohm": 10e3, "supply_pull_down_ohm": 10e3}, "start-up"),
    ("no gate pull-up R5", {"gate_pull_up_ohm": 1e9}, "start-up"),
    ("no resistor R9 across the patch", {"bleeder_ohm": 1e9}, "supply gone"),
    ("store C22 ten times too large", {"store_f": 1e-6}, "supply"),
    ("no resistor R23 across it", {"store_ohm": 1e9}, "supply"),
    ("bulk C24 ten times too large", {"bulk_f": 15e-6}, "supply"),
    ("no dead time, all channels together", {"low_gate_ohm": 100}, "all off"),
)  # fmt: skip


def parameters() -> dict[str, float]:
    """Values of the parts in the netlists, by the names of their parameters."""
    scale = {"": 1.0, "p": 1e-12, "n": 1e-9, "u": 1e-6, "m": 1e-3, "k": 1e3, "meg": 1e6}
    found = {}
    for name in NETLISTS[1:]:
        for line in (data_folder("boards") / "stage" / name).read_text().splitlines():
            if line.startswith(".param "):
                for part, text in (setting.split("=") for setting in line.split()[1:]):
                    digits = text.rstrip("pnumkeg")
                    found[part] = float(digits) * scale[text[len(digits) :]]
    return found


def measure(board: Board, parts: Parts | None = None, benches: Sequence[str] = tuple(BENCHES)) -> list[Figure]:
    """All figures of some benches.

    The figures are compared with the limits of `board`; `parts` take the place of those of the netlists, by the names of their
    parameters; `benches` are of `BENCHES`. Raises ControllerError if ngspice is missing or fails.
    """
    known = limits(board)
    measured = {name: value for bench in benches for name, value in BENCHES[bench](board, parts or {}).items()}
    return [Figure(name, value, *known[name]) for name, value in measured.items()]


def table(figures: Sequence[Figure]) -> str:
    """The figures as rows of a table in Markdown."""
    rows = []
    for figure in figures:
        value, limit = (f"{number:.{3 if abs(number) < 1000 else 4}g} {figure.unit}" for number in (figure.value, figure.limit))
        rows.append(f"| {figure.name} | {value} | {'at most' if figure.most else 'at least'} {limit} | {figure.why} |")
    return "\n".join(["| figure, worst corner | measured | limit | because |", "|---|---|---|---|", *rows])


def with_figures(readme: str) -> str:
    """The README's text with the figures of these netlists, which are measured again only where the netlists have changed."""
    head, _, rest = readme.partition(BEGIN)
    if rest.startswith(f" {digest()} -->"):
        return readme
    return f"{head}{BEGIN} {digest()} -->\n{table(measure(load_board(find_board(BOARD))))}\n{END}{rest.partition(END)[2]}"


@program
def main(arguments: Sequence[str] | None = None) -> int:
    """Print the table, or what finds the wrong parts; 1 if a figure is beyond its limit, or a wrong part is not found."""
    parser = argparse.ArgumentParser(
        prog="python -m controller.workshop.benchmark.stage.power_stage", description=(__doc__ or "").partition("\n")[0]
    )
    parser.add_argument("--board", default=BOARD, help="whose limits and driver are taken (%(default)s)")
    parser.add_argument(
        "--wrong-parts", action="store_true", help="exchange parts, one after the other, and say which figure shows it"
    )
    options = parser.parse_args(arguments)
    board = load_board(find_board(options.board))
    if options.wrong_parts:
        missed = 0
        for what, parts, bench in WRONG_PARTS:
            bad = [
                f"{figure.name}: {figure.value:.3g} {figure.unit}" for figure in measure(board, parts, [bench]) if not figure.good
            ]
            missed += not bad
            say(f"{what}: {'; '.join(bad) or 'NOT FOUND'}")
        return int(missed > 0)
    figures = measure(board)
    say(table(figures))
    beyond = [figure for figure in figures if not figure.good]
    for figure in beyond:
        tell(f"beyond its limit: {figure.name}: {figure.value:.3g} {figure.unit}, {figure.limit:.3g} {figure.unit}")
    return int(bool(beyond))


if __name__ == "__main__":
    sys.exit(main())
