"""Synthetic recording of a finger and a mouse that move together, from a panel of known latency and a mouse."""

from __future__ import annotations

import numpy as np

from controller.board.board import Board
from controller.touch import event_codes as ev
from controller.touch.event_capture import EV_REL, REL_X, REL_Y, recording_text
from controller.touch.event_reader import AxisInfo, DeviceDescription, Event

UNITS_PER_MM = 20


def simulated_strokes(
    board: Board,
    *,
    lag_s: float,
    smoothed_s: float = 0.0,
    period_s: float = 8e-3,
    noise_mm: float = 0.05,
    mouse_period_s: float = 1e-3,
    mouse_age_s: float = 0.5e-3,
    turned_deg: float = 20.0,
    strokes_hz: float = 2.0,
    reach_mm: float = 30.0,
    duration_s: float = 20.0,
    seed: int = 0,
) -> str:
    """Make a recording, as text in evemu's format, with which the measurement of latency is tested.

    Parameters
    ----------
    board : Board
        Gives the plate, which the panel covers exactly.
    lag_s : float
        Total latency of the panel's places.
    smoothed_s : float
        Part of it that comes from smoothing: time constant of a first-order low-pass.
    period_s, noise_mm : float
        Report period of the panel; standard deviation of its noise.
    mouse_period_s, mouse_age_s : float
        Report period of the mouse; age of the place that it reports.
    turned_deg : float
        Angle of the mouse to the plate; it also turns by 3 degrees and slips by 1 %.
    strokes_hz, reach_mm, duration_s : float
        Rate of the strokes, their amplitude, and the length of the recording.
    seed : int
        Seed of noise and phases.

    Returns
    -------
    str
    """
    random = np.random.default_rng(seed)
    fine_s = np.arange(0.0, duration_s + 0.4, 0.25e-3)
    phase = 2 * np.pi * np.cumsum(strokes_hz * (1 + 0.3 * np.sin(2 * np.pi * 0.23 * fine_s + random.uniform(0, 6)))) * 0.25e-3
    x_mm = board.plate.length_mm / 2 + reach_mm * np.sin(phase) * (1 + 0.2 * np.sin(0.7 * fine_s))
    y_mm = board.plate.width_mm / 2 + 0.2 * reach_mm * np.sin(0.61 * phase + 1.0)
    path = np.stack([x_mm, y_mm], axis=1)
    told = path.copy()
    if smoothed_s > 0:
        share = 1 - np.exp(-0.25e-3 / smoothed_s)
        for axis in (0, 1):
            now = told[0, axis]
            for k, value in enumerate(path[:, axis].tolist()):
                now += share * (value - now)
                told[k, axis] = now
    reports_s = np.arange(0.2, duration_s, period_s) + random.uniform(0, period_s)
    events: list[Event] = []
    seen = np.stack([np.interp(reports_s - (lag_s - smoothed_s), fine_s, told[:, axis]) for axis in (0, 1)], axis=1)
    seen += random.normal(0, noise_mm, seen.shape)
    for k, (at_s, place) in enumerate(zip(reports_s.tolist(), np.rint(UNITS_PER_MM * seen).astype(int).tolist(), strict=True)):
        events += [(ev.EV_ABS, ev.ABS_MT_SLOT, 0, at_s), (ev.EV_ABS, ev.ABS_MT_TRACKING_ID, 1, at_s)] if k == 0 else []
        events += [(ev.EV_ABS, code, value, at_s) for code, value in zip(ev.POSITIONS, place, strict=True)]
        events.append((ev.EV_SYN, ev.SYN_REPORT, 0, at_s))
    end_s = float(reports_s[-1]) + period_s
    lifted = [(ev.EV_ABS, ev.ABS_MT_TRACKING_ID, -1, end_s), (ev.EV_SYN, ev.SYN_REPORT, 0, end_s)]
    mouse_s = np.arange(0.1, duration_s + 0.1, mouse_period_s)
    angle = np.deg2rad(turned_deg + 3 * np.sin(0.5 * mouse_s))
    where = np.stack([np.interp(mouse_s - mouse_age_s, fine_s, path[:, axis]) for axis in (0, 1)], axis=1)
    step = np.diff(where, axis=0) * (1 + random.normal(0, 0.01, (len(where) - 1, 1)))
    cosine, sine = np.cos(angle[1:]), np.sin(angle[1:])
    counts = np.cumsum(
        40 * np.stack([cosine * step[:, 0] + sine * step[:, 1], cosine * step[:, 1] - sine * step[:, 0]], axis=1), axis=0
    )
    moved = np.diff(np.rint(counts), axis=0, prepend=0.0).astype(int)
    for at_s, (dx, dy) in zip(mouse_s[1:].tolist(), moved.tolist(), strict=True):
        events += [(EV_REL, code, value, at_s) for code, value in ((REL_X, dx), (REL_Y, dy)) if value]
    plate = board.plate
    sides = zip(ev.POSITIONS, (plate.length_mm, plate.width_mm), strict=True)
    axes = {code: AxisInfo(0, round(UNITS_PER_MM * side_mm)) for code, side_mm in sides}
    axes |= {ev.ABS_MT_SLOT: AxisInfo(0, 9), ev.ABS_MT_TRACKING_ID: AxisInfo(0, 65535)}
    return recording_text(DeviceDescription("simulated strokes", axes=axes), [*events, *lifted])
