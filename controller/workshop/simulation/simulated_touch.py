"""The touch panel of a simulated board: of the kind that its board.toml names, as far as there is one."""

from collections.abc import Callable, Sequence
from math import inf
from random import Random
from typing import Final

from controller.device.board.board import Board
from controller.device.touch.event_reader import EventReader
from controller.device.touch.panels.gt911 import Gt911Touch
from controller.errors import ConfigError
from controller.workshop.gateware.actual_panel import actual_panel
from controller.workshop.simulation.ghostly_panel import Finger, GhostlyPanel, Ghosts

MARKS_APART_S: Final = 2.0  # a person who touches marks: from one to the next, how long each is held, and missed at most
MARK_HELD_S: Final = 1.0
MARK_MISSED_MM: Final = 0.5


def simulated_touch(
    board: Board, fingers: Sequence[Finger] = (), watch: Callable[[float], bool] = lambda _at_s: False, from_s: float = 0.0
) -> EventReader:
    """Panel that reports `fingers`; `watch` is called at each scan, with its time in s.

    Raises ConfigError for a board whose touch panel is real.
    """
    if not board.touch.has_device:
        return GhostlyPanel(board, fingers, watch, Ghosts(0.0, (1, 1)), from_s=from_s, until_s=inf)
    if not board.link.device:
        raise ConfigError(f"board {board.name!r} has a simulated FPGA: nothing buzzes on its real touch panel")
    if not isinstance(board.touch, Gt911Touch):
        raise ConfigError(f"board {board.name!r}: of a simulated panel touch.kind is 'gt911' or 'recording'")
    from controller.workshop.simulation.simulated_gt911 import SimulatedGt911  # noqa: PLC0415 - needs gpiod and smbus2

    return SimulatedGt911(board, fingers, watch, interrupt=actual_panel(board).touch.interrupt, from_s=from_s)


def marks_touched(board: Board, marks_mm: Sequence[tuple[float, float]]) -> EventReader:
    """Panel of a simulated board whose person touches marks one after another; raises as `simulated_touch`."""
    random = Random(1)
    fingers = []
    for number, mark in enumerate(marks_mm, 1):
        x_mm, y_mm = (at + random.uniform(-MARK_MISSED_MM, MARK_MISSED_MM) for at in mark)
        fingers.append((number * MARKS_APART_S, number * MARKS_APART_S + MARK_HELD_S, (x_mm, y_mm)))
    return simulated_touch(board, fingers)
