"""Composes scene after scene; prints how many blocks over 512 bytes that took, and the largest. Run by test_allocations.py."""

import ctypes
import json
import sys
from pathlib import Path

import numpy as np

from controller.device.bank.reader import Bank
from controller.device.waveforms.selection import Selection

ROUNDS = 10

counter = ctypes.CDLL(sys.argv[1])
random = np.random.default_rng(0)


def scene(count, amplitude):
    places = random.uniform([5e-3, 6e-3], [25e-3, 23e-3], (count, 2)).tolist()
    return [(x_m, y_m, amplitude or random.uniform(0.25, 1)) for x_m, y_m in places]


def play(selection, points):
    key = selection.key(points)
    selection.waveform(key)
    selection.reusable(key, 7)


scenes = [scene(count, amplitude) for _ in range(ROUNDS) for count in (1, 2, 4, 10) for amplitude in (1.0, 0.5, None)]
with Bank.open(Path(sys.argv[2])) as bank:
    selection = Selection(bank, 1e-3, 0x69969669)
    warm_up, counted = scenes[:12], scenes[12:]
    for points in warm_up:
        play(selection, points)
    counter.begin()
    for points in counted:
        play(selection, points)
    composing = counter.end(), counter.worst()
bits = np.ones(32000, bool)
counter.begin()
np.packbits(bits)
print(json.dumps({"composing": composing, "packbits": (counter.end(), counter.worst())}))
