"""Scenes and fingers on which skipping is measured, as recordings."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from controller.device.board.board import Board
from controller.device.touch import event_codes as ev
from controller.device.touch.event_reader import AxisInfo, DeviceDescription, Event
from controller.device.touch.recordings.recording import Recording
from controller.device.touch_calibration.event_capture import recording_text

REPORT_S = 8e-3
UNITS_PER_MM = 100
Path_mm = Callable[[float], tuple[float, float]]


@dataclass(frozen=True)
class PlayedContact:
    """A finger that is down for a while: `path` gives (x_mm, y_mm) at a time in s from its start."""

    start_s: float
    end_s: float
    path: Path_mm


@dataclass(frozen=True)
class SkipCase:
    """One scene with its fingers."""

    name: str
    scene: str  # one of the simulated board's
    contacts: tuple[PlayedContact, ...]  # at most ten at a time; each has a slot of its own
    equal_bits: bool  # no finger moves: exact skipping has to leave every output bit as it is


def _still(x_mm: float, y_mm: float) -> Path_mm:
    return lambda _: (x_mm, y_mm)


def _taps(places: Sequence[tuple[float, float]], every_s: float) -> tuple[PlayedContact, ...]:
    return tuple(PlayedContact(n * every_s, n * every_s + 0.08, _still(*place)) for n, place in enumerate(places))


def _circle(x_mm: float, y_mm: float, radius_mm: float, speed_mm_s: float) -> Path_mm:
    def path(at_s: float) -> tuple[float, float]:
        angle = speed_mm_s / radius_mm * at_s
        return x_mm + radius_mm * math.cos(angle), y_mm + radius_mm * math.sin(angle)

    return path


def _to_and_fro(at_s: float) -> tuple[float, float]:
    return 105.0 + 45.0 * math.sin(2 * math.pi * 0.5 * at_s), 74.0


KEYS = [
    (27.0 + 26.0 * key + dx, 29.0 + dy) for key, dx, dy in ((0, 0.5, 1), (2, 3, -2), (4, -1, 4), (4, 5, 0), (2, 3, -2), (0, -4, 2))
]
CASES = (
    SkipCase("idle", "keyboard", (*_taps(KEYS[:1], 1.0), PlayedContact(8.0, 8.08, _still(*KEYS[0]))), True),
    SkipCase("keyboard", "keyboard", _taps(KEYS * 4, 0.15), True),
    SkipCase("slider", "slider", (PlayedContact(0.0, 4.0, _to_and_fro),), False),
    SkipCase("four always-on spots", "spots", (PlayedContact(0.0, 4.0, _still(105.0, 74.0)),), True),
    SkipCase("whole-plate texture, one finger", "plate", (PlayedContact(0.0, 4.0, _circle(105.0, 74.0, 40.0, 100.0)),), False),
    SkipCase(
        "ten free fingers",
        "plate",
        tuple(PlayedContact(0.0, 2.0, _circle(30.0 + 37.5 * (n % 5), 45.0 + 58.0 * (n // 5), 9.0, 50.0)) for n in range(10)),
        False,
    ),
)


def recording(board: Board, case: SkipCase) -> Recording:
    """Recording of a case's fingers, a report every `REPORT_S` while one is down."""
    events: list[Event] = []
    for slot, contact in enumerate(case.contacts):
        number = slot % 10
        times_s = np.arange(contact.start_s, contact.end_s, REPORT_S).tolist()
        for index, at_s in enumerate(times_s):
            events.append((ev.EV_ABS, ev.ABS_MT_SLOT, number, at_s))
            if index == 0:
                events.append((ev.EV_ABS, ev.ABS_MT_TRACKING_ID, slot + 1, at_s))
            place = contact.path(at_s - contact.start_s)
            events += [(ev.EV_ABS, code, round(UNITS_PER_MM * mm), at_s) for code, mm in zip(ev.POSITIONS, place, strict=True)]
        events += [(ev.EV_ABS, ev.ABS_MT_SLOT, number, contact.end_s), (ev.EV_ABS, ev.ABS_MT_TRACKING_ID, -1, contact.end_s)]
    events.sort(key=lambda event: event[3])
    reports: list[Event] = []
    for event in events:
        if reports and event[3] > reports[-1][3]:
            reports.append((ev.EV_SYN, ev.SYN_REPORT, 0, reports[-1][3]))
        reports.append(event)
    reports.append((ev.EV_SYN, ev.SYN_REPORT, 0, reports[-1][3]))
    sides = zip(ev.POSITIONS, (board.plate.length_mm, board.plate.width_mm), strict=True)
    axes = {code: AxisInfo(0, round(UNITS_PER_MM * side_mm)) for code, side_mm in sides}
    axes |= {ev.ABS_MT_SLOT: AxisInfo(0, 9), ev.ABS_MT_TRACKING_ID: AxisInfo(0, 65535)}
    return Recording(recording_text(DeviceDescription(case.name, axes=axes), reports), case.name)
