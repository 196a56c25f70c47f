"""Calibration while the service plays: against panels whose axes and ghosts are known, each program the real one."""

import contextlib
import itertools
import json
import os
import re
import select
import shutil
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import pytest
from kernel.serial_finger import LARGEST, SerialPanel
from patience import wait_for
from tables import each_row

from controller.device.application_socket.client import PanelClient
from controller.device.application_socket.protocol import panel_messages
from controller.device.touch_calibration.running import axes_values
from controller.errors import CalibrationError

TRUE = np.array([[224.0, 3.5, -7.0], [-2.0, -161.0, 155.0]])  # mm from axes, 0 to 1: what the service does not know
BELIEVED = np.array([[210.0, 0.0, 0.0], [0.0, -148.0, 148.0]])
TARGETS = [(31.5, 22.2), (178.5, 22.2), (31.5, 125.8), (178.5, 125.8), (105.0, 74.0)]
PLAYS = ("armed", "playing")


@contextlib.contextmanager
def calibration(socket, *words, stdin=subprocess.DEVNULL):
    """`haptic-panel calibrate-touch --socket`."""
    command = [sys.executable, "-m", "controller", "calibrate-touch", "--socket", str(socket), "--json", *words]
    with subprocess.Popen(command, stdin=stdin, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        try:
            yield process
        finally:
            process.kill()


@pytest.fixture
def folder():
    """With a short name: a socket's path has at most 107 bytes."""
    path = Path(tempfile.mkdtemp(prefix="hp"))
    yield path
    shutil.rmtree(path, ignore_errors=True)


@pytest.fixture
def touched(board, bank_file, folder, tmp_path):
    """`haptic-panel run` with a touch panel whose axes it does not know, and an FPGA that is not there."""
    panel, socket, copy = SerialPanel(), folder / "touched.sock", tmp_path / "touched"
    shutil.copytree(board.folder, copy)
    head, tail = (copy / "board.toml").read_text().split("[touch]\n")
    link = tail.partition("[link]\n")[2].replace(
        'kind = "simulated"', f'kind = "serial"\ndevice = "{tmp_path / "fpga"}"\nbaud = 12_000_000'
    )
    x, y = BELIEVED.tolist()
    (copy / "board.toml").write_text(
        f'{head}[touch]\nkind = "serial_panel"\ndevice = "{panel.device}"\nx_mm_from_axes = {x}\ny_mm_from_axes = {y}\n'
        f'\n[application_socket]\npath = "{socket}"\n\n[realtime]\npriority = 0\nlock_memory = false\n\n[link]\n{link}'
    )
    command = [sys.executable, "-m", "controller", "run", "--board", copy, "--bank", bank_file]
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as service:
        wait_for("its socket", socket.exists)
        yield panel, socket
        service.terminate()


def axes_at(x_mm, y_mm):
    """What the panel reads where it is touched."""
    share = np.linalg.solve(TRUE[:, :2], np.array([x_mm, y_mm]) - TRUE[:, 2])
    return tuple(round(float(one) * LARGEST) for one in share)


def touch_all(touched, process, beside_mm=()):
    """Touch each place that is asked for, or one beside it, until the next is; the last line."""
    panel, socket = touched
    with PanelClient(str(socket), timeout_s=60.0) as watcher:
        watcher.subscribe("touches")
        number = 0
        while (line := json.loads(process.stdout.readline()))["at_mm"] is not None:
            assert line["step"] == number
            place_mm = np.array(line["at_mm"]) + (beside_mm[number] if number < len(beside_mm) else (0.0, 0.0))
            while number and all(touch.contact for touch in watcher.heard(panel_messages.Touch, 60.0)):
                pass  # the one before is lifted as soon as the panel is certain of it
            with panel.finger(itertools.repeat(axes_at(*place_mm))):
                select.select([process.stdout], [], [])
            number += 1
        return line


def off_mm(lines):
    """How far a map puts the corners of the axes from where they are."""
    rows = np.array([json.loads(line.partition(" = ")[2]) for line in lines])
    corners = np.array([[0, 0, 1], [1, 0, 1], [0, 1, 1], [1, 1, 1]])
    return np.hypot(*((rows - TRUE) @ corners.T)).max()


def test_axes_that_are_wrong_are_found_from_touches_on_known_places(touched):
    with calibration(touched[1]) as process:
        last = touch_all(touched, process)
        assert last["say"] == "all targets were touched"
        found = json.loads(process.stdout.readline())
        assert process.wait() == 0
    assert found["residual_mm"]["worst"] < 0.2
    assert off_mm(found["lines"]) < 0.2  # with 0.05 mm from step to step


def test_places_of_ones_own_and_a_touch_that_missed(touched):
    words = [word for place in TARGETS[:4] for word in ("--at", *map(str, place))]
    with calibration(touched[1], *words) as process:
        touch_all(touched, process, beside_mm=[(0.0, 0.0), (12.0, 0.0)])
        assert process.wait() == 78
        said = process.stderr.read()
    assert re.search(r"touch .*2.* is \d+\.\d mm off what the others say, more than 4 mm", said), said


def test_who_goes_in_the_middle_leaves_nothing_and_the_next_begins_anew(touched):
    _, socket = touched
    with PanelClient(str(socket), timeout_s=60.0) as watcher:
        alone = watcher.describe().clients.connected
        with calibration(socket) as process:
            assert json.loads(process.stdout.readline())["step"] == 0
            assert watcher.describe().clients.connected == alone + 1
            process.send_signal(signal.SIGKILL)
            process.wait()
        wait_for("its end", lambda: watcher.describe().clients.connected == alone)


def test_a_touch_at_the_edge_of_the_plate_says_nothing_of_where_it_was(touched):
    _, socket = touched
    with PanelClient(str(socket), timeout_s=60.0) as panel:
        about = panel.describe()
    at_mm = tuple(BELIEVED @ [0.25, 0.5, 1.0])
    assert axes_values(about, at_mm) == pytest.approx((0.25, 0.5))
    with pytest.raises(CalibrationError, match=r"at or beyond the plate's edge, at x = 210\.0 mm.*stop the service"):
        axes_values(about, (210.0, 70.0))


@each_row(
    ("words", "code", "said"),
    [
        (["--at", "300", "20", "--at", "10", "20", "--at", "10", "100"], 78, "target (300, 20) mm is not on the plate"),
        (["--at", "10", "20"], 78, "give 3 to 5 targets, not 1"),
        (["--ghosts"], 78, "nothing can be played: waiting for FPGA"),
        (["--lag"], 2, "--lag is of no use with --socket: stop the service"),
        (["--lag", "--reference", "/dev/input/event0"], 2, "--lag is of no use with --socket: stop the service"),
        (["--reference", "-"], 2, "--reference is of no use here: it goes with --lag"),
        (["--write"], 2, "--write is of no use with --socket"),
        (["--ghosts", "--at", "10", "20"], 2, "--at is of no use here"),
    ],
)
def test_what_cannot_be_is_one_line(touched, words, code, said):
    with calibration(touched[1], *words) as process:
        out, err = process.communicate()
    assert (process.returncode, out) == (code, "")
    assert said in err
    assert err.count("\n") == 1


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("", "nothing is said of the mouse any more: the page is gone"),
        ("steps\n", "standard input: JSON is malformed"),
        ('{"sent_ms": 1, "steps": []}\n', "standard input: Object missing required field `arrived_s`"),
    ],
)
def test_a_mouse_of_which_nothing_can_be_read_is_one_line(touched, line, said):
    with calibration(touched[1], "--lag", "--reference", "-", stdin=subprocess.PIPE) as process:
        out, err = process.communicate(line)
    assert (process.returncode, json.loads(out)["of"]) == (78, 20)
    assert said in err
    assert err.count("\n") == 1


def test_no_panel_is_one_line(folder):
    with calibration(folder / "none.sock") as process:
        _, err = process.communicate()
    assert process.returncode == 69
    assert "no panel to talk to" in err


@pytest.fixture
def ghostly(folder):
    """`haptic-panel serve` with or without ghosts, and a scene that plays by touch alone."""
    started = []

    def make(probability, fingers=0, scene="keyboard"):
        socket = folder / "panel.sock"
        words = ["--background", "--fingers", str(fingers), "--ghosts", str(probability), str(socket)]
        command = [sys.executable, "-m", "controller", "serve", *words]
        done = subprocess.run(command, capture_output=True, text=True, check=True)
        started.append(int(re.search(r"`kill (\d+)`", done.stderr)[1]))
        with PanelClient(str(socket), timeout_s=60.0) as panel:
            if scene:
                panel.load_scene(scene)
            next(state for state in panel.states() if state.state in PLAYS)
        return socket

    yield make
    for pid in started:
        os.kill(pid, signal.SIGTERM)


@pytest.mark.slow
@pytest.mark.parametrize("probability", [0.4, 0.0])
def test_ghosts_are_found_where_there_are_some_and_nowhere_else(ghostly, probability):
    """They live for at most four scans of 7 ms: up to 28 ms from an emission's end to the last report's end."""
    with calibration(ghostly(probability), "--ghosts") as process:
        lines = [json.loads(line) for line in process.stdout]
        assert process.wait() == 0, process.stderr.read()
    found, steps = lines[-1], [line["step"] for line in lines[:-1]]
    assert steps == list(range(len(steps)))
    assert found["emissions"] >= 200
    if probability:
        assert found["ghosts"] >= 60
        assert 20.0 <= found["gone_ms"]["longest"] <= 29.0
        assert found["ghost_ms"] == np.ceil(found["gone_ms"]["longest"] + 5)
        assert found["lines"] == [f"ghost_ms = {found['ghost_ms']:.1f}"]
        assert found["size_mm"] == {"median": 6.0, "largest": 6.0}
    else:
        assert (found["ghosts"], found["lines"]) == (0, ["ghost_ms = 0.0"])


@pytest.mark.parametrize(
    ("fingers", "scene", "said"),
    [(1, "keyboard", "contacts are no ghosts"), (0, "", "the scene plays without a finger at 'beacon': load another scene")],
)
def test_what_is_no_measurement_of_ghosts_is_refused(ghostly, fingers, scene, said):
    with calibration(ghostly(0.2, fingers, scene), "--ghosts") as process:
        _, err = process.communicate()
    assert process.returncode == 78
    assert said in err


def test_outputs_that_go_off_end_it_and_a_ghost_is_never_felt(ghostly):
    socket = ghostly(1.0)
    with PanelClient(str(socket), timeout_s=60.0) as panel, calibration(socket, "--ghosts") as process:
        for line in process.stdout:
            if json.loads(line)["step"] == 5:
                break
        panel.subscribe("emissions")
        seen = [panel.heard(panel_messages.Emissions, 10.0) for _ in range(10)]
        assert {focus.of for batch in seen for one in batch for focus in one.foci} == {"click"}
        panel.stop()
        process.stdout.read()
        assert process.wait() == 78
        assert "a click was refused: the outputs are off" in process.stderr.read()
