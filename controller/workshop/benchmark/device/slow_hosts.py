"""Trains of pulses on hosts of known slowness: how many come late, by how much, and what else the schedule costs.

`python -m controller.workshop.benchmark.device.slow_hosts` plays 50 Hz trains under moving fingers, and a recording, on the model
of the gateware, in virtual time. The host's own time is drawn from a log-normal distribution whose 99th percentile is four times
its median; each frame takes 40 µs in the kernel besides its bits, in which the wire is idle. Seeded: every run gives the same
figures.
"""

from __future__ import annotations

import argparse
import json
import math
import random
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from controller.console import program, say
from controller.device.bank.reader import Bank
from controller.device.board.board import Board, load_board
from controller.device.board.lookup import find_board
from controller.device.touch.prediction import Motion
from controller.device.touch.recordings.recording import Recording
from controller.workshop.bank_builder.build import build_bank
from controller.workshop.bank_builder.request import BankRequest
from controller.workshop.benchmark.device.slow_host import (
    REPORT_S,
    moving,
    run_slow,
    scene_of,
)

HOSTS_US = (140.0, 220.0, 400.0, 550.0, 1300.0)  # median host time of an upload
FAST_REPORT_S, FAST_M_S = 2e-3, 1.0
PITCH_M = 10e-3
TRAIN = '[[regions]]\nname = "all"\nshape = "plate"\neffects = [{ effect = "train", rate_hz = 50.0, duration_ms = 3.6e6 }]\n'
FINE = '[[regions]]\nname = "all"\nshape = "plate"\neffects = [{ effect = "texture", spacing_mm = 0.5 }]\n'
LEADS_MS, SPEEDS_M_S = (2.1, 3.0, 4.7, 8.5), (0.1, 0.2, 0.5, 1.0)
REACH_M, NOISE_M, T_S = 30e-3, 0.05e-3, 2e-3


def late_pulses(
    board: Board, bank: Bank, duration_s: float, hosts_us: Sequence[float] = HOSTS_US, seed: int = 1
) -> list[dict[str, Any]]:
    """Play 50 Hz trains under one moving finger, under two, and under the fingers of the board's recording.

    The fingers move for `duration_s`; `hosts_us` are median host times of an upload. Each row is a scene and a host.
    `late_percent`: of the pulses; `off_worst_ms`: how much later than due a pulse started at most; `spacing_worst_ms`: how far the
    distance of two pulses was off the period; `lead_ms`: at the end of the run.
    """
    scene = scene_of(board, TRAIN)
    recordings = {
        "one finger": moving(duration_s),
        "two fingers": moving(duration_s, 2),
        "recording": Recording.open(board.beside(board.touch.recording)),
    }
    rows = []
    for name, recording in recordings.items():
        for p50_us in hosts_us:
            done = run_slow(board, scene, bank, recording, p50_us * 1e-6, seed)
            rows.append(
                {
                    "fingers": name,
                    "host_p50_us": p50_us,
                    "pulses": len(done.late),
                    "late_percent": round(100 * sum(done.late) / len(done.late), 2),
                    "off_worst_ms": round(1e3 * max(done.off_s), 3),
                    "spacing_worst_ms": round(1e3 * max(done.spacing_error_s), 3),
                    "lead_ms": done.timing.figures()["lead_ms"],
                }
            )
    return rows


def rates(board: Board, bank: Bank, duration_s: float, hosts_us: Sequence[float] = HOSTS_US, seed: int = 1) -> list[dict[str, Any]]:
    """Emissions a second of a fine texture under a fast finger, an upload each: what the host reaches, and what it says it does."""
    scene, recording = scene_of(board, FINE), moving(duration_s, speed_m_s=FAST_M_S, report_s=FAST_REPORT_S)
    rows = []
    for p50_us in hosts_us:
        done = run_slow(board, scene, bank, recording, p50_us * 1e-6, seed)
        rows.append(
            {"host_p50_us": p50_us, "reached_hz": round(done.emissions_hz, 1), "said_hz": done.timing.figures()["uploads_hz"]}
        )
    return rows


def aim_errors(
    leads_ms: Sequence[float] = LEADS_MS, speeds_m_s: Sequence[float] = SPEEDS_M_S, seed: int = 1
) -> list[dict[str, Any]]:
    """Distance of the place a pulse is aimed at from where its finger is when the focus forms, by the lead it is prepared with.

    The finger moves to and fro as a sine of 30 mm, with the highest speed given; the panel reports every 8 ms, with 0.05 mm of
    noise and a resolution of 0.1 mm. A pulse is aimed T and its lead ahead, at any time between two reports.

    Each row is a speed and a lead, with the median and the 95th percentile in mm.
    """
    rows = []
    for speed_m_s in speeds_m_s:
        for lead_ms in leads_ms:
            rng, off = random.Random(seed), []
            rad_s = speed_m_s / REACH_M
            motion = Motion(0.0, 0.0, 0.0)
            for k in range(1, 4000):
                now_s = k * REPORT_S
                noisy_m = [REACH_M * math.sin(rad_s * now_s) + rng.gauss(0, NOISE_M), rng.gauss(0, NOISE_M)]
                motion.report(round(noisy_m[0], 4), round(noisy_m[1], 4), now_s)
                asked_s = now_s + rng.random() * REPORT_S
                focus_s = asked_s + lead_ms * 1e-3 + T_S
                x_m, y_m = motion.predict(focus_s, asked_s, 0.0, REPORT_S)
                off.append(1e3 * math.hypot(x_m - REACH_M * math.sin(rad_s * focus_s), y_m))
            p50_mm, p95_mm = np.percentile(off, [50, 95]).tolist()
            rows.append({"speed_m_s": speed_m_s, "lead_ms": lead_ms, "p50_mm": round(p50_mm, 2), "p95_mm": round(p95_mm, 2)})
    return rows


def table(rows: Sequence[dict[str, Any]]) -> str:
    """Format rows of equal keys as a table in Markdown."""
    heads = list(rows[0])
    lines = [
        heads,
        ["---"] * len(heads),
        *[[f"{row[head]:g}" if head != "fingers" else row[head] for head in heads] for row in rows],
    ]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


@program
def main(arguments: Sequence[str] | None = None) -> int:
    """Run from the command line (`sys.argv` by default); the exit code."""
    name = "python -m controller.workshop.benchmark.device.slow_hosts"
    parser = argparse.ArgumentParser(prog=name, description="Pulses of trains on slow hosts.")
    parser.add_argument("--seconds", type=float, default=40.0, help="for which the fingers move (40)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    options = parser.parse_args(arguments)
    board = load_board(find_board("simulated"))
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "ten.bank"
        build_bank(BankRequest(board, path, PITCH_M))
        with Bank.open(path, board) as bank:
            figures = {
                "late_pulses": late_pulses(board, bank, options.seconds, seed=options.seed),
                "rates": rates(board, bank, options.seconds / 10, seed=options.seed),
                "aim_errors": aim_errors(seed=options.seed),
            }
    say(json.dumps(figures) if options.json else "\n\n".join(table(rows) for rows in figures.values()))
    return 0


if __name__ == "__main__":
    sys.exit(main())
