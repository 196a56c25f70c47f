"""`haptic-panel record` of a serial panel: the driver at one end of a pseudo-terminal, the panel from its manual at the other."""

import json
import os
import select
import shutil
import signal
import subprocess
import sys
import threading

import pytest
from patience import communicate
from peers.elo_panel import INITIAL, UNTOUCH, touch

from controller.board.devices import SerialTouch
from controller.cli import main
from controller.errors import ConfigError, TouchError
from controller.touch.live_source import LiveSource
from controller.touch.panel import Protocol
from controller.touch.recorder import open_recording, record
from controller.touch.recording import Recording
from controller.touch.replay import RecordingSource
from controller.touch.serial_panel import SerialPanel

PROGRAM = "import sys; from controller.cli import main; sys.exit(main(sys.argv[1:]))"
STREAM = touch(0, 0, INITIAL) + touch(1000, 500) + touch(2000, 1500) + touch(2000, 1500, UNTOUCH) + touch(4095, 4095, INITIAL)


@pytest.fixture
def port():
    far_end, near_end = os.openpty()
    yield far_end, os.ttyname(near_end)
    os.close(far_end)
    os.close(near_end)


def panel(device):
    return SerialPanel(SerialTouch(device=device, x_mm_from_axes=(210.0, 0.0, 0.0), y_mm_from_axes=(0.0, 148.0, 0.0)))


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
    figures = json.loads(capsys.readouterr().out)
    assert (figures["events"], figures["reports"], figures["warnings"]) == (0, 0, [])
    assert figures["duration_s"] == pytest.approx(0.01, abs=1e-6)
    assert Recording.open(file).x.maximum == 4095


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
        with pytest.raises(SystemExit) as ended:
            main(["record", "--out", str(file), "--seconds", seconds])
        assert ended.value.code == 2
    capsys.readouterr()


@pytest.mark.parametrize("out", ["absent/x.evemu", ".", "nul\0name"])
def test_a_file_that_cannot_be_made_is_named(tmp_path, out):
    with pytest.raises(TouchError, match="cannot be written"):
        open_recording(tmp_path / out)


def test_only_a_recording_is_written_over(tmp_path):
    notes = tmp_path / "board.toml"
    notes.write_text('name = "panel"\n')
    with pytest.raises(ConfigError, match="is no recording: it is left as it is"):
        open_recording(notes)
    assert notes.read_text() == 'name = "panel"\n'
    for old in ("", "# EVEMU 1.3\nN: a panel\n"):
        notes.write_text(old)
        open_recording(notes).close()
        assert notes.read_text() == ""
