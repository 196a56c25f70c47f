"""A loop with several fingers, over a warm-up and a steady part; what the steady part allocated, as JSON.

Run under `counter.c`, or under strace, to which two calls of `access` show where the steady part begins and ends.
"""

from __future__ import annotations

import ctypes
import json
import os
import sys
from pathlib import Path

from controller.clocks import VirtualClock
from controller.device.bank.reader import Bank
from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.device.loop.context import LoopContext, Watch
from controller.device.loop.wiring import assemble
from controller.device.scene.scene import load_scene
from controller.device.service.drivers import open_session, tracked
from controller.device.touch.live_source import LiveSource
from tests.workshop.benchmark.looped_panel import LoopedPanel
from tests.workshop.benchmark.null_link import NullLink

HERE = Path(__file__).parent
RECORDINGS = sorted((HERE.parent / "touch/recordings").glob("*.ev*"))


def main(bank_path: Path, scene_file: Path, warm_up: int, steady: int, spoilt: bool) -> dict[str, object]:
    board = load_board(find_board("simulated"))
    scene = load_scene(scene_file, board)
    clock = VirtualClock()
    link = NullLink(board, clock.now_s)
    session = open_session(link, board, clock.now_s)
    panel = LoopedPanel([board.folder / "demo.evemu", *RECORDINGS], clock.now_s() + 0.1)
    counter = ctypes.CDLL(None)
    counts = hasattr(counter, "counting_begin")
    figures: dict[str, object] = {}

    def progress(_: float) -> None:
        emissions = counters.emissions
        if emissions >= warm_up and "blocks" not in figures:
            figures["from"] = emissions
            figures["blocks"] = sys.getallocatedblocks()
            os.access("/steady/begin", os.F_OK)
            if counts:
                counter.counting_begin()
        elif spoilt and emissions >= warm_up:
            bytes(600)
        if emissions >= warm_up + steady and not panel.stopped:
            if counts:
                counter.counting_end()
            os.access("/steady/end", os.F_OK)
            figures["blocks"] = sys.getallocatedblocks() - int(str(figures["blocks"]))
            figures["emissions"] = emissions - int(str(figures["from"]))
            panel.stopped = True

    source = tracked(LiveSource(panel, board), board)
    with Bank.open(bank_path, board) as bank:
        assembly = assemble(LoopContext(board, clock, session, source), scene, bank, watch=Watch(progress))
        counters = assembly.counters
        assembly.selection.prepare()
        assembly.loop.run(link.answer_alone)
    figures["most_fingers"] = source.counts.max_fingers
    if counts:
        large = counter.counted_large()
        figures["large"] = large
        figures["sizes"] = [counter.counted_size(index) for index in range(min(large, 32))]
        figures["growth_bytes"] = counter.counted_growth_bytes()
    return figures


if __name__ == "__main__":
    print(json.dumps(main(Path(sys.argv[1]), Path(sys.argv[2]), int(sys.argv[3]), int(sys.argv[4]), "spoilt" in sys.argv[5:])))
