"""A hundred elements that rest, are scrolled, rotated, zoomed, switched off and on, and animated; four fingers at up to 500 mm/s.

The panel replays the fingers. The region of each emission is compared with the browser's own hit test at the place
of the touch reported last before it, at the place of its focus, and with the target of a synthetic touch. If the machine is busy,
an emission may begin after the report that follows its touch: then that of the report before, 8 ms earlier, is right, and counted.
`pytest -m slow -rP tests/device/page/test_elements_under_fingers.py` prints the shares.
"""

import bisect
import math
import shutil
import threading
import time
from collections import defaultdict
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
TAPS = 15  # of a round
LOOK_MS = 500  # of haptic.js, as below
HIT_TESTS = """
  window.hits = [];
  window.since = performance.now();
  layers.length = 0;
  const ask = document.elementFromPoint;
  document.elementFromPoint = function (...point) { hits.push(document.timeline.currentTime); return ask.apply(this, point); };
  0
"""  # in which frames there are some


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
    """What the panel plays, and what it is touched by, as clients of its socket are told."""

    def __init__(self, socket):
        self.touches = defaultdict(list)  # of each finger: time_s, x_mm, y_mm
        self.foci = []
        self._ended = False
        self._threads = [threading.Thread(target=follow, args=(socket,)) for follow in (self._touched, self._played)]
        for thread in self._threads:
            thread.start()

    def end(self):
        self._ended = True
        for thread in self._threads:
            thread.join()

    def _touched(self, socket):
        with PanelClient(socket, timeout_s=60) as client:
            for touch in client.touches():
                if self._ended:
                    return
                self.touches[touch.finger].append((touch.time_s, touch.x_mm, touch.y_mm))

    def _played(self, socket):
        with PanelClient(socket, timeout_s=60) as client:
            for emissions in client.emissions():
                if self._ended:
                    return
                self.foci += [focus for focus in emissions.foci if focus.finger is not None]

    def more(self, enough, after_s):
        """That many foci that began after this time, each with its finger's last two touches before it and its speed in mm/s."""
        wait_for("emissions", lambda: sum(focus.time_s > after_s for focus in self.foci) >= enough)
        return [(focus, *self._cause(focus)) for focus in list(self.foci) if focus.time_s > after_s]

    def _cause(self, focus):
        touches = self.touches[focus.finger]
        wait_for("its touch", lambda: touches[-1][0] > focus.time_s)
        at = bisect.bisect_right(touches, (focus.time_s, math.inf, math.inf)) - 1
        (t0, x0, y0), (t1, x1, y1) = touches[at - 1], touches[at]
        return (touches[at], touches[at - 1]), math.hypot(x1 - x0, y1 - y0) / max(t1 - t0, 1e-6)


def offset_s(page):
    """Of the page's clock to CLOCK_MONOTONIC, from the quickest of several questions."""
    found = []
    for _ in range(20):
        before = time.monotonic()
        at = page.value("performance.now()")
        after = time.monotonic()
        found.append((after - before, (before + after) / 2 - at / 1e3))
    return min(found)[1]


class Share:
    """How often what was played is what was there; places within a pixel of a border are counted, and left out."""

    def __init__(self):
        self.right = self.border = self.off = self.late = 0
        self.wrong = []
        self.fastest_mm_s = 0.0

    def add(self, played, there, speed_mm_s, before=None):
        if there is None:
            self.border += 1
            return
        self.fastest_mm_s = max(self.fastest_mm_s, speed_mm_s)
        self.off += there == "" and before != played
        if played in (there, before):
            self.right += 1
            self.late += played != there
        else:
            self.wrong.append((played, there, round(speed_mm_s)))

    @property
    def share(self):
        return self.right / (self.right + len(self.wrong))

    def __str__(self):
        asked = self.right + len(self.wrong)
        left_out = f"{self.border} within a pixel of a border"
        return f"{self.share:.2%} of {asked} ({self.late} by the report before), {left_out}, to {self.fastest_mm_s:.0f} mm/s"


def played(focus):
    """The element of a region: its name without the number that haptic.js appends."""
    return focus.of.rpartition(" ")[0]


def targets(page, places):
    """What synthetic touches meet at places of the plate."""
    found = []
    for x_mm, y_mm in places:
        x, y = page.value(f"toPixels({x_mm}, {y_mm})")
        page.value("taps.length = 0; 0")
        page.call("Input.dispatchTouchEvent", type="touchStart", touchPoints=[{"x": x, "y": y}])
        page.call("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])
        found.append(page.value("taps[0]"))
    return found


@pytest.fixture
def fingers(panel_of, bridge_with, tmp_path):
    """A panel that replays them, and the page of the elements."""
    (tmp_path / "www").mkdir()
    for file in ("hundred.html", "hundred.css", "hundred.js"):
        shutil.copy(FOLDER / file, tmp_path / "www")
    (tmp_path / "fingers.events").write_text(recording())
    panel = panel_of("--replay", str(tmp_path / "fingers.events"))
    bridge = bridge_with("messages_per_s = 1000\nburst = 1000", www=tmp_path / "www", socket=panel.socket)
    felt = Felt(panel.socket)
    with browser() as page:
        page.size(1260, 888)
        page.open(f"{bridge.address}hundred.html")
        page.until("layers.length")
        yield page, felt
        assert page.said == []
    felt.end()


def places(found, ago=0):
    return [[round(x_mm, 3), round(y_mm, 3)] for _, touches, _ in found for _, x_mm, y_mm in touches[ago : ago + 1]]


def test_each_finger_gets_the_element_under_it_at_rest(fingers):
    page, felt = fingers
    offset = offset_s(page)
    touched, tapped = defaultdict(Share), Share()
    at_focus, lags = Share(), []
    for number, kind in enumerate(ROUNDS):
        changed_ms, settled_ms, refused = page.value(f"change({kind!r}, {number})")
        assert refused == []
        if settled_ms > changed_ms:
            lags.append(settled_ms - changed_ms)
        found = felt.more(ENOUGH, settled_ms / 1e3 + offset)
        theres, befores = (page.value(f"underAll({places(found, ago)})") for ago in (0, 1))
        for (focus, _, speed), there, before in zip(found, theres, befores, strict=True):
            touched[kind].add(played(focus), there, speed, before)
        focused = [[focus.x_mm, focus.y_mm] for focus, _, _ in found]
        for (focus, _, speed), there in zip(found, page.value(f"underAll({focused})"), strict=True):
            at_focus.add(played(focus), there, speed)
        every = len(found) // TAPS
        for (focus, _, speed), there, before, target in zip(
            found[::every], theres[::every], befores[::every], targets(page, places(found[::every])), strict=True
        ):
            tapped.add(played(focus), None if there is None else target, speed, before)
        felt.foci.clear()
    for kind, share in touched.items():
        print(f"{kind}: {share}")
    print(f"by synthetic touches: {tapped}")
    print(f"at the place of the focus, 2 ms after the emission began: {at_focus}")
    print(f"from a change to the panel's last answer: {np.median(lags):.0f} ms at the median, {max(lags):.0f} at worst")
    everything = [*touched.values(), tapped]
    assert min(share.share for share in everything) >= 0.995, [share.wrong[:9] for share in everything]
    assert max(share.fastest_mm_s for share in everything) > 450
    assert sum(share.off for share in everything) == 0, "nothing is felt on what is hidden or disabled"


def test_elements_that_are_animated_are_felt_where_they_were_a_moment_ago(fingers):
    page, felt = fingers
    offset = offset_s(page)
    page.value(HIT_TESTS)
    began_ms = page.value("animate()")
    found = felt.more(ANIMATED, began_ms / 1e3 + offset + 1.0)
    frames, took_ms, layers = page.value("[new Set(hits).size, performance.now() - since, layers.length]")
    then, before = (
        page.value(f"underThen({[[(touches[ago][0] - offset) * 1e3, *touches[ago][1:]] for _, touches, _ in found]})")
        for ago in (0, 1)
    )
    shares = defaultdict(Share)
    for (focus, _, speed), there, earlier in zip(found, then, before, strict=True):
        animated = "animated" in (played(focus) + (there or ""))
        shares["animated" if animated else "all others"].add(played(focus), there, speed, earlier)
    for kind, share in shares.items():
        print(f"{kind}: {share}")
    assert shares["all others"].share >= 0.995, shares["all others"].wrong[:9]
    print(f"{layers / took_ms * 1e3:.1f} layers a second, hit tests in {frames / took_ms * 1e3:.1f} frames a second")
    assert frames <= took_ms / LOOK_MS + 2, "what moves is looked for without them"
    assert shares["animated"].share >= 0.9, shares["animated"].wrong[:9]
