"""The client on a command line: `python -m controller.device.application_socket.client --socket S play click --at 100 70`."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

import msgspec

from controller.console import ReaderGone, flush, program, say
from controller.device.application_socket.client import DEFAULT_PATH, PanelClient
from controller.errors import ConfigError
from controller.text_file import read_text

TEXT_BYTES = 65536  # of a scene to save


@program
def main(arguments: list[str] | None = None) -> int:
    """Command line of the client; messages of the panel go to stdout, one JSON object a line."""
    options = _parser().parse_args(arguments)
    try:
        return send(options)
    except ReaderGone:
        return 0


def send(options: argparse.Namespace) -> int:
    """Send the request that was asked for, and show what the panel says, until Ctrl-C where that has no end."""
    try:
        with PanelClient(options.socket) as panel:
            return _run(panel, options)
    except KeyboardInterrupt:  # how `touches` and `state --follow` end
        return 0


def _run(panel: PanelClient, options: argparse.Namespace) -> int:
    match options.request:
        case "play":
            at_mm = tuple(options.at) if options.at else None
            effect = _table(options.table, options.effect) if options.table else options.effect
            where = {"at_mm": at_mm, "finger": options.finger, "region": options.region}
            answer = panel.play(effect, **where, amplitude=options.amplitude)
            _show(answer)
            return 0 if answer.outcome in ("played", "merged") else 1
        case "touches" | "contacts" | "emissions" | "faults" | "log" as topic:
            for notice in getattr(panel, topic)():
                _show(notice)
        case "regions":
            from controller.device.board.records import read_tables  # no other request needs a board's modules

            tables = read_tables(options.file)
            _show(panel.put_regions(tables.get("regions", ()), effects=tables.get("effects")))
            for state in () if options.once else panel.states():  # the regions stay as long as this does
                _show(state)
        case "load":
            panel.load_scene(options.name)
        case "save":
            panel.save_scene(options.name, _text(options.file))
        case "arm" | "disarm" | "stop" as order:
            getattr(panel, order)()
        case "test-channel":
            answer = panel.test_channel(options.channel)
            _show(answer)
            return 0 if answer.outcome == "played" else 1
        case "trace":
            panel.write_trace()
        case "state" | "describe" as question if options.follow:
            for notice in panel.states() if question == "state" else panel.descriptions():
                _show(notice)
        case "state" | "figures" | "describe" | "hello" as question:
            _show(getattr(panel, question)())
    return 0


def _table(file: Path, name: str) -> dict[str, Any]:
    """The table [effects.NAME] of a file; ConfigError if it has none of this name."""
    from controller.device.board.records import read_tables

    effects = read_tables(file).get("effects")
    if not isinstance(effects, dict) or not isinstance(effects.get(name), dict):
        names = ", ".join(effects) if isinstance(effects, dict) else "none"
        raise ConfigError(f"{file}: no table [effects.{name}]; it has: {names}")
    return dict(effects[name])


def _text(file: Path) -> str:
    """Text of a file; ConfigError if it cannot be read."""
    try:
        return read_text(file, TEXT_BYTES)
    except OSError as error:
        raise ConfigError(f"{file}: cannot be read ({error.strerror})") from error
    except ValueError as error:
        raise ConfigError(f"{file}: {error}") from error


def _show(what: Any) -> None:
    say(msgspec.json.encode(what).decode())
    flush()


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m controller.device.application_socket.client", description="Drive a running haptic panel."
    )
    declare_requests(parser)
    return parser


def declare_requests(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("--socket", default=DEFAULT_PATH, metavar="S", help=f"the panel's socket (default: {DEFAULT_PATH})")
    commands = parser.add_subparsers(dest="request", title="requests", metavar="REQUEST", required=True)
    play = commands.add_parser("play", help="play an effect at a point or for a finger")
    play.add_argument("effect")
    where = play.add_mutually_exclusive_group(required=True)
    where.add_argument("--at", nargs=2, type=float, metavar=("X_MM", "Y_MM"))
    where.add_argument("--finger", type=int, metavar="N", help="as numbered by `touches`")
    where.add_argument("--region", metavar="R", help="each finger in this region of the scene")
    play.add_argument("--table", type=Path, metavar="FILE.toml", help="[effects.EFFECT] of this file, as `effect import` writes it")
    play.add_argument("--amplitude", type=float, metavar="A", help="0.1 to 1 (default: the largest that is allowed)")
    commands.add_parser("touches", help="print every touch until Ctrl-C")
    commands.add_parser("contacts", help="print every contact as the touch panel has it, ghosts too, until Ctrl-C; for operators")
    commands.add_parser("emissions", help="print what is played, and what is not and why, until Ctrl-C")
    regions = commands.add_parser("regions", help="lay the regions of a scene.toml over the scene until Ctrl-C")
    regions.add_argument("file", type=Path, metavar="SCENE.toml")
    regions.add_argument("--once", action="store_true", help="only say what would be refused")
    commands.add_parser("load", help="load another scene of the board").add_argument("name")
    save = commands.add_parser("save", help="keep a scene on the device, for `load`")
    save.add_argument("name")
    save.add_argument("file", type=Path, metavar="SCENE.toml")
    commands.add_parser("stop", help="switch the outputs off until an operator arms; any client may")
    commands.add_parser("disarm", help="as stop, for operators")
    commands.add_parser("arm", help="switch the outputs on as soon as the FPGA allows it")
    state = commands.add_parser("state", help="print the panel's state")
    state.add_argument("--follow", action="store_true", help="and after each change, until Ctrl-C")
    channel = commands.add_parser("test-channel", help="play a chirp on one channel alone: its patch moves and no other")
    channel.add_argument("channel", type=int, metavar="N", help="as `describe` numbers the patches")
    commands.add_parser("trace", help="have written what the loop did in the last seconds; the log says where")
    commands.add_parser("figures", help="print counters and latencies")
    describe = commands.add_parser("describe", help="print plate, patches, axes, scene, effects, limits, versions, last faults")
    describe.add_argument("--follow", action="store_true", help="and whenever another scene is in force, until Ctrl-C")
    commands.add_parser("faults", help="print every fault until Ctrl-C")
    commands.add_parser("log", help="print the last lines of the service's log, and each one from then on, until Ctrl-C")
    commands.add_parser("hello", help="print version, board, extents, effects and your rights")
