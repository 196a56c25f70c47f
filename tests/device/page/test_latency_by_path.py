"""From a touch to the emission that it causes, by two paths: a region that the loop plays, and a page's JavaScript that answers.

`pytest -m slow -rP tests/device/page/test_latency_by_path.py` prints the figures. Both times are the panel's own: of the touch
report, and of the emission's start (CLOCK_MONOTONIC).
"""

import shutil
from pathlib import Path

import numpy as np
import pytest
from chromium import PROGRAM, browser

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(PROGRAM is None, reason="no browser: apt-get install chromium"),
]
FOLDER = Path(__file__).parent
ENOUGH = 300  # emissions of each path


def times_ms(page, mode):
    """How long each emission of a path came after its touch."""
    page.value(f"begin({mode!r}); 0")
    page.until(f"times.length >= {ENOUGH}")
    return np.array(page.value("times")) * 1e3


def test_the_loops_own_path_is_the_shorter_one(bridge_with, tmp_path):
    (tmp_path / "www").mkdir()
    for name in ("paths.html", "paths.js"):
        shutil.copy(FOLDER / name, tmp_path / "www")
    bridge = bridge_with("messages_per_s = 1000\nburst = 1000", www=tmp_path / "www")
    with browser() as page:
        page.size(1000, 700)
        page.open(f"{bridge.address}paths.html")
        page.until("ready")
        found = {mode: times_ms(page, mode) for mode in ("region", "script")}
        assert page.said == []
    for mode, times in found.items():
        p50, p95, worst = np.percentile(times, (50, 95, 100))
        print(f"{mode}: p50 {p50:.2f} ms, p95 {p95:.2f} ms, worst {worst:.1f} ms of {times.size}")
    assert np.median(found["region"]) < np.median(found["script"])
