"""A simulated panel in real time with an application socket, to develop a user interface against.

    python -m controller.offline.served_panel /tmp/panel.sock

Everything but the FPGA and the touch panel is what runs on the device: loop, scene, bank, socket, scheduling. The
FPGA is its model; two fingers go to and fro for ever. It ends with SIGTERM or Ctrl-C.
"""

from __future__ import annotations

import argparse
import math
import sys
import tempfile
import time
from pathlib import Path

import msgspec
from threadpoolctl import threadpool_limits

from controller.application_socket.command_socket import CommandSocket
from controller.assembly import assemble
from controller.bank.reader import Bank
from controller.board import Board, find_board, load_board
from controller.clocks import MonotonicClock
from controller.device_settings import ApplicationSocket
from controller.errors import ControllerError
from controller.hardware import open_session, open_simulated, tracked
from controller.housekeeping import Housekeeping
from controller.offline.bank_builder import build_bank
from controller.prepare_scene import populate
from controller.scene import load_scene
from controller.scene_change import SceneChanger
from controller.scene_file import find_scene
from controller.service import Notifier, Watchdog, enter_realtime, tell
from controller.touch.recording import Recording
from controller.touch.replay import RecordingSource

PITCH_M = 5e-3  # of the bank: the whole plate in a second
REPORT_S = 1 / 60
FINGERS_MM = ((60.0, 50.0), (150.0, 95.0))  # where they go to and fro
SWING_MM, SWING_S = 20.0, 4.0
AXES = "A: 2f 0 9 0 0 0\nA: 35 0 2100 0 0 0\nA: 36 0 1480 0 0 0\nA: 39 0 65535 0 0 0\n"  # tenths of a millimetre on the plate
DRAIN_S = 1.0  # what the simulated pins did is forgotten this often


def serve(board: Board, settings: ApplicationSocket, bank: Bank, touched_s: float) -> None:
    """Run the simulated panel until a signal comes.

    Parameters
    ----------
    settings : ApplicationSocket
        Of the socket, in place of the board's.
    touched_s : float
        For how long the two fingers are down.
    """
    clock = MonotonicClock()
    scene = load_scene(find_scene(board), board)
    populate(bank, scene, board.scene)
    recording = Recording(_to_and_fro(touched_s), "two fingers to and fro")
    commands = CommandSocket(board, settings)
    link = open_simulated(board, clock.now_s)
    session = open_session(link, board, clock.now_s)
    source = tracked(RecordingSource(recording, recording.axes(board), clock.now_s() + 0.2), board)
    change = SceneChanger(board, board.scene, bank)
    for warning in enter_realtime(board.realtime):
        tell(warning)
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
        assembly = assemble(board, scene, bank, clock, session, source, commands=commands, change=change, progress=progress)
        housekeeping.watch(assembly.loop, assembly.counters, None, commands.changed)
        assembly.loop.run()
    finally:
        change.close()
        commands.close()
        link.close()


def _to_and_fro(seconds: float) -> str:
    """Recording of two fingers that stay down."""
    lines = [AXES]
    for number in range(math.ceil(seconds / REPORT_S)):
        at_s = number * REPORT_S
        swing_mm = SWING_MM * math.sin(2 * math.pi * at_s / SWING_S)
        for slot, (x_mm, y_mm) in enumerate(FINGERS_MM):
            events = [(0x2F, slot), *([(0x39, slot)] if number == 0 else []), (0x35, 10 * (x_mm + swing_mm)), (0x36, 10 * y_mm)]
            lines += [f"E: {at_s:.6f} 0003 {code:04x} {round(value):04d}\n" for code, value in events]
        lines.append(f"E: {at_s:.6f} 0000 0000 0000\n")
    return "".join(lines)


def main(arguments: list[str] | None = None) -> int:
    """Command line."""
    parser = argparse.ArgumentParser(prog="python -m controller.offline.served_panel", description=__doc__)
    parser.add_argument("socket", metavar="SOCKET", help="where to make the application socket")
    parser.add_argument("--board", default="simulated", metavar="B", help="name, or folder with a board.toml (default: simulated)")
    parser.add_argument("--commands-per-s", type=float, default=500.0, metavar="N", help="that one client may send (default: 500)")
    parser.add_argument("--touched-s", type=float, default=3600.0, metavar="S", help="for how long the fingers are down")
    options = parser.parse_args(arguments)
    try:
        board = load_board(find_board(options.board))
        settings = msgspec.convert(
            {"path": options.socket, "mode": "600", "commands_per_s": options.commands_per_s, "burst": 200}, ApplicationSocket
        )
        with tempfile.TemporaryDirectory() as folder, threadpool_limits(1, "blas"):
            path = Path(folder) / "whole plate.bank"
            build_bank(board, path, PITCH_M, measure_sgemm=False)
            started_s = time.monotonic()
            with Bank.open(path, board) as bank:
                serve(board, settings, bank, options.touched_s)
        sys.stderr.write(f"served for {time.monotonic() - started_s:.0f} s\n")
    except ControllerError as error:
        sys.stderr.write(f"error: {error}\n")
        return error.exit_code
    except msgspec.ValidationError as error:
        sys.stderr.write(f"error: --commands-per-s {options.commands_per_s:g}: {error}\n")
        return 2
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
