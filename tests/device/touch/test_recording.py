import contextlib
import math
import os
import re
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tables import each_row

from controller.device.board.board import load_board
from controller.device.board.lookup import data_folder
from controller.device.touch.axes import AxisRange
from controller.device.touch.event_codes import Protocol
from controller.device.touch.recordings.recording import Recording
from controller.device.touch.recordings.replay import RecordingSource
from controller.device.touch.reports import WARNINGS, describe_warnings
from controller.errors import ConfigError, TouchError

BOARD = load_board(data_folder("boards") / "simulated")
FOLDER = Path(__file__).parent / "recordings"
HEADER = "# EVEMU 1.3\nN: panel # 1\nI: 0018 0000 0000 0000\nP: 02 00\nB: 03 03 00 00\nA: 2f 0 4 0 0 0\n"
AXES = "A: 35 0 1000 0 0 10\nA: 36 0 500 0 0\n"
TAP = (
    "E: 0.000001 0003 0039 0007\t# EV_ABS / ABS_MT_TRACKING_ID\nE: 0.000001 0003 0035 0250\nE: 0.000001 0003 0036 0125\n"
    "E: 0.000001 0000 0000 0000\nE: 0.500001 0003 0039 -001\nE: 0.500001 0000 0000 0000\n"
)
# reports, contacts, most fingers at once
REAL = {
    "atmel_maxtouch_touchscreen.1-finger-fast-taps.events": (9, 9, 1),
    "dell_canvas_touch.evemu": (446, 12, 5),
    "ep0430m09.1-finger-drag-up-down.events": (182, 1, 1),
    "ep0430m09.2-fingers-touch-release.events": (13, 2, 2),
    "ep0430m09.4-finger-drag-down.events": (103, 4, 4),
    "quanta_opticaltouchscreen.touch-hover.events": (111, 1, 1),
}


def source(recording, start_s=0.0):
    return RecordingSource(recording, recording.axes(BOARD), start_s)


def replay(recording, start_s=0.0):
    """All samples of a recording, report by report, and the source after it."""
    played = source(recording, start_s)
    reports = []
    while (due_s := played.next_time_s()) is not None:
        assert played.read(math.nextafter(due_s, -math.inf)) == ()
        assert not played.touched
        before = played.counts.reports
        reports.append(played.read(due_s))
        assert played.touched == (played.counts.reports > before)
    return [sample for report in reports for sample in report], played


def counted(recording):
    counts = replay(recording)[1].counts
    return counts.reports, counts.contacts, counts.max_fingers


def counted_by_text(text):
    """Without slots: tracking ids begun less ended, at each SYN_REPORT."""
    begun = ended = reports = most = 0
    for report in re.split(r"^E: \S+ 0000 0000 .*$", text, flags=re.MULTILINE)[:-1]:
        ids = [int(value) for value in re.findall(r"^E: \S+ 0003 0039 (-?\d+)", report, flags=re.MULTILINE)]
        ended += ids.count(-1)
        begun += len(ids) - ids.count(-1)
        reports += begun > ended
        most = max(most, begun - ended)
    return reports, begun, most


@each_row("name", REAL)
def test_real_recordings_are_counted_as_their_text_says(name):
    recording = Recording.open(FOLDER / name)
    assert counted(recording) == REAL[name] == counted_by_text((FOLDER / name).read_text(encoding="utf-8"))
    assert recording.protocol is Protocol.B
    assert dict(recording.warnings) in ({}, {"no_axis_lines": 1})


@each_row("name", REAL)
def test_samples_of_real_recordings_are_the_positions_of_the_file(name):
    recording = Recording.open(FOLDER / name)
    samples, played = replay(recording, start_s=1000.0)
    text = (FOLDER / name).read_text(encoding="utf-8")
    xs = {int(x) for x in re.findall(r"^E: \S+ 0003 0035 (\d+)", text, flags=re.MULTILINE)}
    x, x_mm = recording.x, {round(sample.x_m * 1e3, 3) for sample in samples}
    assert x_mm == {round((value - x.minimum) / (x.maximum - x.minimum) * 210, 3) for value in xs}
    assert samples[0].time_s == pytest.approx(1000.0, abs=1e-3)  # the first report's end is a few µs after its begin
    assert [s.time_s for s in samples] == sorted(s.time_s for s in samples)
    assert not set(describe_warnings(played.warnings)) - {f"1 × {WARNINGS['no_axis_lines']}"}
    begun = [s.finger for s in samples if s.contact]
    assert len(set(begun)) == played.counts.contacts
    assert sorted(s.finger for s in samples if not s.contact) == sorted(set(begun))


def test_the_demo_is_the_real_recording_with_a_shorter_pause():
    demo = Recording.open(BOARD.folder / BOARD.touch.recording)
    whole = Recording.open(FOLDER / "dell_canvas_touch.evemu")
    assert [event[:3] for event in demo.events] == [event[:3] for event in whole.events]
    assert {round(b[3] - a[3], 6) for a, b in zip(demo.events, whole.events, strict=True)} == {0.0, 4.0}
    assert counted(demo) == REAL["dell_canvas_touch.evemu"]
    assert 9 < demo.events[-1][3] < 11


def test_one_tap_is_read_with_its_axes():
    recording = Recording(HEADER + AXES + TAP)
    assert (recording.x, recording.y) == (AxisRange(0, 1000), AxisRange(0, 500))
    samples, played = replay(recording, start_s=50.0)
    assert [tuple(s)[:5] for s in samples] == [
        (0, pytest.approx(0.0525, rel=1e-9), pytest.approx(0.037, rel=1e-9), 50.0, True),
        (0, pytest.approx(0.0525, rel=1e-9), pytest.approx(0.037, rel=1e-9), pytest.approx(50.5), False),
    ]
    assert samples[0].x_m != pytest.approx(0.0525 * 1.01, rel=1e-3)
    assert not played.warnings
    assert played.fileno() is None


def test_axes_one_percent_longer_move_the_finger():
    longer = AXES.replace("1000", "1010").replace("500", "505")
    (right, *_), _ = replay(Recording(HEADER + AXES + TAP))
    (off, *_), _ = replay(Recording(HEADER + longer + TAP))
    assert off.x_m == pytest.approx(right.x_m / 1.01, rel=1e-9)
    assert off.y_m == pytest.approx(right.y_m / 1.01, rel=1e-9)


@each_row("version", ["", "# EVEMU 1.0\n", "# EVEMU 1.1\n", "# EVEMU 1.2\n", "# EVEMU 1.3\n"])
def test_all_versions_are_read(version):
    recording = Recording(version + HEADER.split("\n", 1)[1] + AXES + "L: 00 1\nS: 00 0\n\n" + TAP.replace("\n", " \r\n"))
    assert counted(recording) == (1, 1, 1)
    assert not recording.warnings


@pytest.mark.parametrize(
    ("protocol", "text", "expected"),
    [
        (
            Protocol.A,
            "E: 0 0003 0035 1\nE: 0 0003 0036 2\nE: 0 0000 0002 0\nE: 0 0003 0035 900\nE: 0 0003 0036 2\nE: 0 0000 0002 0\n"
            "E: 0 0000 0000 0\nE: 1 0000 0002 0\nE: 1 0000 0000 0\n",
            (1, 2, 2),
        ),
        (
            Protocol.SINGLE,
            "E: 0 0003 0000 1\nE: 0 0003 0001 2\nE: 0 0000 0000 0\nE: 1 0001 014a 1\nE: 1 0000 0000 0\nE: 1.1 0001 014a 0\n"
            "E: 1.1 0000 0000 0\n",
            (1, 1, 1),
        ),
    ],
)
def test_the_other_protocols_are_recognised(protocol, text, expected):
    recording = Recording("A: 00 0 1000 0 0\nA: 01 0 500 0 0\n" + text)
    assert recording.protocol is protocol
    assert not recording.warnings  # the ranges of ABS_X and ABS_Y serve the multi-touch axes as well
    assert (recording.x, recording.y) == (AxisRange(0, 1000), AxisRange(0, 500))
    assert counted(recording) == expected


def test_a_newer_version_is_read_with_a_warning():
    recording = Recording("# EVEMU 2.0\n" + AXES + TAP)
    assert counted(recording) == (1, 1, 1)
    assert recording.warnings == {"unknown_version": 1}


def test_the_slot_current_at_the_start_is_taken_from_the_comments():
    comments = "#     Event code 47 (ABS_MT_SLOT)\n#       Value      3\n#       Min        0\n"
    later = "E: 0.1 0003 002f 3\nE: 0.1 0003 0035 260\nE: 0.1 0000 0000 0\n"
    first = TAP.split("E: 0.5", maxsplit=1)[0]
    assert counted(Recording(HEADER + comments + AXES + first + later)) == (2, 1, 1)
    samples, _ = replay(Recording(HEADER + comments + AXES + first + later))
    assert [s.finger for s in samples] == [0, 0, 0]


def test_without_axis_lines_its_own_extent_is_taken_with_one_warning():
    other = "E: 0.2 0003 0039 8\nE: 0.2 0003 0035 750\nE: 0.2 0003 0036 375\nE: 0.2 0000 0000 0\nE: 0.5"
    moved = TAP.replace("E: 0.5", other, 1)
    recording = Recording(moved)
    assert (recording.x, recording.y) == (AxisRange(250, 750), AxisRange(125, 375))
    assert recording.warnings == {"no_axis_lines": 1}
    samples, played = replay(recording)
    assert played.warnings == recording.warnings
    assert [(s.x_m, s.y_m) for s in samples if s.contact] == [pytest.approx((0, 0)), pytest.approx((0.210, 0.148))]


def test_the_extent_is_that_of_possible_positions_only():
    other = "E: 0.1 0003 0035 99999999999\nE: 0.1 0003 0036 -99999999999\nE: 0.1 0004 0035 9999\n"
    recording = Recording(TAP + other)
    assert (recording.x, recording.y) == (AxisRange(250, 250), AxisRange(125, 125))
    nowhere = Recording(HEADER + "E: 0 0003 0039 5\nE: 0 0000 0000 0\n")
    assert (nowhere.x, nowhere.y) == (AxisRange(0, 0), AxisRange(0, 0))


def test_slots_beyond_the_declared_ones_are_reported():
    begin, end = TAP.split("E: 0.5", 1)
    recording = Recording(HEADER + AXES + "E: 0 0003 002f 5\n" + begin + "E: 0.5" + end)
    assert set(replay(recording)[1].warnings) == {"slot_beyond_range"}


def test_the_largest_and_smallest_values_of_32_bits_are_possible():
    assert not Recording(HEADER + f"E: 0 0003 003a {(1 << 31) - 1}\nE: 0 0003 003a {-(1 << 31)}\n").warnings


def test_a_byte_order_mark_is_no_garbage(tmp_path):
    file = tmp_path / "marked.evemu"
    file.write_text(HEADER + AXES + TAP, encoding="utf-8-sig")
    assert not Recording.open(file).warnings


@each_row("axes", ["A: 35 1000 0 0 0\nA: 36 0 9 0 0\n", "A: 35 0 9 0 0\nA: 36 5 5 0 0\n", "A: 35 0\nA: zz 0 9 0 0\n"])
def test_axis_lines_that_cannot_be_meant_are_not_taken(axes):
    recording = Recording(axes + TAP)
    assert recording.warnings["no_axis_lines"] == 1
    assert counted(recording) == (1, 1, 1)


def test_a_closed_source_has_nothing_more_to_read():
    played = source(Recording(HEADER + AXES + TAP))
    played.close()
    assert played.next_time_s() is None
    assert played.read(math.inf) == ()


def test_fingers_still_down_at_the_end_are_released():
    samples, played = replay(Recording(HEADER + AXES + TAP.split("E: 0.5", maxsplit=1)[0] + "E: 0.400001 0004 0005 1\n"))
    assert [(s.time_s, s.contact) for s in samples] == [(0.0, True), (pytest.approx(0.4), False)]
    assert played.warnings == {"still_down_at_end": 1, "never_reported": 1}


@each_row(
    ("line", "kind"),
    [
        ("hello", "garbage_lines"),
        ("E: 0.1 0003 0035", "garbage_lines"),
        ("E: 0.1 0003 0035 12 34", "garbage_lines"),
        ("E: 0.1 0003 0035 1_0", "garbage_lines"),
        ("E: 0.1 zz03 0035 10", "garbage_lines"),
        ("E: x 0003 0035 10", "garbage_lines"),
        ("E: 0.1 0003 fffff 10", "garbage_lines"),
        ("\0\0\0", "garbage_lines"),
        ("E: 0.1 0003 0035 \N{ARABIC-INDIC DIGIT THREE}", "garbage_lines"),
        ("E: nan 0003 003a 10", "time_absurd"),
        ("E: inf 0003 003a 10", "time_absurd"),
        ("E: 1e30 0003 003a 10", "time_absurd"),
        ("E: 999999 0003 003a 10", "time_absurd"),
        ("E: -1 0003 003a 10", "time_backwards"),
        (f"E: 0.1 0003 003a {'9' * 5000}", "value_absurd"),
        ("E: 0.1 0003 003a -2147483649", "value_absurd"),
    ],
)
def test_a_line_that_cannot_be_meant_costs_one_counted_warning_and_nothing_else(line, kind):
    clean = HEADER + AXES + TAP
    begin, end = clean.split("E: 0.5", 1)
    recording = Recording(begin + f"{line}\n" * 3 + "E: 0.5" + end)
    assert recording.warnings[kind] == 3
    assert set(recording.warnings) == {kind}
    assert len(describe_warnings(recording.warnings)) == 1
    assert [tuple(s) for s in replay(recording)[0]] == [tuple(s) for s in replay(Recording(clean))[0]]


def test_coordinates_outside_the_axes_are_clamped_with_one_counted_warning():
    samples, played = replay(Recording(HEADER + AXES + TAP.replace("0250", "1020").replace("0125", "-14")))
    assert [(s.x_m, s.y_m) for s in samples] == [(pytest.approx(0.210), 0)] * 2
    assert played.warnings == {"outside_axes": 1}


def times(*raw):
    return [event[3] for event in Recording("".join(f"E: {time} 0003 003a 1\n" for time in raw)).events]


def test_times_never_go_back_and_recover_from_a_slip():
    assert times(5, 6, 2, 7, 8) == [0, 1, 1, 2, 3]
    assert times(5, 6, 1e6, 7, 8) == [0, 1, 1, 2, 3]
    assert times("nan", 5, 6) == [0, 0, 1]
    assert times("nan", "nan") == [0, 0]


def test_a_pause_of_a_minute_is_kept_and_a_longer_one_is_not():
    assert times(5, 65) == [0, 60]
    assert times(5, 66) == [0, 0]


def test_a_slip_of_fifty_events_is_a_slip_and_a_longer_one_a_clock_that_was_set():
    assert times(0, 1, *[1e6 + k for k in range(50)], 2) == [0, 1, *[1] * 50, 2]
    assert times(0, 1, *[1e6 + k for k in range(51)], 2) == [0, 1, *range(1, 52), 51]


def test_a_clock_set_while_recording_costs_only_the_moment():
    back = Recording("".join(f"E: {time} 0003 003a 1\n" for time in [1000 + i for i in range(60)] + [10 + i for i in range(60)]))
    assert [event[3] for event in back.events] == [*range(60), *(59 + i for i in range(60))]
    assert back.warnings == {"time_backwards": 1}
    ahead = times(*range(60), *(10**9 + i for i in range(60)))
    assert ahead == [*range(60), *(59 + i for i in range(60))]


@each_row("text", ["", "\n\n", HEADER, HEADER + AXES + "E: 0.1 0004 0005 77\nE: 0.1 0000 0000 0\n"])
def test_no_touch_gives_no_samples(text):
    samples, played = replay(Recording(text))
    assert samples == []
    assert counted(Recording(text)) == (0, 0, 0)
    assert played.next_time_s() is None
    assert Recording(text).tracks(Recording(text).axes(BOARD)) == {}


def test_bytes_that_are_no_text_are_counted(tmp_path):
    file = tmp_path / "bad.evemu"
    file.write_bytes((HEADER + AXES).encode() + b"N: caf\xe9\n\xff\xfe\0garbage\n" + TAP.encode())
    recording = Recording.open(file)
    assert counted(recording) == (1, 1, 1)
    assert recording.warnings == {"not_utf8": 2, "garbage_lines": 1}


@each_row("what", ["absent", "folder", "nul\0name"])
def test_a_file_that_cannot_be_opened_is_named(tmp_path, what):
    path = tmp_path if what == "folder" else tmp_path / what
    with pytest.raises(TouchError, match="cannot be read") as caught:
        Recording.open(path)
    assert repr(str(path))[1:-1] in str(caught.value)


def test_tracks_hold_every_report_and_interpolate_between_them():
    moved = TAP.replace("E: 0.5", "E: 0.1 0004 0005 9\nE: 0.1 0 0 0\nE: 0.2 0003 0035 270\nE: 0.2 0 0 0\nE: 0.5", 1)
    recording = Recording(HEADER + AXES + moved)
    (track,) = recording.tracks(recording.axes(BOARD)).values()
    assert track.finger == 0
    assert track.time_s.tolist() == pytest.approx([0, 0.1, 0.2], abs=2e-6)  # 1 µs: the first event's time
    assert track.end_s == track.time_s[-1]
    assert track.position(0.05) == pytest.approx((0.0525, 0.037))  # at rest until the report at 0.1 s said so
    assert track.position(0.15) == pytest.approx((0.0546, 0.037), rel=1e-4)  # 10 µm/s × 1 µs of the same 1 µs
    assert track.position(0.15) != pytest.approx((0.0546 * 1.01, 0.037), rel=1e-3)
    assert track.position(-1) == pytest.approx((0.0525, 0.037))
    assert track.position(9) == pytest.approx((0.0567, 0.037))


@each_row("name", REAL)
def test_tracks_pass_through_every_sample_of_the_replay(name):
    recording = Recording.open(FOLDER / name)
    tracks = recording.tracks(recording.axes(BOARD))
    samples, _ = replay(recording)
    assert set(tracks) == {s.finger for s in samples}
    for s in samples:
        assert tracks[s.finger].position(s.time_s) == pytest.approx((s.x_m, s.y_m), abs=1e-12)


lines = st.one_of(
    st.text(max_size=40),
    st.builds(
        "E: {} {:04x} {:04x} {}".format,
        st.one_of(st.floats(), st.integers(0, 5)),
        st.sampled_from([0, 1, 3]),
        st.sampled_from([0, 1, 2, 3, 0x2F, 0x35, 0x36, 0x39, 0x3B, 0x14A]),
        st.one_of(st.integers(), st.integers(-1, 3)),
    ),
    st.builds("A: {:x} {} {} 0 0".format, st.sampled_from([0, 1, 0x2F, 0x35, 0x36]), st.integers(), st.integers()),
)


@settings(max_examples=200)
@given(st.lists(lines, max_size=60))
def test_any_text_is_replayed_to_its_end(found):
    recording = Recording("\n".join(found))
    samples, played = replay(recording)
    assert [s.time_s for s in samples] == sorted(s.time_s for s in samples)
    assert sum(not s.contact for s in samples) == len({s.finger for s in samples})
    assert set(played.warnings) <= set(WARNINGS)


@settings(max_examples=100)
@given(st.binary(max_size=300))
def test_any_bytes_are_refused_or_replayed_to_their_end(tmp_path_factory, data):
    file = tmp_path_factory.getbasetemp() / "any.evemu"
    file.write_bytes(data)
    with contextlib.suppress(ConfigError):
        assert replay(Recording.open(file))[1].next_time_s() is None
    file.write_bytes(AXES.encode() + TAP.encode() + data)
    with contextlib.suppress(ConfigError):  # bytes may continue the text to that of a program that is refused
        assert replay(Recording.open(file))[1].next_time_s() is None


@each_row("junk", [b"", b"# nothing\n", b"\x00\xff\xfe garbage\n" * 5, b"time,x,y\n0,1,2\n", bytes(5000)])
def test_a_file_of_which_nothing_is_a_recording_is_refused(tmp_path, junk):
    file = tmp_path / "junk"
    file.write_bytes(junk)
    with pytest.raises(ConfigError, match=r"junk: is no touch recording"):
        Recording.open(file)
    file.write_bytes(junk + b"\n" + AXES.encode())
    with pytest.raises(ConfigError, match="holds no event"):
        Recording.open(file)
    file.write_bytes(junk + b"\n" + AXES.encode() + TAP.encode())
    assert counted(Recording.open(file)) == (1, 1, 1)


def test_a_line_made_to_stall_a_parser_is_one_warning():
    recording = Recording("S: " + "0" * 5000 + "z\n")
    assert recording.warnings == {"garbage_lines": 1}


def test_what_no_report_ever_ended_is_counted(board):
    recording = Recording("E: 0.0 0003 0035 10\nE: 0.0 0003 0036 10\n")
    source = RecordingSource(recording, recording.axes(board), 0.0)
    assert source.read(1.0) == ()
    assert source.next_time_s() is None
    assert source.warnings["never_reported"] == 2


def test_what_is_no_regular_file_is_refused_at_once(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    for path in (tmp_path / "pipe", Path("/dev/zero"), tmp_path):
        with pytest.raises(TouchError, match="cannot be read"):
            Recording.open(path)
