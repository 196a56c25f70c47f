"""The page that calibrates, in a real browser: each step is said and drawn, the result can be copied, refusals are in words."""

import itertools
import os
import re
from pathlib import Path

import pytest
from chromium import PROGRAM, browser
from device.touch_calibration.test_running import axes_at, off_mm, touched  # noqa: F401 - a fixture

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(PROGRAM is None, reason="no browser: apt-get install chromium"),
]
PICTURES = os.environ.get("HAPTIC_PANEL_PICTURES")  # a folder: store what the page looks like there
OPERATES = '[origins]\nself = ["operate"]'


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
