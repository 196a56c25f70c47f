"""A panel of several FPGAs through the real loop: its pins and its foci are those of the same panel with one."""

import os
import re
import shutil
import signal
import subprocess
import sys

import msgspec
import numpy as np
import pytest
from scripted_evemu import evemu
from tables import each_row

from controller.cli import main
from controller.clocks import VirtualClock
from controller.device.application_socket.client import PanelClient
from controller.device.bank.reader import Bank
from controller.device.board.board import load_board
from controller.device.board.devices import LinkedFpga
from controller.device.board.lookup import find_board, fpga_files
from controller.device.board.panel import Compose
from controller.device.board.paths import bank_path
from controller.device.board.plate.patches import Patches
from controller.device.fpga.frames import parted
from controller.device.scene.scene import load_scene
from controller.device.service.drivers import open_session
from controller.device.touch.recordings.recording import Recording
from controller.device.waveforms.channel_test import chirp_words
from controller.device.waveforms.wide_selection import selection_of
from controller.errors import BankError
from controller.workshop.bank_builder.own_bank import own_bank
from controller.workshop.benchmark.focus.focus_emission import emission_at, emission_figures, evaluated_foci
from controller.workshop.gateware.wired_fpgas import SimulatedFpgas
from controller.workshop.physics.modes.plate_modes import modes_of
from controller.workshop.simulation.drift import ASSUMED, Drift
from controller.workshop.simulation.focus_evaluation import judge
from controller.workshop.simulation.ghostly_panel import pins_of
from controller.workshop.simulation.simulated_run import Hardware, play

SCENE = """
[[regions]]
name = "keys"
shape = "rectangle"
x_mm = 75.0
y_mm = 65.0
width_mm = 50.0
height_mm = 10.0
effects = ["click"]
"""


@pytest.fixture
def split(board):
    """The simulated panel, the second half of its patches on an FPGA of their own."""
    patches = tuple(msgspec.structs.replace(a, channel=a.channel + 16 * (a.channel >= 16)) for a in board.actuators)
    link = msgspec.structs.replace(board.link, fpga=(LinkedFpga(), LinkedFpga()))
    return msgspec.structs.replace(board, actuators=patches, link=link)


def test_a_panel_split_between_two_fpgas_plays_as_one(board, split, tmp_path, monkeypatch):
    monkeypatch.setenv("STATE_DIRECTORY", str(tmp_path))
    scene_file = tmp_path / "scene.toml"
    scene_file.write_text(SCENE)
    touches = [(0.1, {0: (105.0, 70.0)}), (0.2, {0: None}), (0.4, {0: (80.0, 70.0), 1: (120.0, 71.0)}), (0.5, {0: None, 1: None})]
    runs, said_um = [], []
    for on in (board, split):
        scene = load_scene(scene_file, on)
        with own_bank(on, scene, scene_file) as bank:
            runs.append(play(on, scene, bank, Recording(evemu(*touches)), real_time=False))
            said_um.append(bank.header.amplitude_um)
    whole, parts = runs
    assert said_um[1] == pytest.approx(said_um[0], rel=0.05)
    one, both = whole.capture, parts.capture
    assert len(one.focus_ticks) == len(both.focus_ticks) > 1
    lone, halves = (
        capture.words[np.searchsorted(capture.ticks, capture.focus_ticks[0] - np.arange(1, 1000) * board.bit_ticks, "right") - 1]
        for capture in (one, both)
    )
    assert np.mean((halves[:, 0] | halves[:, 1] << 16) == lone) > 0.9  # responses are rounded by the largest of each FPGA
    foci, same = (judge(run).foci for run in runs)
    assert [focus.metrics.amplitude_m for focus in foci] == pytest.approx([f.metrics.amplitude_m for f in same], rel=0.05)
    assert min(focus.exact_share for focus in same) > 0.95
    one_channel_chirps_alone(split, bank_path(split))
    followed_by_the_bit_clock(split, bank_path(split), scene_file, Recording(evemu(*touches)))
    refused_without_the_others(split, bank_path(split))


def one_channel_chirps_alone(split, path):
    """The chirp is that of the channel's own FPGA; the other one rests."""
    first, second = split.fpga_boards
    waveform = split.waveform
    with Bank.open(path, split) as bank:
        selection = selection_of(bank, split, 0.0)
        words = parted(selection.waveform(selection.channel_key(35)), 2)
    assert np.frombuffer(words[0], "<u4").tolist() == [first.idle_word] * waveform.samples
    assert bytes(words[1]) == bytes(chirp_words(3, waveform.samples, waveform.bit_clock_hz, second.idle_word, waveform.band_hz))


def followed_by_the_bit_clock(split, path, scene_file, recording):
    """The plate of all FPGAs drifts, and the bit clock of each follows."""
    shares = []
    for sensor in (ASSUMED, None):
        on = msgspec.structs.replace(split, temperature=sensor)
        scene = load_scene(scene_file, on)
        with Bank.open(path, split) as bank:
            run = play(on, scene, bank, recording, real_time=False, hardware=Hardware(drift=Drift.constant(-1.0)))
        shares.append(min(focus.exact_share for focus in judge(run).foci))
    assert shares[0] > 0.95
    assert shares[1] < 0.6


def refused_without_the_others(split, path):
    """A bank is that of all FPGAs, or none."""
    first, second = fpga_files(path, 2)
    Bank.open(path, split).close()
    shutil.copy(first, second)
    with pytest.raises(BankError, match="was built for another board"):
        Bank.open(path, split)
    second.unlink()
    with pytest.raises(BankError, match="cannot be read"):
        Bank.open(path, split)


@each_row(
    "changes",
    [
        {"compose": Compose(method="compact", max_error=0.3)},
        {"compose": Compose(method="auto", max_error=0.3)},
        {"patches": Patches(mass_kg_m2=3.0, stiffness_ratio=1.5)},
    ],
    ids=["compact", "auto", "patches that stiffen the plate"],
)
def test_banks_of_any_kind_are_as_of_the_same_panel_with_one(changes, tmp_path, monkeypatch):
    monkeypatch.setenv("STATE_DIRECTORY", str(tmp_path))
    scene_file = tmp_path / "scene.toml"
    scene_file.write_text(SCENE.replace("75.0", "25.0").replace("65.0", "20.0").replace("50.0", "10.0"))
    found = []
    for fpgas in (1, 2):
        on = msgspec.structs.replace(small_board(fpgas), **changes, folder=tmp_path / str(fpgas))
        scene = load_scene(scene_file, on)
        with own_bank(on, scene, scene_file) as bank:
            found.append((bank.header.amplitude_um, bank.grid, bank.header.compact is None))
        written_ns = [file.stat().st_mtime_ns for file in fpga_files(bank_path(on), fpgas)]
        own_bank(on, scene, scene_file).close()
        assert [file.stat().st_mtime_ns for file in fpga_files(bank_path(on), fpgas)] == written_ns, "it suits"
        modes = {modes_of(one).count for one in (on, *on.fpga_boards)}
        assert len(modes) == 1, "the plate of each has the patches of all"
    (one_um, *one), (two_um, *two) = found
    assert two == one
    assert two_um == pytest.approx(one_um, rel=0.1)


def small_board(fpgas):
    """A plate of 60 by 50 mm with four discs, the last two of which two FPGAs leave to the second."""
    board = load_board(find_board("simulated"))
    corners = [(x, y) for x in (10.0, 45.0) for y in (10.0, 35.0)]
    places = [(x + dx, y + dy) for x, y in corners for dx in (0.0, 5.0) for dy in (0.0, 5.0)]
    patches = tuple(
        msgspec.structs.replace(board.actuators[n], channel=n + 24 * (fpgas > 1 and n >= 8), x_mm=x, y_mm=y)
        for n, (x, y) in enumerate(places)
    )
    plate = msgspec.structs.replace(board.plate, length_mm=60.0, width_mm=50.0)
    link = msgspec.structs.replace(board.link, fpga=(LinkedFpga(),) * fpgas if fpgas > 1 else ())
    waveform = msgspec.structs.replace(board.waveform, duration_ms=0.4)  # how compact banks are made takes its square
    return msgspec.structs.replace(board, plate=plate, actuators=patches, link=link, waveform=waveform)


def test_a_focus_of_both_is_that_of_the_same_patches_on_one(board, split):
    points_m = [(0.1, 0.07), (0.06, 0.09)]
    one, both = (emission_at(on, points_m) for on in (board, split))
    period_s = board.waveform.duration_s
    for whole, parts in zip(evaluated_foci(one, period_s), evaluated_foci(both, period_s), strict=True):
        assert parts == {name: value if isinstance(value, str) else pytest.approx(value, rel=1e-6) for name, value in whole.items()}
    whole, parts = (emission_figures(one, period_s) for one in (one, both))
    assert parts["stages_uj"] == pytest.approx(whole["stages_uj"], rel=1e-6)
    assert [row["channel"] for row in parts["channels"]] == [*range(16), *range(32, 48)]
    assert parts["sound"] == pytest.approx(whole["sound"], abs=0.1)


def test_what_disturbs_a_touch_panel_are_the_pins_of_all(split):
    clock = VirtualClock()
    link = SimulatedFpgas(split, clock.now_s)
    moved = pins_of(link)
    session = open_session(link, split, clock.now_s)
    assert not moved(clock.now_s())
    one = session._others[0]
    one.arm()
    clock._now_s = link.wire_free_s() + 5e-3
    assert moved(clock.now_s())


def test_it_is_served_as_one_panel(tmp_path):
    """A plate with a disc of each FPGA, whose bank takes no time."""
    text = (find_board("simulated_64") / "board.toml").read_text()
    for whole, short in (
        ("length_mm = 210.0", "length_mm = 100.0"),
        ("width_mm = 148.0", "width_mm = 60.0"),
        ("../simulated/scene.toml", "keys.toml"),
    ):
        assert text.count(whole) == 1
        text = text.replace(whole, short)
    text = re.sub(r"    \{ channel = +(\d+), .*\n", lambda line: line[0] if int(line[1]) % 32 < 4 else "", text)
    (tmp_path / "board.toml").write_text(text)
    (tmp_path / "keys.toml").write_text(SCENE.replace("width_mm = 50", "width_mm = 20").replace("y_mm = 65", "y_mm = 45"))
    socket = tmp_path / "panel.sock"
    command = [sys.executable, "-m", "controller", "serve", "--background", "--board", str(tmp_path), "--fingers", "0", str(socket)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    try:
        with PanelClient(str(socket), timeout_s=60.0) as panel:
            assert panel.test_channel(33).outcome == "played"
            assert panel.play("click", at_mm=(45.0, 30.0)).outcome == "played"
            assert panel.test_channel(31).reason == "channel 31 drives no actuator of board 'simulated_64'"
            assert [patch.channel for patch in panel.describe().patches] == [0, 1, 2, 3, 32, 33, 34, 35]
    finally:
        os.kill(int(re.search(r"`kill (\d+)`", done.stderr)[1]), signal.SIGTERM)


def test_commands_for_one_fpga_refuse_a_board_of_several_in_one_line(capsys):
    for command in (["gateware", "waves"], ["benchmark", "paper"]):
        assert main([*command, "--board", "simulated_64"]) == 78, command
        out, err = capsys.readouterr()
        assert not out
        assert len(err.splitlines()) == 1
        assert "link.fpga: this serves boards of one FPGA, not of 2" in err
