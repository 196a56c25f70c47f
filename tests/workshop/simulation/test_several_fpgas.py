"""A panel of several FPGAs through the real loop: its pins and its foci are those of the same panel with one."""

import shutil

import msgspec
import numpy as np
import pytest
from scripted_evemu import evemu

from controller.cli import main
from controller.device.bank.reader import Bank
from controller.device.board.devices import LinkedFpga
from controller.device.board.paths import bank_path, fpga_files
from controller.device.scene.scene import load_scene
from controller.device.touch.recordings.recording import Recording
from controller.errors import BankError
from controller.workshop.bank_builder.own_bank import own_bank
from controller.workshop.simulation.focus_evaluation import judge
from controller.workshop.simulation.simulated_run import play

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
    runs = []
    for on in (board, split):
        scene = load_scene(scene_file, on)
        with own_bank(on, scene, scene_file) as bank:
            runs.append(play(on, scene, bank, Recording(evemu(*touches)), real_time=False))
    whole, parts = runs
    (one,), (first, second) = whole.captures, parts.captures
    assert len(one.focus_ticks) == len(first.focus_ticks) == len(second.focus_ticks) > 1
    assert np.array_equal(first.focus_ticks, second.focus_ticks)
    lone = [
        capture.words[np.searchsorted(capture.ticks, capture.focus_ticks[0] - np.arange(1, 1000) * board.bit_ticks, "right") - 1]
        for capture in (one, first, second)
    ]
    assert np.mean((lone[1] | lone[2] << 16) == lone[0]) > 0.9  # responses are rounded by the largest of each FPGA
    foci, same = (judge(run).foci for run in runs)
    assert [focus.metrics.amplitude_m for focus in foci] == pytest.approx([f.metrics.amplitude_m for f in same], rel=0.05)
    assert min(focus.exact_share for focus in same) > 0.95
    refused_without_the_others(split, bank_path(split))


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


def test_commands_for_one_fpga_refuse_a_board_of_several_in_one_line(capsys):
    for command in (["focus", "--at", "100", "70"], ["gateware", "load"], ["calibrate", "plan"], ["serve", "/nowhere/socket"]):
        assert main([*command, "--board", "simulated_64"]) == 78, command
        out, err = capsys.readouterr()
        assert not out
        assert len(err.splitlines()) == 1
        assert "link.fpga: this serves boards of one FPGA; with 2 there are" in err
