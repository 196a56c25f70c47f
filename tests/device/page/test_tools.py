"""What the bridge does for operators' pages: traces that lie beside the socket, and commands that it runs."""

import json
import os
import shutil
import time

import pytest
from patience import wait_for
from tables import each_row

from controller.device.page.tools import PageTools
from controller.device.page.traces import PART_BYTES, TraceFolder
from controller.device.service.tracing.trace_report import read_trace
from controller.errors import ConfigError

PATIENCE_S = 60.0
OPERATES = '[origins]\nself = ["operate"]'


def stored(folder, name, text, at_ns):
    (folder / name).write_text(text)
    os.utime(folder / name, ns=(at_ns, at_ns))


def whole(read):
    """A trace, part by part."""
    text = ""
    while True:
        part = read(offset=len(text))
        text += part["text"]
        if len(text) >= part["bytes"]:
            return text


def test_a_trace_is_read_in_parts_and_never_mixed_with_a_newer_one(tmp_path):
    traces = TraceFolder(tmp_path)
    assert traces.listed({}) == {"kind": "traces", "files": []}
    long = "x" * (2 * PART_BYTES + 5)
    stored(tmp_path, "trace-2.json", long, 2_000)
    stored(tmp_path, "trace-3.json", "old", 1_000)
    (tmp_path / "trace-1.new").write_text("{")
    newest, old = traces.listed({})["files"]
    assert (newest, old["name"]) == ({"name": "trace-2.json", "bytes": len(long), "written": "2000"}, "trace-3.json")
    message = {"kind": "read_trace", "name": "trace-2.json", "written": "2000"}
    assert whole(lambda **more: traces.part(message | more)) == long
    stored(tmp_path, "trace-2.json", "new", 3_000)
    with pytest.raises(ConfigError, match=r"trace-2\.json was replaced by a newer trace"):
        traces.part(message)


@each_row(
    ("changed", "reason"),
    [
        ({"name": "../panel.sock"}, "must be one of 'trace-1.json'"),
        ({"name": "trace-1.json/../../x"}, "must be one of"),
        ({"name": 7}, "Expected `str`, got `int`"),
        ({"offset": -1}, "Expected `int` >= 0"),
        ({"offset": 1.5}, "Expected `int`, got `float`"),
        ({"offset": 1 << 63}, "<= 1099511627776"),
        ({"more": 1}, "unknown field `more`"),
        ({}, r"trace-1\.json: cannot be read \(No such file or directory\)"),
    ],
)
def test_what_is_no_trace_is_refused(tmp_path, changed, reason):
    message = {"kind": "read_trace", "name": "trace-1.json", "written": "0"} | changed
    with pytest.raises(ConfigError, match=reason):
        TraceFolder(tmp_path).part(message)


def test_links_and_pipes_are_no_traces(tmp_path):
    (tmp_path / "trace-1.json").symlink_to("/etc/passwd")
    os.mkfifo(tmp_path / "trace-2.json")
    for name in ("trace-1.json", "trace-2.json"):
        written = str((tmp_path / name).lstat().st_mtime_ns)
        with pytest.raises(ConfigError, match="cannot be read"):
            TraceFolder(tmp_path).part({"kind": "read_trace", "name": name, "written": written})


@pytest.fixture
def asked(bridge_with, asks):
    """A page, and the newest trace once one was written because the page asked for it: another one may be on its way."""
    with bridge_with(OPERATES).open() as page:

        def explained():
            assert asks(page, kind="trace")["outcome"] == "done"
            files = asks(page, kind="traces")["files"]
            answer = asks(page, kind="explain_trace", name=files[0]["name"]) if files else {}
            return "asked for it" in str(answer.get("lines")) and (files[0], answer["lines"])

        yield page, *wait_for("a trace", explained)


def test_a_page_has_a_trace_written_reads_it_and_has_it_explained(asked, asks, tmp_path):
    page, file, lines = asked
    assert "asked for it (board 'simulated'" in lines[0]
    assert "turns of the loop" in lines[1]
    named = {"kind": "read_trace", "name": file["name"], "written": file["written"]}
    text = whole(lambda **more: asks(page, **named, **more))
    assert len(text) == file["bytes"]
    (tmp_path / "read.json").write_text(text)
    found = read_trace(tmp_path / "read.json")
    assert found.starts
    assert found.turns
    assert_nested(json.loads(text)["traceEvents"])


def test_what_cannot_be_explained_is_one_line(bridge_with, asks, folder):
    (folder / "beside").mkdir()
    (folder / "beside/panel.sock").symlink_to(folder / "panel.sock")
    (folder / "beside/trace-3.json").write_text("{")
    with bridge_with(OPERATES, socket=str(folder / "beside/panel.sock")).open() as page:
        assert "is no trace of a panel" in asks(page, kind="explain_trace", name="trace-3.json")["reason"]
        assert asks(page, kind="explain_trace", name="trace-9.json")["reason"].startswith("name = 'trace-9.json': must be one of")
    shutil.rmtree(folder / "beside")


def assert_nested(events):
    """Events of one track follow one another: what overlaps, Perfetto leaves out."""
    ends = {}
    for event in sorted((event for event in events if event["ph"] == "X"), key=lambda event: (event["tid"], event["ts"])):
        assert event["ts"] >= ends.get(event["tid"], 0.0) - 1e-3, event
        ends[event["tid"]] = event["ts"] + event["dur"]


def test_traces_and_calibration_are_for_operators(bridge, asks):
    with bridge.open() as page:
        for kind in ("traces", "read_trace", "explain_trace", "calibrate", "cancel", "mouse"):
            assert asks(page, kind=kind)["reason"] == (
                f"this page's origin may not {kind}: the bridge's settings do not give it the right 'operate'"
            )


def test_a_calibration_goes_on_beside_the_page_alone_and_ends_when_it_is_cancelled(bridge_with, asks):
    bridge = bridge_with(OPERATES)
    with bridge.open() as page, bridge.open() as other:
        page.send(json.dumps({"kind": "calibrate", "what": "axes", "at_mm": [[20, 20], [190, 20], [100, 130]], "id": 7}))
        (first,) = heard(page, "calibration")
        assert (first["step"], first["of"], first["at_mm"]) == (0, 3, [20.0, 20.0])
        assert first["say"].startswith("touch 1 of 3: at x = 20.0 mm, y = 20.0 mm")
        again = asks(other, kind="calibrate", what="ghosts")
        assert again["reason"] == "calibrate: another page has one running; wait until it has ended"
        assert "this page has one running" in asks(page, kind="calibrate", what="ghosts")["reason"]
        assert "no calibration running" in asks(other, kind="cancel")["reason"]
        page.send(json.dumps({"kind": "cancel", "id": 8}))
        answers = heard(page, "answer", 2)
        assert {answer["id"]: answer.get("reason", "") for answer in answers} == {7: "it was cancelled", 8: ""}
        assert asks(page, kind="play", effect="click", x_mm=100, y_mm=70)["outcome"] == "played"


def test_a_calibration_ends_with_its_page(bridge_with, asks):
    bridge = bridge_with(OPERATES)
    with bridge.open() as other:
        before = asks(other, kind="describe")["clients"]["connected"]
        with bridge.open() as page:
            page.send(json.dumps({"kind": "calibrate", "what": "axes", "id": 7}))
            heard(page, "calibration")
            assert asks(other, kind="describe")["clients"]["connected"] == before + 2
        wait_for("their end", lambda: asks(other, kind="describe")["clients"]["connected"] == before)
        other.send(json.dumps({"kind": "calibrate", "what": "axes", "id": 1}))
        assert heard(other, "calibration")[0]["step"] == 0


@each_row(
    ("message", "reason"),
    [
        ({"what": "all"}, "Invalid enum value 'all'"),
        ({"what": "axes", "at_mm": [[1, 2, 3]]}, "Expected `array` of length 2"),
        ({"what": "axes", "at_mm": [[20, "x"]]}, "Expected `float`, got `str`"),
        ({"what": "axes", "at_mm": [[20, 20]] * 6}, "length <= 5"),
        ({"what": "axes", "at_mm": [[-20, 20], [190, 20], [100, 130]]}, "target (-20, 20) mm is not on the plate"),
        ({"what": "axes", "at_mm": [[20, 20], [30, 30], [40, 40]]}, "the targets lie on one line"),
        ({"what": "ghosts", "socket": "/x"}, "unknown field `socket`"),
        (
            {"what": "ghosts"},
            "the scene plays without a finger at 'beacon': load another scene before, with `haptic-panel client load NAME`",
        ),
    ],
)
def test_what_cannot_be_calibrated_is_refused_in_plain_words(bridge_with, asks, message, reason):
    with bridge_with(OPERATES).open() as page:
        assert reason in asks(page, kind="calibrate", **message)["reason"]


STEPS = {"kind": "mouse", "sent_ms": 5.0, "steps": [[4.0, 1, -2]]}


@pytest.mark.parametrize("address", ["192.168.1.5", "::ffff:192.168.1.5", "fe80::1%eth0"])
def test_the_lag_is_measured_on_the_panels_own_machine_alone(tmp_path, address):
    tools = PageTools("/none", address, TraceFolder(tmp_path), set(), print)
    with pytest.raises(ConfigError, match="in a browser on the panel's own machine"):
        tools.kinds["calibrate"]({"kind": "calibrate", "what": "lag"})


@each_row(
    ("changed", "reason"),
    [
        ({}, "no lag is being measured"),
        ({"steps": [[4.0, 1]]}, "Expected `array` of length 3"),
        ({"steps": [[4.0, 1, 2]] * 1001}, "Expected `array` of length <= 1000"),
        ({"sent_ms": "now"}, "Expected `float`, got `str`"),
        ({"arrived_s": 1.0}, "unknown field `arrived_s`"),
    ],
)
def test_steps_of_a_mouse_that_nobody_asked_for_are_refused(tmp_path, changed, reason):
    tools = PageTools("/none", "127.0.0.1", TraceFolder(tmp_path), set(), print)
    with pytest.raises(ConfigError, match=reason):
        tools.kinds["mouse"](STEPS | changed)


def test_steps_of_the_mouse_come_with_the_panels_clock_while_the_lag_is_measured(bridge_with, panel_of, asks):
    nobody_touches = panel_of("--fingers", "0")  # with several fingers down the measurement ends
    with bridge_with(OPERATES, socket=nobody_touches.socket).open() as page:
        page.send(json.dumps({"kind": "calibrate", "what": "lag", "id": 7}))
        assert heard(page, "calibration")[0]["say"].startswith("hold the mouse to the finger")
        before_s = time.monotonic()
        answers = [asks(page, **STEPS) for _ in range(3)]
        assert [answer["outcome"] for answer in answers] == ["done"] * 3, answers
        times_s = [before_s, *(answer["time_s"] for answer in answers), time.monotonic()]
        assert times_s == sorted(times_s)
        page.send(json.dumps({"kind": "cancel", "id": 8}))
        heard(page, "answer", 2)
        assert asks(page, **STEPS)["reason"] == "no lag is being measured"


def heard(page, kind, count=1):
    """The next messages of a kind."""
    found = []
    while len(found) < count:
        message = json.loads(page.recv(PATIENCE_S))
        found += [message] if message["kind"] == kind else []
    return found
