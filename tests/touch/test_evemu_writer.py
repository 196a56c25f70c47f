import re
import resource
import subprocess
import sys
from io import FileIO
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from controller.touch.evemu_writer import MASK_BYTES, EvemuWriter, head
from controller.touch.event_reader import AxisInfo, DeviceDescription
from controller.touch.recording import Recording

FOLDER = Path(__file__).parent / "recordings"
WHOLE = ["atmel_maxtouch_touchscreen.1-finger-fast-taps.events", "dell_canvas_touch.evemu", "ep0430m09.4-finger-drag-down.events"]


def bits(rows):
    """Numbers of the bits that are set in rows of hexadecimal bytes."""
    data = bytes.fromhex("".join(rows))
    return tuple(8 * k + bit for k, byte in enumerate(data) for bit in range(8) if byte >> bit & 1)


def description_of(text):
    """What the description lines of somebody else's recording say."""
    fields = re.findall(r"^([NIPBA]): (.*)$", text, re.MULTILINE)
    masks = {}
    for letter, rest in fields:
        if letter == "B":
            kind, row = rest.split(" ", 1)
            masks.setdefault(int(kind, 16), []).append(row)
    axes = {}
    for letter, rest in fields:
        if letter == "A":
            code, *numbers = rest.split()
            axes[int(code, 16)] = AxisInfo(*map(int, numbers))
    (name,) = (rest for letter, rest in fields if letter == "N")
    (numbers,) = (rest for letter, rest in fields if letter == "I")
    properties = bits([rest for letter, rest in fields if letter == "P"])
    codes = {kind: bits(rows) for kind, rows in masks.items()}
    return DeviceDescription(name, *(int(number, 16) for number in numbers.split()), properties, codes, axes)


@pytest.mark.parametrize("name", WHOLE)
def test_the_description_of_a_real_recording_is_written_as_evemu_wrote_it(name):
    text = (FOLDER / name).read_text(encoding="utf-8")
    wanted = [line.rstrip() for line in text.splitlines() if re.match("[NIPBA]:", line)]
    written = head(description_of(text)).splitlines()
    assert written[0] == "# EVEMU 1.3"
    assert written[1:] == wanted


def stored(path, events, description=None):
    """Each event a report of its own time."""
    with FileIO(path, "w") as file:
        writer = EvemuWriter(file, description or DeviceDescription("panel"))
        for event in events:
            writer.write([event], event[3])
    return path.read_text(encoding="utf-8")


int32 = st.integers(-(1 << 31), (1 << 31) - 1)
events = st.tuples(st.integers(0, 0x1F), st.integers(0, 0x2FF), int32)
axes = st.builds(AxisInfo, int32, int32, int32, int32, int32)


@settings(max_examples=50)
@given(st.lists(st.tuples(events, st.floats(0, 300)), max_size=12), st.floats(0, 1e7))
def test_what_is_written_is_read_again_to_the_microsecond(tmp_path_factory, found, begin_s):
    path = tmp_path_factory.getbasetemp() / "written.evemu"
    time_s, written = begin_s, []
    for event, later_s in found:
        written.append((*event, time_s))
        time_s += later_s
    text = stored(path, written)
    recording = Recording.open(path)
    assert set(recording.warnings) <= {"no_axis_lines"}
    again = "".join(f"E: {time_s:.6f} {kind:04x} {code:04x} {value:04d}\n" for kind, code, value, time_s in recording.events)
    assert again == text[text.index("\nE:") + 1 :] if found else "E:" not in text
    kept = [event for event in recording.events if event[:3] != (0, 0, 0)]
    wanted = [event for event in written if event[:3] != (0, 0, 0)]
    assert [event[:3] for event in kept] == [event[:3] for event in wanted]
    assert all(abs(k[3] - (w[3] - begin_s)) < 2e-6 for k, w in zip(kept, wanted, strict=True))


@settings(max_examples=50)
@given(st.text(), st.lists(int32, min_size=4, max_size=4), st.dictionaries(st.integers(0, 0x3F), axes), st.data())
def test_any_description_is_read_without_a_warning(name, numbers, declared, data):
    codes = {kind: tuple(data.draw(st.sets(st.integers(-5, 1000), max_size=5))) for kind in MASK_BYTES}
    description = DeviceDescription(name, *numbers, (1, 70, -1), codes, declared)
    recording = Recording(head(description))
    assert not recording.warnings
    assert head(description).count("\n") == len(head(description).splitlines())


def test_a_pause_of_minutes_is_bridged_by_empty_reports(tmp_path):
    text = stored(tmp_path / "pause.evemu", [(3, 0x35, 5, 10.0), (3, 0x35, 6, 135.0)])
    assert text.splitlines()[-4:] == [
        "E: 0.000000 0003 0035 0005",
        "E: 50.000000 0000 0000 0000",
        "E: 100.000000 0000 0000 0000",
        "E: 125.000000 0003 0035 0006",
    ]
    assert Recording.open(tmp_path / "pause.evemu").events[-1][3] == 125.0


def test_negative_values_are_written_as_evemu_writes_them(tmp_path):
    assert stored(tmp_path / "lifted.evemu", [(3, 0x39, -1, 0.0)]).endswith("E: 0.000000 0003 0039 -001\n")


FILL = """
import resource, sys
from io import FileIO
from controller.touch.event_reader import DeviceDescription
from controller.touch.evemu_writer import EvemuWriter
resource.setrlimit(resource.RLIMIT_FSIZE, (int(sys.argv[2]), int(sys.argv[2])))
file = FileIO(sys.argv[1], "w")
writer = EvemuWriter(file, DeviceDescription("panel"))
try:
    while True:
        writer.write([(3, 0x35, 100, 0.0), (3, 0x36, 200, 0.0), (0, 0, 0, 0.0)], 0.0)
except OSError as error:
    print(error.errno)
"""


def test_when_there_is_no_more_room_the_recording_ends_with_a_whole_report(tmp_path):
    """A limit of the process stands for a full disk: a write is cut short, the next one fails."""
    path = tmp_path / "full.evemu"
    limit = len(head(DeviceDescription("panel"))) + 1000
    assert resource.getrlimit(resource.RLIMIT_FSIZE)[1] in (resource.RLIM_INFINITY, -1)
    done = subprocess.run([sys.executable, "-c", FILL, str(path), str(limit)], capture_output=True, text=True, check=True)
    assert done.stdout == "27\n"  # EFBIG
    text = path.read_text()
    reports = text.count("E: 0.000000 0000 0000 0000\n")
    assert reports == 1000 // 81
    assert text.endswith("E: 0.000000 0000 0000 0000\n")
    assert len(Recording.open(path).events) == 3 * reports
