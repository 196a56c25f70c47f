"""How far beside the finger a prediction is: measured on recordings, for several ways to predict.

`python -m controller.offline.prediction_error FILE...` predicts after every report of every finger where it will be a
horizon later and compares with the recorded track. The horizon is taken for the panel's lag; that of the board
is not added. What no recording shows, stops and turns at a known instant and noise at rest, is made here.
"""

from __future__ import annotations

import argparse
import json
import math
import sys
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from controller.board import find_board, load_board
from controller.errors import ControllerError
from controller.offline.plot import check_picture
from controller.touch.prediction import PAUSE_S, SHORTEST_STEP_S, Motion
from controller.touch.recording import Recording
from controller.touch.report_rate import ReportRate
from controller.touch.tracks import Track

HORIZONS_MS = (3.4, 10.0, 20.0, 30.0)
LINE_S = 45e-3
NOISE_M, ACCELERATION = 0.2e-3, 1e-2  # of the Kalman filter: of a report; spectral density, m²/s³. The best of 8 pairs tried
STARTING_SPEED = 0.3  # m/s, before anything is known
PERIOD_S, SPEED, RESOLUTION_M, SIGMA_M = 8e-3, 0.3, 0.1e-3, 0.05e-3  # of the fingers made here
AHEAD_S = 13.4e-3  # their horizon: 10 ms of lag, and an emission

Places = NDArray[np.float64]
Method = Callable[[Track, float, float], Places]


def last_report(track: Track, horizon_s: float, period_s: float) -> Places:  # noqa: ARG001
    """No prediction."""
    return np.column_stack([track.x_m, track.y_m])


def line(track: Track, horizon_s: float, period_s: float) -> Places:
    """Slope of the straight line through the reports of the last `LINE_S`, from the last report on."""
    found = last_report(track, horizon_s, period_s)
    first = 0
    for k in range(len(found)):
        while track.time_s[k] - track.time_s[first] > LINE_S:
            first += 1
        if k > first:
            at_s = track.time_s[first : k + 1] - track.time_s[first : k + 1].mean()
            for axis, values in enumerate((track.x_m, track.y_m)):
                found[k, axis] += horizon_s * float(at_s @ values[first : k + 1]) / float(at_s @ at_s)
    return found


def kalman(track: Track, horizon_s: float, period_s: float) -> Places:
    """Kalman filter of constant velocity; the prediction starts at the last report."""
    found = last_report(track, horizon_s, period_s)
    at = found[0].copy()
    speed = np.zeros(2)
    place, both, velocity = NOISE_M**2, 0.0, STARTING_SPEED**2  # covariance, the same along x and y
    for k in range(1, len(found)):
        step_s = _step_s(track, k)
        place += step_s * (2 * both + step_s * velocity) + ACCELERATION * step_s**3 / 3
        both += step_s * velocity + ACCELERATION * step_s**2 / 2
        velocity += ACCELERATION * step_s
        to_place, to_velocity = place / (place + NOISE_M**2), both / (place + NOISE_M**2)
        off = found[k] - at - step_s * speed
        at += step_s * speed + to_place * off
        speed += to_velocity * off
        velocity -= to_velocity * both
        both -= to_place * both
        place -= to_place * place
        found[k] += horizon_s * speed
    return found


def alpha_beta(track: Track, horizon_s: float, period_s: float) -> Places:
    """What the tracker does."""
    reports = zip(track.time_s.tolist(), track.x_m.tolist(), track.y_m.tolist(), strict=True)
    begin_s, x_m, y_m = next(reports)
    motion = Motion(x_m, y_m, begin_s)
    found = [motion.place(begin_s, horizon_s, period_s)]
    for time_s, x_m, y_m in reports:
        motion.report(x_m, y_m, time_s)
        found.append(motion.place(time_s, horizon_s, period_s))
    return np.array(found)


METHODS: dict[str, Method] = {
    "last report": last_report,
    f"line, {LINE_S * 1e3:g} ms": line,
    "Kalman": kalman,
    "alpha-beta (the tracker)": alpha_beta,
}


def errors_m(method: Method, track: Track, horizon_s: float, period_s: float) -> Places:
    """Distance of each prediction from the recorded track, as far as this goes."""
    later_s = track.time_s + horizon_s
    known = later_s <= track.end_s
    true = np.column_stack([np.interp(later_s, track.time_s, along) for along in (track.x_m, track.y_m)])
    beside: Places = np.hypot(*(method(track, horizon_s, period_s) - true)[known].T)
    return beside


def overshoot_m(method: Method, *, turns: bool) -> float:
    """Farthest prediction beyond the place where a finger at `SPEED` stopped or turned, once a report shows it."""
    farthest = -math.inf
    for phase in range(20):
        steps, stop = np.arange(60), 30 + phase / 20
        way = np.where(steps <= stop, steps, 2 * stop - steps if turns else stop)
        track = _noisy(way * PERIOD_S * SPEED, phase)
        ahead = method(track, AHEAD_S, PERIOD_S)[:, 0] - stop * PERIOD_S * SPEED
        farthest = max(farthest, float(ahead[math.floor(stop) + 2 :].max()))
    return farthest


def rest_m(method: Method) -> float:
    """How far apart the predictions for a finger at rest lie, once it has rested for 20 reports."""
    return max(float(np.ptp(method(_noisy(np.zeros(100), seed), AHEAD_S, PERIOD_S)[20:], axis=0).max()) for seed in range(20))


def measure(recordings: Iterable[Recording]) -> dict[str, Any]:
    """All figures: period and jitter of each recording, errors in mm by method and horizon."""
    board = load_board(find_board("simulated"))
    tracks, rates = [], {}
    for recording in recordings:
        found = list(recording.tracks(recording.axes(board)).values())
        rate = ReportRate()
        for time_s in sorted({float(time_s) for track in found for time_s in track.time_s}):
            rate.report(time_s)
        tracks += [(track, rate.median_s or rate.period_s) for track in found]
        rates[recording.name] = {
            "period_ms": None if rate.median_s is None else rate.median_s * 1e3,
            "jitter_ms": None if rate.jitter_s is None else rate.jitter_s * 1e3,
            "fingers": len(found),
        }
    return {
        "recordings": rates,
        "methods": {
            name: {
                "error_mm": {f"{horizon_ms:g}": _spread_mm(method, tracks, horizon_ms * 1e-3) for horizon_ms in HORIZONS_MS},
                "overshoot_at_a_stop_mm": overshoot_m(method, turns=False) * 1e3,
                "overshoot_at_a_turn_mm": overshoot_m(method, turns=True) * 1e3,
                "jitter_at_rest_mm": rest_m(method) * 1e3,
            }
            for name, method in METHODS.items()
        },
    }


def table(figures: dict[str, Any]) -> str:
    """The figures as two tables in Markdown."""
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
    """Draw the 95th percentile of the error over the horizon, one line for each method."""
    from matplotlib.figure import Figure  # noqa: PLC0415 - only where a picture is asked for

    figure = Figure(figsize=(6, 4), layout="constrained")
    axes = figure.subplots()
    for name, found in figures["methods"].items():
        axes.plot(HORIZONS_MS, [error["p95"] for error in found["error_mm"].values()], marker="o", label=name)
    axes.set(xlabel="predicted ahead (ms)", ylabel="error, 95th percentile (mm)", xlim=(0, None), ylim=(0, None))
    axes.legend(frameon=False)
    figure.savefig(path)


def main(arguments: Sequence[str] | None = None) -> int:
    """Measure the recordings named on the command line."""
    parser = argparse.ArgumentParser(prog="python -m controller.offline.prediction_error", description="Errors of prediction.")
    parser.add_argument("files", nargs="+", metavar="FILE", type=Path, help="evemu recordings")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    parser.add_argument("--plot", metavar="FILE", type=Path, help="draw the errors (.png, .svg, .pdf)")
    options = parser.parse_args(arguments)
    try:
        if options.plot:
            check_picture(options.plot)
        figures = measure(Recording.open(path) for path in options.files)
        if options.plot:
            plot(options.plot, figures)
    except ControllerError as error:
        sys.stderr.write(f"prediction_error: {error}\n")
        return error.exit_code
    sys.stdout.write((json.dumps(figures, allow_nan=False) if options.json else table(figures)) + "\n")
    return 0


def _spread_mm(method: Method, tracks: Sequence[tuple[Track, float]], horizon_s: float) -> dict[str, float]:
    found = [errors_m(method, track, horizon_s, period_s) for track, period_s in tracks]
    all_mm = np.concatenate(found or [np.zeros(0)]) * 1e3
    if not len(all_mm):
        all_mm = np.zeros(1)  # taps only: nothing to compare with
    return {"median": float(np.median(all_mm)), "p95": float(np.quantile(all_mm, 0.95)), "worst": float(all_mm.max())}


def _step_s(track: Track, k: int) -> float:
    return min(max(float(track.time_s[k] - track.time_s[k - 1]), SHORTEST_STEP_S), PAUSE_S)


def _noisy(along_m: Places, seed: int) -> Track:
    """A finger along x with a panel's noise and resolution."""
    noise: Places = np.random.default_rng(seed).normal(0, SIGMA_M, (2, len(along_m)))
    noisy: Places = np.round((noise + np.array([along_m, 0 * along_m])) / RESOLUTION_M) * RESOLUTION_M
    return Track(0, np.arange(len(along_m), dtype=np.float64) * PERIOD_S, noisy[0], noisy[1])


if __name__ == "__main__":
    sys.exit(main())
