"""A simulated panel in real time with an application socket, to develop a user interface against.

    python -m controller.simulation.served_panel /tmp/panel.sock

Loop, scene, bank, socket and scheduling are those of the device. The FPGA is its model; two fingers move back and forth.
SIGTERM or Ctrl-C ends it. With --background the command returns once the panel plays, and the panel keeps running.
"""

from __future__ import annotations

import argparse
import math
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from pathlib import Path

from threadpoolctl import threadpool_limits

from controller.application_socket.command_socket import CommandSocket
from controller.bank.reader import Bank
from controller.bank_builder.build import build_bank
from controller.board.board import Board, load_board
from controller.board.devices import ApplicationSocket
from controller.board.lookup import find_board
from controller.board.records import as_record
from controller.clocks import MonotonicClock
from controller.console import program, tell
from controller.log import Priority, log
from controller.loop.wiring import assemble
from controller.scene.scene import load_scene
from controller.scene.scene_file import find_scene
from controller.service.drivers import open_session, open_simulated, tracked
from controller.service.housekeeping import Housekeeping
from controller.service.prepare_scene import populate
from controller.service.realtime import enter_realtime
from controller.service.scene_reload import SceneChanger
from controller.service.systemd import Notifier, Watchdog
from controller.touch.recording import Recording
from controller.touch.replay import RecordingSource

PITCH_M = 4e-3  # of the bank: the whole plate in a second
REPORT_S = 1 / 60
FINGERS_MM = ((60.0, 50.0), (150.0, 95.0))  # centres of their movement
SWING_MM, SWING_S = 20.0, 4.0
AXES = "A: 2f 0 9 0 0 0\nA: 35 0 2100 0 0 0\nA: 36 0 1480 0 0 0\nA: 39 0 65535 0 0 0\n"  # tenths of a millimetre on the plate
DRAIN_S = 1.0  # interval at which the captured pins are discarded


def serve(board: Board, settings: ApplicationSocket, bank: Bank, touched_s: float, ready: Callable[[], None]) -> None:
    """Run the simulated panel until SIGTERM or SIGINT.

    Parameters
    ----------
    board : Board
    settings : ApplicationSocket
        Settings of the socket, instead of the board's.
    bank : Bank
        Bank of the whole plate.
    touched_s : float
        How long the two fingers are down.
    ready : callable
        Called once the outputs are on.

    Raises
    ------
    ControllerError
        If scene or socket cannot be opened, or from the event loop.
    """
    clock = MonotonicClock()
    scene = load_scene(find_scene(board), board)
    populate(bank, scene, board.scene)
    recording = Recording(_back_and_forth(touched_s), "two fingers that move back and forth")
    commands = CommandSocket(board, settings)
    link = open_simulated(board, clock.now_s)
    session = open_session(link, board, clock.now_s)
    source = tracked(RecordingSource(recording, recording.axes(board), clock.now_s() + 0.2), board)
    change = SceneChanger(board, board.scene, bank)
    for warning in enter_realtime(board.realtime):
        log(warning, Priority.WARNING)
    drain_s = clock.now_s()

    def progress(now_s: float) -> None:
        nonlocal drain_s
        housekeeping.progress(now_s)
        if now_s >= drain_s:
            drain_s = now_s + DRAIN_S
            link.take_capture()

    notifier = Notifier("")
    housekeeping = Housekeeping(board, session, notifier, Watchdog(notifier, math.inf), None)
    try:
        assembly = assemble(
            board,
            scene,
            bank,
            clock,
            session,
            source,
            commands=commands,
            change=change,
            progress=progress,
            emission_started=housekeeping.emission_started,
            scene_changed=housekeeping.scene_changed,
        )
        housekeeping.watch(assembly.loop, None, [commands.changed])
        assembly.loop.run(ready)
    finally:
        change.close()
        commands.close()
        link.close()


def _back_and_forth(seconds: float) -> str:
    """Recording of two fingers that stay down and move back and forth."""
    lines = [AXES]
    for number in range(math.ceil(seconds / REPORT_S)):
        at_s = number * REPORT_S
        swing_mm = SWING_MM * math.sin(2 * math.pi * at_s / SWING_S)
        for slot, (x_mm, y_mm) in enumerate(FINGERS_MM):
            events = [(0x2F, slot), *([(0x39, slot)] if number == 0 else []), (0x35, 10 * (x_mm + swing_mm)), (0x36, 10 * y_mm)]
            lines += [f"E: {at_s:.6f} 0003 {code:04x} {round(value):04d}\n" for code, value in events]
        lines.append(f"E: {at_s:.6f} 0000 0000 0000\n")
    return "".join(lines)


@program
def main(arguments: list[str] | None = None) -> int:
    """Run from the command line (`sys.argv` by default); the exit code."""
    parser = argparse.ArgumentParser(prog="python -m controller.simulation.served_panel", description=__doc__)
    parser.add_argument("socket", metavar="SOCKET", help="path of the application socket to create")
    parser.add_argument("--board", default="simulated", metavar="B", help="name, or folder with a board.toml (default: simulated)")
    parser.add_argument("--commands-per-s", type=float, default=500.0, metavar="N", help="rate limit of one client (default: 500)")
    parser.add_argument("--touched-s", type=float, default=3600.0, metavar="S", help="how long the fingers are down")
    parser.add_argument("--background", action="store_true", help="return once the panel plays; it keeps running until it is ended")
    parser.add_argument("--ready-fd", type=int, help=argparse.SUPPRESS)
    options = parser.parse_args(arguments)
    if options.background:
        return _in_background(sys.argv[1:] if arguments is None else arguments)

    def ready() -> None:
        tell(f"playing; its socket is {options.socket}, and `kill {os.getpid()}` or Ctrl-C ends it")
        if options.ready_fd is not None:
            os.write(options.ready_fd, b"1")
            os.close(options.ready_fd)

    board = load_board(find_board(options.board))
    asked = {"path": options.socket, "mode": "600", "commands_per_s": options.commands_per_s, "burst": 200}
    settings = as_record("--commands-per-s: ", asked, ApplicationSocket)
    with tempfile.TemporaryDirectory() as folder, threadpool_limits(1, "blas"):
        path = Path(folder) / "whole plate.bank"
        tell(f"building a bank of the whole plate, {PITCH_M * 1e3:g} mm from cell to cell: some seconds")
        report = build_bank(board, path, PITCH_M, progress=True, measure_sgemm=False)
        tell(f"built {report.cells:,} cells in {report.seconds:.1f} s; arming")
        started_s = time.monotonic()
        with Bank.open(path, board) as bank:
            serve(board, settings, bank, options.touched_s, ready)
    tell(f"served for {time.monotonic() - started_s:.0f} s")
    return 0


def _in_background(arguments: Sequence[str]) -> int:
    """Start this module as another process; 0 once the panel plays, else the exit code of that process."""
    own = [argument for argument in arguments if argument != "--background"]
    read_end, write_end = os.pipe()
    with os.fdopen(read_end, "rb") as answer:
        command = [sys.executable, "-m", "controller.simulation.served_panel", *own, "--ready-fd", str(write_end)]
        panel = subprocess.Popen(command, stdin=subprocess.DEVNULL, pass_fds=(write_end,), start_new_session=True)
        os.close(write_end)
        playing = answer.read(1)
    return 0 if playing else panel.wait()


if __name__ == "__main__":
    raise SystemExit(main())
