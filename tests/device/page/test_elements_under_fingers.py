"""A hundred elements that rest, are scrolled, rotated, zoomed, switched off and on, and animated; four fingers at up to 500 mm/s.

The panel replays the fingers. Of each emission that it plays for a finger, the region is compared with what the browser's own hit test
finds at the place of the touch that was reported last, and at the place of the focus: with `elementFromPoint`, and with the target of a
synthetic touch. `pytest -m slow -rP tests/device/page/test_elements_under_fingers.py` prints the shares.
"""

import bisect
import math
import shutil
import threading
import time
from collections import Counter, defaultdict
from pathlib import Path

import numpy as np
import pytest
from chromium import PROGRAM, browser
from patience import wait_for

from controller.device.application_socket.client import PanelClient

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(PROGRAM is None, reason="no browser: apt-get install chromium"),
]
FOLDER = Path(__file__).parent
SECONDS, REPORT_HZ = 400, 120
LARGEST_MM_S = (500.0, 350.0, 200.0, 100.0)  # speed of each finger where it is fastest
QUARTERS_MM = ((52.0, 37.0), (158.0, 37.0), (52.0, 111.0), (158.0, 111.0))  # one for each finger: its middle
REACH_MM = 46.0, 31.0
ROUNDS = ("resting", "scrolled", "rotated", "zoomed", "switched") * 3
ENOUGH = 400  # emissions of a round
ANIMATED = 2500


def recording():
    """evemu's text: each finger goes to and fro in its quarter of the plate, along x and y in a ratio that fills it."""
    lines = ["A: 2f 0 9 0 0 0\nA: 35 0 21000 0 0 0\nA: 36 0 14800 0 0 0\nA: 39 0 65535 0 0 0\n"]  # hundredths of a mm
    for number in range(SECONDS * REPORT_HZ):
        at_s = number / REPORT_HZ
        for slot, ((x_mm, y_mm), fastest_mm_s) in enumerate(zip(QUARTERS_MM, LARGEST_MM_S, strict=True)):
            omega = fastest_mm_s / math.hypot(REACH_MM[0], 0.618 * REACH_MM[1])
            x, y = x_mm + REACH_MM[0] * math.sin(omega * at_s), y_mm + REACH_MM[1] * math.sin(0.618 * omega * at_s)
            events = [(0x2F, slot), *([(0x39, slot)] if number == 0 else []), (0x35, 100 * x), (0x36, 100 * y)]
            lines += [f"E: {at_s:.6f} 0003 {code:04x} {round(value):04d}\n" for code, value in events]
        lines.append(f"E: {at_s:.6f} 0000 0000 0000\n")
    return "".join(lines)


class Felt:
    """What the panel plays, and what it is touched by, as a client of its socket is told."""

    def __init__(self, socket):
        self.touches = defaultdict(list)  # of each finger: time_s, x_mm, y_mm
        self.foci = []
        self._clients = [PanelClient(socket, timeout_s=60) for _ in range(2)]
        for follow in (self._touches, self._foci):
            threading.Thread(target=follow, daemon=True).start()

    def _touches(self):
        for touch in self._clients[0].touches():
            self.touches[touch.finger].append((touch.time_s, touch.x_mm, touch.y_mm))

    def _foci(self):
        for emissions in self._clients[1].emissions():
            self.foci += [focus for focus in emissions.foci if focus.finger is not None]

    def cause(self, focus):
        """The touch that was reported last before this focus began, and the finger's speed in mm/s."""
        touches = self.touches[focus.finger]
        at = bisect.bisect_right(touches, (focus.time_s, math.inf, math.inf)) - 1
        (t0, x0, y0), (t1, x1, y1) = touches[at - 1], touches[at]
        return t1, x1, y1, math.hypot(x1 - x0, y1 - y0) / max(t1 - t0, 1e-6)


def offset_s(page):
    """Of the page's clock to CLOCK_MONOTONIC, from the quickest of several questions."""
    found = []
    for _ in range(20):
        before = time.monotonic()
        at = page.value("performance.now()")
        after = time.monotonic()
        found.append((after - before, (before + after) / 2 - at / 1e3))
    return min(found)[1]


def name(of):
    """The element of a region: without the number that haptic.js appends."""
    return of.rpartition(" ")[0]


class Shares:
    """Of each kind of element: how often the region that was played is that of the element there."""

    def __init__(self):
        self.right = defaultdict(Counter)  # of each kind of place: right, wrong, border, and "felt on what is not"

    def add(self, kind, focus, expected):
        if expected is None:
            self.right[kind]["border"] += 1
            return
        played = name(focus.of)
        self.right[kind]["right" if played == expected else "wrong"] += 1
        self.right[kind]["not"] += not expected
        if played != expected:
            self.wrong.append((kind, focus, expected))

    def share(self, kind):
        return self.right[kind]["right"] / max(1, self.right[kind]["right"] + self.right[kind]["wrong"])


def test_each_finger_gets_the_element_under_it(panel_of, bridge_with, tmp_path):
    (tmp_path / "www").mkdir()
    for name_ in ("hundred.html", "hundred.css", "hundred.js"):
        shutil.copy(FOLDER / name_, tmp_path / "www")
    (tmp_path / "fingers.events").write_text(recording())
    panel = panel_of(tmp_path / "fingers.events")
    bridge = bridge_with("messages_per_s = 1000\nburst = 1000", www=tmp_path / "www", socket=panel.socket)
    felt = Felt(panel.socket)
    with browser() as page:
        page.size(1260, 888)
        page.open(f"{bridge.address}hundred.html")
        page.until("layers.length")
        page.picture(Path("/work/h/scratch_js/hundred.png"))
        offset = offset_s(page)
        for number, kind in enumerate(ROUNDS):
            changed, settled, refused = page.value(f"change({kind!r}, {number})")
            assert refused == []
            first = len(felt.foci)
            wait_for("emissions", lambda: len(felt.foci) >= first + ENOUGH)
            foci = [f for f in felt.foci if f.time_s > settled / 1e3 + offset]
            causes = [felt.cause(f) for f in foci]
            under = page.value(f"underAll({[[x, y] for _, x, y, _ in causes]})")
            at = page.value(f"underAll({[[f.x_mm, f.y_mm] for f in foci]})")
            felt.foci = []
            bad = [(name(f.of), u, c) for f, c, u in zip(foci, causes, under) if u is not None and name(f.of) != u]
            print(kind, len(foci), "lag", settled - changed, "border", under.count(None), "wrong", len(bad), "at focus wrong", sum(u is not None and name(f.of) != u for f, u in zip(foci, at)), bad[:6], max(c[3] for c in causes))
        assert page.said == []
