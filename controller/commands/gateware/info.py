"""`haptic-panel gateware info`: what a bitstream is, and whether a board's bring-up would take it."""

import argparse
from pathlib import Path
from typing import Any

import msgspec

from controller.commands.common.named_board import add_fpga, with_one_fpga
from controller.commands.common.output import show
from controller.console import tell
from controller.device.board.board import Board, load_board
from controller.device.board.lookup import find_board
from controller.device.fpga.bitstreams.bitstream import Identity, differences, read_figures, read_identity, sha256_of
from controller.device.fpga.build_parameters import top_parameters
from controller.device.service.drivers import gateware_hash
from controller.errors import ConfigError


def add(step: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    step.add_argument("file", metavar="FILE", help="the bitstream")
    step.add_argument("--board", metavar="B", help="board that it is compared with (default: the one that it was built for)")
    add_fpga(step)
    step.add_argument("--json", action="store_true", help="print one JSON object and nothing else on stdout")
    step.set_defaults(command=gateware_info)


def gateware_info(options: argparse.Namespace) -> int:
    """Print what a bitstream says of itself; 1 if the board would refuse it, or if it is not whole."""
    file = Path(options.file)
    identity, figures = read_identity(file), read_figures(file)
    found = _board_to_compare(options.board, identity)
    board = None if found is None else with_one_fpga(found, options.fpga)
    complaints = [] if board is None else differences(identity, board, gateware_hash())
    shown = ("clock_mhz", "fmax_mhz", "longest_path", "miso_ns")
    reported = {
        "file": str(file),
        "bytes": file.stat().st_size,
        "sha256": sha256_of(file),
        "identity": msgspec.to_builtins(identity),
        "board": None if board is None else {"name": board.name, "parameters": top_parameters(board, gateware_hash())},
        "figures": None if figures is None else {name: getattr(figures, name) for name in shown},
        "complaints": complaints,
    }
    show(options, reported, _table)
    if board is None:
        tell(f"this computer has no board {identity.board!r}: --board compares it with another")
    for complaint in complaints:
        tell(f"{file}: {complaint}")
    return 1 if complaints else 0


def _board_to_compare(named: str | None, identity: Identity) -> Board | None:
    """The board that was named; else that of the bitstream, None if this computer does not have it."""
    if named:
        return load_board(find_board(named))
    try:
        folder = find_board(identity.board)
    except ConfigError:
        return None
    return load_board(folder)


def _table(reported: dict[str, Any]) -> str:
    identity, figures = reported["identity"], reported["figures"]
    board = reported["board"] or {"name": "", "parameters": identity["parameters"]}
    tools = ", ".join(f"{name} {version}" for name, version in identity["tools"].items())
    lines = [
        f"{reported['file']}: {reported['bytes']:,} bytes, SHA-256 {reported['sha256']}",
        f"{identity['top']}/top.v for {identity['device']}, limits of board {identity['board']}, seed {identity['seed']}",
        f"by {tools}, of sources {identity['sources']}",
    ]
    if figures:
        miso = "" if figures["miso_ns"] is None else f"; MISO {figures['miso_ns']} ns behind the fall of SCK"
        lines.append(f"{figures['fmax_mhz']} MHz of {figures['clock_mhz']:g}; longest path: {figures['longest_path']}{miso}")
    lines += ["", f"{'built in':<22}{'this file':>12}{board['name']:>22}"]
    for name, value in sorted(identity["parameters"].items()):
        wanted = board["parameters"].get(name)
        shown = [f"0x{number:08X}" if name in {"BUILD_HASH", "CHANNEL_MASK_MAX"} else number for number in (value, wanted or 0)]
        compared = f"{shown[1]:>22}{'' if value == wanted else '  differs'}" if reported["board"] else ""
        lines.append(f"{name:<22}{shown[0]:>12}{compared}")
    return "\n".join(lines)
