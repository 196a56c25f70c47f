"""Scenes and fingers on which skipping is measured, as recordings."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from controller.device.board.board import Board
from controller.device.touch.recordings.recording import Recording

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
    reports: dict[float, list[str]] = {}  # what is reported at each time
    for number, contact in enumerate(case.contacts, start=1):
        slot = f"002f {(number - 1) % 10}"
        for at_s in np.arange(contact.start_s, contact.end_s, REPORT_S).tolist():
            began = [f"0039 {number}"] if at_s == contact.start_s else []
            x, y = (round(UNITS_PER_MM * mm) for mm in contact.path(at_s - contact.start_s))
            reports.setdefault(at_s, []).extend([slot, *began, f"0035 {x}", f"0036 {y}"])
        reports.setdefault(contact.end_s, []).extend([slot, "0039 -1"])
    sides = (round(UNITS_PER_MM * side_mm) for side_mm in (board.plate.length_mm, board.plate.width_mm))
    lines = ["A: 2f 0 9 0 0 0\nA: 35 0 {} 0 0 0\nA: 36 0 {} 0 0 0\nA: 39 0 65535 0 0 0\n".format(*sides)]
    for at_s, events in sorted(reports.items()):
        lines += [*(f"E: {at_s:.6f} 0003 {event}\n" for event in events), f"E: {at_s:.6f} 0000 0000 0000\n"]
    return Recording("".join(lines), case.name)
