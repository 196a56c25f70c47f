"""Runs on both kinds of machine: prints digests of a bank built there, and of words composed there, which have to be the same.

usage: same_bytes.py FOLDER
"""

import hashlib
import sys
from pathlib import Path

import numpy as np

from controller.device import kernel
from controller.device.bank.reader import Bank
from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.device.waveforms.selection import Selection
from controller.workshop.bank_builder.build import build_bank
from controller.workshop.bank_builder.request import BankRequest

PITCH_M = 20e-3
POINTS = 40


def main(folder):
    board = load_board(find_board("ulx3s"))
    path = Path(folder) / "panel.bank"
    build_bank(BankRequest(board, path, PITCH_M))
    print("bank", hashlib.sha256(path.read_bytes()).hexdigest())
    words = hashlib.sha256()
    random = np.random.default_rng(11)
    with Bank.open(path, board) as bank:
        selection = Selection(bank, board.bank.snap_mm * 1e-3, board.idle_word)
        for number in range(POINTS):
            fingers = 1 + number % 10
            x_m, y_m = random.uniform(0.02, 0.19, fingers), random.uniform(0.02, 0.12, fingers)
            amplitudes = random.uniform(0.25, 1.0, fingers) if number % 2 else np.ones(fingers)
            points = [(float(x), float(y), float(a)) for x, y, a in zip(x_m, y_m, amplitudes, strict=True)]
            key = selection.key(points)
            words.update(bank.drive.words(key) if isinstance(key, int) else selection.waveform(key))
    print("words", words.hexdigest())
    print("kernel", "compiled" if kernel.COMPILED else "numpy", file=sys.stderr)


main(sys.argv[1])
