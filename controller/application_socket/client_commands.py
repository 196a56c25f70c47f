"""The client on a command line: `python -m controller.application_socket.client --socket S play click --at 100 70`."""

from __future__ import annotations

import argparse
from typing import Any

import msgspec

from controller.application_socket.client import DEFAULT_PATH, PanelClient
from controller.console import ReaderGone, flush, program, say


@program
def main(arguments: list[str] | None = None) -> int:
    """Command line of the client; messages of the panel go to stdout, one JSON object a line."""
    options = _parser().parse_args(arguments)
    try:
        return send(options)
    except ReaderGone:
        return 0


def send(options: argparse.Namespace) -> int:
    """Send the request that was asked for, and show what the panel says, until Ctrl-C where that has no end.

    Raises
    ------
    ControllerError
        If there is no panel, or it refuses.
    """
    try:
        with PanelClient(options.socket) as panel:
            return _run(panel, options)
    except KeyboardInterrupt:  # how `touches` and `state --follow` end
        return 0


def _run(panel: PanelClient, options: argparse.Namespace) -> int:
    match options.request:
        case "play":
            at_mm = tuple(options.at) if options.at else None
            answer = panel.play(options.effect, at_mm=at_mm, finger=options.finger, amplitude=options.amplitude)
            _show(answer)
            return 0 if answer.outcome in ("played", "merged") else 1
        case "touches":
            for touch in panel.touches():
                _show(touch)
        case "load":
            panel.load_scene(options.name)
        case "arm":
            panel.arm()
        case "disarm":
            panel.disarm()
        case "state" if options.follow:
            for state in panel.states():
                _show(state)
        case "state":
            _show(panel.state())
        case "figures":
            _show(panel.figures())
        case "hello":
            _show(panel.hello())
    return 0


def _show(what: Any) -> None:
    say(msgspec.json.encode(what).decode())
    flush()


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m controller.application_socket.client", description="Drive a running haptic panel."
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
    play.add_argument("--amplitude", type=float, metavar="A", help="0.25 to 1 (default: the largest that is allowed)")
    commands.add_parser("touches", help="print every touch until Ctrl-C")
    commands.add_parser("load", help="load another scene of the board").add_argument("name")
    commands.add_parser("disarm", help="switch the outputs off until a client arms")
    commands.add_parser("arm", help="switch the outputs on as soon as the FPGA allows it")
    state = commands.add_parser("state", help="print the panel's state")
    state.add_argument("--follow", action="store_true", help="and after each change, until Ctrl-C")
    commands.add_parser("figures", help="print counters and latencies")
    commands.add_parser("hello", help="print version, board, extents, effects and your rights")
