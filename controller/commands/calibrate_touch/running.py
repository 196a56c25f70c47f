"""`haptic-panel calibrate-touch --socket`: axes, ghosts or lag of a panel whose service plays, through its application socket."""

import argparse
from typing import Any

import msgspec

from controller.commands.calibrate_touch import ghosts, residual_words
from controller.commands.common.output import progress_bar
from controller.console import flush, say, tell
from controller.device.application_socket.client import PanelClient
from controller.device.touch_calibration.calibration import MAX_TARGETS, Point, check_targets, default_targets
from controller.device.touch_calibration.running import Progress, running_axes, running_ghosts
from controller.device.touch_calibration.touch_table import board_lines, value_line


def calibrate_running(options: argparse.Namespace) -> int:
    """Calibrate, and print the lines for board.toml; with --json each step as an object on a line of its own, the result last."""
    with PanelClient(options.socket) as panel:
        if options.ghosts:
            figures, words = _ghosts(panel, _progress(options, "emissions"))
        elif options.lag:
            figures, words = _lag(panel, options.seconds, _progress(options, ""))
        else:
            figures, words = _axes(panel, options, _progress(options, ""))
    if options.json:
        _line(figures | {"words": words})
    else:
        say("\n".join([*figures["lines"], *words, "for [touch] of board.toml; the service takes it when it starts again"]))
    return 0


def _axes(panel: PanelClient, options: argparse.Namespace, progress: Progress) -> tuple[dict[str, Any], list[str]]:
    about = panel.describe()
    targets = [(x, y) for x, y in options.at] if options.at else default_targets(about, options.targets or MAX_TARGETS)
    check_targets(targets, about)
    found = running_axes(panel, targets, progress)
    residual = {"rms": found.rms_mm, "worst": found.worst_mm} if found.residuals_mm else None
    figures = {"board": about.board, "lines": list(board_lines(found)), "residual_mm": residual}
    return figures, [residual_words(residual, len(targets))]


def _ghosts(panel: PanelClient, progress: Progress) -> tuple[dict[str, Any], list[str]]:
    found = running_ghosts(panel, progress)
    figures = ghosts.figures(found)
    lines = [value_line("ghost_ms", found.ghost_ms)]
    return {"board": panel.describe().board, "lines": lines} | figures, ghosts.table(figures)


def _lag(panel: PanelClient, seconds: float | None, progress: Progress) -> tuple[dict[str, Any], list[str]]:
    from controller.commands.calibrate_touch import lag  # no other calibration needs what drives touch panels, and the page
    from controller.device.touch_calibration.page_mouse import StandardInput
    from controller.device.touch_calibration.running_lag import SECONDS, running_lag

    found = running_lag(panel, StandardInput(), progress, seconds or SECONDS)
    figures = lag.figures(found.figures)
    figures["error_ms"]["clock"] = round(found.clock_error_ms, 2)
    words = lag.table(figures)
    words.insert(1, f"within {found.clock_error_ms:.1f} ms for the page's clock, by its messages there and back")
    return {"board": panel.describe().board, "lines": [value_line("lag_ms", found.figures.lag_ms)]} | figures, words


def _progress(options: argparse.Namespace, bar: str) -> Progress:
    """Where progress goes: lines of JSON, a bar, or sentences."""
    shown = progress_bar(bar)
    if bar and not options.json:
        tell("hands off the panel for one to three minutes: it plays by itself")

    def progress(step: int, of: int, words: str, at_mm: Point | None = None) -> None:
        if options.json:
            _line({"step": step, "of": of, "say": words, "at_mm": at_mm})
        elif bar:
            shown(step, of)
        else:
            tell(words)

    return progress


def _line(what: dict[str, Any]) -> None:
    say(msgspec.json.encode(what).decode())
    flush()
