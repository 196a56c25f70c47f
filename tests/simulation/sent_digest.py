"""Prints what a simulated panel receives for a recording: run by test_same_bytes.py with one kernel or the other."""

import hashlib
import sys
from pathlib import Path

from controller import kernel
from controller.bank.reader import Bank
from controller.board.board import load_board
from controller.board.lookup import find_board
from controller.gateware_model.model import GatewareModel
from controller.scene.scene import load_scene
from controller.scene.scene_file import find_scene
from controller.simulation.simulated_run import play
from controller.touch.recording import Recording


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


def main():
    bank_file, recording = sys.argv[1:]
    board = load_board(find_board("simulated"))
    digest = hashlib.sha256()
    with Bank.open(Path(bank_file), board) as bank:
        scene = load_scene(find_scene(board, "library"), board)
        source = Recording.open(Path(recording))
        done = play(board, scene, bank, source, real_time=False, gateware=lambda *told: Listener(GatewareModel(*told), digest))
    skipped = done.counters.skipped.compositions
    print(kernel.COMPILED, digest.hexdigest(), done.counters.uploads, done.counters.uploads - skipped)


main()
