"""Prediction figures (device/touch/README.md, Prediction): distance of predicted from recorded places, for several predictors.

`python -m controller.workshop.benchmark.device.prediction_error FILE...` replays recordings through the board's tracker. After
every report it predicts where each finger will be, by the loop's own call (`Tracker.predict`), and compares with the recorded
track at that time. Stops and turns at a known instant and noise at rest, which no recording shows, are synthesised.
"""

from __future__ import annotations

import argparse
import json
import math
import sys
from collections.abc import Iterable, Sequence
from functools import cache
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
from numpy.typing import NDArray

from controller.console import program, say
from controller.device.board.board import Board, load_board
from controller.device.board.lookup import find_board
from controller.device.service.drivers import tracked
from controller.device.touch.prediction import Motion
from controller.device.touch.recordings.recording import Recording, Track
from controller.device.touch.recordings.replay import RecordingSource
from controller.workshop.benchmark.device.predictors import METHODS
from controller.workshop.physics.pictures.plot import check_picture

HORIZONS_MS = (5.0, 10.0, 20.0, 30.0)
PERIOD_S, SPEED_M_PER_S, SIGMA_M = 8e-3, 0.3, 0.05e-3  # of synthesised fingers: report period, speed, noise; resolution 0.1 mm
LAG_MS, AHEAD_S = 10.0, 3.4e-3  # latency of their panel; duration of an upload with its emission
SYNTHETIC_AXES = "A: 35 0 2100 0 0 0\nA: 36 0 1480 0 0 0\n"
START_M = 0.05
PHASES = 20

Places = NDArray[np.float64]


def errors_m(recording: Recording, board: Board, motion: type[Motion], ahead_s: Sequence[float]) -> list[Places]:
    """Distances in m of the tracker's predictions from the recorded tracks, for each horizon, from each report on.

    Predictions beyond the end of a track are left out.
    """
    asked, tracks = _asked(recording, board, motion, ahead_s)
    found = []
    for index, horizon_s in enumerate(ahead_s):
        off = [
            math.dist(places[index], tracks[finger].position(later_s))
            for finger, now_s, places in asked
            if (later_s := now_s + horizon_s + board.touch.lag_s) <= tracks[finger].end_s
        ]
        found.append(np.array(off))
    return found


def overshoot_m(motion: type[Motion], *, turns: bool) -> float:
    """How far in m predictions overshoot a finger that stops, or `turns` back, once a report shows it.

    The farthest over `PHASES` phases of the reports.
    """
    farthest = -math.inf
    for phase in range(PHASES):
        steps, stop = np.arange(60), 30 + phase / PHASES
        way = np.where(steps <= stop, steps, 2 * stop - steps if turns else stop)
        along = _predictions(way * PERIOD_S * SPEED_M_PER_S, phase, motion)[:, 0] - START_M - stop * PERIOD_S * SPEED_M_PER_S
        farthest = max(farthest, float(along[math.floor(stop) + 2 :].max()))
    return farthest


def rest_m(motion: type[Motion]) -> float:
    """Measure the jitter of a predictor, in m: range of predictions for a finger at rest, from its 20th report on."""
    return max(float(np.ptp(_predictions(np.zeros(100), seed, motion)[20:], axis=0).max()) for seed in range(PHASES))


def measure(recordings: Iterable[Recording]) -> dict[str, Any]:
    """Make all figures: report period and jitter of each recording; errors in mm by predictor and horizon."""
    board = _board()
    ahead_s = [horizon_ms * 1e-3 for horizon_ms in HORIZONS_MS]
    rates = {}
    off: dict[str, list[list[Places]]] = {name: [[] for _ in HORIZONS_MS] for name in METHODS}
    for recording in recordings:
        rates[recording.name] = _rate(recording, board)
        for name, motion in METHODS.items():
            for kept, found in zip(off[name], errors_m(recording, board, motion, ahead_s), strict=True):
                kept.append(found)
    return {
        "recordings": rates,
        "methods": {
            name: {
                "error_mm": {f"{ms:g}": _spread_mm(found) for ms, found in zip(HORIZONS_MS, off[name], strict=True)},
                "overshoot_at_a_stop_mm": overshoot_m(motion, turns=False) * 1e3,
                "overshoot_at_a_turn_mm": overshoot_m(motion, turns=True) * 1e3,
                "jitter_at_rest_mm": rest_m(motion) * 1e3,
            }
            for name, motion in METHODS.items()
        },
    }


def table(figures: dict[str, Any]) -> str:
    """Format the figures of `measure` as two tables in Markdown."""
    lines = ["| recording | fingers | period (ms) | jitter, p95 − p5 (ms) |", "|---|---|---|---|"]
    for name, rate in figures["recordings"].items():
        period, jitter = ("–" if rate[key] is None else f"{rate[key]:.2f}" for key in ("period_ms", "jitter_ms"))
        lines.append(f"| {name} | {rate['fingers']} | {period} | {jitter} |")
    heads = " | ".join(f"+{horizon_ms:g} ms" for horizon_ms in HORIZONS_MS)
    lines += ["", f"| median / p95 / worst (mm) | {heads} | stop | turn | rest |", "|---" * (len(HORIZONS_MS) + 4) + "|"]
    for name, found in figures["methods"].items():
        errors = " | ".join("{median:.2f} / {p95:.2f} / {worst:.1f}".format(**error) for error in found["error_mm"].values())
        stop, turn, rest = (found[f"{key}_mm"] for key in ("overshoot_at_a_stop", "overshoot_at_a_turn", "jitter_at_rest"))
        lines.append(f"| {name} | {errors} | {stop:.2f} | {turn:.2f} | {rest:.2f} |")
    return "\n".join(lines)


def plot(path: Path, figures: dict[str, Any]) -> None:
    """Draw the 95th percentile of the error over the horizon, one line for each predictor, to a .png, .svg or .pdf file."""
    from matplotlib.figure import Figure  # noqa: PLC0415 - only where a picture is asked for

    figure = Figure(figsize=(6, 4), layout="constrained")
    axes = figure.subplots()
    for name, found in figures["methods"].items():
        axes.plot(HORIZONS_MS, [error["p95"] for error in found["error_mm"].values()], marker="o", label=name)
    axes.set(xlabel="predicted ahead (ms)", ylabel="error, 95th percentile (mm)", xlim=(0, None), ylim=(0, None))
    axes.legend(frameon=False)
    figure.savefig(path)


@program
def main(arguments: Sequence[str] | None = None) -> int:
    """Run from the command line (`sys.argv` by default); the exit code."""
    name = "python -m controller.workshop.benchmark.device.prediction_error"
    parser = argparse.ArgumentParser(prog=name, description="Errors of prediction.")
    parser.add_argument("files", nargs="+", metavar="FILE", type=Path, help="evemu recordings")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    parser.add_argument("--plot", metavar="FILE", type=Path, help="draw the errors (.png, .svg, .pdf)")
    options = parser.parse_args(arguments)
    if options.plot:
        check_picture(options.plot)
    figures = measure(Recording.open(path) for path in options.files)
    if options.plot:
        plot(options.plot, figures)
    say(json.dumps(figures, allow_nan=False) if options.json else table(figures))
    return 0


@cache
def _board() -> Board:
    return load_board(find_board("simulated"))


def _asked(
    recording: Recording, board: Board, motion: type[Motion], ahead_s: Sequence[float]
) -> tuple[list[tuple[int, float, list[tuple[float, float]]]], dict[int, Track]]:
    """(finger, time_s, predicted places) after each report, and the recorded track of each finger."""
    axes = recording.axes(board)
    contacts = recording.tracks(axes)
    parts = {finger: [track] for finger, track in contacts.items()}
    source = RecordingSource(recording, axes, 0.0)
    tracker = tracked(source, board, lambda finger, contact: parts[finger].append(contacts[contact]), motion)
    asked = []
    down: set[int] = set()
    while (now_s := tracker.next_time_s()) is not None:
        for sample in tracker.read(now_s):
            (down.add if sample.contact else down.discard)(sample.finger)
        if not tracker.touched:
            continue
        for finger in down:
            places = [place for horizon_s in ahead_s if (place := tracker.predict(finger, now_s + horizon_s)) is not None]
            asked.append((finger, now_s, places))
    return asked, {finger: Track.joined(finger, found) for finger, found in parts.items()}


def _rate(recording: Recording, board: Board) -> dict[str, Any]:
    tracker = tracked(RecordingSource(recording, recording.axes(board), 0.0), board)
    while (now_s := tracker.next_time_s()) is not None:
        tracker.read(now_s)
    figures = tracker.figures()
    return {"period_ms": figures["report_period_ms"], "jitter_ms": figures["report_jitter_ms"], "fingers": tracker.counts.contacts}


def _predictions(along_m: Places, seed: int, motion: type[Motion]) -> Places:
    """(report, 2) predictions for a synthesised finger along x, with latency, noise and resolution of a panel."""
    noise = np.random.default_rng(seed).normal(0, SIGMA_M, (2, len(along_m)))
    raw = np.rint((noise + np.array([along_m, 0 * along_m]) + START_M) * 1e4).astype(int)
    lines = [SYNTHETIC_AXES, "E: 0.0 0003 002f 0\nE: 0.0 0003 0039 1\n"]
    for k, (x, y) in enumerate(raw.T.tolist()):
        lines += [f"E: {k * PERIOD_S:.6f} {code}\n" for code in (f"0003 0035 {x}", f"0003 0036 {y}", "0000 0000 0")]
    lagging = msgspec.structs.replace(_board(), touch=msgspec.structs.replace(_board().touch, lag_ms=LAG_MS))
    asked, _ = _asked(Recording("".join(lines)), lagging, motion, [AHEAD_S])
    return np.array([place for _, _, (place,) in asked])


def _spread_mm(found: list[Places]) -> dict[str, float]:
    all_mm = np.concatenate(found or [np.zeros(0)]) * 1e3
    if not len(all_mm):
        all_mm = np.zeros(1)  # recordings of taps only have nothing to compare
    return {"median": float(np.median(all_mm)), "p95": float(np.quantile(all_mm, 0.95)), "worst": float(all_mm.max())}


if __name__ == "__main__":
    sys.exit(main())
