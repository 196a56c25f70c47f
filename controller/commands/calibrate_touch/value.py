"""What `calibrate-touch --ghosts` and `--lag` share: measure or replay, judge the recording, print or write one key of [touch]."""

import argparse
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

from controller.commands.common.named_board import board_of
from controller.commands.common.output import show
from controller.device.board.board import Board
from controller.device.touch.recordings.recording import Recording
from controller.device.touch_calibration.event_capture import write_recording
from controller.device.touch_calibration.touch_table import check_writable, value_line, write_value

T = TypeVar("T")


def calibrate_value(
    options: argparse.Namespace,  # of `calibrate-touch`: board, replay, out, write, json
    key: str,  # of [touch], and the attribute of what `judge` returns
    measure: Callable[[argparse.Namespace, Board], str],  # returns the measurement as the text of an evemu recording
    judge: Callable[[Recording, Board], T],  # computes the result from a recording
    figures: Callable[[T], dict[str, Any]],  # the result as figures for JSON
    table: Callable[[dict[str, Any]], list[str]],  # figures as lines for people
) -> int:
    """Determine one value of [touch] from a measurement, or with --replay from a recording of one.

    Raises ConfigError if board.toml is to be written and cannot be; this is checked before anything is measured.
    """
    board = board_of(options)
    file = board.folder / "board.toml"
    if options.write:
        check_writable(file)
    if options.replay:
        recording = Recording.open(Path(options.replay))
    else:
        text = measure(options, board)
        if options.out:
            write_recording(Path(options.out), text)
        recording = Recording(text, options.out or "this measurement")
    found = judge(recording, board)
    value = getattr(found, key)
    if options.write:
        write_value(file, key, value)

    def shown(all_figures: dict[str, Any]) -> str:
        written = all_figures["written"]
        where = f"written to {written}" if written else "for [touch] of board.toml (--write puts it there)"
        return "\n".join([*all_figures["lines"], *table(all_figures), where])

    result = {"lines": [value_line(key, value)], "written": str(file) if options.write else None}
    show(options, {"board": board.name} | figures(found) | result, shown)
    return 0
