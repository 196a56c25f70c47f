"""Runs in the guest: every driver of touch panels against real event devices, a real I2C bus and real GPIO lines.

Behind the event devices is uinput; behind the bus, GT911 and FT5x06 from their data sheets (tests/device/touch/peers).
"""

import contextlib
import errno
import json
import os
import select
import shutil
import signal
import subprocess
import sys
import time
from collections import Counter
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent / "device/touch"))

from evdev import AbsInfo, InputDevice, UInput  # noqa: E402
from evdev import ecodes as e  # noqa: E402
from far_end_i2c import FarEnd, bus_path  # noqa: E402
from gpio_lines import GpioLines  # noqa: E402
from peers.ft5x06_chip import Ft5x06Chip  # noqa: E402
from peers.gt911_chip import STATUS, Gt911Chip  # noqa: E402

from controller.device.board.board import load_board  # noqa: E402
from controller.device.board.lookup import find_board  # noqa: E402
from controller.device.touch.drivers.event_device import LinuxInput  # noqa: E402
from controller.device.touch.event_codes import Protocol  # noqa: E402
from controller.device.touch.live_source import LiveSource  # noqa: E402
from controller.device.touch.panels.ft5x06 import Ft5x06Touch  # noqa: E402
from controller.device.touch.panels.ft5x06 import open_panel as open_ft5x06  # noqa: E402
from controller.device.touch.panels.gt911 import Gt911Touch  # noqa: E402
from controller.device.touch.panels.gt911 import open_panel as open_gt911  # noqa: E402
from controller.device.touch.recordings.recording import Recording  # noqa: E402
from controller.device.touch.recordings.replay import RecordingSource  # noqa: E402
from controller.device.touch_calibration.mouse import Mouse  # noqa: E402
from controller.errors import TouchError  # noqa: E402

BOARD = load_board(find_board("simulated"))
DEADLINE_S = 20.0
RECORDER_S = 60.0  # Python has much to import in a guest
AXES_MM = {"x_mm_from_axes": (210.0, 0.0, 0.0), "y_mm_from_axes": (0.0, 148.0, 0.0)}
RECORDINGS = HERE.parent / "device/touch/recordings"
PANEL_B = {
    e.EV_KEY: [e.BTN_TOUCH],
    e.EV_ABS: [
        (e.ABS_MT_SLOT, AbsInfo(0, 0, 9, 0, 0, 0)),
        (e.ABS_MT_TOUCH_MAJOR, AbsInfo(0, 0, 255, 0, 0, 0)),
        (e.ABS_MT_POSITION_X, AbsInfo(0, 0, 2100, 0, 0, 10)),
        (e.ABS_MT_POSITION_Y, AbsInfo(0, 0, 1480, 0, 0, 10)),
        (e.ABS_MT_TRACKING_ID, AbsInfo(0, 0, 65535, 0, 0, 0)),
    ],
}

MOUSE = {e.EV_KEY: [e.BTN_LEFT], e.EV_REL: [e.REL_X, e.REL_Y]}


def raised(action):
    """The words of the TouchError that an action raises."""
    try:
        action()
    except TouchError as error:
        return str(error)
    raise AssertionError("nothing was raised")


def uinput(capabilities, name):
    return UInput(capabilities, name=name, input_props=[e.INPUT_PROP_DIRECT])


def send(panel, *events):
    """Axis events (code, value) or (type, code, value) of one report."""
    for event in events:
        kind, code, value = event if len(event) == 3 else (e.EV_ABS, *event)
        panel.write(kind, code, value)
    panel.syn()


TOUCH = (e.EV_KEY, e.BTN_TOUCH, 1)


def finger(slot, tracking_id, x, y, size=80):
    return [
        (e.ABS_MT_SLOT, slot),
        (e.ABS_MT_TRACKING_ID, tracking_id),
        (e.ABS_MT_TOUCH_MAJOR, size),
        (e.ABS_MT_POSITION_X, x),
        (e.ABS_MT_POSITION_Y, y),
    ]


def until(source, count=None, condition=None):
    """Samples read as the event loop would, until there are `count` of them or the condition holds."""
    samples = []
    ends_s = time.monotonic() + DEADLINE_S
    while not (len(samples) >= count if count is not None else condition()):
        now_s = time.monotonic()
        assert now_s < ends_s, (samples, dict(source.warnings))
        next_s = source.next_time_s()
        wait_s = 0.5 if next_s is None else min(max(next_s - now_s, 0.0), 0.5)
        fileno = source.fileno()
        select.select([] if fileno is None else [fileno], [], [], wait_s)
        now_s = time.monotonic()
        found = source.read(now_s)
        assert all(sample.time_s <= now_s for sample in found)
        samples += found
    assert [sample.time_s for sample in samples] == sorted(sample.time_s for sample in samples)
    return samples


def places(samples):
    return [(s.finger, round(s.x_m * 1e3, 1), round(s.y_m * 1e3, 1), s.contact) for s in samples]


# ---- panels with a kernel driver


def test_fingers_of_an_event_device_have_places_sizes_and_times_of_the_monotonic_clock():
    panel = uinput(PANEL_B, "panel of protocol B")
    source = LiveSource(LinuxInput("panel of protocol B"), BOARD)
    before_s = time.monotonic()
    send(panel, *finger(0, 7, 100, 200), *finger(1, 8, 2000, 1400, 120), TOUCH)
    samples = until(source, 2)
    assert places(samples) == [(0, 10, 20, True), (1, 200, 140, True)]
    assert [round(s.size_m * 1e3, 6) for s in samples] == [8, 12]
    assert before_s <= samples[0].time_s == samples[1].time_s <= time.monotonic()
    send(panel, (e.ABS_MT_SLOT, 0), (e.ABS_MT_POSITION_X, 110))
    send(panel, (e.ABS_MT_TRACKING_ID, -1))
    assert places(until(source, 2)) == [(0, 11, 20, True), (0, 11, 20, False)]
    assert source.counts.contacts == 2
    assert not source.warnings
    source.close()
    panel.close()


def test_a_finger_that_is_down_when_the_panel_is_opened_is_there():
    panel = uinput(PANEL_B, "touched before")
    send(panel, *finger(3, 7, 100, 200), TOUCH)
    source = LiveSource(LinuxInput(panel.device.path), BOARD)
    assert places(until(source, 1)) == [(0, 10, 20, True)]
    send(panel, (e.ABS_MT_POSITION_Y, 210))  # slot 3 is still the current one
    assert places(until(source, 1)) == [(0, 10, 21, True)]
    source.close()
    panel.close()


def test_after_lost_events_the_state_is_read_and_the_finger_that_stayed_is_the_same():
    panel = uinput(PANEL_B, "flooded")
    source = LiveSource(LinuxInput("flooded"), BOARD)
    send(panel, *finger(0, 7, 100, 200), *finger(1, 8, 300, 400), TOUCH)
    assert places(until(source, 2)) == [(0, 10, 20, True), (1, 30, 40, True)]
    for k in range(3000):
        send(panel, (e.ABS_MT_SLOT, 0), (e.ABS_MT_POSITION_X, 100 + k % 15), (e.ABS_MT_POSITION_Y, 200 + k % 7))
    send(panel, (e.ABS_MT_POSITION_X, 115), (e.ABS_MT_POSITION_Y, 205), *finger(1, 9, 600, 700), *finger(2, 10, 800, 900))
    samples = places(until(source, condition=lambda: source.counts.contacts >= 4))
    assert samples[-4:] == [(1, 30, 40, False), (0, 11.5, 20.5, True), (2, 60, 70, True), (3, 80, 90, True)], samples[-6:]
    assert source.warnings["dropped"] == 1
    send(panel, (e.ABS_MT_POSITION_X, 810))
    assert places(until(source, 1)) == [(3, 81, 90, True)]
    source.close()
    panel.close()


def test_a_panel_that_is_unplugged_lifts_its_fingers_and_is_found_again_by_its_name():
    panel = uinput(PANEL_B, "unplugged")
    source = LiveSource(LinuxInput("unplugged"), BOARD)
    send(panel, *finger(0, 7, 100, 200), TOUCH)
    until(source, 1)
    panel.close()
    assert places(until(source, 1)) == [(0, 10, 20, False)]
    assert not source.present
    assert source.fileno() is None
    other_axes = {**PANEL_B, e.EV_ABS: [(code, info._replace(max=info.max * 2)) for code, info in PANEL_B[e.EV_ABS]]}
    panel = uinput(other_axes, "unplugged")
    until(source, condition=lambda: source.present)
    send(panel, *finger(0, 7, 200, 400), TOUCH)
    assert places(until(source, 1)) == [(1, 10, 20, True)]
    assert source.warnings == {"panel_lost": 1}
    assert source.counts.contacts == 2
    source.close()
    panel.close()


def test_a_panel_is_found_again_by_its_stable_path():
    path = Path("/run/by-path-of-a-panel")
    panel = uinput(PANEL_B, "by path")
    path.symlink_to(panel.device.path)
    source = LiveSource(LinuxInput(str(path)), BOARD)
    panel.close()
    until(source, condition=lambda: not source.present)
    path.unlink()
    panel = uinput(PANEL_B, "by path, another name")
    path.symlink_to(panel.device.path)
    until(source, condition=lambda: source.present)
    send(panel, *finger(0, 7, 100, 200), TOUCH)
    assert places(until(source, 1)) == [(0, 10, 20, True)]
    source.close()
    panel.close()


def test_two_panels_of_one_name_are_listed():
    panels = [uinput(PANEL_B, "twin") for _ in range(2)]
    words = raised(lambda: LinuxInput("twin"))
    assert all(panel.device.path in words for panel in panels), words
    panels[0].close()
    LinuxInput("twin").close()
    panels[1].close()
    assert "no touch panel named 'twin'" in raised(lambda: LinuxInput("twin"))


def test_what_is_no_touch_panel_is_refused_by_what_it_lacks_whether_it_is_given_by_path_or_by_name():
    flat = {e.EV_KEY: [e.BTN_TOUCH], e.EV_ABS: [(e.ABS_X, AbsInfo(0, 0, 0, 0, 0, 0)), (e.ABS_Y, AbsInfo(0, 0, 9, 0, 0, 0))]}
    stick = [(code, AbsInfo(0, 0, 255, 0, 0, 0)) for code in (e.ABS_X, e.ABS_Y)]
    others = (
        ({e.EV_KEY: [e.KEY_A]}, [], "no position axes: a keyboard"),
        (MOUSE, [], "only steps: a mouse?"),
        ({e.EV_KEY: [e.BTN_SOUTH, e.BTN_EAST], e.EV_ABS: stick}, [], "a gamepad or joystick?"),
        (
            {e.EV_KEY: [e.BTN_LEFT, e.BTN_TOOL_FINGER, e.BTN_TOUCH], e.EV_ABS: PANEL_B[e.EV_ABS]},
            [e.INPUT_PROP_POINTER],
            "a touchpad?",
        ),
        ({e.EV_KEY: [e.BTN_TOOL_PEN, e.BTN_TOUCH], e.EV_ABS: stick}, [e.INPUT_PROP_DIRECT], "a pen or a tablet?"),
    )
    for capabilities, properties, words in others:
        device = UInput(capabilities, name="odd", input_props=properties)
        for given in (device.device.path, "odd"):
            refusal = raised(lambda given=given: LinuxInput(given))
            assert words in refusal, refusal
            assert device.device.path in refusal
            assert "\n" not in refusal
        panel = uinput(PANEL_B, "odd")  # another node with the same name
        LinuxInput("odd").close()
        panel.close()
        device.close()
    device = uinput(flat, "flat")
    assert "range from 0 to 0" in raised(lambda: LinuxInput("flat"))
    device.close()
    assert "no input device" in raised(lambda: LinuxInput("/dev/input/event99"))
    assert "is no input device" in raised(lambda: LinuxInput("/dev/zero"))


def test_a_grabbed_panel_is_ours_alone():
    panel = uinput(PANEL_B, "grabbed")
    reader = LinuxInput("grabbed", grab=True)
    other = InputDevice(panel.device.path)
    source = LiveSource(reader, BOARD)
    until(source, condition=lambda: source.next_time_s() is None)
    send(panel, *finger(0, 7, 100, 200), TOUCH)
    until(source, 1)
    assert other.read_one() is None
    assert "grabbed by another program" in raised(lambda: LinuxInput("grabbed", grab=True))
    source.close()
    other.grab()
    other.close()
    panel.close()


def test_protocol_a_without_slots():
    axes = [axis for axis in PANEL_B[e.EV_ABS] if axis[0] in (e.ABS_MT_POSITION_X, e.ABS_MT_POSITION_Y)]
    panel = uinput({e.EV_KEY: [e.BTN_TOUCH], e.EV_ABS: axes}, "panel of protocol A")
    source = LiveSource(LinuxInput("panel of protocol A"), BOARD)
    until(source, condition=lambda: source.next_time_s() is None)
    end = (e.EV_SYN, e.SYN_MT_REPORT, 0)
    one, two = (
        [(e.ABS_MT_POSITION_X, 100), (e.ABS_MT_POSITION_Y, 200), end],
        [(e.ABS_MT_POSITION_X, 900), (e.ABS_MT_POSITION_Y, 800), end],
    )
    send(panel, *one, *two)
    assert places(until(source, 2)) == [(0, 10, 20, True), (1, 90, 80, True)]
    send(panel, *two)
    send(panel, end)
    assert places(until(source, 2)) == [(0, 10, 20, False), (1, 90, 80, False)]
    source.close()
    panel.close()


def test_a_single_touch_panel():
    axes = [(e.ABS_X, AbsInfo(0, -1000, 1000, 0, 0, 0)), (e.ABS_Y, AbsInfo(0, 0, 500, 0, 0, 0))]
    panel = uinput({e.EV_KEY: [e.BTN_TOUCH], e.EV_ABS: axes}, "one finger")
    send(panel, (e.ABS_X, 500), (e.ABS_Y, 250), TOUCH)
    source = LiveSource(LinuxInput("one finger"), BOARD)
    assert places(until(source, 1)) == [(0, 157.5, 74, True)]
    send(panel, (e.ABS_X, 480))
    send(panel, (e.EV_KEY, e.BTN_TOUCH, 0))
    assert places(until(source, 2)) == [(0, 155.4, 74, True), (0, 155.4, 74, False)]
    source.close()
    panel.close()


def test_a_report_of_ten_fingers_comes_in_parts_and_a_flood_a_report_at_a_time():
    panel = uinput(PANEL_B, "ten fingers")
    source = LiveSource(LinuxInput("ten fingers"), BOARD)
    until(source, condition=lambda: source.next_time_s() is None)
    send(panel, *[event for slot in range(10) for event in finger(slot, slot, 200 * slot + 5, 100 * slot + 7)], TOUCH)
    assert [sample[0] for sample in places(until(source, 10))] == list(range(10))
    for k in range(20):
        send(panel, (e.ABS_MT_POSITION_X, 1800 + k))
    reports = [source.read(time.monotonic()) for _ in range(20)]
    assert [len(report) for report in reports] == [1] * 20
    assert source.read(time.monotonic()) == ()
    source.close()
    panel.close()


def test_a_recording_of_a_panel_gives_the_samples_that_the_panel_gave():
    """The real recording with four fingers through uinput: read live and stored by `haptic-panel record` at once."""
    played = Recording.open(RECORDINGS / "ep0430m09.4-finger-drag-down.events")
    x, y = played.x, played.y
    capabilities = {
        e.EV_KEY: [e.BTN_TOUCH],
        e.EV_ABS: [
            (e.ABS_X, AbsInfo(0, x.minimum, x.maximum, 0, 0, 0)),
            (e.ABS_Y, AbsInfo(0, y.minimum, y.maximum, 0, 0, 0)),
            (e.ABS_MT_SLOT, AbsInfo(0, 0, 4, 0, 0, 0)),
            (e.ABS_MT_POSITION_X, AbsInfo(0, x.minimum, x.maximum, 0, 0, 0)),
            (e.ABS_MT_POSITION_Y, AbsInfo(0, y.minimum, y.maximum, 0, 0, 0)),
            (e.ABS_MT_TRACKING_ID, AbsInfo(0, 0, 65535, 0, 0, 0)),
        ],
    }
    panel = uinput(capabilities, "four fingers")
    resting = [(e.ABS_MT_SLOT, 4), (e.ABS_MT_TRACKING_ID, 60000), (e.ABS_MT_POSITION_X, 9), (e.ABS_MT_POSITION_Y, 9), TOUCH]
    send(panel, *resting)
    file = Path("/run/four.evemu")
    program = "import sys; from controller.cli import main; sys.exit(main(sys.argv[1:]))"
    command = [sys.executable, "-c", program, "record", "--device", panel.device.path, "--out", str(file), "--json"]
    recorder = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    ends_s = time.monotonic() + RECORDER_S
    while not (file.exists() and b"E: " in file.read_bytes()):  # the state at its start is stored
        assert time.monotonic() < ends_s
        assert recorder.poll() is None, recorder.communicate()
        time.sleep(0.05)
    source = LiveSource(LinuxInput(panel.device.path), BOARD)
    live = until(source, 1)
    for kind, code, value, _ in played.events:
        panel.write(kind, code, value)
        if (kind, code) == (e.EV_SYN, e.SYN_REPORT):
            live += source.read(time.monotonic())
    while source.counts.contacts < 5 or source.next_time_s() is not None:
        live += source.read(time.monotonic())
    send(panel, (e.ABS_MT_SLOT, 4), (e.ABS_MT_TRACKING_ID, 65000), (e.ABS_MT_POSITION_X, 11), TOUCH)
    while not live or live[-1].finger != 5:
        live += until(source, 1)
    while "0003 0039 65000" not in file.read_text():
        assert time.monotonic() < ends_s, file.read_text()[-400:]
        time.sleep(0.05)
    recorder.send_signal(signal.SIGINT)
    out, errors = recorder.communicate(timeout=DEADLINE_S)
    assert recorder.returncode == 0, errors
    stored = json.loads(out)
    assert stored["device"] == "four fingers"
    assert not stored["warnings"]
    recording = Recording.open(file)
    assert recording.protocol is Protocol.B
    replay = RecordingSource(recording, recording.axes(BOARD), 0.0)
    again = []
    while (due_s := replay.next_time_s()) is not None:
        again += replay.read(due_s)
    assert again.pop().contact is False  # of the finger that is still down at the end
    assert [(*s[:3], *s[4:]) for s in again] == [(*s[:3], *s[4:]) for s in live]
    offset_s = live[1].time_s - again[1].time_s  # the first is of the state, which each of both read at its own time
    assert all(abs(s.time_s - t.time_s - offset_s) < 3e-6 for s, t in zip(live[1:], again[1:], strict=True))
    assert replay.warnings == {"still_down_at_end": 1}
    assert len({s.finger for s in again}) == 6
    source.close()
    panel.close()


def test_a_mouse_tells_its_steps_with_times_of_the_monotonic_clock():
    device = UInput(MOUSE, name="mouse")
    mouse = Mouse(device.device.path)
    assert mouse.read() == []
    before_s = time.monotonic()
    send(device, (e.EV_REL, e.REL_X, 3), (e.EV_REL, e.REL_Y, -2))
    send(device, (e.EV_KEY, e.BTN_LEFT, 1), (e.EV_REL, e.REL_X, 1))
    steps = []
    while len(steps) < 3:
        steps += mouse.read()
    after_s = time.monotonic()
    assert [step[:3] for step in steps] == [(e.EV_REL, e.REL_X, 3), (e.EV_REL, e.REL_Y, -2), (e.EV_REL, e.REL_X, 1)]
    assert all(before_s - 1e-5 <= step[3] <= after_s for step in steps)
    device.close()
    assert "the mouse was disconnected" in raised(mouse.read)
    mouse.close()
    panel = uinput(PANEL_B, "no mouse")
    assert "is no mouse" in raised(lambda: Mouse(panel.device.path))
    assert "cannot be opened" in raised(lambda: Mouse("/dev/input/event99"))
    assert "cannot be opened" in raised(lambda: Mouse("/dev/zero"))
    panel.close()


def test_a_lag_is_measured_from_both_devices_at_once_and_strokes_that_tell_nothing_are_refused():
    panel, device = uinput(PANEL_B, "with a mouse"), UInput(MOUSE, name="mouse")
    folder, kept = Path("/run/with a mouse"), Path("/run/strokes.evemu")
    shutil.copytree(BOARD.folder, folder)
    text = (folder / "board.toml").read_text()
    text = text.replace('kind = "recording"\nrecording = "demo.evemu"\n', 'kind = "linux_input"\ndevice = "with a mouse"\n')
    assert "linux_input" in text
    (folder / "board.toml").write_text(text)
    program = "import sys; from controller.cli import main; sys.exit(main(sys.argv[1:]))"
    command = [sys.executable, "-c", program, "calibrate-touch", "--lag", "--board", str(folder), "--seconds", "5", "--write"]
    command += ["--reference", device.device.path, "--out", str(kept)]
    running = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    first = running.stderr.readline()
    assert "hold the mouse to the finger and slide both" in first, first + running.stderr.read()
    for k in range(50):
        send(panel, *finger(0, 5, 500 + k, 500), TOUCH)
        for _ in range(4):  # a fast mouse, as seen by the median of its periods, however slow this machine
            send(device, (e.EV_REL, e.REL_X, 1))
        time.sleep(0.01)
    out, errors = running.communicate()
    assert (running.returncode, out) == (78, ""), errors
    assert errors.startswith("haptic-panel: only 0 turns: slide to and fro"), errors
    assert (folder / "board.toml").read_text() == text
    recording = Recording.open(kept)
    assert sum(value for kind, _, value, _ in recording.events if kind == e.EV_REL) == 200
    slot, positions = 0, []
    for kind, code, value, _ in recording.events:
        if (kind, code) == (e.EV_ABS, e.ABS_MT_SLOT):
            slot = value
        elif (kind, code, slot) == (e.EV_ABS, e.ABS_MT_POSITION_X, 0):  # the recording begins with the state of every slot
            positions.append(value)
    assert positions == sorted(positions), positions
    assert positions[-1] == 549
    assert len(set(positions)) > 10
    panel.close()
    device.close()


# ---- panels on an I2C bus


@contextlib.contextmanager
def bench(chip, names=True):
    """A chip at the far end of the bus, its interrupt and reset pins on GPIO lines, with names or without."""
    lines = GpioLines("panel", ["TOUCH_INT", "TOUCH_RST"], named=names)
    lines.pull("TOUCH_INT", 1)
    lines.pull("TOUCH_RST", 1)
    far_end = FarEnd(chip, lines)
    try:
        yield far_end
    finally:
        far_end.close()
        lines.close()


@contextlib.contextmanager
def opened(reader):
    source = LiveSource(reader, BOARD)
    try:
        yield source
    finally:
        source.close()


def gt911(**more):
    settings = {"bus": bus_path(), "interrupt_chip": "panel", "interrupt_line": "TOUCH_INT", **AXES_MM, **more}
    return open_gt911(Gt911Touch(**settings))


def ft5x06(**more):
    settings = {
        "bus": bus_path(),
        "interrupt_chip": "panel",
        "interrupt_line": "TOUCH_INT",
        "width": 2100,
        "height": 1480,
        **AXES_MM,
    }
    return open_ft5x06(Ft5x06Touch(**(settings | more)))


def test_a_gt911_is_reset_to_either_address_and_tells_its_resolution():
    for address in (0x5D, 0x14):
        chip = Gt911Chip(width=2100, height=1480)
        with bench(chip) as far_end, opened(gt911(address=address, reset_line="TOUCH_RST")) as source:
            assert chip.address == address
            assert (source.axes.x.maximum, source.axes.y.maximum) == (2100, 1480)
            before_s = time.monotonic()
            far_end.touch({0: (100, 200), 3: (300, 400)}, size=75)
            samples = until(source, 2)
            assert places(samples) == [(0, 10, 20, True), (1, 30, 40, True)]
            assert [round(s.size_m * 1e3, 6) for s in samples] == [7.5, 7.5]
            assert samples[0].time_s >= before_s  # of the edge
            assert not source.warnings


def test_a_gt911_without_reset_line_is_found_at_its_other_address_and_every_report_is_cleared():
    chip = Gt911Chip(width=2100, height=1480, contacts=10, trigger=0)
    with bench(chip) as far_end, opened(gt911(address=0x14)) as source:
        clears = chip.clears
        far_end.touch({number: (200 * number + 1, 100 * number) for number in range(10)})
        assert [place[1:3] for place in places(until(source, 10))] == [(20 * k + 0.1, 10 * k) for k in range(10)]
        far_end.touch({4: (801, 400)})
        assert len(until(source, 9)) == 9
        far_end.touch({})
        until(source, 1)
        assert chip.clears == clears + 3
        assert chip.lost_reports == 0
        assert source.counts.max_fingers == 10


def test_a_report_that_is_not_ready_at_its_edge_is_waited_for():
    chip = Gt911Chip(width=2100, height=1480)
    with bench(chip) as far_end, opened(gt911()) as source:
        until(source, condition=lambda: chip.transfers > 6)  # what it had at its start was read
        with far_end.lock:
            chip.late = 3
        before_s = time.monotonic()
        far_end.touch({0: (100, 200)})
        (sample,) = until(source, 1)
        assert chip.late == 0
        assert before_s <= sample.time_s


def test_missed_edges_do_not_silence_a_panel_and_are_said():
    chip = Gt911Chip(width=2100, height=1480)
    with bench(chip) as far_end, opened(gt911()) as source:
        far_end.touch({0: (100, 200)}, pulse=False)  # found by polling
        assert places(until(source, 1)) == [(0, 10, 20, True)]
        far_end.touch({0: (110, 200)}, pulse=False)
        assert places(until(source, 1)) == [(0, 11, 20, True)]
        far_end.touch({}, pulse=False)
        assert places(until(source, 1)) == [(0, 11, 20, False)]
        assert source.warnings == {"interrupt_silent": 1}


def test_lines_without_names_are_given_by_their_numbers_and_a_panel_without_lines_is_polled():
    chip = Ft5x06Chip()
    with bench(chip, names=False) as far_end:
        assert 'its lines have no names; a line without a name is given by its number, "0" to "1"' in raised(ft5x06)
        with opened(ft5x06(interrupt_line="0", reset_line="1")) as source:
            before_s = time.monotonic()
            far_end.touch({0: (100, 200)})
            (sample,) = until(source, 1)
            assert places([sample]) == [(0, 10, 20, True)]
            assert sample.time_s >= before_s
        with opened(ft5x06(interrupt_chip="", interrupt_line="")) as source:
            assert source.fileno() is None
            far_end.touch({0: (110, 200)})
            assert places(until(source, 1)) == [(0, 11, 20, True)]
            assert not source.warnings - Counter(stale_reports=10**6)


def test_a_gt911_that_goes_silent_about_a_finger_is_started_again():
    chip = Gt911Chip(width=2100, height=1480)
    with bench(chip) as far_end, opened(gt911()) as source:
        far_end.touch({0: (100, 200)})
        assert places(until(source, 2)) == [(0, 10, 20, True), (0, 10, 20, False)]
        assert source.warnings == {"contact_stuck": 1}
        until(source, condition=lambda: source.present)
        far_end.touch({0: (100, 200)})
        assert places(until(source, 1)) == [(1, 10, 20, True)]


def test_another_chip_at_the_address_is_refused():
    with bench(Gt911Chip(product=b"1158")):
        assert "'1158', which this driver does not support" in raised(gt911)
    with bench(Gt911Chip(width=0)):
        assert "width and height" in raised(gt911)
        gt911(width=100, height=100).close()


def test_an_absurd_report_is_skipped_and_the_next_one_read():
    chip = Gt911Chip(width=2100, height=1480)
    with bench(chip) as far_end, opened(gt911()) as source:
        far_end.touch({0: (100, 200)}, status=0x8F)
        until(source, condition=lambda: source.warnings["report_absurd"] == 1)
        far_end.touch({0: (100, 200)})
        assert places(until(source, 1)) == [(0, 10, 20, True)]


def test_a_chip_that_does_not_acknowledge_is_asked_again_and_one_that_is_silent_is_lost_and_started_when_it_is_back():
    chip = Gt911Chip(width=2100, height=1480)
    with bench(chip) as far_end, opened(gt911(reset_line="TOUCH_RST")) as source:
        far_end.touch({0: (100, 200)}, pulse=False)
        with far_end.lock:
            chip.nacks = 2
        assert places(until(source, 1)) == [(0, 10, 20, True)]
        assert source.warnings == {"bus_retried": 2}
        with far_end.lock:
            chip.silent = True
        assert places(until(source, 1)) == [(0, 10, 20, False)]
        assert not source.present
        assert source.warnings["panel_lost"] == 1
        transfers = chip.transfers
        until(source, condition=lambda: chip.transfers > transfers + 2)  # it is looked for in vain
        assert not source.present
        with far_end.lock:
            chip.silent = False
        until(source, condition=lambda: source.present)
        far_end.touch({0: (300, 400)})
        assert places(until(source, 1)) == [(1, 30, 40, True)]
        assert chip.registers[STATUS] == 0


def test_a_hung_bus_costs_one_time_out_and_the_panel_until_it_is_free():
    chip = Gt911Chip(width=2100, height=1480)
    with bench(chip) as far_end, opened(gt911()) as source:
        far_end.touch({0: (100, 200)})
        until(source, 1)
        with far_end.lock:
            chip.hangs = True
        assert places(until(source, 1)) == [(0, 10, 20, False)]
        assert source.warnings == {"panel_lost": 1}  # not tried again at once
        until(source, condition=lambda: source.present)
        far_end.touch({0: (100, 200)})
        assert places(until(source, 1)) == [(1, 10, 20, True)]


def test_an_ft5x06_tells_up_to_ten_fingers_and_no_ghosts():
    chip = Ft5x06Chip()
    with bench(chip) as far_end, opened(ft5x06(reset_line="TOUCH_RST")) as source:
        assert chip.registers[0xA4] == 1  # a pulse for each report
        chip.ghosts = 1
        far_end.touch({0: (100, 200)})
        assert places(until(source, 1)) == [(0, 10, 20, True)]
        assert source.warnings["ghost_points"] >= 1
        chip.ghosts = 0
        far_end.touch({number: (200 * number + 1, 100 * number) for number in range(10)})
        until(source, 10)
        far_end.touch({5: (1001, 500)})
        assert len(until(source, 9)) == 9
        far_end.touch({})
        assert places(until(source, 1)) == [(5, 100.1, 50, False)]
        assert source.counts.max_fingers == 10


def test_what_an_ft5x06_holds_from_before_its_start_is_not_a_touch():
    chip = Ft5x06Chip()
    chip.touch({0: (100, 200)})
    with bench(chip) as far_end, opened(ft5x06()) as source:
        until(source, condition=lambda: source.warnings["stale_reports"] >= 1)
        assert source.counts.contacts == 0
        far_end.touch({0: (110, 200)})
        assert places(until(source, 1)) == [(0, 11, 20, True)]


def test_an_ft5x06_that_loses_its_power_is_set_to_work_again():
    chip = Ft5x06Chip()
    with bench(chip) as far_end, opened(ft5x06()) as source:
        far_end.touch({0: (100, 200)})
        until(source, 1)
        with far_end.lock:
            chip.silent = True
        assert places(until(source, 1)) == [(0, 10, 20, False)]
        with far_end.lock:
            chip.touch({})
            chip.power_up()
            assert chip.registers[0xA4] == 0
            chip.silent = False
        until(source, condition=lambda: source.present)
        assert chip.registers[0xA4] == 1
        far_end.touch({0: (100, 200)})
        assert places(until(source, 1)) == [(1, 10, 20, True)]


def test_lines_and_buses_that_are_not_there_are_named():
    assert "no GPIO chip has the label 'panel'" in raised(gt911)
    with bench(Gt911Chip()) as far_end:
        assert "has no line named 'NO_SUCH'" in raised(lambda: gt911(interrupt_line="NO_SUCH"))
        assert "no I2C bus /dev/i2c-99" in raised(lambda: gt911(bus="/dev/i2c-99"))
        with far_end.lock:
            far_end.chip.silent = True
        assert "does not answer" in raised(gt911)
        assert os.strerror(errno.ENXIO) in raised(gt911)
        with far_end.lock:
            far_end.chip.silent = False
        first = gt911()
        assert "is in use by another program" in raised(gt911)
        first.close()
        gt911().close()
