"""The trace's page in a real browser: lanes, late pulses, zoom, table, words, download, and one that is written on request."""

import json
import os
import shutil
from pathlib import Path

import pytest
from chromium import PROGRAM, browser
from patience import wait_for

from controller.device.loop.rings.trace_ring import StartRecord, TurnRecord
from controller.device.service.tracing.trace_file import END, events_of, head_of

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(PROGRAM is None, reason="no browser: apt-get install chromium"),
]
PICTURES = os.environ.get("HAPTIC_PANEL_PICTURES")  # a folder: store what the page looks like there
T_S, WIRE_S, PERIOD_S, PULSES = 2e-3, 1.4e-3, 20e-3, 60
LATE = {20: 4.5e-3, 40: 11e-3}  # by pulse
OPERATES = '[origins]\nself = ["operate"]'


def late_trace():
    """A train whose turns were held up twice."""
    events = []
    for number in range(PULSES):
        due_s, late_s = 100 + PERIOD_S * number, LATE.get(number, 0.0)
        ready_s = due_s + late_s - (0.0 if late_s else 0.3e-3)
        begun_s = ready_s - WIRE_S - 0.2e-3
        if late_s:
            events.append(TurnRecord(begun_s - late_s, begun_s - 1e-5, 1e-3, 0, started=False))
        events.append(TurnRecord(begun_s, begun_s + 0.25e-3, -1.0, 1, started=True))
        events.append(
            StartRecord(
                due_s,
                ready_s,
                max(ready_s, due_s),
                0.1e-3,
                0.1e-3,
                WIRE_S,
                1 + number % 2,
                pulse=True,
                resident=False,
                by_clock=False,
            )
        )
    text = "".join(f",\n{event}" for record in events for event in events_of(record, 100.0, T_S))
    return head_of("a pulse was 11.0 ms late", "simulated", "checkout") + text + END


@pytest.fixture
def beside(folder):
    """A folder with the panel's socket, into which the panel writes no traces of its own."""
    (folder / "beside").mkdir()
    (folder / "beside/panel.sock").symlink_to(folder / "panel.sock")
    yield folder / "beside"
    shutil.rmtree(folder / "beside")


def test_a_late_pulse_is_seen_read_and_downloaded(bridge_with, beside, tmp_path):
    written = late_trace()
    (beside / "trace-1.json").write_text(written)
    pictures = Path(PICTURES) if PICTURES else tmp_path
    bridge = bridge_with(OPERATES, socket=str(beside / "panel.sock"))
    with browser() as page:
        page.size(1280, 1000)
        page.dark("light")
        page.open(f"{bridge.address}live/trace.html")
        page.until("document.querySelectorAll('#words li').length >= 4")
        words = page.value("[...document.querySelectorAll('#words li')].map((one) => one.textContent)")
        assert words[0].startswith("written because: a pulse was 11.0 ms late")
        assert "2 pulses were more than 2 ms late" in words[2]
        assert "11 ms late: the loop was busy with other turns for" in words[3]
        # It begins at the latest pulse, which is marked in its lane, from when it was due
        assert page.value("document.querySelectorAll('.event.late').length") == 1
        title = page.value("document.querySelector('.event.late title').textContent")
        assert "11.0 ms late" in title
        due, start = page.value("['x1', 'x2'].map((key) => Number(document.querySelector('.delay').getAttribute(key)))")
        from_ms, to_ms, width, _ = shown(page)
        assert (start - due) / width * (to_ms - from_ms) == pytest.approx(11.0, rel=0.01)
        for lane in range(1, 6):
            assert page.value(f"document.querySelectorAll('.lane-{lane}').length") >= 1 or lane == 4
        (late_row,) = page.value(
            "[...document.querySelectorAll('tr.late')].map((row) => [...row.cells].map((one) => one.textContent))"
        )
        assert (late_row[2], late_row[4], late_row[6]) == ("11.000 ms", "1.400 ms", "pulse of a train, uploaded")
        page.picture(pictures / "trace.png")

        page.value("document.querySelector('[data-move=late]').click(); 0")
        page.until("document.querySelector('tr.late td:nth-child(3)').textContent === '4.500 ms'")
        page.value("document.getElementById('timeline').focus(); 0")
        press(page, "Home")
        page.until(f"document.querySelectorAll('.delay').length === {len(LATE)}")
        assert page.value("document.querySelectorAll('.event').length") <= 5 * width
        assert page.value("document.querySelectorAll('#rows tr').length") == PULSES
        from_ms, to_ms, *_ = shown(page)
        for key, share in (("+", 0.5), ("-", 1.0), ("+", 0.5)):
            before = shown(page)
            press(page, key)
            page.until(f"document.getElementById('shown').textContent !== {json.dumps(before[3])}")
            now = shown(page)
            assert now[1] - now[0] == pytest.approx(share * (to_ms - from_ms), abs=0.2)
        press(page, "ArrowRight")
        page.until(f"document.getElementById('shown').textContent !== {json.dumps(now[3])}")
        assert shown(page)[0] > now[0]

        page.call("Browser.setDownloadBehavior", behavior="allow", downloadPath=str(tmp_path))
        page.value("document.getElementById('download').click(); 0")
        wait_for("the download", (tmp_path / "trace-1.json").exists)
        assert (tmp_path / "trace-1.json").read_text() == written

        page.size(390, 844, 2, mobile=True)
        page.dark()
        assert page.value("document.documentElement.scrollWidth") == 390
        page.picture(pictures / "trace_phone.png")
        assert page.said == []


def test_a_trace_is_written_when_it_is_asked_for(bridge_with, tmp_path):
    bridge = bridge_with(OPERATES)
    with browser() as page:
        page.size(1280, 1000)
        page.open(f"{bridge.address}live/trace.html")
        page.until("!document.getElementById('write').disabled")
        # again and again: one that a late pulse has caused may be on its way, and is not followed by another one
        page.until(
            "document.getElementById('reason').textContent.includes('asked for it') || document.getElementById('write').click()"
        )
        page.until("document.querySelectorAll('#rows tr').length && document.querySelectorAll('.lane-5').length")
        page.until("document.querySelectorAll('#words li').length >= 3")
        page.picture((Path(PICTURES) if PICTURES else tmp_path) / "trace_asked_for.png")
        assert page.said == []


def shown(page):
    """Begin and end in ms of what is shown, the picture's width, and the sentence that says it."""
    text = page.value("document.getElementById('shown').textContent")
    begin, end = (float(word.replace(",", "")) for word in text.partition(" ms of")[0].split(" to "))
    return begin, end, page.value("document.getElementById('timeline').clientWidth"), text


def press(page, key):
    """Press a key on what has the focus."""
    page.call("Input.dispatchKeyEvent", type="keyDown", key=key, text=key if len(key) == 1 else "")
    page.call("Input.dispatchKeyEvent", type="keyUp", key=key)
