"""`haptic-panel gateware load`: a bitstream into each FPGA, by the program that board.toml names."""

import argparse
import contextlib
import fcntl
import os
import shlex
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path

from controller.commands.common.named_board import add_fpga, board_of, with_one_fpga
from controller.commands.common.output import show
from controller.console import tell
from controller.device.board.board import Board
from controller.device.fpga.bitstreams.bitstream import differences, read_identity
from controller.device.fpga.bitstreams.loader import ATTEMPTS
from controller.device.service.drivers import bitstream_path, gateware_hash
from controller.errors import ConfigError, GatewareError, LinkError, UsageError
from controller.programs import CannotStart, ProgramError, run_program

TO_MEMORY, TO_FLASH = "--write-sram", "--write-flash"  # of openFPGALoader
FLASH_S = 600.0  # that writing the flash may take
PACKAGES = {"openFPGALoader": "openfpgaloader"}  # Debian's, by program


def add(step: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    step.add_argument("file", nargs="?", metavar="FILE", help="the bitstream (default: gateware.bitstream of the board)")
    add_fpga(step, all_by_default=True)
    step.add_argument("--flash", action="store_true", help="write the flash, where a lost supply goes back to, not the memory")
    step.set_defaults(command=gateware_load)


def gateware_load(options: argparse.Namespace) -> int:
    """Load bitstreams that the board's bring-up would take, while nothing else uses the board; the link stays silent.

    All FPGAs are loaded, one after the other, unless one is asked for; and none, unless what is for each would be taken.
    """
    board = board_of(options)
    boards = board.fpga_boards if options.fpga is None else (with_one_fpga(board, options.fpga),)
    if options.file and len(boards) > 1:
        raise UsageError(f"{options.file}: for which FPGA? give --fpga N, from 0 to {len(boards) - 1}")
    files = [Path(options.file) if options.file else bitstream_path(one) for one in boards]
    steps = [_step(one, file, options) for one, file in zip(boards, files, strict=True)]
    for step in steps:
        step()
    loaded = [{"file": str(file), "flash": options.flash} for file in files]
    figures = {**loaded[0], **({"fpgas": loaded} if len(loaded) > 1 else {})}
    show(options, figures, lambda _: "\n".join(f"{file}: loaded" for file in files))
    return 0


def _step(board: Board, file: Path, options: argparse.Namespace) -> Callable[[], None]:
    """What loads the one FPGA of a board with a file; raises ConfigError if nothing does, or the bring-up would not take it."""
    has_flash = board.link.kind == "simulated" and board.link.device  # a simulated panel that is another than board.toml says
    command = [] if has_flash else _command(board, flash=options.flash)
    if not file.is_file():
        raise ConfigError(f"{file}: there is no such bitstream: haptic-panel gateware build --board {options.board} --out {file}")
    if complaints := differences(read_identity(file), board, gateware_hash()):
        raise ConfigError(f"{file}: bring-up would refuse it: {'; '.join(complaints)}")
    if command:
        return partial(_run, board, [word.replace("{bitstream}", str(file)) for word in command], flash=options.flash)
    from controller.workshop.gateware.actual_panel import load_flash

    return partial(load_flash, board, file)


def _command(board: Board, *, flash: bool) -> list[str]:
    """What loads the FPGA of a board; raises ConfigError if it does not say."""
    if board.gateware is None:
        raise ConfigError(f"board {board.name!r} does not say how its FPGA is loaded: give it a table [gateware]")
    command = list(board.gateware.load)
    if flash:
        if TO_MEMORY not in command:
            raise ConfigError(f"board {board.name!r}: --flash: gateware.load has no {TO_MEMORY} that {TO_FLASH} could replace")
        command[command.index(TO_MEMORY)] = TO_FLASH
    return command


def _run(board: Board, command: list[str], *, flash: bool) -> None:
    """Load the FPGA by a program."""
    assert board.gateware is not None
    with _nobody_else(board):
        tell(f"{shlex.join(command)}")
        package = PACKAGES.get(command[0], "")
        try:
            run_program(command, FLASH_S if flash else board.gateware.limit_s, attempts=ATTEMPTS, package=package, shown=True)
        except CannotStart as error:
            raise ConfigError(str(error) if package else f"{error}: gateware.load of board.toml names it") from error
        except ProgramError as error:
            raise GatewareError(f"{error}: is its USB plugged in?") from error


@contextlib.contextmanager
def _nobody_else(board: Board) -> Iterator[None]:
    """Keep every other program from the link, where this computer has it: none may have the outputs on meanwhile."""
    if not Path(board.link.device).exists():
        yield
        return
    device = os.open(board.link.device, os.O_RDWR | os.O_NONBLOCK | os.O_NOCTTY)
    try:
        fcntl.flock(device, fcntl.LOCK_EX | fcntl.LOCK_NB)
        yield
    except BlockingIOError as error:
        raise LinkError(f"{board.link.device} is in use by another program: systemctl stop haptic-panel") from error
    finally:
        os.close(device)
