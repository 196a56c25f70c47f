"""Recordings of libinput record, evtest and getevent, in the shapes that these programs print (other_recorders.py)."""

import contextlib
import gzip
import math
from collections import Counter
from pathlib import Path

import pytest
import yaml
from hypothesis import given, settings
from hypothesis import strategies as st
from other_recorders import AXES, KEYS, evemu, evtest, getevent, libinput
from tables import each_row

from controller.device.board.board import load_board
from controller.device.board.lookup import data_folder
from controller.device.touch.event_codes import Protocol
from controller.device.touch.recordings.libinput_text import read_libinput
from controller.device.touch.recordings.recording import Recording
from controller.device.touch.recordings.replay import RecordingSource
from controller.device.touch.reports import WARNINGS
from controller.errors import ConfigError

BOARD = load_board(data_folder("boards") / "simulated")
SYN, MT_SYN, DROPPED = (0, 0, 0), (0, 2, 0), (0, 3, 0)
SLOT, SIZE, X, Y, TOOL, ID = 0x2F, 0x30, 0x35, 0x36, 0x37, 0x39
TOUCH = 0x14A


def timed(*reports):
    """Events of reports, 8 ms apart."""
    return [(8000 * k, *event) for k, report in enumerate(reports) for event in report]


def axis(code, value):
    return (3, code, value)


TWO_FINGERS = timed(
    [axis(SLOT, 0), axis(ID, 7), axis(X, 100), axis(Y, 200), axis(TOOL, 0), (1, TOUCH, 1), SYN],
    [axis(X, 110), axis(SLOT, 1), axis(ID, 8), axis(X, 2000), axis(Y, 1400), SYN],
    [axis(Y, 1380), (4, 4, 0x90001), SYN],
    [axis(SLOT, 0), axis(ID, -1), SYN],
    [axis(ID, 9), axis(Y, 250), SYN],
    [axis(X, 115), axis(X, 999), DROPPED, axis(X, 5), SYN],
    [axis(SLOT, 2), axis(ID, 70), axis(X, 300), axis(Y, 300), axis(TOOL, 2), SYN],
    [axis(ID, -1), (1, TOUCH, 0), SYN],
    [axis(SLOT, 0), axis(ID, 71), axis(X, 300), axis(Y, 1480), (1, TOUCH, 1), SYN],
    [axis(ID, -1), (1, TOUCH, 0), SYN],
)
PROTOCOL_A = timed(
    [axis(X, 100), axis(Y, 200), MT_SYN, axis(X, 2000), axis(Y, 1400), MT_SYN, SYN],
    [axis(X, 120), axis(Y, 200), MT_SYN, SYN],
    [MT_SYN, SYN],
)
A_AXES = {X: (0, 2100), Y: (0, 1480)}
SINGLE = timed(
    [axis(0, 100), axis(1, 200), (1, TOUCH, 1), SYN], [axis(0, 150), SYN], [(1, TOUCH, 0), SYN], [axis(0, 9), (1, TOUCH, 1), SYN]
)
SINGLE_AXES = {0: (0, 2100), 1: (0, 1480)}
MOUSE = timed([(1, 0x110, 1), SYN], [(1, 0x110, 0), SYN])
TOUCHPAD = ({**AXES}, (0x110, 0x145, TOUCH), (0,))


def screen(name, events, axes=AXES):
    return name, events, axes, KEYS, (1,)


WRITERS = {
    "libinput record": lambda events, axes: libinput(screen("panel", events, axes)),
    "evtest": lambda events, axes: evtest("panel", events, axes),
    "getevent -lt": lambda events, axes: getevent(events, axes=axes),
    "getevent -t": lambda events, axes: getevent(events, axes=axes, labels=False),
    "getevent -lt of all devices": lambda events, axes: getevent(events, axes=axes, device="/dev/input/event3"),
    "getevent -lrt": lambda events, axes: getevent(events, axes=axes, rate=True),
    "getevent -t of old Androids": lambda events, axes: getevent(events, axes=axes, labels=False, old=True),
}


def replayed(recording):
    """All samples as (finger, x in mm, y in mm, time in µs, contact), and the source after them."""
    source = RecordingSource(recording, recording.axes(BOARD), 0.0)
    samples = []
    while (due_s := source.next_time_s()) is not None:
        samples += source.read(due_s)
    return [(s.finger, round(s.x_m * 1e3, 3), round(s.y_m * 1e3, 3), round(s.time_s * 1e6), s.contact) for s in samples], source


def plain(text):
    samples, source = replayed(Recording(text))
    return samples, source.counts, source.warnings


@each_row("writer", WRITERS)
@each_row(("events", "axes"), [(TWO_FINGERS, AXES), (PROTOCOL_A, A_AXES), (SINGLE, SINGLE_AXES)], ids=["B", "A", "single"])
def test_the_same_events_give_the_same_samples_whoever_has_recorded_them(writer, events, axes):
    expected, counts, _ = plain(evemu(events, axes))
    assert counts.contacts >= 2
    samples, source = replayed(Recording(WRITERS[writer](events, axes)))
    assert samples == expected
    assert source.counts == counts
    assert not source.warnings - Counter(dropped=1, still_down_at_end=1)


@each_row("writer", WRITERS)
def test_the_slot_at_the_start_is_that_of_the_head(writer):
    """Shapes of the head say that slot 3 is current: the first contact and a later one in slot 0 are two fingers."""
    events = timed([axis(ID, 7), axis(X, 100), axis(Y, 200), SYN], [axis(SLOT, 0), axis(ID, 8), axis(X, 9), axis(Y, 9), SYN])
    samples, source = replayed(Recording(WRITERS[writer](events, AXES)))
    assert source.counts.max_fingers == 2
    assert len(samples) == 4


@each_row("writer", WRITERS)
@each_row(("marked", "end"), [("utf-8-sig", "\n"), ("utf-8", "\r\n"), ("utf-16", "\r\n"), ("utf-16-be", "\n")])
def test_files_of_other_systems_are_read(tmp_path, writer, marked, end):
    """UTF-16 is what PowerShell makes of `adb shell getevent -lt > FILE`."""
    file = tmp_path / "log.txt"
    text = ("\ufeff" if marked == "utf-16-be" else "") + WRITERS[writer](TWO_FINGERS, AXES).replace("\n", end)
    file.write_bytes(text.encode(marked))
    samples, source = replayed(Recording.open(file))
    assert samples == plain(evemu(TWO_FINGERS))[0]
    assert not source.warnings - Counter(dropped=1)


@each_row("writer", WRITERS)
def test_what_people_store_around_it_does_no_harm(writer):
    text = (
        "$ sudo something\nNo device specified, trying to scan all of /dev/input/event*\nSelect the device event number [0-5]: 5\n"
    )
    text += "".join(f"    {line}\n" for line in WRITERS[writer](TWO_FINGERS, AXES).split("\n")) + "^C\n$ exit\n"
    assert replayed(Recording(text))[0] == plain(evemu(TWO_FINGERS))[0]


@each_row("writer", WRITERS)
def test_a_part_of_a_file_without_its_head_takes_its_own_extent_with_one_warning(writer):
    text = WRITERS[writer](TWO_FINGERS, AXES)
    start = {"libinput record": "  - evdev:", "evtest": "Event: "}.get(writer, "31-" if "old" in writer else "[  ")
    recording = Recording(text[text.index(start) :])
    assert recording.warnings == {"no_axis_lines": 1}
    assert (recording.x.maximum, recording.y.maximum) == (2000, 1480)
    assert replayed(recording)[1].counts.contacts == 5


@each_row("writer", WRITERS)
def test_a_line_that_cannot_be_meant_costs_one_warning_and_nothing_else(writer):
    text = WRITERS[writer](TWO_FINGERS, AXES)
    lines = text.split("\n")
    at = next(k for k, line in enumerate(lines) if line.startswith(("    - [", "Event: time", "[  ", "31-"))) + 4
    cut = lines[at][: lines[at].index(",") + 2] if "," in lines[at] else "[      31.2"
    recording = Recording("\n".join([*lines[:at], cut, cut, *lines[at:]]))
    assert recording.warnings == {"garbage_lines": 2}
    assert replayed(recording)[0] == plain(evemu(TWO_FINGERS))[0]


def test_labels_that_only_a_newer_kernel_has_are_nobodys():
    text = getevent(TWO_FINGERS, axes=AXES)
    stamp = "[      31.200500]"
    more = f"{stamp} EV_ABS       ABS_MT_NEW_AXIS      00000001            \n{stamp} EV_MSC       MSC_SCAN             00090001\n"
    begin, end = text.split("[      31.208000]", 1)
    recording = Recording(begin + more + "[      31.208000]" + end)
    assert not recording.warnings
    assert replayed(recording)[0] == plain(evemu(TWO_FINGERS))[0]


# ---- several devices


def test_of_several_devices_the_touch_panel_is_played():
    devices = [
        ("Mouse", MOUSE, {}, (0x110,), ()),
        ("Touchpad", timed([axis(SLOT, 0), axis(ID, 1), axis(X, 5), axis(Y, 5), SYN]), *TOUCHPAD),
        screen("Panel", TWO_FINGERS),
        screen("a panel that nobody touched", []),
    ]
    for order in (devices, devices[::-1]):
        assert replayed(Recording(libinput(*order)))[0] == plain(evemu(TWO_FINGERS))[0]
    both = evtest("Mouse", MOUSE, {}, (0x110,), ()) + evtest("Panel", TWO_FINGERS)
    assert replayed(Recording(both))[0] == plain(evemu(TWO_FINGERS))[0]
    all_of_them = 'add device 1: /dev/input/event1\n  name:     "gpio-keys"\n' + getevent(
        TWO_FINGERS, device="/dev/input/event3", axes=AXES
    )
    all_of_them += "[      40.000000] /dev/input/event1: EV_KEY       KEY_POWER            DOWN\n"
    all_of_them += "[      40.000000] /dev/input/event1: EV_SYN       SYN_REPORT           00000000\n"
    assert replayed(Recording(all_of_them))[0] == plain(evemu(TWO_FINGERS))[0]


@each_row(
    ("text", "words"),
    [
        (
            libinput(screen("left", TWO_FINGERS), screen("right", TWO_FINGERS)),
            "several touch panels, 'left', 'right': record one alone",
        ),
        (evtest("left", TWO_FINGERS) + evtest("right", TWO_FINGERS), "several touch panels, 'left', 'right'"),
        (libinput(("Mouse", MOUSE, {}, (0x110,), ())), "holds no positions, only other events of 'Mouse'"),
        (evtest("Mouse", MOUSE, {}, (0x110,), ()), "holds no positions, only other events of 'Mouse'"),
        (getevent(MOUSE, labels=False), "holds no positions, only other events of 'panel'"),
    ],
)
def test_several_panels_and_none_are_refused_by_name(text, words):
    with pytest.raises(ConfigError) as caught:
        Recording(text, "notes.txt")
    assert words in str(caught.value)
    assert str(caught.value).startswith("notes.txt: ")


# ---- information that is missing


def without(events, *codes):
    return [event for event in events if event[1:3] not in codes]


def one_finger():
    tap = [axis(X, 100), axis(Y, 200), (1, TOUCH, 1), SYN]
    return timed(tap, [axis(X, 120), SYN], [(1, TOUCH, 0), SYN], tap, [(1, TOUCH, 0), SYN])


@each_row("writer", WRITERS)
def test_without_tracking_ids_the_touch_key_tells_of_one_finger(writer):
    recording = Recording(WRITERS[writer](one_finger(), A_AXES))
    assert recording.protocol is Protocol.SINGLE
    samples, source = replayed(recording)
    assert [(x, y, contact) for _, x, y, _, contact in samples] == [
        (10, 20, True),
        (12, 20, True),
        (12, 20, False),
        (10, 20, True),
        (10, 20, False),
    ]
    assert source.counts.contacts == 2
    both = [(us, kind, {X: 0, Y: 1}.get(code, code), value) for us, kind, code, value in one_finger() if kind == 3]
    doubled = sorted([*one_finger(), *both], key=lambda event: (event[0], event[1] == 0))  # a panel with axes of both kinds
    assert replayed(Recording(WRITERS[writer](doubled, A_AXES | SINGLE_AXES)))[0] == samples


@each_row("writer", WRITERS)
def test_what_does_not_tell_when_a_finger_is_lifted_is_refused_with_the_way_on(writer):
    for events in (without(one_finger(), (1, TOUCH)), without(SINGLE, (1, TOUCH))):
        with pytest.raises(ConfigError, match=r"nothing tells when a finger is lifted; record the device with .*evemu-record"):
            Recording(WRITERS[writer](events, A_AXES | SINGLE_AXES))


@pytest.mark.parametrize("labels", [True, False])
def test_getevent_without_times_is_refused_with_the_way_on(labels):
    for device in ("", "/dev/input/event3"):
        lines = getevent(TWO_FINGERS, labels=labels, device=device).split("\n")
        text = "\n".join(line.partition("] ")[2] or line for line in lines)
        with pytest.raises(ConfigError, match=r"getevent without times: record with `getevent -lt`"):
            Recording(text)


@each_row("writer", [*WRITERS, "evemu"])
def test_a_recording_without_any_event_is_refused(tmp_path, writer):
    file = tmp_path / "empty"
    file.write_text(evemu([]) if writer == "evemu" else WRITERS[writer]([], AXES))
    with pytest.raises(ConfigError) as caught:
        Recording.open(file)
    assert f"{file}: holds no event" in str(caught.value)
    assert "haptic-panel record" in str(caught.value)


# ---- what is refused as what it is

HID = "R: 20 05 0d 09 04 a1 01 85 01 09 22 a1 02 09 42 15 00 25 01 75 01\nN: panel\nP: usb-1/input0\nI: 3 0eef 0001\n"
HID_EVENTS = "E: 000000.000000 9 01 01 00 10 00 20 00 00 01\nE: 000000.008000 9 01 01 00 12 00 22 00 00 01\n"


@each_row("text", [f"D: 0\n{HID}D: 0\n{HID_EVENTS}", f"# panel\n# 0x05, 0x0d, // Usage Page\n{HID}{HID_EVENTS}", HID_EVENTS])
def test_hid_recorders_file_is_refused_as_such_with_the_way_on(text):
    with pytest.raises(ConfigError, match=r"is of hid-recorder, .*hid-replay, and record the device with .*libinput record"):
        Recording(text)


def test_libinputs_other_command_is_refused_as_such():
    text = "-event5   DEVICE_ADDED   Panel     seat0 default group1  cap:t\n event5   TOUCH_DOWN   +0.000s\t0 (0) 49.87/32.10\n"
    with pytest.raises(ConfigError, match="is of libinput debug-events"):
        Recording(text)


def test_a_packed_file_is_refused_as_such(tmp_path):
    file = tmp_path / "touch.yml.gz"
    file.write_bytes(gzip.compress(libinput(screen("panel", TWO_FINGERS)).encode()))
    with pytest.raises(ConfigError, match=r"is compressed \(gzip\): unpack it first"):
        Recording.open(file)


def test_a_newer_format_of_libinput_is_read_with_a_warning():
    text = libinput(screen("panel", TWO_FINGERS)).replace("version: 1\n", "version: 2\n")
    assert Recording(text).warnings == {"unknown_version": 1}


# ---- whatever stands in it

events = st.lists(
    st.tuples(
        st.integers(0, 10**9),
        st.sampled_from([(0, 0), (0, 2), (0, 3), (1, TOUCH), (3, SLOT), (3, X), (3, Y), (3, ID), (3, 0), (3, 1), (3, 0x3A)]),
        st.integers(-(1 << 31), (1 << 31) - 1) | st.integers(-1, 9),
    ).map(lambda event: (event[0], *event[1], event[2])),
    max_size=40,
)


@settings(max_examples=30)
@given(events)
def test_the_lines_of_libinput_mean_what_yaml_means(recorded):
    text = libinput(("Mouse: a 'strange' # name", MOUSE, {}, (0x110,), ()), screen("panel", recorded))
    document = yaml.load(text, yaml.CSafeLoader)
    warnings = Counter()
    devices = read_libinput(text, warnings)
    assert not warnings
    for ours, theirs in zip(devices, document["devices"], strict=True):
        listed = [event for entry in theirs["events"] or () for event in entry.get("evdev", ())]
        assert [(round(time_s * 1e6), *event) for *event, time_s in ours.events] == [
            (1_000_000 * second + us, *event) for second, us, *event in listed
        ]
        assert {code: [its.minimum, its.maximum] for code, its in ours.axes.items()} == {
            code: its[:2] for code, its in (theirs["evdev"]["absinfo"] or {}).items()
        }
        assert ours.keys == set(theirs["evdev"]["codes"][1])
        assert ours.properties == set(theirs["evdev"]["properties"])


def refused_or_replayed(text):
    with contextlib.suppress(ConfigError):
        recording = Recording(text)
        samples, source = replayed(recording)
        assert [time for _, _, _, time, _ in samples] == sorted(time for _, _, _, time, _ in samples)
        assert all(math.isfinite(x) and math.isfinite(y) for _, x, y, _, _ in samples)
        assert set(source.warnings) <= set(WARNINGS)


@settings(max_examples=30)
@given(st.sampled_from(sorted(WRITERS)), events, st.data())
def test_any_events_cut_anywhere_are_refused_or_replayed_to_their_end(writer, recorded, data):
    text = WRITERS[writer](recorded, AXES)
    begin, end = sorted((data.draw(st.integers(0, len(text))), data.draw(st.integers(0, len(text)))))
    refused_or_replayed(text[:begin])
    refused_or_replayed(text[begin:])
    refused_or_replayed(text[:begin] + text[end:])
    refused_or_replayed(text[:begin] + data.draw(st.text(max_size=20)) + text[begin:])


NUMBERS = st.sampled_from(
    ["nan", "inf", "-1", "1e400", "9" * 5000, "-" + "9" * 400, "0x35", "\N{ARABIC-INDIC DIGIT THREE}", "", "1_0"]
)
SHAPES = (
    "- [{}, {}, {}, {}, {}]",
    "    - [ {},  {}, 3, 53, {} ]",
    "Event: time {}.{}, type {} (X), code {} (Y), value {}",
    "Event: time 1.000000, type 3 (X), code 53 (Y), value {}",
    "[  {}.{}] {} {} {}",
    "[       1.000000] 0003 0035 {}",
    "{}-{}: 0003 0035 {}",
    "      53: [{}, {}, 0, 0, 0]",
    "      Min {}\n      Max {}",
    "    ABS (0003): 0035  : value {}, min {}, max {}, fuzz 0, flat 0, resolution 0",
    "    Event code {} (X)",
    "E: 000000.{} 9 01 {}",
)


@settings(max_examples=30)
@given(
    st.sampled_from(sorted(WRITERS)),
    st.lists(st.tuples(st.sampled_from(SHAPES), st.lists(NUMBERS, min_size=5, max_size=5)), max_size=8),
)
def test_hostile_numbers_are_refused_or_replayed_to_their_end(writer, lines):
    text = WRITERS[writer](TWO_FINGERS, AXES)
    hostile = "".join(f"{shape.format(*numbers)}\n" for shape, numbers in lines)
    refused_or_replayed(hostile + text)
    refused_or_replayed(text + hostile)
    middle = text.index("\n", len(text) // 2) + 1
    refused_or_replayed(text[:middle] + hostile + text[middle:])


@settings(max_examples=30)
@given(
    st.binary(max_size=200), st.sampled_from([b"", b"\xff\xfe", b"\xfe\xff", b"\xef\xbb\xbf", b"Event: time 1", b"ndevices: 1\n"])
)
def test_any_bytes_behind_any_mark_are_refused_or_replayed(tmp_path_factory, data, mark):
    file = Path(tmp_path_factory.getbasetemp()) / "any"
    file.write_bytes(mark + data)
    with contextlib.suppress(ConfigError):
        replayed(Recording.open(file))
