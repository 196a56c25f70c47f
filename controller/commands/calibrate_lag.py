"""`haptic-panel calibrate-touch --lag`: how late the panel tells where a finger is, against a mouse that moves with it."""

from __future__ import annotations

import argparse
import selectors
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from controller.board.board import Board, find_board, load_board
from controller.board.devices import RecordingTouch
from controller.clocks import MonotonicClock
from controller.commands.output import show
from controller.errors import ConfigError
from controller.service.drivers import open_panel
from controller.touch.event_capture import EventCapture, recording_text, write_recording
from controller.touch.event_reader import Event
from controller.touch.lag_figures import LagFigures, lag_figures
from controller.touch.recording import Recording
from controller.touch.touch_table import check_writable, value_line, write_value

if TYPE_CHECKING:
    from controller.touch.mouse import Mouse

SECONDS = 20.0
SIMULATED_LAG_S = 12e-3  # of the simulated board's panel


def calibrate_lag(options: argparse.Namespace) -> int:
    """Watch finger and mouse, and print or write what follows; or judge a recording of that."""
    board = load_board(find_board(options.board))
    file = board.folder / "board.toml"
    if options.write:
        check_writable(file)
    if options.replay:
        recording = Recording.open(Path(options.replay))
    else:
        text = _measured(options, board)
        if options.out:
            write_recording(Path(options.out), text)
        recording = Recording(text, options.out or "this measurement")
    found = lag_figures(recording, board)
    if options.write:
        write_value(file, "lag_ms", found.lag_ms)
    show(options, _figures(board, found, file if options.write else None), _table)
    return 0


def _measured(options: argparse.Namespace, board: Board) -> str:
    """All that the board's panel and the mouse said for some seconds, as a recording."""
    if options.reference is None:
        if not isinstance(board.touch, RecordingTouch):
            raise ConfigError(
                "--lag needs --reference DEVICE: a mouse held to the finger, such as /dev/input/by-id/...-event-mouse"
            )
        from controller.simulation.simulated_strokes import simulated_strokes

        print(f"haptic-panel: a simulated panel: its lag is {SIMULATED_LAG_S * 1e3:g} ms", file=sys.stderr)
        return simulated_strokes(board, lag_s=SIMULATED_LAG_S)

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
    print(
        f"haptic-panel: hold the mouse to the finger and slide both 5 cm to and fro, twice a second, for {seconds:g} s from now on",
        file=sys.stderr,
        flush=True,
    )
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


def _figures(board: Board, found: LagFigures, written: Path | None) -> dict[str, Any]:
    return {
        "board": board.name,
        "lag_ms": round(found.lag_ms, 1),
        "error_ms": {"chance": round(found.error_ms, 2), "mouse": round(found.mouse_ms / 2, 2)},
        "turns": found.turns,
        "seconds": found.windows,
        "residual_mm": round(found.residual_mm, 2),
        "lines": [value_line("lag_ms", found.lag_ms)],
        "written": None if written is None else str(written),
    }


def _table(figures: dict[str, Any]) -> str:
    error = figures["error_ms"]
    where = f"written to {figures['written']}" if figures["written"] else "for [touch] of board.toml (--write puts it there)"
    return "\n".join(
        [
            *figures["lines"],
            f"within {error['chance']:.1f} ms by chance, and {error['mouse']:.1f} ms for what the mouse itself is late",
            f"from {figures['turns']} turns in {figures['seconds']} s; finger and mouse {figures['residual_mm']:.1f} mm apart, rms",
            where,
        ]
    )
