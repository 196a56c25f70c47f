"""`haptic-panel record`: store the events of a touch panel as a recording that can be replayed."""

import argparse
from dataclasses import asdict
from pathlib import Path

from controller.commands.common.arguments import Declare, seconds
from controller.commands.common.named_board import board_of
from controller.commands.common.output import show
from controller.commands.common.tables import plain_table
from controller.console import tell
from controller.device.service.drivers import open_input, open_panel
from controller.device.touch.recordings.recorder import open_recording, record


def add(declare: Declare, common: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    command = declare(
        example="haptic-panel record --board panel --out touches.evemu",
        parents=[common],
        description="Store the events of the board's touch panel and the description of its device, in evemu's text format, until "
        "Ctrl-C or for some seconds. `haptic-panel run --replay FILE` replays it.",
    )
    command.add_argument(
        "--device", metavar="PATH", help="an input device of the kernel, by path or name, instead of the board's panel"
    )
    command.add_argument("--out", required=True, metavar="FILE", help="recording to write")
    command.add_argument("--seconds", type=seconds, metavar="N", help="stop by itself (default: at Ctrl-C)")
    command.set_defaults(command=store)


def store(options: argparse.Namespace) -> int:
    """Record until Ctrl-C or for the given time, and print what was stored."""
    reader = open_input(options.device) if options.device else open_panel(board_of(options))
    try:
        with open_recording(Path(options.out)) as file:
            if not options.json:
                tell(f"recording {reader.description.name!r}; Ctrl-C ends it")
            stored = asdict(record(reader, file, options.seconds))
    finally:
        reader.close()
    for warning in stored["warnings"]:
        tell(warning)
    if not stored["events"]:
        tell(f"{options.out}: holds no event, as the panel sent none: it cannot be replayed")
    show(options, {"file": options.out} | stored, plain_table)
    return 0
