"""The page that calibrates, in a real browser: each step is said and drawn, the result can be copied, refusals are in words."""

import itertools
import json
import math
import os
import re
import threading
import time
from pathlib import Path

import numpy as np
import pytest
from chromium import PROGRAM, browser
from device.touch_calibration.test_running import axes_at, off_mm, touched  # noqa: F401 - a fixture

from controller.device.application_socket.client import PanelClient
from controller.device.application_socket.protocol.panel_messages import ContactNotice

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(PROGRAM is None, reason="no browser: apt-get install chromium"),
]
LAG_S = 0.025
STROKES_HZ, MOUSE_HZ = 1.7, 250.0
PICTURES = os.environ.get("HAPTIC_PANEL_PICTURES")  # a folder: store what the page looks like there
OPERATES = '[origins]\nself = ["operate"]'


def strokes(at_s):
    """Where a finger is that slides to and fro, as shares of how far it goes."""
    phase = 2 * math.pi * STROKES_HZ * at_s + 0.8 * math.sin(1.3 * at_s)
    return math.sin(phase), 0.3 * math.sin(0.61 * phase + 1.0)


class LateFinger:
    """What a panel writes of such a finger, each report of where it was `LAG_S` before; and how late the service has it besides."""

    def __init__(self):
        self.written_s = []

    def __iter__(self):
        while True:
            self.written_s.append(time.monotonic())
            x, y = strokes(self.written_s[-1] - LAG_S)
            yield round(2048 + 600 * x), round(2048 + 600 * y)

    def lag_ms(self, heard_s):
        """The true lag of contacts with these times."""
        at = np.searchsorted(self.written_s, heard_s) - 1
        return 1e3 * (LAG_S + np.median(np.array(heard_s) - np.array(self.written_s)[at]))


def contacts(socket, ended):
    """Times of the panel's contacts until something has ended."""
    found = []
    with PanelClient(str(socket), timeout_s=60.0) as panel:
        panel.subscribe("contacts")
        while not ended.is_set():
            found += [one.time_s for one in panel.heard(ContactNotice, 0.5)]
    return found


def mouse(page, **event):
    """An event of the page's mouse; nobody waits until it was dealt with."""
    page._socket.send(json.dumps({"id": 10**9, "method": "Input.dispatchMouseEvent", "params": event}))


def move(page, till):
    """Move the page's mouse as the finger until something is true."""
    began_s, number = time.monotonic(), 0
    while True:
        x, y = strokes(time.monotonic())
        mouse(page, type="mouseMoved", x=640 + 400 * x, y=450 + 400 * y, timestamp=time.time())
        number += 1
        if number % 50 == 0 and page.value(till):
            return
        time.sleep(max(began_s + number / MOUSE_HZ - time.monotonic(), 0.0))


def text(page, name):
    return page.value(f"document.getElementById('{name}').textContent")


def press(page, name):
    page.value(f"document.getElementById('{name}').click(); 0")


def test_axes_are_calibrated_by_touches_on_known_places(bridge_with, touched, tmp_path):  # noqa: F811
    panel, socket = touched
    pictures = Path(PICTURES) if PICTURES else tmp_path
    bridge = bridge_with(OPERATES, socket=str(socket))
    with browser() as page:
        page.size(1280, 900)
        page.dark("light")
        page.open(f"{bridge.address}live/calibrate.html")
        page.until("!document.getElementById('axes').disabled")
        page.value(
            "lifted = true; HapticPanel.addEventListener('message', ({detail: {kind, contact}}) =>"
            " { if (kind === 'touch') lifted = !contact; }); 0"
        )
        page.value("document.getElementById('targets').value = '20 20\\n190 twenty'; 0")
        press(page, "axes")
        assert text(page, "say").startswith("“190 twenty” is no place")
        page.value("document.getElementById('targets').value = '20 20\\n190 20\\n20; 128\\n\\n190 128'; 0")
        press(page, "axes")
        for number, place_mm in enumerate([(20, 20), (190, 20), (20, 128), (190, 128)]):
            page.until(f"document.getElementById('say').textContent.startsWith('touch {number + 1} of 4') && lifted")
            assert page.value("document.getElementById('target').children.length") == 2
            if number == 2:
                page.picture(pictures / "calibrate_axes.png")
            with panel.finger(itertools.repeat(axes_at(*place_mm))):
                page.until(f"document.getElementById('progress').value > {number} || !document.getElementById('result').hidden")
        page.until("document.getElementById('say').textContent === 'Done.'")
        assert off_mm(text(page, "lines").split("\n")) < 0.2
        assert re.match(r"residual: 0\.\d\d mm rms", text(page, "words"))
        page.picture(pictures / "calibrate_done.png")
        press(page, "ghosts")
        page.until("document.getElementById('say').textContent.startsWith('Not calibrated')")
        assert "nothing can be played: waiting for FPGA" in text(page, "say")
        press(page, "axes")
        page.until("!document.getElementById('cancel').hidden")
        press(page, "cancel")
        page.until("document.getElementById('say').textContent === 'Not calibrated: it was cancelled'")
        page.size(390, 844, 2, mobile=True)
        page.dark()
        assert page.value("document.documentElement.scrollWidth") == 390
        page.picture(pictures / "calibrate_phone.png")
        assert page.said == []


def test_the_lag_is_measured_by_a_mouse_of_the_page(bridge_with, touched, tmp_path):  # noqa: F811
    panel, socket = touched
    bridge = bridge_with(OPERATES, socket=str(socket))
    finger, ended, heard_s = LateFinger(), threading.Event(), []
    watcher = threading.Thread(target=lambda: heard_s.extend(contacts(socket, ended)))
    with browser() as page:
        page.size(1280, 900)
        page.open(f"{bridge.address}live/calibrate.html")
        page.until("!document.getElementById('lag').disabled")
        press(page, "lag")
        page.until("document.getElementById('say').textContent.startsWith('hold the mouse to the finger')")
        page.picture((Path(PICTURES) if PICTURES else tmp_path) / "calibrate_lag.png")
        watcher.start()
        with panel.finger(finger):
            move(page, "/^(Done|Not calibrated)/.test(document.getElementById('say').textContent)")
        ended.set()
        watcher.join()
        assert text(page, "say") == "Done."
        words = text(page, "words")
        print(text(page, "lines"), words, "true:", finger.lag_ms(heard_s))
        found_ms = float(re.fullmatch(r"lag_ms = (\S+)", text(page, "lines"))[1])
        within_ms = sum(float(ms) for ms in re.findall(r"([\d.]+) ms (?:by chance|for what the mouse|for the page)", words))
        assert within_ms < 8
        assert found_ms == pytest.approx(finger.lag_ms(heard_s), abs=within_ms + 1.0)
        page.picture((Path(PICTURES) if PICTURES else tmp_path) / "calibrate_lag_done.png")
        assert page.said == []


def test_a_mouse_that_the_page_holds_reaches_stop_by_any_button(bridge_with, touched):  # noqa: F811
    bridge = bridge_with(OPERATES, socket=str(touched[1]))
    with browser() as page:
        page.size(1280, 1400)
        page.open(f"{bridge.address}live/calibrate.html")
        page.until("!document.getElementById('lag').disabled")
        x, y = page.value(
            "(({x, y, width, height}) => [x + width / 2, y + height / 2])(document.getElementById('lag').getBoundingClientRect())"
        )
        left = {"x": x, "y": y, "button": "left", "clickCount": 1}
        for kind in ("mousePressed", "mouseReleased"):
            mouse(page, type=kind, **left)
        page.until("Boolean(document.pointerLockElement)")
        page.until("document.getElementById('say').textContent.startsWith('hold the mouse to the finger')")
        mouse(page, type="mousePressed", **left)
        page.until("document.getElementById('say').textContent.startsWith('STOP was accepted')")
        page.until("!document.pointerLockElement")
        press(page, "cancel")
        page.until("document.getElementById('say').textContent === 'Not calibrated: it was cancelled'")
        assert page.said == []
