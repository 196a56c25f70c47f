"""Benches of one reference stage on supplies that are there; each figure is the worst of the corners."""

import math
from typing import Final

import numpy as np

from controller.device.board.board import Board
from controller.device.board.relations.stage_heat import worst_edge_j
from controller.workshop.benchmark.stage.stage_circuit import (
    CORNERS,
    DEAD_TIME_S,
    LEGS,
    STAGES,
    Measured,
    Parts,
    levels,
    parameters,
    stage,
    through_both,
    worst,
)
from controller.workshop.physics.responses.driver import DriverResponse

WIDTHS_S: Final = (4e-9, 8e-9, 16e-9, 32e-9, 64e-9, 128e-9, 256e-9, 512e-9)  # of pulses that a fault may leave
FAULT_PULSE_S: Final = 16e-9  # a clock at 62.5 MHz


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
