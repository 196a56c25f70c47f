"""`haptic-panel calibrate-touch --lag`: age of the panel's positions when reported, against a mouse that moves with the finger."""

from __future__ import annotations

import argparse
import selectors
from typing import TYPE_CHECKING, Any

from controller.clocks import MonotonicClock
from controller.commands.calibrate_touch.value import calibrate_value
from controller.console import tell
from controller.device.board.board import Board
from controller.device.service.drivers import open_panel
from controller.device.touch.event_reader import Event
from controller.device.touch_calibration.event_capture import EventCapture, recording_text
from controller.device.touch_calibration.lag_figures import LagFigures, lag_figures
from controller.errors import ConfigError

if TYPE_CHECKING:
    from controller.device.touch_calibration.mouse import Mouse

SECONDS = 20.0
SIMULATED_LAG_S = 12e-3  # of the simulated board's panel


def calibrate_lag(options: argparse.Namespace) -> int:
    """Record finger and mouse, and print or write `lag_ms`; or determine it from such a recording."""
    return calibrate_value(options, "lag_ms", _measured, lag_figures, figures, table)


def _measured(options: argparse.Namespace, board: Board) -> str:
    """Events of the board's panel and of the mouse for some seconds, as a recording."""
    if options.reference is None:
        if board.touch.has_device:
            raise ConfigError(
                "--lag needs --reference DEVICE: a mouse held to the finger, such as /dev/input/by-id/...-event-mouse"
            )
        from controller.workshop.simulation.simulated_strokes import SimulatedStrokes

        tell(f"a simulated panel: its lag is {SIMULATED_LAG_S * 1e3:g} ms")
        return SimulatedStrokes(lag_s=SIMULATED_LAG_S).recording(board)

    from controller.device.touch_calibration.mouse import Mouse

    reader = open_panel(board)
    try:
        mouse = Mouse(options.reference)
        try:
            return _watched(EventCapture(reader), mouse, options.seconds or SECONDS)
        finally:
            mouse.close()
    finally:
        reader.close()


def _watched(panel: EventCapture, mouse: Mouse, seconds: float) -> str:
    tell(f"hold the mouse to the finger and slide both 5 cm to and fro, twice a second, for {seconds:g} s from now on")
    clock = MonotonicClock()
    end_s = clock.now_s() + seconds
    steps: list[Event] = []
    while clock.now_s() < end_s:
        with selectors.DefaultSelector() as selector:
            selector.register(mouse.fileno(), selectors.EVENT_READ)
            if (fileno := panel.fileno()) is not None:
                selector.register(fileno, selectors.EVENT_READ)
            next_s = panel.next_time_s()
            clock.wait(selector, end_s if next_s is None else min(next_s, end_s))
        steps += mouse.read()
        panel.read(clock.now_s())
    return recording_text(panel.description, [*panel.events, *steps])


def figures(found: LagFigures) -> dict[str, Any]:
    """The result as figures for JSON."""
    return {
        "lag_ms": round(found.lag_ms, 1),
        "error_ms": {"chance": round(found.error_ms, 2), "mouse": round(found.mouse_ms / 2, 2)},
        "turns": found.turns,
        "seconds": found.windows,
        "residual_mm": round(found.residual_mm, 2),
    }


def table(found: dict[str, Any]) -> list[str]:
    """These figures as lines for people."""
    error = found["error_ms"]
    return [
        f"within {error['chance']:.1f} ms by chance, and {error['mouse']:.1f} ms for what the mouse itself is late",
        f"from {found['turns']} turns in {found['seconds']} s; finger and mouse {found['residual_mm']:.1f} mm apart, rms",
    ]
