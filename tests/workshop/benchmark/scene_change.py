"""For how long a change of scene holds up the loop: `python -m tests.workshop.benchmark.scene_change [--busy 6] [--regions 2000]`.

The calls of the loop are timed, at real-time priority if that is permitted, beside ordinary processes that never rest.
"""

from __future__ import annotations

import argparse
import gc
import math
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from controller.device.bank.reader import Bank
from controller.device.board.board import Board, load_board
from controller.device.board.lookup import find_board
from controller.device.service.realtime import enter_realtime
from controller.device.service.scenes.scene_reload import SceneChanger
from controller.workshop.bank_builder.build import build_bank
from controller.workshop.bank_builder.request import BankRequest

DEATHS = 5
TURN_S = 5e-3


def regions(board: Board, count: int) -> str:
    """A scene of this many rectangles."""
    columns = math.ceil(math.sqrt(count))
    x_mm, y_mm = board.plate.length_mm / columns, board.plate.width_mm / columns
    return "".join(
        f'[[regions]]\nname = "{k}"\nshape = "rectangle"\neffects = ["click"]\n'
        f"x_mm = {k % columns * x_mm:.3f}\ny_mm = {k // columns * y_mm:.3f}\n"
        f"width_mm = {0.9 * x_mm:.3f}\nheight_mm = {0.9 * y_mm:.3f}\n"
        for k in range(count)
    )


def change(changer: SceneChanger) -> tuple[float, float]:
    """The call that begins it and the longest of those that look for the answer, in ms."""
    started_s = time.perf_counter()
    changer.begin(None, 1)
    begin_s, take_s, done = time.perf_counter() - started_s, 0.0, None
    while done is None:
        time.sleep(TURN_S)
        started_s = time.perf_counter()
        done = changer.take()
        take_s = max(take_s, time.perf_counter() - started_s)
    if done.scene is None:
        raise SystemExit(done.reason)
    return begin_s * 1e3, take_s * 1e3


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--busy", type=int, default=6, help="processes that never rest")
    parser.add_argument("--regions", type=int, help="of the scene; else it is the board's own")
    parser.add_argument("--changes", type=int, default=40, help="of scene")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        shutil.copytree(find_board("simulated"), folder, dirs_exist_ok=True)
        board = load_board(Path(folder))
        scene = Path(folder) / board.scene
        if options.regions:
            scene.write_text(regions(board, options.regions))
        build_bank(BankRequest(board, Path(folder) / "plate.bank", 5e-3))
        with Bank.open(Path(folder) / "plate.bank", board) as bank:
            changer = SceneChanger(board, str(scene), bank)
            busy = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(options.busy)]
            for warning in enter_realtime(board.realtime):
                print(warning, file=sys.stderr)
            gc.collect()
            gc.disable()
            try:
                times = [change(changer) for _ in range(options.changes)]
                deaths = []
                for _ in range(DEATHS):
                    os.kill(changer.helper.process.pid, signal.SIGKILL)
                    os.waitid(os.P_PID, changer.helper.process.pid, os.WEXITED | os.WNOWAIT)
                    deaths.append(change(changer))
            finally:
                for process in busy:
                    process.kill()
                    process.wait()
            changer.close()
    for name, each in (
        ("begin", [t[0] for t in times]),
        ("take", [t[1] for t in times]),
        ("begin, helper dead", [t[0] for t in deaths]),
    ):
        print(f"{name}: median {sorted(each)[len(each) // 2]:.2f} ms, worst {max(each):.2f} ms of {len(each)}")


if __name__ == "__main__":
    main()
