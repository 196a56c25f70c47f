"""A panel into which emissions couple, its events decoded by the product's own decoder.

Every emission may make a ghost: at a random place, from the first scan that the emission disturbs, for some reports.
"""

import random
from collections import Counter
from itertools import count

from controller.board import data_folder, load_board
from controller.touch.axes import Axes, AxisRange
from controller.touch.decoder import Decoder
from controller.touch.panel import Protocol

PERIOD_S = 7e-3
BOARD = load_board(data_folder("boards") / "simulated")
SYN, ABS = 0, 3
SLOT, X, Y, ID = 0x2F, 0x35, 0x36, 0x39


class GhostlyPanel:
    """A `TouchSource` that reports every `PERIOD_S` while something is down.

    `fingers`: (begin_s, end_s, (x_mm, y_mm)) of real ones, at rest.
    """

    def __init__(self, fingers, *, probability, lives_reports, protocol=Protocol.B, seed=0, until_s=10.0):
        self.decoder = Decoder(Axes(BOARD, AxisRange(0, 2100), AxisRange(0, 1480)), protocol)
        self.warnings = Counter()
        self.ghosts = 0
        self._random = random.Random(seed)
        self._fingers = fingers
        self._probability = probability
        self._lives_reports = lives_reports
        self._until_s = until_s
        self._report = 1
        self._emissions = []  # start, end, of those that no scan has heard yet
        self._alive = {}  # ghost: place, reports left
        self._slots = {}  # who: slot
        self._ids = count()

    @property
    def counts(self):
        return self.decoder.counts

    def fileno(self):
        return None

    def close(self):
        self._report = 1 << 60

    def heard(self, start_s, end_s):
        self._emissions.append((start_s, end_s))

    def next_time_s(self):
        at_s = self._report * PERIOD_S
        return at_s if at_s <= self._until_s else None

    def is_real(self, x_m, y_m):
        """Whether a real finger is there: ghosts keep 12 mm away from them."""
        return any(abs(x_m * 1e3 - x_mm) < 1 and abs(y_m * 1e3 - y_mm) < 1 for _, _, (x_mm, y_mm) in self._fingers)

    def read(self, now_s):
        at_s = self._report * PERIOD_S
        if at_s > min(now_s, self._until_s):
            return ()
        self._report += 1
        for start_s, end_s in tuple(self._emissions):
            if start_s < at_s and self._random.random() < self._probability:  # once for each scan that it disturbs
                self._haunt()
            if end_s <= at_s:
                self._emissions.remove((start_s, end_s))
        there = {f"finger {k}": place for k, (begin_s, end_s, place) in enumerate(self._fingers) if begin_s <= at_s < end_s}
        there |= {name: place for name, (place, _) in self._alive.items()}
        self._alive = {name: (place, left - 1) for name, (place, left) in self._alive.items() if left > 1}
        return self._told(there, at_s)

    def _haunt(self):
        while True:
            place = self._random.uniform(0, 210), self._random.uniform(0, 148)
            if all(abs(place[0] - x_mm) > 12 or abs(place[1] - y_mm) > 12 for _, _, (x_mm, y_mm) in self._fingers):
                break
        self._alive[f"ghost {self.ghosts}"] = place, self._lives_reports
        self.ghosts += 1

    def _told(self, there, at_s):
        events = []
        if self.decoder.protocol is Protocol.A:
            for x_mm, y_mm in there.values():
                events += [(ABS, X, round(10 * x_mm)), (ABS, Y, round(10 * y_mm)), (SYN, 2, 0)]
            events += [] if there else [(SYN, 2, 0)]
        else:
            for name in [name for name in self._slots if name not in there]:
                events += [(ABS, SLOT, self._slots.pop(name)), (ABS, ID, -1)]
            for name, (x_mm, y_mm) in there.items():
                if name in self._slots:
                    continue  # at rest: the kernel says nothing
                self._slots[name] = min(set(range(64)) - set(self._slots.values()))
                events += [(ABS, SLOT, self._slots[name]), (ABS, ID, next(self._ids))]
                events += [(ABS, X, round(10 * x_mm)), (ABS, Y, round(10 * y_mm))]
        if not events:
            return ()
        for kind, code, value in events:
            self.decoder.feed(kind, code, value, at_s)
        return self.decoder.feed(SYN, 0, 0, at_s) or ()
