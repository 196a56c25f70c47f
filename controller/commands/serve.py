"""`haptic-panel serve`: a simulated panel with an application socket."""

import argparse
import os
import select
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from controller.commands.common.arguments import Declare, require_within
from controller.commands.common.named_board import board_of
from controller.console import tell
from controller.errors import UsageError
from controller.programs import SHOWN_EVERY_S, end, repeat

PITCH_M = 4e-3  # of the bank: the whole plate in a second


def add(declare: Declare, _: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    command = declare(
        example="haptic-panel serve /tmp/panel.sock",
        description="Simulate a panel in real time with an application socket, to develop a user interface against. Loop, scene, "
        "bank and socket are those of a device; the FPGA is its model, and fingers move to and fro. Ctrl-C or SIGTERM ends "
        "it.",
    )
    command.add_argument("socket", metavar="SOCKET", help="path of the application socket to create")
    command.add_argument("--board", default="simulated", metavar="B", help="name, or folder with a board.toml (default: simulated)")
    command.add_argument("--commands-per-s", type=float, default=500.0, metavar="N", help="rate limit of one client (default: 500)")
    command.add_argument(
        "--touched-s", type=float, default=3600.0, metavar="S", help="for how long fingers are down (default: 3600)"
    )
    command.add_argument("--fingers", type=int, default=2, choices=range(5), metavar="N", help="that move, 0 to 4 (default: 2)")
    command.add_argument(
        "--ghosts",
        type=float,
        default=0.0,
        metavar="P",
        help="probability of a false contact during an emission (default: 0)",
    )
    command.add_argument("--replay", type=Path, metavar="FILE", help="fingers of this recording instead, from the start once")
    command.add_argument("--background", action="store_true", help="return once the panel plays; it runs until it is ended")
    command.add_argument(
        "--ready-fd",
        type=int,
        metavar="FD",
        help="write a byte to this file descriptor once the panel plays, and nothing to standard output and error from then on",
    )
    command.set_defaults(command=run)


def run(options: argparse.Namespace) -> int:
    """Build a bank of the whole plate, and play from it until a signal."""
    from threadpoolctl import threadpool_limits

    from controller.device.bank.reader import Bank
    from controller.device.board.devices import ApplicationSocket
    from controller.device.board.records import as_record
    from controller.device.touch.recordings.recording import Recording
    from controller.workshop.bank_builder.own_bank import Order
    from controller.workshop.simulation.served_panel import ghostly, moving, replayed, serve

    require_within(options, {"touched_s": (0, 1e9), "ghosts": (0, 1)})
    board = board_of(options)
    asked = {"path": options.socket, "mode": "600", "commands_per_s": options.commands_per_s, "burst": 200}
    settings = as_record("--commands-per-s: ", asked, ApplicationSocket)
    if options.background:
        return _in_background(options)
    if options.replay and options.ghosts:
        raise UsageError("--replay and --ghosts: give one of both")
    if options.ghosts:
        touched = ghostly(options.touched_s, options.fingers, options.ghosts)
    else:
        touched = replayed(Recording.open(options.replay) if options.replay else moving(options.touched_s, options.fingers))

    def ready() -> None:
        tell(f"playing; its socket is {options.socket}, and `kill {os.getpid()}` or Ctrl-C ends it")
        if options.ready_fd is not None:
            os.write(options.ready_fd, b"1")
            os.close(options.ready_fd)
            _leave_output()

    with tempfile.TemporaryDirectory() as folder, threadpool_limits(1, "blas"):
        path = Path(folder) / "whole plate.bank"
        tell(f"building a bank of the whole plate, {PITCH_M * 1e3:g} mm from cell to cell: some seconds")
        report = Order(board, PITCH_M).build(path)
        tell(f"built {report.cells:,} cells in {report.seconds:.1f} s; arming")
        started_s = time.monotonic()
        with Bank.open(path, board) as bank:
            serve(board, settings, bank, touched, ready)
    tell(f"served for {time.monotonic() - started_s:.0f} s")
    return 0


def _leave_output() -> None:
    """Let go of standard output and error: whoever reads them to their end does not wait for a panel in the background."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    for fd in (1, 2):
        os.dup2(nowhere, fd)
    os.close(nowhere)


def _in_background(options: argparse.Namespace) -> int:
    """Start this command as another process; 0 once the panel plays, else the exit code of that process.

    What it says until then is repeated, from a file: its helpers would keep a pipe of our caller open for as long as it plays.
    """
    command = [sys.executable, "-m", "controller", "serve", "--board", options.board]
    command += ["--commands-per-s", str(options.commands_per_s), "--touched-s", str(options.touched_s)]
    command += ["--fingers", str(options.fingers), "--ghosts", str(options.ghosts)]
    command += ["--replay", str(options.replay)] if options.replay else []
    read_end, write_end = os.pipe()
    with os.fdopen(read_end, "rb") as answer, tempfile.TemporaryFile() as said:
        command += ["--ready-fd", str(write_end), "--", options.socket]
        panel = subprocess.Popen(
            command, stdin=subprocess.DEVNULL, stdout=said, stderr=said, pass_fds=(write_end,), start_new_session=True
        )
        os.close(write_end)
        shown, answered = 0, False
        try:
            while not answered:
                answered = bool(select.select([answer], [], [], SHOWN_EVERY_S)[0])
                shown += repeat(said, shown)
        except BaseException:
            end(panel)
            raise
        return 0 if answer.read(1) else panel.wait()
