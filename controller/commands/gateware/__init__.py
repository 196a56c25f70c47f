"""`haptic-panel gateware`: build, describe and load bitstreams; bring up an FPGA."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from dataclasses import asdict
from functools import partial
from typing import TYPE_CHECKING, Any

import msgspec

from controller.clocks import Clock, MonotonicClock, VirtualClock
from controller.commands.common.arguments import Declare, require_within
from controller.commands.common.fpga_link import LINK_RANGES, announced_chirps, fpga_link, fpga_links
from controller.commands.common.named_board import board_of
from controller.commands.common.output import progress_bar, show
from controller.commands.common.tables import check_table
from controller.commands.gateware import build as gateware_build
from controller.commands.gateware import info as gateware_info
from controller.commands.gateware import load as gateware_load
from controller.commands.gateware import waves as gateware_waves
from controller.console import tell
from controller.device.board.board import Board
from controller.device.doctor import bring_up
from controller.device.doctor.bring_up import Chirps
from controller.device.doctor.several_fpgas import chirps_of
from controller.device.fpga import configuration
from controller.device.fpga.capture import Capture
from controller.device.fpga.links.link import Link
from controller.device.fpga.registers import IDENTITY_MAGIC, PROTOCOL_VERSION, Register
from controller.device.service.drivers import gateware_hash, open_session
from controller.errors import ConfigError

if TYPE_CHECKING:
    from controller.workshop.gateware.gateware import GatewareFactory


def add(declare: Declare, common: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    gateware = declare(
        example="haptic-panel gateware check",
        description="The gateware is what the FPGA runs: it plays the waveforms and protects the driver stages. A bitstream holds "
        "it for one FPGA board, with the limits of one panel.",
    ).add_subparsers(title="actions", metavar="ACTION", required=True)
    check = gateware.add_parser(
        "check",
        parents=[common],
        help="check identity, link, memory and every channel of an FPGA",
        description="Read what the FPGA says of itself, send random bits and count those that come back wrong, fill and read "
        "back every slot, and chirp on one channel after the other. Outputs are on during the chirps, if the permits are given.",
    )
    check.add_argument("--link", choices=["model", "rtl"], default="model", help="as for run, while the board's link is simulated")
    check.add_argument("--device", metavar="TTY", help="serial port of a real FPGA, such as /dev/ttyUSB0")
    check.add_argument("--baud", type=int, default=1_000_000, metavar="N", help="rate that its gateware was built for (1000000)")
    check.add_argument("--bits", type=float, default=1e5, metavar="N", help="random bits to send at least (default: 1e5)")
    check.add_argument(
        "--channel", type=int, action="append", metavar="Q", help="chirp on this channel only; may be given again (default: all)"
    )
    check.add_argument("--pause-s", type=float, default=0.0, metavar="S", help="silence behind each channel's chirps")
    check.set_defaults(command=gateware_check)
    for name, module, parents, text in (
        ("build", gateware_build, [common], "build a board's bitstream, and the file of figures beside it"),
        ("info", gateware_info, [], "what a bitstream is, and whether a board's bring-up would take it"),
        ("load", gateware_load, [common], "load a bitstream into the FPGA's memory; arms nothing"),
        ("waves", gateware_waves, [common], "write the signals of a run or of a script to an FST file, for a wave viewer"),
    ):
        module.add(gateware.add_parser(name, parents=parents, help=text, description=f"{text[0].upper()}{text[1:]}."))


def gateware_check(options: argparse.Namespace) -> int:
    """Check an FPGA, simulated or at a serial port: identity, link, memory and every channel."""
    require_within(options, LINK_RANGES)
    board = board_of(options)
    if options.device:
        if board.link.fpga:
            raise ConfigError("--device: a board of several FPGAs plays over SPI alone: leave it out")
        serial = msgspec.structs.replace(board.link, kind="serial", device=options.device, baud=options.baud)
        board = msgspec.structs.replace(board, link=serial)
    chirps = announced_chirps(board, _channels(options, board), options.pause_s)
    simulated = board.link.kind == "simulated"
    clock = VirtualClock() if simulated else MonotonicClock()
    factory = gateware_factory(options)[0] if simulated else None
    if not board.link.fpga:
        link, take_capture = fpga_link(board, clock.now_s, factory)
        figures = _checked(options, link, board, clock, chirps, take_capture)
        link.close()
        show(options, figures, check_table)
        complaints = figures["complaints"]
    else:
        links, captures = fpga_links(board, clock.now_s, factory)
        open_session(links, board, clock.now_s)  # all: a fault of one takes the permit from the others
        each = [
            _checked(options, link, one, clock, chirps_of(number, chirps), captures[number] if captures else None)
            for number, (link, one) in enumerate(zip(links.links, board.fpga_boards, strict=True))
        ]
        links.close()
        complaints = [f"FPGA {number}: {said}" for number, figures in enumerate(each) for said in figures["complaints"]]
        show(options, {"fpgas": each, "complaints": complaints, "good": not complaints}, _several_table)
    for complaint in complaints:
        tell(complaint)
    return 1 if complaints else 0


def _checked(
    options: argparse.Namespace,
    link: Link,
    board: Board,
    clock: Clock,
    chirps: Chirps,
    take_capture: Callable[[], Capture] | None,
) -> dict[str, Any]:
    """Figures of one FPGA, with what is wrong with it as `complaints`."""
    session = open_session(link, board, clock.now_s)
    done = bring_up.check(session, board, clock, options.bits, chirps, progress_bar("bits"), take_capture)
    expected = _expected(board)
    complaints = [
        f"{name} is {done.registers[name]}, not {value}" for name, value in expected.items() if done.registers[name] != value
    ]
    complaints += done.complaints
    return asdict(done) | {"expected": expected, "complaints": complaints, "good": not complaints}


def _several_table(figures: dict[str, Any]) -> str:
    return "\n\n".join(f"FPGA {number}\n{check_table(one)}" for number, one in enumerate(figures["fpgas"]))


def _expected(board: Board) -> dict[str, int]:
    """Values of registers after bring-up, by name: identity, the board's limits and settings, no fault."""
    built_in, settings = configuration.limits(board), configuration.settings(board)
    identity = {
        Register.IDENTITY: IDENTITY_MAGIC,
        Register.PROTOCOL: PROTOCOL_VERSION,
        Register.BUILD_HASH: gateware_hash(),
        Register.CLOCK_HZ: board.link.clock_hz,
    }
    at_rest = dict.fromkeys((Register.FAULT, Register.FAULT_CHANNELS, Register.UNDERRUNS, Register.PLAYS_MISSED, Register.QUEUE), 0)
    return {register.name.lower(): value for register, value in (identity | built_in | settings | at_rest).items()}


def _channels(options: argparse.Namespace, board: Board) -> list[int]:
    """Channels to chirp on: those of --channel, else all of the board."""
    there = [actuator.channel for actuator in board.actuators]
    for channel in options.channel or []:
        if channel not in there:
            raise ConfigError(f"--channel: board {board.name!r} has no channel {channel}")
    return sorted(options.channel or there)


def gateware_factory(options: argparse.Namespace) -> tuple[GatewareFactory, bool]:
    """Simulated gateware for --link, and whether it runs in real time."""
    if options.link != "rtl":
        from controller.workshop.gateware.model.model import GatewareModel

        return GatewareModel, getattr(options, "speed", "max") != "max"
    from controller.workshop.gateware.rtl_gateware import RtlGateware

    if getattr(options, "speed", "max") == "1":
        raise ConfigError("--link rtl is slower than real time, and the FPGA would call the host silent: use --speed max")

    def compiling() -> None:
        tell("compiling the gateware, about 10 s")

    return partial(RtlGateware, compiling=compiling), False
