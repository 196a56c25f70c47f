"""Distance of predicted from recorded places: recordings are replayed through the board's tracker.

After every report it predicts where each finger will be, by the loop's own call (`Tracker.predict`), and that is compared with
the recorded track at that time. Stops and turns at a known instant and noise at rest, which no recording shows, are synthesised.
"""

import math
from functools import cache

import msgspec
import numpy as np

from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.device.service.drivers import tracked
from controller.device.touch.recordings.recording import Recording, Track
from controller.device.touch.recordings.replay import RecordingSource

HORIZONS_MS = (5.0, 10.0, 20.0, 30.0)
PERIOD_S, SPEED_M_PER_S, SIGMA_M = 8e-3, 0.3, 0.05e-3  # of synthesised fingers: report period, speed, noise; resolution 0.1 mm
LAG_MS, AHEAD_S = 10.0, 3.4e-3  # latency of their panel; duration of an upload with its emission
SYNTHETIC_AXES = "A: 35 0 2100 0 0 0\nA: 36 0 1480 0 0 0\n"
START_M = 0.05
PHASES = 20


def measure(recordings, *, predicted=True):
    """Median, 95th percentile and worst error in mm over all recordings, by horizon in ms; else of the places last reported."""
    recordings = list(recordings)
    found = {}
    for horizon_ms in HORIZONS_MS:
        off_mm = 1e3 * np.concatenate([errors_m(recording, horizon_ms * 1e-3, predicted=predicted) for recording in recordings])
        found[f"{horizon_ms:g}"] = {"median": np.median(off_mm), "p95": np.quantile(off_mm, 0.95), "worst": off_mm.max()}
    return found


def errors_m(recording, ahead_s, *, predicted=True):
    """Distances in m of the predictions from the recorded tracks, but for those beyond the end of a track."""
    asked, tracks = _asked(recording, _board(), ahead_s, predicted=predicted)
    later = [(place, tracks[finger], now_s + ahead_s + _board().touch.lag_s) for finger, now_s, place in asked]
    return np.array([math.dist(place, track.position(at_s)) for place, track, at_s in later if at_s <= track.end_s])


def overshoot_m(*, turns):
    """How far predictions overshoot a finger that stops, or `turns` back, once a report shows it: the farthest of all phases."""
    farthest = -math.inf
    for phase in range(PHASES):
        steps, stop = np.arange(60), 30 + phase / PHASES
        way = np.where(steps <= stop, steps, 2 * stop - steps if turns else stop)
        along = _predictions(way * PERIOD_S * SPEED_M_PER_S, phase)[:, 0] - START_M - stop * PERIOD_S * SPEED_M_PER_S
        farthest = max(farthest, along[math.floor(stop) + 2 :].max())
    return farthest


def rest_m(*, predicted=True):
    """Range of predictions, or of reports, for a finger at rest, from its 20th report on."""
    return max(np.ptp(_predictions(np.zeros(100), seed, predicted=predicted)[20:], axis=0).max() for seed in range(PHASES))


@cache
def _board():
    return load_board(find_board("simulated"))


def _asked(recording, board, ahead_s, *, predicted=True):
    """(finger, time_s, its predicted or last place) after each report, and the recorded track of each finger."""
    axes = recording.axes(board)
    contacts = recording.tracks(axes)
    parts = {finger: [track] for finger, track in contacts.items()}
    source = RecordingSource(recording, axes, 0.0)
    tracker = tracked(source, board, lambda finger, contact: parts[finger].append(contacts[contact]))
    asked, down = [], {}
    while (now_s := tracker.next_time_s()) is not None:
        for sample in tracker.read(now_s):
            down.pop(sample.finger, None)
            if sample.contact:
                down[sample.finger] = sample.x_m, sample.y_m
        if tracker.touched:
            there = {finger: tracker.predict(finger, now_s + ahead_s) if predicted else last for finger, last in down.items()}
            asked += [(finger, now_s, place) for finger, place in there.items() if place is not None]
    return asked, {finger: Track.joined(finger, found) for finger, found in parts.items()}


def _predictions(along_m, seed, *, predicted=True):
    """(report, 2) predictions for a synthesised finger along x, with latency, noise and resolution of a panel."""
    noise = np.random.default_rng(seed).normal(0, SIGMA_M, (2, len(along_m)))
    raw = np.rint((noise + np.array([along_m, 0 * along_m]) + START_M) * 1e4).astype(int)
    lines = [SYNTHETIC_AXES, "E: 0.0 0003 002f 0\nE: 0.0 0003 0039 1\n"]
    for k, (x, y) in enumerate(raw.T.tolist()):
        lines += [f"E: {k * PERIOD_S:.6f} {code}\n" for code in (f"0003 0035 {x}", f"0003 0036 {y}", "0000 0000 0")]
    lagging = msgspec.structs.replace(_board(), touch=msgspec.structs.replace(_board().touch, lag_ms=LAG_MS))
    asked, _ = _asked(Recording("".join(lines)), lagging, AHEAD_S, predicted=predicted)
    return np.array([place for *_, place in asked])
