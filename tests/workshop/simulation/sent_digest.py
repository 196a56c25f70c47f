"""Prints what a simulated panel receives for a recording: run by test_same_bytes.py with one kernel or the other.

With a number as its last argument, the host's clocks jump at random, to and fro.
"""

import hashlib
import itertools
import random
import sys
import time
from pathlib import Path

from controller.device import kernel
from controller.device.bank.reader import Bank
from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.device.scene.scene import load_scene
from controller.device.scene.scene_file import find_scene
from controller.device.touch.recordings.recording import Recording
from controller.workshop.gateware.model.model import GatewareModel
from controller.workshop.simulation.simulated_run import Hardware, play


class Listener:
    """The gateware, with all that it receives digested."""

    def __init__(self, gateware, digest):
        self._gateware, self._digest = gateware, digest

    def __getattr__(self, name):
        return getattr(self._gateware, name)

    def exchange(self, select_tick, release_tick, mosi, miso):
        self._digest.update(f"{select_tick} {release_tick} ".encode() + bytes(mosi))
        self._gateware.exchange(select_tick, release_tick, mosi, miso)

    def trigger(self, tick, *high_ticks):
        self._digest.update(f"trigger {tick} {high_ticks} ".encode())
        self._gateware.trigger(tick, *high_ticks)


def confuse_clocks(seed):
    steps = random.Random(seed).choices([0, 1, 10**3, 10**6, 10**9, 10**12, -(10**7)], k=10_000)
    said = itertools.accumulate(itertools.cycle(steps))
    time.perf_counter_ns = time.monotonic_ns = lambda: next(said)
    time.perf_counter = time.monotonic = time.time = lambda: next(said) * 1e-9


def main():
    bank_file, recording, *seed = sys.argv[1:]
    if seed:
        confuse_clocks(int(seed[0]))
    board = load_board(find_board("simulated"))
    digest = hashlib.sha256()
    with Bank.open(Path(bank_file), board) as bank:
        scene = load_scene(find_scene(board, "library"), board)
        source = Recording.open(Path(recording))
        done = play(
            board, scene, bank, source, real_time=False, hardware=Hardware(lambda *given: Listener(GatewareModel(*given), digest))
        )
    skipped = done.counters.skipped.compositions
    print(kernel.COMPILED, digest.hexdigest(), done.counters.uploads, done.counters.uploads - skipped)


main()
