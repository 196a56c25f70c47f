"""`haptic-panel calibrate channels`: which disc each channel moves, by a finger put where it buzzes; no sensor is needed."""

import argparse
import os
import select
import sys
from collections import Counter
from collections.abc import Sequence
from contextlib import closing
from functools import partial
from typing import Any

from controller.clocks import Clock, MonotonicClock, VirtualClock
from controller.commands.common.fpga_link import fpga_link, fpga_links
from controller.commands.common.named_board import board_of
from controller.commands.common.output import show
from controller.console import tell
from controller.device.board.board import Board
from controller.device.board.panel import CHANNELS
from controller.device.fpga.links.link import Link
from controller.device.service.drivers import open_session, open_touch
from controller.device.touch.live_source import LiveSource
from controller.device.touch.reports import FAULTS, describe_warnings
from controller.device.touch.source import TouchSource
from controller.device.touch_calibration.channel_map import ChannelMap, Place, channel_map
from controller.device.touch_calibration.channel_survey import Person, survey
from controller.errors import UsageError


class AtTerminal:
    """The person at this terminal: Enter means that nothing is felt."""

    def fileno(self) -> int | None:
        """Of stdin, if it is a terminal."""
        return sys.stdin.fileno() if sys.stdin is not None and sys.stdin.isatty() else None

    def feels_nothing(self) -> bool:
        """As in `Person`."""
        file = self.fileno()
        return file is not None and bool(select.select([file], [], [], 0)[0]) and bool(os.read(file, 1024))


def add(step: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    step.add_argument("--channel", type=int, action="append", metavar="Q", help="this channel only; may be repeated (default: all)")
    step.add_argument(
        "--swapped", nargs=2, type=int, action="append", default=[], metavar=("A", "B"), help="simulated board: wires"
    )
    step.add_argument(
        "--dead", type=int, action="append", default=[], metavar="Q", help="simulated board: a patch that does not move"
    )
    step.set_defaults(command=channels)


def channels(options: argparse.Namespace) -> int:
    """Buzz on each channel until it was touched; 1 if one moves another disc than its own, or none."""
    board = board_of(options)
    simulated, there = board.link.kind == "simulated", sorted(actuator.channel for actuator in board.actuators)
    asked = options.channel if options.channel is not None else there
    for channel in {*asked, *options.dead, *(one for pair in options.swapped for one in pair)} - set(there):
        raise UsageError(f"channel {channel}: board {board.name!r} has {there[0]} to {there[-1]}")
    if (options.swapped or options.dead) and not simulated:
        raise UsageError("--swapped and --dead are for a simulated board: on a real one the wires are what they are")
    clock: Clock = VirtualClock() if simulated else MonotonicClock()
    places: dict[int, Place | None] = {}
    warnings = Counter[str]()
    tell("Put a finger where the glass buzzes, and hold it still; lift it. If nothing buzzes, press Enter. Ctrl-C ends it.")
    whole, each = _opened(board, clock)
    with closing(whole):
        for number, (one, link) in enumerate(zip(board.fpga_boards, each, strict=True)):
            first = CHANNELS * number
            own = [channel - first for channel in asked if first <= channel < first + CHANNELS]
            if own:
                source, person = _before(board, number, link, options)
                with closing(source):
                    session = open_session(link, one, clock.now_s)
                    felt = survey(session, one, clock, source, own, person, partial(_ask, first))
                    places |= {first + channel: place for channel, place in felt}
                warnings += source.warnings
    found = channel_map(board, places)
    faults = describe_warnings({kind: warnings[kind] for kind in FAULTS})
    show(options, _figures(board, found) | {"touch_panel": faults}, _table)
    return 1 if found.wrong else 0


def _opened(board: Board, clock: Clock) -> tuple[Link, Sequence[Link]]:
    """The link to an FPGA, or to all of several, and that to each, which were all brought up: one with a fault stops the others."""
    if not board.link.fpga:
        link, _ = fpga_link(board, clock.now_s)
        return link, [link]
    links, _ = fpga_links(board, clock.now_s)
    open_session(links, board, clock.now_s)
    return links, links.links


def _ask(first: int, channel: int) -> None:
    tell(f"channel {first + channel} buzzes")


def _before(board: Board, number: int, link: Link, options: argparse.Namespace) -> tuple[TouchSource, Person]:
    """The touches of a board's panel, and who makes them, where the channels of one FPGA buzz."""
    if board.link.kind != "simulated":
        return open_touch(board), AtTerminal()
    from controller.workshop.gateware.actual_panel import ActualPanel, actual_panel, rewired
    from controller.workshop.gateware.simulated_link import SimulatedLink
    from controller.workshop.simulation.feeling_person import FeelingPerson

    assert isinstance(link, SimulatedLink)
    real = actual_panel(board).of(board)
    if options.swapped or options.dead:
        real = ActualPanel(actuators=rewired(real, options.swapped, options.dead)).of(real)
    person = FeelingPerson(board, link, real.fpga_boards[number])
    return LiveSource(person.panel, board), person


def _figures(board: Board, found: ChannelMap) -> dict[str, Any]:
    felt = {str(channel): at for channel, at in found.felt_at.items()}
    return {"board": board.name, "discs": found.discs, "felt_at_disc": felt, "wrong": found.wrong}


def _table(figures: dict[str, Any]) -> str:
    wrong, count = figures["wrong"], len(figures["felt_at_disc"])
    said = wrong or [f"PASS: each of {count} channels moves its own disc"]
    said = [*said, *(f"WARNING: touch panel: {fault}" for fault in figures["touch_panel"])]
    return "\n".join([*said, "Within a disc a finger cannot tell: `calibrate check` names swapped quadrants, of measurements"])
