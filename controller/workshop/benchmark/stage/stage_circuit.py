"""The reference stage and its supply (boards/stage) as circuits for ngspice: netlists, corners, and what drives them."""

import hashlib
import math
from collections.abc import Mapping, Sequence
from typing import Final

import numpy as np

from controller.arrays import Floats
from controller.device.board.lookup import data_folder
from controller.workshop.simulation.ngspice import Traces, transient

NETLISTS: Final = ("models.lib", "stage.cir", "supply.cir")
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
ALIVE_HZ: Final = 20e3

STAGES: Final = 32
DEAD_TIME_S: Final = 2e-6  # both legs are watched for so long behind an edge

LEGS: Final = ("i(v.xs.vhigh)", "i(v.xs.vlow)")
STAGE_VECTORS: Final = (
    *("v(drive)", "v(v60)", "v(xs.out)", "v(patch)", "v(xs.filter)", "v(xs.low_gate)", "v(xs.high_gate)"),
    *("v(xs.level)", "v(xs.sink)", "v(xs.high_leg)", "v(xs.low_leg)", *LEGS),
)
SOURCES: Final = ("Vhv v60_in 0 {high_v}", "Vlogic v5 0 {logic_v}")  # both supplies, there from the start
SUPPLY: Final = "Xsupply enable alive v60_in v5 v60 supply"


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


def alive(begin_s: float, stop_s: float, level: int = 0) -> str:
    """hv_alive between two times, and its level from then on."""
    half_s = 0.5 / ALIVE_HZ
    changes = [(begin_s + n * half_s, 1 - n % 2) for n in range(max(1, int((stop_s - begin_s) / half_s)))]
    return f"Valive alive 0 {levels([*changes, (stop_s, level)])}"


def through_both(traces: Traces) -> Floats:
    """Current in A that flows through both switches at once."""
    return np.maximum(np.minimum(traces[LEGS[0]], traces[LEGS[1]]), 0.0)


def worst(values: Sequence[float], *, most: bool = True) -> float:
    """The worst of the corners; nan if one is missing."""
    if any(map(math.isnan, values)):
        return float("nan")
    return max(values) if most else min(values)


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


def digest() -> str:
    """Hash of the netlists, by which table and pictures say what they show."""
    texts = b"".join((data_folder("boards") / "stage" / name).read_bytes() for name in NETLISTS)
    return hashlib.sha256(texts).hexdigest()[:16]
