"""Recording a panel: evemu text; `haptic-panel record` of a serial panel on a pseudo-terminal, its manual at the far end."""

import json
import os
import re
import resource
import select
import shutil
import signal
import subprocess
import sys
import threading
from io import FileIO
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from patience import communicate
from peers.elo_panel import INITIAL, UNTOUCH, touch
from tables import each_row

from controller.cli import main
from controller.device.touch.event_codes import Protocol
from controller.device.touch.event_reader import AxisInfo, DeviceDescription
from controller.device.touch.live_source import LiveSource
from controller.device.touch.panels.serial_panel import EloTouch, SerialPanel
from controller.device.touch.recordings.recorder import MASK_BYTES, EvemuWriter, head, open_recording, record
from controller.device.touch.recordings.recording import Recording
from controller.device.touch.recordings.replay import RecordingSource
from controller.errors import ConfigError, TouchError

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


@each_row("name", WHOLE)
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
@given(st.lists(st.tuples(events, st.floats(0, 300)), min_size=1, max_size=12), st.floats(0, 1e7))
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
    assert again == text[text.index("\nE:") + 1 :]
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
from controller.device.touch.event_reader import DeviceDescription
from controller.device.touch.recordings.recorder import EvemuWriter
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


PROGRAM = "import sys; from controller.cli import main; sys.exit(main(sys.argv[1:]))"
STREAM = touch(0, 0, INITIAL) + touch(20, 10) + touch(40, 30) + touch(40, 30, UNTOUCH) + touch(4095, 4095, INITIAL)


@pytest.fixture
def port():
    far_end, near_end = os.openpty()
    yield far_end, os.ttyname(near_end)
    os.close(far_end)
    os.close(near_end)


def panel(device):
    return SerialPanel(EloTouch(device=device, x_mm_from_axes=(210.0, 0.0, 0.0), y_mm_from_axes=(0.0, 148.0, 0.0)))


def reports_of(path):
    return path.read_text().count(" 0000 0000 0000\nE: ") + 1 if path.exists() and "\nE: " in path.read_text() else 0


def interrupt_when(condition):
    """Ctrl-C for this process once it has done what is waited for."""
    while not condition():
        pass
    os.kill(os.getpid(), signal.SIGINT)


def replayed(path, board):
    recording = Recording.open(path)
    replay = RecordingSource(recording, recording.axes(board), 0.0)
    samples = []
    while (due_s := replay.next_time_s()) is not None:
        samples += replay.read(due_s)
    return recording, samples, replay


def test_a_replay_gives_what_the_panel_gave(port, board, tmp_path):
    far_end, device = port
    file = tmp_path / "elo.evemu"
    reader = panel(device)
    os.write(far_end, STREAM)
    interrupting = threading.Thread(target=interrupt_when, args=(lambda: reports_of(file) == 5,))
    interrupting.start()
    with open_recording(file) as opened:
        done = record(reader, opened, 60.0)
    interrupting.join()
    source = LiveSource(reader, board)
    os.write(far_end, STREAM)
    live = []
    while len(live) < 5:
        select.select([source.fileno()], [], [], 1.0 if source.next_time_s() else 0.0)
        live += source.read(0.0)
    source.close()
    recording, samples, replay = replayed(file, board)
    assert recording.protocol is Protocol.SINGLE
    assert samples.pop().contact is False  # of the finger that is still down at the end
    assert [(*s[:3], *s[4:]) for s in samples] == [(*s[:3], *s[4:]) for s in live]
    assert replay.warnings == {"still_down_at_end": 1}
    assert (done.device, done.reports, done.warnings) == ("Elo SmartSet", 5, [])
    assert done.events == len(recording.events)


def board_with(tmp_path, board, device):
    """A folder with the simulated board, and this panel."""
    folder = tmp_path / "board"
    shutil.copytree(board.folder, folder)
    text = (folder / "board.toml").read_text()
    assert 'kind = "recording"\nrecording = "demo.evemu"\n' in text
    text = text.replace('kind = "recording"\nrecording = "demo.evemu"\n', f'kind = "serial_panel"\ndevice = "{device}"\n')
    (folder / "board.toml").write_text(text)
    return folder


def test_ctrl_c_ends_a_recording_that_is_whole(port, board, tmp_path):
    far_end, device = port
    file = tmp_path / "elo.evemu"
    command = [sys.executable, "-c", PROGRAM, "record", "--board", str(board_with(tmp_path, board, device)), "--out", str(file)]
    recorder = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert "recording 'Elo SmartSet'; Ctrl-C ends it" in recorder.stderr.readline()
    os.write(far_end, STREAM)
    while reports_of(file) < 5:
        assert recorder.poll() is None
    recorder.send_signal(signal.SIGINT)
    out, errors = communicate(recorder)
    assert recorder.returncode == 0
    assert errors == ""
    assert "Elo SmartSet" in out
    assert len(replayed(file, board)[1]) == 6


def test_it_stops_by_itself_and_tells_figures(port, board, tmp_path, capsys):
    folder, file = board_with(tmp_path, board, port[1]), tmp_path / "none.evemu"
    assert main(["record", "--board", str(folder), "--out", str(file), "--seconds", "0.01", "--json"]) == 0
    out, errors = capsys.readouterr()
    figures = json.loads(out)
    assert (figures["events"], figures["reports"], figures["warnings"]) == (0, 0, [])
    assert errors == f"haptic-panel: {file}: holds no event, as the panel sent none: it cannot be replayed\n"
    assert figures["duration_s"] == pytest.approx(0.01, abs=1e-6)
    assert Recording(file.read_text()).x.maximum == 4095
    with pytest.raises(ConfigError, match="holds no event"):
        Recording.open(file)


def test_a_full_disk_is_one_line(port, board, tmp_path, capsys):
    folder = board_with(tmp_path, board, port[1])
    assert main(["record", "--board", str(folder), "--out", "/dev/full", "--seconds", "1"]) == 69
    errors = capsys.readouterr().err.splitlines()
    assert len(errors) == 2
    assert "/dev/full: cannot be written (No space left on device)" in errors[-1]


def test_what_cannot_be_recorded_is_said_in_one_line(tmp_path, capsys):
    file = tmp_path / "x.evemu"
    assert main(["record", "--out", str(file)]) == 69  # the simulated board has no panel
    assert main(["record", "--device", "/dev/input/absent", "--out", str(file)]) == 69
    assert main(["record", "--device", "no such panel", "--out", str(file)]) == 69
    assert len(capsys.readouterr().err.splitlines()) == 3
    assert not file.exists()
    for seconds in ("0", "-1", "nan", "soon"):
        assert main(["record", "--out", str(file), "--seconds", seconds]) == 2
    assert len(capsys.readouterr().err.splitlines()) == 4


@each_row("out", ["absent/x.evemu", ".", "nul\0name"])
def test_a_file_that_cannot_be_made_is_named(tmp_path, out):
    with pytest.raises(TouchError, match="cannot be written"):
        open_recording(tmp_path / out)


def test_only_a_recording_is_written_over(tmp_path):
    notes = tmp_path / "board.toml"
    notes.write_text('name = "panel"\n')
    with pytest.raises(ConfigError, match="is no recording: it is left unchanged"):
        open_recording(notes)
    assert notes.read_text() == 'name = "panel"\n'
    for old in ("", "# EVEMU 1.3\nN: a panel\n"):
        notes.write_text(old)
        open_recording(notes).close()
        assert notes.read_text() == ""
