"""`haptic-panel doctor`: check every device, file and permission of a panel, and say what to do."""

import argparse
from contextlib import closing
from dataclasses import asdict
from functools import partial
from typing import Any

from controller.clocks import Clock, MonotonicClock, VirtualClock
from controller.commands.common.arguments import Declare, require_within
from controller.commands.common.fpga_link import LINK_RANGES, announced_chirps, fpga_link, fpga_links, touch_panel_of
from controller.commands.common.output import progress_bar, show
from controller.device.board.board import Board, load_board
from controller.device.board.lookup import find_board, own_board
from controller.device.doctor.doctor import look
from controller.device.doctor.finding import Finding
from controller.device.doctor.link_examination import LinkExamined, examine_link
from controller.device.doctor.several_fpgas import examine_links
from controller.device.doctor.way import WayStep, in_lines, way
from controller.device.service.drivers import open_session
from controller.device.service.installation import is_installed
from controller.errors import ControllerError

BITS = 1e6


def add(declare: Declare, common: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    doctor = declare(
        example="haptic-panel doctor --board panel --link",
        parents=[common],
        description="Check every device, file and permission that the board needs, and releases and updates of this device. With "
        "--link, also send random bits to the FPGA at several speeds, propose one, fill its memory and chirp on each channel: "
        "outputs are on meanwhile, if the permits are given. End the service first. Without --board: `panel`, which the service "
        "runs, if this device has it. Exit code 1 if anything is wrong.",
    )
    doctor.add_argument("--link", action="store_true", help="examine the link to the FPGA and what is behind it")
    doctor.add_argument("--bits", type=float, default=BITS, metavar="N", help="random bits to send at least (default: 1e6)")
    how = doctor.add_mutually_exclusive_group()
    how.add_argument("--no-chirps", action="store_true", help="leave the outputs off")
    how.add_argument("--pause-s", type=float, default=0.0, metavar="S", help="silence after each channel's chirps, to listen")
    doctor.set_defaults(command=examine, board=None)


def examine(options: argparse.Namespace) -> int:
    """Check the panel, with --link also the link to its FPGA; returns 1 if anything is wrong."""
    require_within(options, LINK_RANGES)
    board = load_board(find_board(options.board or own_board()))
    real = MonotonicClock()
    findings = look(board, real.now_s, touch_panel_of(board)) + _releases()
    figures: dict[str, Any] = {}
    if options.link:
        try:
            examined = _link(options, board, VirtualClock() if board.link.kind == "simulated" else real)
        except ControllerError as error:
            examined = LinkExamined([Finding("link", False, str(error))], {})
        findings += examined.findings
        figures = examined.figures
    good = all(finding.good for finding in findings)
    steps = [] if board.link.kind == "simulated" and not board.link.device else [step._asdict() for step in way(board, findings)]
    said = [asdict(finding) for finding in findings]
    show(options, {"board": board.name, "good": good, "findings": said, **figures, "way": steps}, _table)
    return 0 if good else 1


def _link(options: argparse.Namespace, board: Board, clock: Clock) -> LinkExamined:
    """The link examined, or those of several FPGAs; raises ControllerError if it cannot be opened."""
    channels = [] if options.no_chirps else sorted(actuator.channel for actuator in board.actuators)
    chirps = announced_chirps(board, channels, options.pause_s)
    progress = progress_bar("link") if not options.json else lambda *_: None
    if not board.link.fpga:
        link, take_capture = fpga_link(board, clock.now_s)
        with closing(link):
            opened = partial(open_session, link, board, clock.now_s)
            return examine_link(board, link, opened, clock, options.bits, chirps, progress, take_capture)
    links, captures = fpga_links(board, clock.now_s)
    with closing(links):
        return examine_links(
            board,
            links,
            lambda link, one: open_session(link, one, clock.now_s),
            clock,
            options.bits,
            chirps,
            progress,
            captures,
        )


def _releases() -> list[Finding]:
    """Findings on releases and updates of this device; none without the room that has them."""
    if not is_installed("device.update"):
        return []
    from controller.device.doctor.update_examination import look_at_updates
    from controller.device.update.layout import Layout

    return look_at_updates(Layout.from_environment())


def _table(figures: dict[str, Any]) -> str:
    width = max(24, *(len(finding["about"]) + 2 for finding in figures["findings"]))
    lines = [f"{_verdict(finding):<8}{finding['about']:<{width}}{finding['said']}" for finding in figures["findings"]]
    for number, link in enumerate(figures.get("fpgas", (figures,))):
        of = f"FPGA {number}: " if "fpgas" in figures else ""
        for speed in link.get("sweep", ()):
            said = speed["trouble"] or f"{speed['errors']} errors in {speed['bits']:,} bits"
            lines.append(f"{'':<8}{speed['sck_hz'] / 1e6:>8.4g} MHz            {of}{said}")
        if "sck_measured_hz" in link:
            unknown = "; SCK could not be measured" if link["sck_measured_hz"] is None else ""
            lines.append(f"{'':<8}{of}{link['effective_hz'] / 1e6:.3g} Mbit/s with pauses and kernel{unknown}")
    if any(step["done"] is False for step in figures["way"]):
        lines += [
            "",
            "the way of a new panel ([?]: not to be seen from here):",
            *in_lines(WayStep(**step) for step in figures["way"]),
        ]
    return "\n".join(lines)


def _verdict(finding: dict[str, Any]) -> str:
    return "NOT OK" if not finding["good"] else "WARNING" if finding["warns"] else "ok"
